//! The callbacks of scripts: their page and their editor stubs.

use std::fmt::Write as _;

/// One line for each: name, scripts that have it, arguments, fields of the result, when it is called, and how it differs here.
///
/// Arguments are `name type; name type`, or `name: field type, field type` for a table.
const TABLE: &str = include_str!("callbacks.tsv");

/// The names of all callbacks.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    TABLE.lines().filter_map(|line| line.split('\t').next())
}

/// Name, the line that begins its definition, and when it is called.
pub(crate) fn summaries() -> impl Iterator<Item = (&'static str, String, &'static str)> {
    all().map(|callback| {
        let signature = format!("function {}({})", callback.name, callback.parameters());
        (callback.name, signature, callback.when)
    })
}

struct Callback {
    name: &'static str,
    scripts: &'static str,
    arguments: Vec<Argument>,
    results: Vec<Field>,
    when: &'static str,
    /// Empty where it is called as in CoppeliaSim.
    difference: &'static str,
}

struct Argument {
    field: Field,
    /// Fields of a table, where they are known.
    fields: Vec<Field>,
}

struct Field {
    name: &'static str,
    ty: &'static str,
}

impl Field {
    fn read(text: &'static str) -> Option<Self> {
        let (name, ty) = text.trim().split_once(' ')?;
        Some(Self { name, ty })
    }

    fn list(text: &'static str) -> Vec<Self> {
        text.split(',').filter_map(Self::read).collect()
    }
}

fn all() -> impl Iterator<Item = Callback> {
    TABLE.lines().map(|line| {
        let mut columns = line.split('\t');
        let mut next = || columns.next().unwrap_or_default();
        let (name, scripts, arguments) = (next(), next(), arguments(next()));
        Callback {
            name,
            scripts,
            arguments,
            results: Field::list(next()),
            when: next(),
            difference: next(),
        }
    })
}

fn arguments(text: &'static str) -> Vec<Argument> {
    if let Some((name, fields)) = text.split_once(':') {
        return vec![Argument {
            field: Field { name, ty: "table" },
            fields: Field::list(fields),
        }];
    }
    text.split(';')
        .filter_map(Field::read)
        .map(|field| Argument {
            field,
            fields: Vec::new(),
        })
        .collect()
}

impl Callback {
    fn parameters(&self) -> String {
        let names: Vec<&str> = self
            .arguments
            .iter()
            .map(|argument| argument.field.name)
            .collect();
        names.join(", ")
    }

    /// Its description as a sentence.
    fn sentence(&self) -> String {
        let mut letters = self.when.chars();
        let first = letters
            .next()
            .map(|letter| letter.to_uppercase().to_string())
            .unwrap_or_default();
        format!("{first}{}.", letters.as_str())
    }
}

/// `docs/CALLBACKS.md`.
pub(super) fn text() -> String {
    let mut out = String::from(
        "# Callbacks\n\nGenerated from the sources: `UPDATE=1 cargo test --test repository generated`. A script is called by defining global functions with these \
         names. Which it has is determined when its text has run; only `sysCall_actuation`, `sysCall_nonSimulation` and `sysCall_cleanup` may be defined \
         later. The result of a callback is a table with the listed fields, all optional; `cmd` is `'cleanup'`, which ends the script, or \
         `'restart'`. `swanilda init` sets up an editor that completes the names and shows the arguments. \
         The order of calls is in [spec/callbacks](spec/callbacks.md).\n\n| callback | when | scripts |\n|---|---|---|\n",
    );
    for callback in all() {
        let Callback {
            name,
            scripts,
            when,
            difference,
            ..
        } = callback;
        let difference = if difference.is_empty() {
            String::new()
        } else {
            format!("; **{difference}**")
        };
        let _ = writeln!(
            out,
            "| [`{name}`](#{}) | {when}{difference} | {scripts} |",
            name.to_lowercase()
        );
    }
    for callback in all() {
        out.push_str(&section(&callback));
    }
    out
}

fn section(callback: &Callback) -> String {
    let mut out = format!(
        "\n## {}\n\n```lua\nfunction {0}({})\n```\n\n{}\n",
        callback.name,
        callback.parameters(),
        callback.sentence()
    );
    if !callback.difference.is_empty() {
        let _ = writeln!(out, "\nIn Swanilda: {}.", callback.difference);
    }
    for Argument { field, fields } in &callback.arguments {
        let _ = writeln!(
            out,
            "\n- `{}`: {}{}",
            field.name,
            field.ty,
            if fields.is_empty() { "" } else { " with" }
        );
        fields
            .iter()
            .for_each(|field| out.push_str(&format!("  - `{}`: {}\n", field.name, field.ty)));
    }
    if !callback.results.is_empty() {
        out.push_str("\nResult:\n\n");
        callback
            .results
            .iter()
            .for_each(|field| out.push_str(&format!("- `{}`: {}\n", field.name, field.ty)));
    }
    out
}

/// The stub for editors.
pub(super) fn stub() -> String {
    let mut out = String::from(
        "---@meta\n\n-- Callbacks that scripts define, for editors. Generated by Swanilda; never run.\n",
    );
    for callback in all() {
        let table = |fields: &[Field]| {
            let fields: Vec<String> = fields
                .iter()
                .map(|field| format!("{}?: {}", field.name, field.ty))
                .collect();
            format!("{{ {} }}", fields.join(", "))
        };
        let _ = writeln!(out, "\n--- {}", callback.sentence());
        for Argument { field, fields } in &callback.arguments {
            let ty = if fields.is_empty() {
                field.ty.to_owned()
            } else {
                table(fields)
            };
            let _ = writeln!(out, "---@param {} {ty}", field.name);
        }
        if !callback.results.is_empty() {
            let _ = writeln!(out, "---@return {}? result", table(&callback.results));
        }
        let _ = writeln!(
            out,
            "function {}({}) end",
            callback.name,
            callback.parameters()
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::all;
    use script::SysCall;

    #[test]
    fn every_callback_is_described_once() {
        let described: Vec<&str> = all().map(|callback| callback.name).collect();
        let expected: BTreeSet<&str> = SysCall::ALL.iter().map(|call| call.name()).collect();
        assert_eq!(described.iter().copied().collect::<BTreeSet<_>>(), expected);
        assert_eq!(described.len(), expected.len());
    }

    #[test]
    fn arguments_and_results_are_read() {
        let joint = all()
            .find(|callback| callback.name == "sysCall_joint")
            .expect("it is described");
        assert_eq!(joint.parameters(), "inData");
        assert_eq!(joint.arguments[0].fields[0].name, "handle");
        let message = all()
            .find(|callback| callback.name == "sysCall_msg")
            .expect("it is described");
        assert_eq!(message.parameters(), "message, origin");
        assert!(all().all(|callback| !callback.when.is_empty()));
    }
}
