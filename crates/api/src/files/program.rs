//! `sim.*`: starting programs.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use io::Program;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![launch_executable];

/// Starts a program that goes on by itself.
///
/// @param filename path of the program, or a name to be looked up where the system looks for programs
/// @param parameters its arguments, with spaces between; double quotes hold one together
/// @param showStatus has no effect
#[api("sim.launchExecutable")]
fn launch_executable(
    cx: &mut Cx,
    filename: String,
    #[default(String::new())] parameters: String,
    #[default(1)] _show_status: i64,
) -> Result<()> {
    cx.permissions().check_run(&filename)?;
    let program = Program {
        path: filename,
        args: words(&parameters),
        search_path: true,
        ..Program::default()
    };
    program
        .launch()
        .map_err(|error| ApiError::Other(format!("cannot launch {}: {error}.", program.path)))
}

/// The words of a command line.
fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut quoted = false;
    for letter in line.chars() {
        match letter {
            '"' => {
                quoted = !quoted;
                word.get_or_insert_default();
            }
            _ if letter.is_whitespace() && !quoted => words.extend(word.take()),
            _ => word.get_or_insert_default().push(letter),
        }
    }
    words.extend(word);
    words
}

#[cfg(test)]
mod tests {
    use super::words;

    #[test]
    fn quotes_hold_words_together() {
        assert_eq!(
            words(r#" -a "two words" c"d e"f "" "#),
            ["-a", "two words", "cd ef", ""]
        );
        assert_eq!(words(r#"left "open"#), ["left", "open"]);
        assert!(words(" ").is_empty());
    }
}
