//! Lines of the log as JSON, and the line of the script that an error is about.

use serde_json::json;

use script::log::RecentLine;

/// Characters of a line that pages get; the rest is cut off.
const MAX_CHARACTERS: usize = 20_000;

/// A line as JSON.
pub(crate) fn describe(line: &RecentLine) -> String {
    let mut value = json!({
        "time": line.time, "level": line.level_name(), "origin": line.origin, "text": shortened(line.located.as_ref().unwrap_or(&line.text)),
    });
    if let Some(script) = line.script {
        value["handle"] = script.into();
    }
    if let Some(number) = line_of(&line.text).filter(|_| line.is_script_error()) {
        value["line"] = number.into();
    }
    value.to_string()
}

fn shortened(text: &str) -> &str {
    text.char_indices()
        .nth(MAX_CHARACTERS)
        .map_or(text, |(end, _)| &text[..end])
}

/// The line in a message such as `[string "/Robot/Script"]:12: attempt ...`, or `12: attempt ...`.
pub(super) fn line_of(message: &str) -> Option<u64> {
    let number = |text: &str| {
        let (digits, _) = text.split_once(':')?;
        digits.parse().ok()
    };
    let after_name = message
        .split_once("\"]:")
        .and_then(|(_, rest)| number(rest));
    after_name.or_else(|| number(message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_name_their_line() {
        assert_eq!(line_of("[string \"/a/Script\"]:12: no"), Some(12));
        assert_eq!(line_of("7: no"), Some(7));
        assert_eq!(line_of("no"), None);
        assert_eq!(line_of("[string \"a\"]:x: no"), None);
    }
}
