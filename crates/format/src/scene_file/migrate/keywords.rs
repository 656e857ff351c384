//! Names that became keywords: V-REP had Lua 5.1, in which `goto` is a name like any other.

/// Words that cannot be a label.
const KEYWORDS: [&str; 22] = [
    "and", "break", "do", "else", "elseif", "end", "false", "for", "function", "goto", "if", "in",
    "local", "nil", "not", "or", "repeat", "return", "then", "true", "until", "while",
];

/// Variables, functions and fields named `goto` get the name `goto_`. The statement, which LuaJIT has too, stays.
pub(super) fn goto_as_name(text: &str) -> String {
    const WORD: &str = "goto";
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(WORD) {
        let (before, after) = (&rest[..at], &rest[at + WORD.len()..]);
        out.push_str(before);
        let is_word = !out.ends_with(is_part_of_name) && !after.starts_with(is_part_of_name);
        out.push_str(WORD);
        if is_word && !names_a_label(after) {
            out.push('_');
        }
        rest = after;
    }
    out + rest
}

/// Whether a label follows on the same line.
fn names_a_label(after: &str) -> bool {
    let next = after.trim_start_matches([' ', '\t']);
    let end = next.find(|c| !is_part_of_name(c)).unwrap_or(next.len());
    let word = &next[..end];
    !word.is_empty() && !word.starts_with(|c: char| c.is_ascii_digit()) && !KEYWORDS.contains(&word)
}

fn is_part_of_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use super::goto_as_name;

    #[test]
    fn names_are_replaced() {
        for (old, new) in [
            ("function goto(x) end", "function goto_(x) end"),
            ("goto(1)", "goto_(1)"),
            ("local goto = f\ngoto = 2", "local goto_ = f\ngoto_ = 2"),
            ("if goto then goto() end", "if goto_ then goto_() end"),
            (
                "robot.goto{1}; robot:goto(2)",
                "robot.goto_{1}; robot:goto_(2)",
            ),
            ("x = goto\ny = 1", "x = goto_\ny = 1"),
            ("goto", "goto_"),
        ] {
            assert_eq!(goto_as_name(old), new);
        }
    }

    #[test]
    fn statements_and_other_words_stay() {
        for text in [
            "goto continue\n::continue::",
            "if x then goto\tl1 end",
            "gotoTarget(1) mygoto(2) goto_ = 1 goto2() agotob = 1",
            "",
        ] {
            assert_eq!(goto_as_name(text), text);
        }
    }
}
