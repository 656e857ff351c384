//! The head of a Python script: lines for its Lua part, and the file it includes.

/// A script's text in its parts.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Parts {
    /// The Lua lines of `#luaExec` and `'''luaExec ... '''`.
    pub lua: Vec<u8>,
    /// The file of an `include` line.
    pub include: Option<String>,
    /// The Python text. What was taken from it are comments now, so that lines keep their numbers.
    pub python: Vec<u8>,
}

/// Takes the head apart: comments, empty lines, Lua code and an include, up to the first line of Python.
pub(super) fn split(text: &[u8]) -> Parts {
    let mut parts = Parts::default();
    let mut lines = text.split_inclusive(|&byte| byte == b'\n');
    let mut block = None;
    for line in lines.by_ref() {
        let word = line.trim_ascii();
        if let Some(end) = block {
            let lua = word.strip_suffix(end);
            block = if lua.is_some() { None } else { block };
            take(&mut parts, lua.unwrap_or(line));
        } else if let Some(lua) = word.strip_prefix(b"#luaExec") {
            take(&mut parts, lua);
        } else if let Some((lua, end)) = block_start(word) {
            block = (!lua.ends_with(end)).then_some(end);
            take(&mut parts, lua.strip_suffix(end).unwrap_or(lua));
        } else if let Some(name) = word.strip_prefix(b"include ") {
            parts.include = Some(format!("{}.py", String::from_utf8_lossy(name.trim_ascii())));
            parts.python.extend_from_slice(b"#\n");
        } else {
            parts.python.extend_from_slice(line);
            if !(word.is_empty() || word.starts_with(b"#")) {
                break;
            }
        }
    }
    lines.for_each(|line| parts.python.extend_from_slice(line));
    parts
}

/// A line that is no Python.
fn take(parts: &mut Parts, lua: &[u8]) {
    parts.lua.extend_from_slice(lua.trim_ascii());
    parts.lua.push(b'\n');
    parts.python.extend_from_slice(b"#\n");
}

/// What stands behind the beginning of a block, and what ends it.
fn block_start(line: &[u8]) -> Option<(&[u8], &'static [u8])> {
    let quotes: [&'static [u8]; 2] = [b"'''", b"\"\"\""];
    quotes
        .into_iter()
        .find_map(|quote| Some((line.strip_prefix(quote)?.strip_prefix(b"luaExec")?, quote)))
}

#[cfg(test)]
mod tests {
    use super::{Parts, split};

    #[test]
    fn lua_lines_leave_comments_behind() {
        let text =
            b"#python\n\n#luaExec x = 5\n'''luaExec\nfunction f()\n    return x\nend\n'''\nimport os\n#luaExec y = 1\n";
        let parts = split(text);
        assert_eq!(parts.lua, b"x = 5\n\nfunction f()\nreturn x\nend\n\n");
        assert_eq!(
            parts.python,
            b"#python\n\n#\n#\n#\n#\n#\n#\nimport os\n#luaExec y = 1\n"
        );
    }

    #[test]
    fn an_include_names_a_file() {
        let parts = split(b"#python\ninclude robot\nx = 1");
        assert_eq!(parts.include.as_deref(), Some("robot.py"));
        assert_eq!(parts.python, b"#python\n#\nx = 1");
    }

    #[test]
    fn a_block_may_end_on_its_line() {
        let parts = split(b"'''luaExec x = 1'''\ny = 2\n");
        assert_eq!(
            (parts.lua.as_slice(), parts.python.as_slice()),
            (&b"x = 1\n"[..], &b"#\ny = 2\n"[..])
        );
    }

    #[test]
    fn other_texts_stay_as_they_are() {
        for text in [
            &b""[..],
            b"'''doc'''\n#luaExec x\n",
            b"x = 1",
            b"# a\r\n\r\nimport os\r\n",
        ] {
            assert_eq!(
                split(text),
                Parts {
                    python: text.to_vec(),
                    ..Parts::default()
                }
            );
        }
    }
}
