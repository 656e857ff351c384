//! Terminal colours, and removal of control characters.

use testing::Status;

/// When to use colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum ColorChoice {
    /// On a terminal, unless `NO_COLOR` is set
    Auto,
    Always,
    Never,
}

pub(super) const RED: u8 = 31;
pub(super) const GREEN: u8 = 32;
pub(super) const YELLOW: u8 = 33;
pub(super) const BOLD: u8 = 1;
pub(super) const DIM: u8 = 2;

/// Colours, or none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Paint(bool);

impl Paint {
    pub(super) fn new(choice: ColorChoice, is_terminal: bool) -> Self {
        let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
        let is_dumb = std::env::var_os("TERM").is_some_and(|value| value == "dumb");
        Self(match choice {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            ColorChoice::Auto => is_terminal && !is_set("NO_COLOR") && !is_dumb,
        })
    }

    pub(super) fn paint(self, style: u8, text: &str) -> String {
        if self.0 {
            format!("\x1b[{style}m{text}\x1b[0m")
        } else {
            text.to_owned()
        }
    }

    pub(super) fn status(self, status: Status) -> String {
        let (colour, word) = match status {
            Status::Passed => (GREEN, "PASS"),
            Status::Failed => (RED, "FAIL"),
            Status::Error => (RED, "ERROR"),
            Status::Pending => (YELLOW, "PENDING"),
        };
        self.paint(colour, word)
    }
}

/// Text of tests and scripts with control characters of the terminal replaced.
pub(super) fn harmless(text: &str) -> String {
    let sign = |c: char| match c {
        '\n' | '\t' => c,
        '\0'..='\x1f' => {
            char::from_u32(0x2400 + u32::from(c)).unwrap_or(char::REPLACEMENT_CHARACTER)
        }
        c if c.is_control() => char::REPLACEMENT_CHARACTER,
        c => c,
    };
    text.chars().map(sign).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_to_the_terminal_become_signs() {
        assert_eq!(
            harmless("a\x1b[31mb\r\n\tc\u{9b}\x7f"),
            "a␛[31mb␍\n\tc\u{fffd}\u{fffd}"
        );
    }

    #[test]
    fn colours_are_a_choice() {
        assert_eq!(
            Paint::new(ColorChoice::Always, false).paint(RED, "x"),
            "\x1b[31mx\x1b[0m"
        );
        assert_eq!(
            Paint::new(ColorChoice::Never, true).status(Status::Failed),
            "FAIL"
        );
        assert_eq!(
            Paint::new(ColorChoice::Auto, false).status(Status::Pending),
            "PENDING"
        );
    }
}
