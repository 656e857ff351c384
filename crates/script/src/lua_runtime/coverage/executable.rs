//! The lines of a Lua text that can run, as Lua's compiler sees them: the lines of the instructions of all its functions.
//!
//! Instructions that are not statements of the text are left out: the return at the end of every function, and lines with only `end`,
//! `else` or brackets, to which the compiler assigns instructions of neighbouring lines.

use std::collections::BTreeSet;

use crate::coverage::FunctionLines;
use crate::lua::{Bytecode, Prototype};

/// The functions of a text and their lines that can run, sorted by first line. None if the text does not compile.
pub fn executable(text: &[u8]) -> Option<Vec<FunctionLines>> {
    let mut text = text.to_vec();
    if text.first() == Some(&b'#') {
        // As `lua` does for the first line of a file.
        text.splice(0..0, *b"--");
    }
    let bytecode = Bytecode::compile(&text, "=").ok()?;
    let mut found = Vec::new();
    let source: Vec<&[u8]> = text.split(|&byte| byte == b'\n').collect();
    add(&bytecode.main_function()?, &mut found, &source)?;
    found.sort();
    Some(found)
}

/// Adds a function and the functions inside it.
fn add(function: &Prototype<'_>, found: &mut Vec<FunctionLines>, source: &[&[u8]]) -> Option<()> {
    function
        .inner
        .iter()
        .try_for_each(|inner| add(inner, found, source))?;
    // The return at the end of every function is not in the text; the first instruction of a function with `...` only arranges its arguments.
    let (_, lines) = function.lines.split_last()?;
    let lines = lines.iter().skip(usize::from(function.is_vararg)).copied();
    let lines: BTreeSet<u32> = lines.filter(|&line| is_statement(source, line)).collect();
    let line = u32::try_from(function.line).ok()?;
    if !lines.is_empty() {
        found.push(FunctionLines {
            line,
            lines: lines.into_iter().collect(),
            name: name(line_of(source, line)),
        });
    }
    Some(())
}

fn line_of<'a>(source: &[&'a [u8]], line: u32) -> &'a [u8] {
    source
        .get(line.wrapping_sub(1) as usize)
        .copied()
        .unwrap_or_default()
}

/// Whether a line has more than `end`, `else` and brackets.
fn is_statement(source: &[&[u8]], line: u32) -> bool {
    let text = String::from_utf8_lossy(line_of(source, line));
    let code = text.split("--").next().unwrap_or_default();
    let words = code.split(|c: char| c.is_whitespace() || ")]},;".contains(c));
    words
        .filter(|word| !word.is_empty())
        .any(|word| !matches!(word, "end" | "else"))
}

/// The name in `function name(`, or in `name = function(`.
fn name(line: &[u8]) -> Option<String> {
    let text = String::from_utf8_lossy(line);
    let (before, after) = text.split_once("function")?;
    let is_part = |c: char| c.is_alphanumeric() || "_.:".contains(c);
    let after = after.split('(').next().unwrap_or_default().trim();
    let before = before
        .trim_end()
        .strip_suffix('=')
        .unwrap_or_default()
        .trim_end();
    let start = before.rfind(|c: char| !is_part(c)).map_or(0, |at| {
        at + before[at..].chars().next().map_or(1, char::len_utf8)
    });
    let name = if after.is_empty() {
        &before[start..]
    } else {
        after
    };
    (!name.is_empty() && name.chars().all(is_part)).then(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{executable, name};

    fn lines(text: &str) -> Vec<u32> {
        let functions = executable(text.as_bytes()).expect("it compiles");
        let lines: BTreeSet<u32> = functions
            .into_iter()
            .flat_map(|function| function.lines)
            .collect();
        lines.into_iter().collect()
    }

    #[test]
    fn statements_count_and_ends_do_not() {
        assert_eq!(
            lines("local x = 1\n\n-- nothing\nif x then\n  x = 2\nelse\n  x = 3\nend\n"),
            [1, 4, 5, 7]
        );
        assert_eq!(
            lines("for i = 1, 2 do\n  print(i)\nend\nwhile x do\n  x = nil\nend"),
            [1, 2, 4, 5]
        );
        assert_eq!(
            lines("f(\n  1,\n  a\n)\nlocal t = {\n  x = 1,\n  y = a,\n}\n"),
            [1, 2, 5, 6, 7]
        );
        assert!(lines("").is_empty());
        assert_eq!(lines("#!/usr/bin/lua\nprint(1)"), [2]);
    }

    #[test]
    fn functions_inside_of_functions_are_read() {
        let text = "function a(...)\n  local function b()\n    return 1\n  end\n  return b, ...\nend\nM.c = function()\n  x = 1.5\nend\n";
        let found = executable(text.as_bytes()).expect("it compiles");
        let functions: Vec<_> = found
            .iter()
            .map(|f| (f.line, f.lines.as_slice(), f.name.as_deref()))
            .collect();
        let expected: [(u32, &[u32], Option<&str>); 4] = [
            (0, &[1, 7], None),
            (1, &[5], Some("a")),
            (2, &[3], Some("b")),
            (7, &[8], Some("M.c")),
        ];
        assert_eq!(functions, expected);
    }

    #[test]
    fn a_return_that_cannot_be_reached_is_not_missed() {
        assert_eq!(
            lines(
                "local function f(x)\n  if x then\n    return 1\n  else\n    return 2\n  end\nend"
            ),
            [2, 3, 5]
        );
    }

    #[test]
    fn lines_far_apart_are_found() {
        let text = "x = 1\n".to_owned() + &"\n".repeat(1000) + &"y = 2 z = 3\n".repeat(300);
        let found = lines(&text);
        assert_eq!((found[0], found[1], found.len()), (1, 1002, 301));
    }

    #[test]
    fn what_does_not_compile_has_no_lines() {
        assert_eq!(executable(b"if"), None);
        assert_eq!(executable(b"\x1bLua"), None);
    }

    #[test]
    fn names_are_those_of_the_text() {
        assert_eq!(name(b"local function f(x)").as_deref(), Some("f"));
        assert_eq!(name(b"function M.a:b (x)").as_deref(), Some("M.a:b"));
        assert_eq!(name(b"  t.x = function()").as_deref(), Some("t.x"));
        assert_eq!(name(b"f(function()"), None);
        assert_eq!(
            name("\u{e4} = function()".as_bytes()).as_deref(),
            Some("\u{e4}")
        );
    }
}
