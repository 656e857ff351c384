//! Joins the modules of the page into one: each becomes a function that returns what it exports.
//!
//! The modules keep to a form (docs/VIEW_PROTOCOL.md, "One file"), so that lines are enough and no parser of JavaScript is needed.

use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The text of `main` and all modules it imports; None where one is missing or not in the form.
pub fn join(main: &str, read: &dyn Fn(&str) -> Option<String>) -> Option<String> {
    let mut bundle = Bundle {
        read,
        numbers: BTreeMap::new(),
        text: String::new(),
    };
    bundle.add(main, &mut Vec::new())?;
    Some(bundle.text)
}

/// A program without lines of comments, indentation and comments at the ends of lines, as far as they hold no quotes.
pub fn stripped(program: &str) -> String {
    let mut text = String::new();
    let mut is_comment = false;
    for line in program.lines().map(str::trim) {
        is_comment |= line.starts_with("/**");
        let ends = is_comment && line.contains("*/");
        let rest = if ends {
            line.rsplit_once("*/").map_or("", |(_, rest)| rest.trim())
        } else {
            line
        };
        if (!is_comment || ends) && !rest.is_empty() && !rest.starts_with("//") {
            text += without_remark(rest);
            text.push('\n');
        }
        is_comment &= !ends;
    }
    text
}

/// A line without the comment at its end.
fn without_remark(line: &str) -> &str {
    match line.rsplit_once(" // ") {
        Some((code, remark))
            if code.ends_with([';', ',', '{', '}', ')', ']'])
                && !remark.contains(['\'', '"', '`']) =>
        {
            code
        }
        _ => line,
    }
}

struct Bundle<'a> {
    read: &'a dyn Fn(&str) -> Option<String>,
    /// Of the modules that are in the text.
    numbers: BTreeMap<String, usize>,
    text: String,
}

impl Bundle<'_> {
    /// The number of a module, which is added with those that it imports before it.
    fn add(&mut self, name: &str, importers: &mut Vec<String>) -> Option<usize> {
        if let Some(number) = self.numbers.get(name) {
            return Some(*number);
        }
        if importers.iter().any(|importer| importer == name) {
            return None;
        }
        importers.push(name.to_owned());
        let (mut body, mut exports) = (String::new(), Vec::new());
        for line in (self.read)(name)?.lines() {
            let line = match (import(line), export(line)) {
                (Some((names, path)), _) => {
                    let number = self.add(&resolved(name, path)?, importers)?;
                    format!("const {{ {} }} = m{number};", names.replace(" as ", ": "))
                }
                (_, Some((rest, names))) => {
                    exports.extend(names);
                    rest.to_owned()
                }
                _ => line.to_owned(),
            };
            body += &(line + "\n");
        }
        importers.pop();
        let number = self.numbers.len();
        self.numbers.insert(name.to_owned(), number);
        let exports = exports.join(", ");
        writeln!(
            self.text,
            "// {name}\nconst m{number} = (() => {{\n{body}return {{ {exports} }};\n}})();"
        )
        .ok()?;
        Some(number)
    }
}

/// The names and the path of `import { a, b as c } from './d.js';`.
fn import(line: &str) -> Option<(&str, &str)> {
    let (names, rest) = line.strip_prefix("import {")?.split_once('}')?;
    let path = rest.trim().strip_prefix("from '")?.split_once('\'')?.0;
    Some((names.trim().trim_end_matches(','), path))
}

/// What is left of a line that exports, and the names.
fn export(line: &str) -> Option<(&str, Vec<String>)> {
    let rest = line.strip_prefix("export ")?;
    if let Some(names) = rest.strip_prefix('{') {
        let names = names
            .split_once('}')?
            .0
            .split(',')
            .map(|name| name.trim().to_owned());
        return Some(("", names.filter(|name| !name.is_empty()).collect()));
    }
    let mut words = rest
        .split([' ', '(', '*', '='])
        .filter(|word| !word.is_empty());
    let name = words.find(|word| !["async", "function", "class", "const", "let"].contains(word))?;
    Some((rest, vec![name.to_owned()]))
}

/// A path that the module `from` imports, below the page; None where it leaves that.
fn resolved(from: &str, path: &str) -> Option<String> {
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in path.split('/') {
        match part {
            "." => {}
            ".." => drop(parts.pop()?),
            name => parts.push(name),
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joined(files: &[(&str, &str)]) -> Option<String> {
        let read = |name: &str| {
            files
                .iter()
                .find(|(file, _)| *file == name)
                .map(|(_, text)| (*text).to_owned())
        };
        join("main.js", &read)
    }

    #[test]
    fn modules_come_after_those_they_import() {
        let text = joined(&[
            (
                "main.js",
                "import { a, b as c } from './gl/one.js';\nimport { two } from './two.js';\nstart(a, c);",
            ),
            (
                "gl/one.js",
                "import { two } from '../two.js';\nexport const a = two;\nexport async function b() {}",
            ),
            ("two.js", "export class two {}\nexport { three };\n"),
        ]);
        let expected = "// two.js\nconst m0 = (() => {\nclass two {}\n\nreturn { two, three };\n})();\n\
            // gl/one.js\nconst m1 = (() => {\nconst { two } = m0;\nconst a = two;\nasync function b() {}\nreturn { a, b };\n})();\n\
            // main.js\nconst m2 = (() => {\nconst { a, b: c } = m1;\nconst { two } = m0;\nstart(a, c);\nreturn {  };\n})();\n";
        assert_eq!(text.as_deref(), Some(expected));
    }

    #[test]
    fn comments_and_indentation_go_and_texts_stay() {
        let program = "// a\n/** b\n * c */\nf( // d\n  'x // y', // e\n  2); // don't\n/** @type {A} */ g();\n\nh('/** i');\n";
        assert_eq!(
            stripped(program),
            "f( // d\n'x // y',\n2); // don't\ng();\nh('/** i');\n"
        );
    }

    #[test]
    fn what_is_missing_or_a_cycle_is_noticed() {
        assert_eq!(joined(&[]), None);
        assert_eq!(joined(&[("main.js", "import { a } from './a.js';")]), None);
        assert_eq!(
            joined(&[("main.js", "import { a } from '../../a.js';")]),
            None
        );
        assert_eq!(
            joined(&[("main.js", "import { a } from './main.js';")]),
            None
        );
    }
}
