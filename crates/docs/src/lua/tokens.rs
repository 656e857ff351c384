//! Lua code as tokens, as far as one needs them to see which names it uses: comments are gone, strings are whole.
//!
//! It never fails: code that is no Lua gives what tokens there are.

/// A token and the line it begins in, from 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Token<'a> {
    pub kind: Kind<'a>,
    pub line: usize,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Kind<'a> {
    /// A name, a keyword, or a chain of names such as `sim.getObject`.
    Name(String),
    /// Content between the quotes or brackets, escapes unchanged.
    Text(&'a [u8]),
    /// Anything else: one sign, or a number as its first digit.
    Sign(u8),
}

/// The tokens of `source`.
pub(crate) fn tokens(source: &[u8]) -> Vec<Token<'_>> {
    let mut reader = Reader {
        rest: source,
        line: 1,
    };
    let mut found = Vec::new();
    if source.starts_with(b"#") {
        reader.skip_line();
    }
    while let Some(token) = reader.next() {
        found.push(token);
    }
    join_chains(found)
}

struct Reader<'a> {
    rest: &'a [u8],
    line: usize,
}

impl<'a> Reader<'a> {
    fn next(&mut self) -> Option<Token<'a>> {
        self.skip_blanks();
        let line = self.line;
        let first = *self.rest.first()?;
        let kind = match first {
            b'"' | b'\'' => Kind::Text(self.quoted(first)),
            b'[' if long_bracket(self.rest).is_some() => Kind::Text(self.long_text()),
            _ if is_letter(first) => Kind::Name(String::from_utf8_lossy(self.word()).into_owned()),
            _ if first.is_ascii_digit() => {
                self.number();
                Kind::Sign(first)
            }
            _ => Kind::Sign(self.take(1)[0]),
        };
        Some(Token { kind, line })
    }

    fn take(&mut self, length: usize) -> &'a [u8] {
        let (taken, rest) = self.rest.split_at(length.min(self.rest.len()));
        self.line += taken.iter().filter(|byte| **byte == b'\n').count();
        self.rest = rest;
        taken
    }

    fn skip_line(&mut self) {
        let end = self
            .rest
            .iter()
            .position(|byte| *byte == b'\n')
            .unwrap_or(self.rest.len());
        self.take(end);
    }

    /// Skips white space and comments.
    fn skip_blanks(&mut self) {
        loop {
            let blanks = self
                .rest
                .iter()
                .take_while(|byte| byte.is_ascii_whitespace())
                .count();
            self.take(blanks);
            if !self.rest.starts_with(b"--") {
                return;
            }
            self.take(2);
            match long_bracket(self.rest) {
                Some(_) => drop(self.long_text()),
                None => self.skip_line(),
            }
        }
    }

    fn word(&mut self) -> &'a [u8] {
        let end = self
            .rest
            .iter()
            .position(|byte| !is_letter(*byte) && !byte.is_ascii_digit());
        self.take(end.unwrap_or(self.rest.len()))
    }

    /// A number, with a dot only where it does not begin `..`.
    fn number(&mut self) {
        self.word();
        if self.rest.starts_with(b".") && !self.rest.starts_with(b"..") {
            self.take(1);
            self.word();
        }
    }

    /// A string up to its quote, or to the end of the line where there is none.
    fn quoted(&mut self, quote: u8) -> &'a [u8] {
        self.take(1);
        let mut end = 0;
        while end < self.rest.len() && self.rest[end] != quote && self.rest[end] != b'\n' {
            end += if self.rest[end] == b'\\' { 2 } else { 1 };
        }
        let text = self.take(end);
        if self.rest.first() == Some(&quote) {
            self.take(1);
        }
        text
    }

    /// `[[text]]`, `[==[text]==]`; to the end of the file where it is not closed.
    fn long_text(&mut self) -> &'a [u8] {
        let level = long_bracket(self.rest).unwrap_or(0);
        self.take(level + 2);
        let close = [b"]".as_slice(), &vec![b'='; level], b"]"].concat();
        let end = self
            .rest
            .windows(close.len())
            .position(|window| window == close)
            .unwrap_or(self.rest.len());
        let text = self.take(end);
        self.take(close.len());
        text
    }
}

