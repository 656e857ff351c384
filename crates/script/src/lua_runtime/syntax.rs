//! Whether a text is Lua, without running it.

use crate::lua::Bytecode;

/// Where a text is no Lua, and why.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SyntaxError {
    /// From 1.
    pub line: u64,
    /// In the words of Lua's compiler, without the place.
    pub message: String,
}

/// The first error of a text, as the compiler finds it; None where it is Lua. A first line with `#` is skipped, as `lua` does with files.
pub fn syntax_error(text: &[u8]) -> Option<SyntaxError> {
    let mut text = text.to_vec();
    if text.first() == Some(&b'#') {
        text.splice(0..0, *b"--");
    }
    let error = Bytecode::compile(&text, "=text").err()?;
    let placed = error.strip_prefix("text:").unwrap_or(&error);
    Some(match placed.split_once(": ") {
        Some((line, message)) if line.parse::<u64>().is_ok() => SyntaxError {
            line: line.parse().unwrap_or(1),
            message: message.to_owned(),
        },
        _ => SyntaxError {
            line: 1,
            message: error,
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_error_has_its_line() {
        assert_eq!(syntax_error(b"local a = 1\nreturn a"), None);
        assert_eq!(syntax_error(b"#!/usr/bin/lua\nreturn 1"), None);
        assert_eq!(syntax_error(b""), None);
        let error = syntax_error(b"local a = 1\n\nif a then\nend end").expect("one `end` too many");
        assert_eq!(error.line, 4);
        assert_eq!(error.message, "<eof> expected near 'end'");
        let error = syntax_error(b"x = 'open").expect("the string has no end");
        assert_eq!(
            (error.line, error.message.contains("unfinished string")),
            (1, true)
        );
    }

    #[test]
    fn no_text_is_too_odd() {
        let deep = [
            b"(".repeat(100_000),
            b"\x1bLua".to_vec(),
            b"\0\xff:\n".to_vec(),
        ];
        for text in deep {
            let error = syntax_error(&text).expect("it is no Lua");
            assert!(error.line >= 1 && !error.message.is_empty());
        }
    }
}
