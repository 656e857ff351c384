//! Loading code: only files that may be read, and only text where native code is not allowed. Modified bytecode makes Lua write where it
//! should not, so it counts as native code.

use std::ffi::c_int;
use std::fs::File;
use std::path::Path;

use super::super::calls::callback::push_callback;
use super::super::calls::guard::{Next, guarded, install as guard};
use super::super::{Stack, Type};
use super::{c_text, or_raise, path, permissions, unless_denied};
use permissions::c_path;

pub(super) fn install(stack: Stack<'_>) {
    stack.push_globals();
    guard::<{ guarded::LOAD }, _>(stack, "load", load);
    guard::<{ guarded::LOAD_FILE }, _>(stack, "loadfile", load_file);
    stack.pop(1);
    stack.push_global("package");
    guard::<{ guarded::LOAD_LIBRARY }, _>(stack, "loadlib", load_library);
    stack.pop(1);
    install_search(stack);
}

/// Puts ours in place of Lua's search for files.
pub(super) fn install_search(stack: Stack<'_>) {
    stack.push_global("package");
    push_callback(stack, search_path, 0);
    stack.raw_set_field(-2, "searchpath");
    stack.pop(1);
}

fn load(stack: Stack<'_>) -> Next {
    set_text_mode(stack, 3)
}

fn load_file(stack: Stack<'_>) -> Next {
    let checked = path(stack, 1).map_or(Ok(()), |path| permissions(stack).check_read(&path));
    match unless_denied(stack, checked) {
        Next::Original => set_text_mode(stack, 2),
        refused => refused,
    }
}

/// Lua's function is to see the mode for text, in that argument.
fn set_text_mode(stack: Stack<'_>, mode: c_int) -> Next {
    let Err(denied) = permissions(stack).check_native("bytecode") else {
        return Next::Original;
    };
    while stack.top() < mode {
        stack.push_nil();
    }
    match stack.kind(mode) {
        Type::Nil => {}
        Type::String if stack.with_bytes(mode, |mode| mode.contains(&b't')) == Some(true) => {}
        Type::String => {
            stack.push_nil();
            stack.push_bytes(denied.to_string().as_bytes());
            return Next::Return(2);
        }
        // Lua's function reports the error.
        _ => return Next::Original,
    }
    stack.push_bytes(b"t");
    stack.insert(mode);
    stack.remove(mode + 1);
    Next::Original
}

fn load_library(stack: Stack<'_>) -> Next {
    or_raise(
        stack,
        permissions(stack).check_native("loading native libraries"),
    )
}

/// `package.searchpath(name, path, separator, replacement)`: the first file that is there, of those that may be read.
fn search_path(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let needed =
        |index| c_text(stack, index).ok_or_else(|| stack.argument_error(index, "string expected"));
    let optional =
        |index, default: &[u8]| match stack.top() < index || stack.kind(index) == Type::Nil {
            true => Ok(default.to_vec()),
            false => needed(index),
        };
    let (name, templates) = (needed(1)?, needed(2)?);
    let (separator, replacement) = (
        optional(3, b".")?,
        optional(4, std::path::MAIN_SEPARATOR_STR.as_bytes())?,
    );
    let name = if separator.is_empty() {
        name
    } else {
        replaced(&name, &separator, &replacement)
    };
    let mut missing = Vec::new();
    for template in templates.split(|&byte| byte == b';') {
        let file = replaced(template, b"?", &name);
        let path = c_path(&file);
        let checked = permissions(stack).check_read(&path);
        if checked.is_ok() && can_be_opened(stack, &path) {
            stack.push_bytes(&file);
            return Ok(1);
        }
        let reason = checked.err().map(|_| " that may be read");
        missing.push(
            [
                b"no file '".as_slice(),
                &file,
                b"'",
                reason.unwrap_or_default().as_bytes(),
            ]
            .concat(),
        );
    }
    stack.push_nil();
    stack.push_bytes(&missing.join(b"\n\t".as_slice()));
    Ok(2)
}

fn can_be_opened(stack: Stack<'_>, path: &Path) -> bool {
    let tape = stack.tape();
    if !tape.is_on() {
        return File::open(path).is_ok();
    }
    let kind = format!("whether there is a file {}", path.display());
    let opened = tape.input(&kind, || File::open(path).is_ok());
    opened.unwrap_or_default()
}

fn replaced(text: &[u8], pattern: &[u8], replacement: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(text.len());
    let mut rest = text;
    while let Some(&first) = rest.first() {
        if let Some(after) = rest.strip_prefix(pattern) {
            out.extend_from_slice(replacement);
            rest = after;
        } else {
            out.push(first);
            rest = &rest[1..];
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::replaced;

    #[test]
    fn every_occurrence_is_replaced() {
        assert_eq!(replaced(b"a.b.c", b".", b"/"), b"a/b/c");
        assert_eq!(replaced(b"./?.lua", b"?", b"??"), b"./??.lua");
        assert_eq!(replaced(b"...", b"..", b""), b".");
        assert_eq!(replaced(b"", b".", b"/"), b"");
    }
}
