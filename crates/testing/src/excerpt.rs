//! The source around the lines where something went wrong.

/// Lines before and after the one that is meant.
const CONTEXT: u32 = 2;
/// Characters of a line; the rest is cut.
const WIDTH: usize = 200;
/// Positions of one message.
const POSITIONS: usize = 3;

/// Lines of a test file, or of a script of the scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// The file as the user named it, or the path of the script.
    pub place: String,
    /// The line that is meant, from 1.
    pub line: u32,
    /// Number of the first of `lines`.
    pub first: u32,
    /// The lines, without their ends; long ones are cut.
    pub lines: Vec<String>,
}

impl Excerpt {
    /// The lines around `line`, if `source` has it.
    pub fn of(place: &str, source: &[u8], line: u32) -> Option<Self> {
        let first = line.checked_sub(1)?.saturating_sub(CONTEXT) + 1;
        let source = String::from_utf8_lossy(source);
        let count = (line - first + CONTEXT + 1) as usize;
        let lines: Vec<_> = source
            .lines()
            .skip(first as usize - 1)
            .take(count)
            .map(cut)
            .collect();
        let has_line = lines.len() > (line - first) as usize;
        has_line.then(|| Self {
            place: place.to_owned(),
            line,
            first,
            lines,
        })
    }

    /// Number and text of each line, and whether it is the one that is meant.
    pub fn numbered(&self) -> impl Iterator<Item = (u32, &str, bool)> {
        (self.first..)
            .zip(&self.lines)
            .map(|(number, text)| (number, text.as_str(), number == self.line))
    }

    /// Place and lines, with `mark` before the one that is meant.
    pub fn text(&self, mark: &str) -> String {
        let mut text = format!("{}:{}\n", self.place, self.line);
        for (number, code, is_meant) in self.numbered() {
            let mark = if is_meant { mark } else { " " };
            text += format!("{mark} {number:>4} | {code}").trim_end();
            text += "\n";
        }
        text
    }
}

fn cut(line: &str) -> String {
    match line.char_indices().nth(WIDTH) {
        Some((end, _)) => line[..end].to_owned() + "...",
        None => line.to_owned(),
    }
}

/// The positions `[string "NAME"]:LINE:` of a message, before its traceback.
pub fn positions(message: &str) -> Vec<(&str, u32)> {
    let text = message
        .split("\nstack traceback:")
        .next()
        .unwrap_or_default();
    let mut found = Vec::new();
    for part in text.split("[string \"").skip(1) {
        let Some((name, rest)) = part.split_once("\"]:") else {
            continue;
        };
        let line = rest
            .split(|c: char| !c.is_ascii_digit())
            .next()
            .and_then(|digits| digits.parse().ok());
        if let Some(position) = line
            .map(|line| (name, line))
            .filter(|position| !found.contains(position))
        {
            found.push(position);
        }
    }
    found.truncate(POSITIONS);
    found
}

#[cfg(test)]
mod tests {
    use super::{Excerpt, positions};

    #[test]
    fn lines_around_one() {
        let source = b"a\nb\nc\nd\ne\nf";
        let excerpt = Excerpt::of("x.lua", source, 4).unwrap();
        assert_eq!(
            excerpt.text(">"),
            "x.lua:4\n     2 | b\n     3 | c\n>    4 | d\n     5 | e\n     6 | f\n"
        );
        assert_eq!(
            Excerpt::of("x.lua", source, 1).unwrap().lines,
            ["a", "b", "c"]
        );
        assert_eq!(Excerpt::of("x.lua", source, 6).unwrap().first, 4);
    }

    #[test]
    fn lines_there_are_not() {
        for line in [0, 2, u32::MAX] {
            assert_eq!(Excerpt::of("x.lua", b"a", line), None, "{line}");
        }
        assert_eq!(Excerpt::of("x.lua", b"", 1), None);
    }

    #[test]
    fn long_lines_are_cut_between_characters() {
        let excerpt = Excerpt::of("x.lua", "é".repeat(1000).as_bytes(), 1).unwrap();
        assert_eq!(excerpt.lines, ["é".repeat(200) + "..."]);
    }

    #[test]
    fn positions_of_scripts_are_found_in_messages() {
        let message = "[string \"/a/s\"]:12: [string \"/b\"]:3: oh\nstack traceback:\n\t[string \"/c\"]:4: in main chunk";
        assert_eq!(positions(message), [("/a/s", 12), ("/b", 3)]);
        assert!(positions("x.lua:3: oh").is_empty());
        assert!(
            positions("[string \"/a\"]:x: [string \"/b\"]:99999999999: [string \"/c").is_empty()
        );
    }
}
