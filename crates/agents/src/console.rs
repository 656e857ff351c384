//! What scripts print and log, kept for the answer of the call in which it happened.

use std::cell::RefCell;
use std::rc::Rc;

use heap::outside;
use script::log::verbosity;
use simulator::{Console, LogLine};

/// Lines that are kept.
const MAX_KEPT: usize = 10_000;
/// Lines of an answer.
const MAX_SHOWN: usize = 30;
/// Characters of a line of an answer.
const MAX_WIDTH: usize = 300;

/// A line.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    pub time: f64,
    pub text: String,
    /// Whether it is the error of a script.
    pub is_error: bool,
}

/// Lines since the last answer.
#[derive(Clone, Default)]
pub(crate) struct Lines(Rc<RefCell<Kept>>);

#[derive(Default)]
struct Kept {
    lines: Vec<Line>,
    left_out: usize,
}

impl Lines {
    fn add(&self, line: Line) {
        let mut kept = self.0.borrow_mut();
        if kept.lines.len() < MAX_KEPT {
            kept.lines.push(line);
        } else {
            kept.left_out += 1;
        }
    }

    /// All of them, which are gone then, and how many more there were.
    pub(crate) fn take(&self) -> (Vec<Line>, usize) {
        let kept = self.0.take();
        (kept.lines, kept.left_out)
    }
}

/// The console of a simulator.
pub(crate) struct Recorder(Lines);

impl Recorder {
    pub(crate) fn new(lines: &Lines) -> Self {
        Self(lines.clone())
    }
}

impl Console for Recorder {
    fn print(&mut self, line: &[u8], time: f64) {
        outside(|| {
            self.0.add(Line {
                time,
                text: String::from_utf8_lossy(line).into_owned(),
                is_error: false,
            });
        });
    }

    fn log(&mut self, line: &LogLine<'_>) {
        if line.status {
            return;
        }
        outside(|| {
            let level = verbosity::plain(line.level);
            let is_error = level == verbosity::SCRIPT_ERRORS;
            let text = line.located.unwrap_or(line.text);
            let text = if is_error {
                without_frames_of_c(text)
            } else {
                format!("[{}] {text}", verbosity::name(level))
            };
            self.0.add(Line {
                time: line.time,
                text,
                is_error,
            });
        });
    }
}

/// An error whose traceback has only lines of scripts; none if it has no more than the place of the error.
fn without_frames_of_c(text: &str) -> String {
    const HEAD: &str = "\nstack traceback:";
    let Some((error, trace)) = text.split_once(HEAD) else {
        return text.to_owned();
    };
    let frames: Vec<&str> = trace
        .lines()
        .filter(|line| line.contains("[string "))
        .collect();
    if frames.len() < 2 {
        return error.to_owned();
    }
    format!("{error}{HEAD}\n{}", frames.join("\n"))
}

/// Lines for an answer: the last ones, each with its time; lines that repeat are counted.
pub(crate) fn shown(lines: &[Line], left_out: usize) -> String {
    let mut merged: Vec<(&Line, usize)> = Vec::new();
    for line in lines {
        match merged.last_mut() {
            Some((last, count)) if last.text == line.text => *count += 1,
            _ => merged.push((line, 1)),
        }
    }
    let hidden = merged.len().saturating_sub(MAX_SHOWN);
    let mut out = String::new();
    if hidden + left_out > 0 {
        out += &format!("({} lines before)\n", hidden + left_out);
    }
    for (line, count) in &merged[hidden..] {
        let times = if *count > 1 {
            format!(" ({count} times)")
        } else {
            String::new()
        };
        out += &format!("[{:.3} s] {}{times}\n", line.time, cut(&line.text));
    }
    out
}

/// A text that is not too long.
pub(crate) fn cut(text: &str) -> String {
    match text.char_indices().nth(MAX_WIDTH) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(text: &str) -> Line {
        Line {
            time: 0.5,
            text: text.to_owned(),
            is_error: false,
        }
    }

    #[test]
    fn tracebacks_have_the_lines_of_scripts() {
        let one = "[string \"/a\"]:1: x\nstack traceback:\n\t[C]: in function 'error'\n\t[string \"/a\"]:1: in function 'f'";
        assert_eq!(without_frames_of_c(one), "[string \"/a\"]:1: x");
        let two = format!("{one}\n\t[string \"/a\"]:5: in function 'g'");
        let shown = without_frames_of_c(&two);
        assert!(
            shown.ends_with("'f'\n\t[string \"/a\"]:5: in function 'g'"),
            "{shown}"
        );
        assert_eq!(without_frames_of_c("oh"), "oh");
    }

    #[test]
    fn repeated_lines_are_counted_and_old_ones_left_out() {
        assert_eq!(
            shown(&[line("a"), line("a"), line("b")], 0),
            "[0.500 s] a (2 times)\n[0.500 s] b\n"
        );
        let many: Vec<Line> = (0..100).map(|i| line(&i.to_string())).collect();
        let text = shown(&many, 5);
        assert!(
            text.starts_with("(75 lines before)\n[0.500 s] 70\n"),
            "{text}"
        );
        assert_eq!(text.lines().count(), MAX_SHOWN + 1);
    }
}
