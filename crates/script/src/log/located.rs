//! Errors of scripts as people read them: with files where Lua has names of texts, so that an editor can open them.
//!
//! Scripts, and what is compared with CoppeliaSim, have the original text; this one stands beside it in the log.

use std::borrow::Cow;
use std::collections::BTreeMap;

/// Begins the list of calls below a message.
const TRACEBACK: &str = "stack traceback:";
/// Characters of a name that Lua shows in positions, with quotes and brackets (`LUA_IDSIZE`, less its end).
const MAX_NAME_LENGTH: usize = 59;

/// The files of scripts, by what Lua shows for their texts.
#[derive(Debug, Default)]
pub(crate) struct ScriptFiles {
    by_name: BTreeMap<String, String>,
}

impl ScriptFiles {
    /// The text with that name is the content of `file`.
    pub(crate) fn insert(&mut self, chunk_name: &str, file: &str) {
        self.by_name.insert(shown(chunk_name), file.to_owned());
    }

    /// The file with the text of that name.
    pub(crate) fn file_of(&self, chunk_name: &str) -> Option<&str> {
        self.by_name.get(&shown(chunk_name)).map(String::as_str)
    }

    /// The error with files in its positions, and a hint below the message. A line of the library never stands for one of the script: the nearest call in a script does.
    pub(crate) fn locate(
        &self,
        error: &str,
        hint: &str,
        is_library: impl Fn(&str) -> bool,
    ) -> String {
        let (message, calls) = match error.find(TRACEBACK) {
            Some(at) => error.split_at(at),
            None => (error, ""),
        };
        let caller = calls
            .lines()
            .filter_map(position)
            .find(|position| !is_library(position.name))
            .map(|position| position.text);
        let message = match (beginning(message, &is_library), caller) {
            (Some(rest), Some(caller)) => Cow::Owned(format!("{caller}: {rest}")),
            _ => Cow::Borrowed(message),
        };
        let calls = calls
            .split_inclusive('\n')
            .map(|line| match position(line) {
                Some(position) if is_library(position.name) => {
                    Cow::Owned(line.replacen(position.text, "(library)", 1))
                }
                _ => Cow::Borrowed(line),
            });
        let message = message.trim_end_matches('\n');
        let message = without_library(message, &is_library);
        let parts = [message, hint.to_owned(), calls.collect::<String>()];
        let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        self.with_files(&parts.join("\n"))
    }

    fn with_files(&self, text: &str) -> String {
        self.by_name
            .iter()
            .fold(text.to_owned(), |text, (name, file)| {
                text.replace(&format!("{name}:"), &format!("{file}:"))
            })
    }
}

/// The message with the places in the library left out.
fn without_library(message: &str, is_library: &impl Fn(&str) -> bool) -> String {
    let starts = message
        .match_indices("[string \"")
        .map(|(at, _)| &message[at..]);
    let places = starts
        .filter_map(position)
        .filter(|position| is_library(position.name));
    places.fold(message.to_owned(), |text, position| {
        text.replace(position.text, "(library)")
    })
}

/// Form in which Lua shows a chunk name: it shortens long ones.
fn shown(chunk_name: &str) -> String {
    if let Some(file) = chunk_name.strip_prefix('@') {
        return file.to_owned();
    }
    let line = chunk_name.lines().next().unwrap_or_default();
    let room = MAX_NAME_LENGTH - "[string \"...\"]".len();
    if line.len() == chunk_name.len() && line.len() <= room {
        return format!("[string \"{line}\"]");
    }
    let end = (0..=room.min(line.len()))
        .rev()
        .find(|&end| line.is_char_boundary(end))
        .unwrap_or_default();
    format!("[string \"{}...\"]", &line[..end])
}

/// A place in a text.
struct Position<'a> {
    /// As it is written: `[string "/Arm"]:17`, or `arm.lua:17`.
    text: &'a str,
    /// The name in quotes, or the file.
    name: &'a str,
}

/// The place that a line of a traceback begins with; None for native functions.
fn position(line: &str) -> Option<Position<'_>> {
    let line = line.trim_start();
    let (name_end, name) = match line.strip_prefix("[string \"") {
        Some(rest) => (line.find("\"]:")? + 2, rest.split("\"]:").next()?),
        None => (line.find(':')?, line.split(':').next()?),
    };
    let digits = line[name_end + 1..]
        .bytes()
        .take_while(u8::is_ascii_digit)
        .count();
    (digits > 0).then(|| Position {
        text: &line[..name_end + 1 + digits],
        name,
    })
}

/// The message that needs a place: one without any, or with the line alone, as native functions have it, or with a line of the library; it comes
/// without that.
fn beginning<'a>(message: &'a str, is_library: &impl Fn(&str) -> bool) -> Option<&'a str> {
    let digits = message.bytes().take_while(u8::is_ascii_digit).count();
    if digits > 0 {
        return message[digits..].strip_prefix(": ");
    }
    match position(message) {
        None => Some(message),
        Some(position) if is_library(position.name) => {
            message[position.text.len()..].strip_prefix(": ")
        }
        Some(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{ScriptFiles, shown};

    fn located(error: &str) -> String {
        let mut files = ScriptFiles::default();
        files.insert("/Script", "scenes/arm.lua");
        files.locate(error, "", |name| name == "base" || name == "sim/script")
    }

    #[test]
    fn positions_are_those_of_files() {
        assert_eq!(
            located("[string \"/Script\"]:3: broken"),
            "scenes/arm.lua:3: broken"
        );
        assert_eq!(
            located("[string \"/Other\"]:3: broken"),
            "[string \"/Other\"]:3: broken"
        );
        assert_eq!(located("without a place"), "without a place");
    }

    #[test]
    fn lines_of_the_library_are_replaced_by_that_of_the_caller() {
        let calls = "stack traceback:\n\t[C]: in function 'sim._getObject'\n\t[string \"sim/script\"]:17: in function 'sim.getObject'\n\t\
                     [string \"/Script\"]:12: in function 'f'";
        let error = format!("17: in sim._getObject: object does not exist.\n{calls}");
        assert_eq!(
            located(&error),
            "scenes/arm.lua:12: in sim._getObject: object does not exist.\nstack traceback:\n\t[C]: in function 'sim._getObject'\n\t\
             (library): in function 'sim.getObject'\n\tscenes/arm.lua:12: in function 'f'"
        );
        assert!(
            located(&format!("no module\n{calls}")).starts_with("scenes/arm.lua:12: no module\n")
        );
        let error = format!("[string \"base\"]:101: no module\n{calls}");
        assert!(
            located(&error).starts_with("scenes/arm.lua:12: no module\n"),
            "{}",
            located(&error)
        );
    }

    #[test]
    fn a_hint_stands_below_the_message() {
        let error = "12: no such object.\nstack traceback:\n\t[C]: in ?";
        let located = ScriptFiles::default().locate(error, "did you mean it?", |_| false);
        assert_eq!(
            located,
            "12: no such object.\ndid you mean it?\nstack traceback:\n\t[C]: in ?"
        );
    }

    #[test]
    fn names_are_shortened_as_lua_does() {
        assert_eq!(shown("/Script"), "[string \"/Script\"]");
        assert_eq!(shown("@a/b.lua"), "a/b.lua");
        assert_eq!(shown("first\nsecond"), "[string \"first...\"]");
        assert_eq!(
            shown(&"x".repeat(80)),
            format!("[string \"{}...\"]", "x".repeat(45))
        );
    }
}
