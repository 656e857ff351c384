//! The compact form of the built-in descriptions: several interfaces of a package in one text.
//!
//! A line at the margin names an interface (`msg Pose`); indented lines are its text, with `;` between members.

use super::TextFile;
use crate::{Generation, Interface, InterfaceError, InterfaceKind, TypeName};

/// Reads the description of a package.
pub(crate) fn parse_package(
    package: &str,
    text: &str,
    generation: Generation,
) -> Result<Vec<Interface>, InterfaceError> {
    let file = TextFile {
        file: package,
        generation,
        package,
    };
    let mut interfaces = Vec::new();
    let mut heading = None;
    let mut body: Vec<(usize, &str)> = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        if line.starts_with(' ') {
            body.extend(line.split(';').map(|member| (number, member)));
        } else if !line.is_empty() && !line.starts_with('#') {
            finish(file, heading.take(), &mut body, &mut interfaces)?;
            heading = Some(parse_heading(file, number, line)?);
        }
    }
    finish(file, heading, &mut body, &mut interfaces)?;
    Ok(interfaces)
}

fn parse_heading(file: TextFile, number: usize, line: &str) -> Result<TypeName, InterfaceError> {
    let (kind, name) = line
        .split_once(' ')
        .ok_or_else(|| file.error(number, "no heading"))?;
    let kind =
        InterfaceKind::of_word(kind).ok_or_else(|| file.error(number, "no kind of interface"))?;
    TypeName::new(file.package, kind, name)
}

fn finish(
    file: TextFile,
    heading: Option<TypeName>,
    body: &mut Vec<(usize, &str)>,
    interfaces: &mut Vec<Interface>,
) -> Result<(), InterfaceError> {
    if let Some(name) = heading {
        let parts = file.parts(&name, body.drain(..))?;
        interfaces.push(Interface { name, parts });
    }
    Ok(())
}
