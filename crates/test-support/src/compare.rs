//! Comparing output with a recording: the rules of the READMEs in `tests/conformance`.

use std::path::Path;

/// What the original adds to the notice of a deprecated function: the name of a file that is not read here.
const SETTINGS_REMARK: &str = " (control verbosity via notifyDeprecated in usrset.txt)";

/// Drops what is not a script's output: loading chatter, the sandbox's infos, tracebacks, addresses, the folder of the case; and
/// in cases about the scene all warnings and infos. Positions in the case have its file, however it was loaded.
pub fn normalize(output: &str, case: &Path) -> String {
    let folder = format!(
        "{}/",
        case.parent().expect("a case lies in a folder").display()
    );
    let name = case.file_stem().unwrap_or_default().to_string_lossy();
    let (chunk, file) = (format!("[string \"{name}\"]:"), format!("{name}.lua:"));
    let about_scene = case.components().any(|part| part.as_os_str() == "scene");
    let lines = output.lines().filter(|line| {
        let chatter = line.contains(":loadinfo]")
            || line.starts_with("[sandboxScript:info]")
            || (about_scene && is_log(line, &["warning", "info"]));
        !chatter && *line != "stack traceback:" && !line.starts_with('\t')
    });
    let text: Vec<String> = lines
        .map(|line| mask_addresses(&line.replace(&folder, "").replace(&chunk, &file)))
        .collect();
    text.join("\n")
}

/// Whether `line` is a log line of one of these levels.
fn is_log(line: &str, levels: &[&str]) -> bool {
    let head = line
        .strip_prefix('[')
        .and_then(|rest| rest.split_once(']'))
        .map(|(head, _)| head);
    head.and_then(|head| head.rsplit_once(':'))
        .is_some_and(|(_, level)| levels.contains(&level))
}

/// `0x` and at least six hexadecimal digits become `0xADDR`.
fn mask_addresses(line: &str) -> String {
    let mut out = String::new();
    let mut rest = line;
    while let Some(at) = rest.find("0x") {
        let digits = rest[at + 2..]
            .chars()
            .take_while(char::is_ascii_hexdigit)
            .count();
        out += &rest[..at];
        out += if digits >= 6 {
            "0xADDR"
        } else {
            &rest[at..at + 2 + digits]
        };
        rest = &rest[at + 2 + digits..];
    }
    out + rest
}

/// The first lines that differ, or None when all agree within `tolerance`.
pub fn difference(expected: &str, actual: &str, tolerance: f64) -> Option<String> {
    let (expected, actual) = (lines(expected), lines(actual));
    let mut report = String::new();
    for i in 0..expected.len().max(actual.len()) {
        let (want, got) = (expected.get(i), actual.get(i));
        if !want
            .zip(got)
            .is_some_and(|(want, got)| lines_agree(want, got, tolerance))
        {
            report += &format!(
                "  line {}:\n    expected {}\n    actual   {}\n",
                i + 1,
                shown(want),
                shown(got)
            );
        }
        if report.lines().count() > 24 {
            break;
        }
    }
    (!report.is_empty()).then_some(report)
}

fn lines(text: &str) -> Vec<&str> {
    text.trim_end_matches('\n')
        .split('\n')
        .map(|line| line.trim_end().trim_end_matches(SETTINGS_REMARK))
        .collect()
}

fn shown<'a>(line: Option<&&'a str>) -> &'a str {
    line.copied().unwrap_or("(nothing)")
}

fn lines_agree(want: &str, got: &str, tolerance: f64) -> bool {
    if want == got {
        return true;
    }
    let (want, got) = (split_numbers(want), split_numbers(got));
    want.0 == got.0
        && want.1.len() == got.1.len()
        && want.1.iter().zip(&got.1).all(|(a, b)| {
            (a - b).abs() <= tolerance + 1e-12 || a == b || (a.is_nan() && b.is_nan())
        })
}

/// The text with every number replaced by `#`, and the numbers.
fn split_numbers(line: &str) -> (String, Vec<f64>) {
    let (mut text, mut numbers) = (String::new(), Vec::new());
    let mut previous = ' ';
    let mut rest = line;
    while let Some(first) = rest.chars().next() {
        match number_at(rest).filter(|_| !is_word(previous)) {
            Some((length, number)) => {
                text.push('#');
                numbers.push(number);
                previous = '0';
                rest = &rest[length..];
            }
            None => {
                text.push(first);
                previous = first;
                rest = &rest[first.len_utf8()..];
            }
        }
    }
    (text, numbers)
}

fn is_word(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

/// The number `text` begins with, if it is not the beginning of a word, and its length.
fn number_at(text: &str) -> Option<(usize, f64)> {
    let digits = |s: &str| s.len() - s.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let mut length = usize::from(text.starts_with(['-', '+']));
    let whole = digits(&text[length..]);
    let special = ["nan", "inf"]
        .iter()
        .find(|word| text[length..].starts_with(**word));
    if let Some(word) = special {
        length += word.len();
    } else {
        length += whole;
        let fraction = text[length..].strip_prefix('.').map(digits);
        if whole == 0 && fraction.is_none_or(|n| n == 0) {
            return None;
        }
        length += fraction.map_or(0, |n| n + 1);
        let exponent = text[length..]
            .strip_prefix(['e', 'E'])
            .map(|e| (e.len() - e.trim_start_matches(['-', '+']).len(), e));
        if let Some((sign, e)) = exponent.filter(|(sign, e)| digits(&e[*sign..]) > 0) {
            length += 1 + sign + digits(&e[sign..]);
        }
    }
    if text[length..].chars().next().is_some_and(is_word) {
        return None;
    }
    text[..length]
        .trim_end_matches('.')
        .parse()
        .ok()
        .map(|number| (length, number))
}
