//! The console: destination of prints and log lines.

use std::borrow::Cow;

use super::verbosity;

/// Ends a text that is HTML.
const HTML_MARK: &str = "@html";

/// One line of the log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogLine<'a> {
    /// The source of a line: a script's path, `sandboxScript`, `CoppeliaSim`'s place taken by `Swanilda`, ...
    pub origin: &'a str,
    /// `sim.verbosity_*` with its flag bits.
    pub level: i64,
    /// The message, in the words of CoppeliaSim.
    pub text: &'a str,
    /// An error as people read it, with files and hints, where `text` has the words of CoppeliaSim.
    pub located: Option<&'a str>,
    /// Simulated time, seconds.
    pub time: f64,
    /// The simulator reports its own status, e.g. that the simulation started.
    pub status: bool,
}

impl LogLine<'_> {
    /// The line as a terminal shows it. `sim.verbosity_undecorated` is for status bars: terminals show the author all the same.
    /// A further line of the text is indented where it begins like one of an author, so that it cannot pass for it.
    pub fn decorated(&self) -> String {
        let text = self.plain_text().replace("\r\n", "\n").replace('\r', "\n");
        let mut lines = text.split('\n');
        let mut shown = format!("[{}:{}]   ", self.origin, verbosity::name(self.level));
        shown.extend(lines.next());
        for line in lines {
            shown.push_str(if line.starts_with('[') {
                "\n    "
            } else {
                "\n"
            });
            shown.push_str(line);
        }
        shown
    }

    /// The line as a terminal shows it to people, who look for files.
    pub fn located(&self) -> String {
        LogLine {
            text: self.located.unwrap_or(self.text),
            ..*self
        }
        .decorated()
    }

    /// The line as CoppeliaSim shows it: messages of its libraries have no author.
    pub fn original(&self) -> String {
        if self.origin == "CoppeliaSim" && self.level & verbosity::UNDECORATED != 0 {
            return self.text.to_owned();
        }
        self.decorated()
    }

    /// The text; where it is marked as HTML, by `@html` at its end, without mark and tags.
    pub fn plain_text(&self) -> Cow<'_, str> {
        self.text
            .strip_suffix(HTML_MARK)
            .map_or(Cow::Borrowed(self.text), |html| {
                Cow::Owned(without_tags(html))
            })
    }
}

fn without_tags(html: &str) -> String {
    let mut text = String::with_capacity(html.len());
    let mut rest = html;
    while let Some((before, tag)) = rest.split_once('<') {
        let Some((_, after)) = tag.split_once('>') else {
            break;
        };
        text.push_str(before);
        rest = after;
    }
    text + rest
}

/// A stream that scripts write with Lua's `io`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputStream {
    /// Standard output.
    Output,
    /// Standard error.
    Error,
}

/// Receives the output of a simulator and its scripts, filtered by verbosity.
pub trait Console {
    /// One call of a script's `print`: the line without its end, and the simulated time, seconds.
    fn print(&mut self, line: &[u8], time: f64);

    /// One line of the log.
    fn log(&mut self, line: &LogLine<'_>);

    /// A script could not write to standard output, or to another pipe that `io.output` is, since nobody reads it any more.
    fn pipe_closed(&mut self) {}

    /// Receives parts of lines that a script wrote to a stream of the process.
    fn write(&mut self, text: &[u8], stream: OutputStream, time: f64) {
        let _ = (text, stream, time);
    }
}

/// Swallows everything.
pub struct Silent;

impl Console for Silent {
    fn print(&mut self, _: &[u8], _: f64) {}

    fn log(&mut self, _: &LogLine<'_>) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(text: &str) -> String {
        LogLine {
            origin: "a",
            level: verbosity::SCRIPT_INFOS,
            text,
            located: None,
            time: 0.0,
            status: false,
        }
        .plain_text()
        .into_owned()
    }

    #[test]
    fn tags_are_removed_from_html_only() {
        assert_eq!(plain("<b>bold</b> text@html"), "bold text");
        assert_eq!(plain("<b>bold</b> text"), "<b>bold</b> text");
        assert_eq!(plain("1 < 2@html"), "1 < 2");
    }

    #[test]
    fn messages_of_the_original_s_libraries_have_no_author() {
        let level = verbosity::SCRIPT_WARNINGS | verbosity::UNDECORATED;
        let line = LogLine {
            origin: "CoppeliaSim",
            level,
            text: "refused",
            located: None,
            time: 0.0,
            status: false,
        };
        assert_eq!(line.original(), "refused");
        assert_eq!(line.decorated(), "[CoppeliaSim:warning]   refused");
        assert_eq!(
            LogLine {
                origin: "/script",
                ..line
            }
            .original(),
            "[/script:warning]   refused"
        );
        assert_eq!(
            LogLine {
                level: verbosity::SCRIPT_WARNINGS,
                ..line
            }
            .original(),
            line.decorated()
        );
    }

    #[test]
    fn a_text_cannot_pass_for_a_line_of_another_author() {
        let text = "mine\n[CoppeliaSim:error]   yours\r\n[/a:error]   his\r[/b:info]   hers";
        let line = LogLine {
            origin: "/script",
            level: verbosity::SCRIPT_INFOS,
            text,
            located: None,
            time: 0.0,
            status: false,
        };
        let shown = line.decorated();
        let forged = shown
            .split(['\n', '\r'])
            .skip(1)
            .filter(|line| !line.starts_with("    "));
        assert_eq!(forged.count(), 0, "{shown}");
        assert_eq!(shown.lines().count(), 4, "{shown}");
    }
}
