//! Texts of interfaces: `.msg`, `.srv` and `.action` files.

mod description;
mod line;

pub(crate) use description::parse_package;
use line::{Member, parse_line};

use crate::name::is_identifier;
use crate::{Generation, Interface, InterfaceError, Structure, TypeName, limits};

/// Reads the text of one interface. `file` is for error messages.
///
/// # Errors
/// File, line, and what is wrong there.
pub fn parse(
    name: &TypeName,
    text: &str,
    generation: Generation,
    file: &str,
) -> Result<Interface, InterfaceError> {
    let numbered = (1..).zip(text.lines());
    let file = TextFile {
        file,
        generation,
        package: &name.package,
    };
    if text.len() > limits::TEXT {
        return Err(file.error(1, format!("the text has more than {} bytes", limits::TEXT)));
    }
    Ok(Interface {
        name: name.clone(),
        parts: file.parts(name, numbered)?,
    })
}

/// Where lines come from.
#[derive(Clone, Copy)]
struct TextFile<'a> {
    file: &'a str,
    generation: Generation,
    /// Nested types without a package are of this one.
    package: &'a str,
}

impl TextFile<'_> {
    fn error(self, line: usize, problem: impl Into<String>) -> InterfaceError {
        InterfaceError::Text {
            file: self.file.into(),
            line,
            problem: problem.into(),
        }
    }

    /// The structures between lines of three dashes.
    fn parts<'a>(
        self,
        name: &TypeName,
        lines: impl Iterator<Item = (usize, &'a str)>,
    ) -> Result<Vec<Structure>, InterfaceError> {
        let mut parts = vec![Structure::default()];
        let mut last = 0;
        for (number, line) in lines {
            last = number;
            if line.trim() == "---" {
                parts.push(Structure::default());
            } else if let Some(member) =
                parse_line(line, self).map_err(|problem| self.error(number, problem))?
            {
                let part = parts.last_mut().expect("there is at least one");
                part.add(member)
                    .map_err(|problem| self.error(number, problem))?;
            }
        }
        let expected = name.kind.parts();
        if parts.len() != expected {
            let found = parts.len();
            return Err(self.error(
                last.max(1),
                format!("{found} parts between lines of ---, where {expected} are expected"),
            ));
        }
        Ok(parts)
    }
}

impl Structure {
    fn add(&mut self, member: Member) -> Result<(), String> {
        let name = member.name();
        if !is_identifier(name) {
            return Err(format!("'{name}' is no name"));
        }
        let taken = self.fields.iter().any(|field| field.name == name)
            || self.constants.iter().any(|constant| constant.name == name);
        if taken {
            return Err(format!("there is a '{name}' already"));
        }
        if self.fields.len() + self.constants.len() == limits::MEMBERS {
            return Err(format!(
                "more than {} fields and constants",
                limits::MEMBERS
            ));
        }
        match member {
            Member::Constant(constant) => self.constants.push(constant),
            Member::Field(field) => self.fields.push(field),
        }
        Ok(())
    }
}