/// The level of the long bracket that opens here.
fn long_bracket(text: &[u8]) -> Option<usize> {
    let rest = text.strip_prefix(b"[")?;
    let level = rest.iter().take_while(|byte| **byte == b'=').count();
    (rest.get(level) == Some(&b'[')).then_some(level)
}

fn is_letter(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_'
}

/// Joins `a`, `.`, `b` to `a.b`. The chain stands where it begins.
fn join_chains(tokens: Vec<Token<'_>>) -> Vec<Token<'_>> {
    let mut joined: Vec<Token<'_>> = Vec::with_capacity(tokens.len());
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        let member = tokens.peek().and_then(|next| match &next.kind {
            Kind::Name(name) => Some(name.clone()),
            _ => None,
        });
        if token.kind == Kind::Sign(b'.')
            && let Some(member) = member
            && let Some(Token {
                kind: Kind::Name(owner),
                ..
            }) = joined.last_mut()
            && !KEYWORDS.contains(&owner.as_str())
        {
            owner.push('.');
            owner.push_str(&member);
            tokens.next();
            continue;
        }
        joined.push(token);
    }
    joined
}

/// Words of the language that may stand before a dot only by mistake, or before `..`.
const KEYWORDS: &[&str] = &[
    "and", "do", "else", "end", "false", "if", "in", "nil", "not", "or", "return", "then", "true",
];

#[cfg(test)]
mod tests {
    use super::{Kind, tokens};

    /// Names and texts with their lines.
    fn seen(source: &str) -> Vec<(String, usize)> {
        let text = |kind: &Kind<'_>| match kind {
            Kind::Name(name) => Some(name.clone()),
            Kind::Text(text) => Some(format!("'{}'", String::from_utf8_lossy(text))),
            Kind::Sign(_) => None,
        };
        tokens(source.as_bytes())
            .iter()
            .filter_map(|token| Some((text(&token.kind)?, token.line)))
            .collect()
    }

    fn names(source: &str) -> Vec<String> {
        seen(source).into_iter().map(|(name, _)| name).collect()
    }

    #[test]
    fn chains_are_one_name() {
        assert_eq!(names("sim.getObject(a . b.c)"), ["sim.getObject", "a.b.c"]);
        assert_eq!(names("a..b"), ["a", "b"]);
        assert_eq!(names("x = 1..sim.f"), ["x", "sim.f"]);
        assert_eq!(names("0x1fp4.e2 v"), ["v"]);
    }

    #[test]
    fn comments_are_gone_and_strings_whole() {
        assert_eq!(
            names("f() -- sim.a\ng() --[[ sim.b\n]] h()"),
            ["f", "g", "h"]
        );
        assert_eq!(names("--[==[ ]] sim.a ]==] x"), ["x"]);
        assert_eq!(names(r"p('sim.a \' b') q"), ["p", r"'sim.a \' b'", "q"]);
        assert_eq!(
            names("p[[a]] q[=[ ]] ]=] t[1]"),
            ["p", "'a'", "q", "' ]] '", "t"]
        );
        assert_eq!(names("#!/bin/lua sim.a\nx"), ["x"]);
    }

    #[test]
    fn lines_are_counted_everywhere() {
        assert_eq!(
            seen("--[[\n\n]]a\n[[\n]]b'\\\n'c")
                .iter()
                .map(|(_, line)| *line)
                .collect::<Vec<_>>(),
            [3, 4, 5, 5, 6]
        );
    }

    #[test]
    fn what_is_not_closed_ends_with_the_line_or_the_file() {
        assert_eq!(
            names("a 'b\nc"),
            ["a", "'b", "c"].map(|name| name.replace("'b", "'b'"))
        );
        assert_eq!(names("a [[b\nc"), ["a", "'b\nc'"]);
        assert_eq!(names("a '\\"), ["a", r"'\'"]);
        assert_eq!(names("--[["), [""; 0]);
    }
}
