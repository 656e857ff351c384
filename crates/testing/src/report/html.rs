//! One page for a browser, with everything in it: it needs no network, and works without JavaScript, which only adds a filter.
//!
//! Its content security policy forbids external resources. Plots are separate images, so their text never becomes part of the page.

mod property;

use std::fmt;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;

use super::parts;
use crate::{Comparison, Excerpt, Outcome, Recordings, Status, Summary};
use script::test_bench::ConsoleLine;

const STYLE: &str = include_str!("html/page.css");
const SCRIPT: &str = include_str!("html/page.js");

const STATUSES: [(Status, &str); 4] = [
    (Status::Failed, "failed"),
    (Status::Error, "errors"),
    (Status::Pending, "pending"),
    (Status::Passed, "passed"),
];

/// The report on a whole run, for a file in `folder`: recordings are linked relative to it.
pub fn report(summary: &Summary, folder: &Path) -> String {
    let title = title(summary);
    let files: String = parts::files(summary)
        .map(|outcomes| file(outcomes, folder))
        .collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
        <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; \
        script-src 'unsafe-inline'; img-src data:\">\n\
        <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n\
        <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n{}{CONTROLS}</header>\n\
        <main>\n{files}</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        counts(summary),
    )
}

/// Shown by the script only.
const CONTROLS: &str = "<form class=\"controls\" role=\"search\" hidden>\n\
    <input type=\"search\" id=\"find\" placeholder=\"Find in names, messages, consoles\" aria-label=\"Find\">\n\
    <button type=\"button\" id=\"unfold\">Unfold all</button>\n<button type=\"button\" id=\"fold\">Fold all</button>\n\
    <output id=\"shown\"></output>\n</form>\n";

fn title(summary: &Summary) -> String {
    let bad = summary.count(Status::Failed) + summary.count(Status::Error);
    let total = summary.outcomes.len();
    let interrupted = if summary.interrupted {
        ", interrupted"
    } else {
        ""
    };
    match (bad, total) {
        (_, 0) => format!("No tests{interrupted}"),
        (0, _) => format!("No test of {total} failed{interrupted}"),
        _ => format!("{bad} of {} failed{interrupted}", plural(total, "test")),
    }
}

/// The counts are boxes to tick: they choose what is shown.
fn counts(summary: &Summary) -> String {
    let boxes: String = STATUSES
        .iter()
        .map(|&(status, word)| {
            let (count, class) = (summary.count(status), parts::word(status));
            format!(
                "<li class=\"{class}\"><label><input type=\"checkbox\" value=\"{class}\" checked> \
                <b>{count}</b> {word}</label></li>\n"
            )
        })
        .collect();
    let rest = [
        (summary.not_run, "not run"),
        (summary.deselected, "deselected"),
    ];
    let rest = rest
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, word)| format!("<li><b>{count}</b> {word}</li>\n"));
    let wall = format!("<li>{}</li>\n", duration(summary.wall.as_secs_f64()));
    format!(
        "<ul class=\"counts\">\n{boxes}{}{wall}</ul>\n",
        rest.collect::<String>()
    )
}

fn file(outcomes: &[Outcome], folder: &Path) -> String {
    let path = outcomes[0].test.file.to_string_lossy();
    let bad = outcomes.iter().filter(|outcome| outcome.is_bad()).count();
    let failed = if bad > 0 {
        format!(", {bad} failed")
    } else {
        String::new()
    };
    let tests: String = outcomes
        .iter()
        .map(|outcome| test(outcome, folder))
        .collect();
    let count = plural(outcomes.len(), "test");
    format!(
        "<section>\n<h2>{} <small>{count}{failed}</small></h2>\n{tests}</section>\n",
        Quoted(&path)
    )
}

fn test(outcome: &Outcome, folder: &Path) -> String {
    let word = parts::word(outcome.status);
    let open = if outcome.is_bad() { " open" } else { "" };
    let title = outcome.test.title();
    let wall = duration(outcome.wall.as_secs_f64());
    format!(
        "<details class=\"test {word}\"{open}>\n<summary><span class=\"status\">{word}</span> \
        <span class=\"name\">{}</span> <span class=\"time\">{wall}</span></summary>\n<div>\n{}{}{}{}{}{}{}{}{}</div>\n</details>\n",
        Quoted(&title),
        message(outcome),
        outcome.excerpts.iter().map(excerpt).collect::<String>(),
        facts(outcome),
        property::section(outcome),
        outcome
            .recording
            .as_deref()
            .map_or_else(String::new, |page| recording(page, folder, outcome.time)),
        outcome
            .capture
            .as_deref()
            .map_or_else(String::new, |file| captured(file, folder)),
        outcome.comparisons.iter().map(plot).collect::<String>(),
        console(&outcome.console),
        folded("trace", "Traceback", outcome.trace.trim()),
    )
}

fn message(outcome: &Outcome) -> String {
    if outcome.message.is_empty() {
        return String::new();
    }
    format!(
        "<pre class=\"message\">{}</pre>\n",
        Quoted(&outcome.message)
    )
}

fn excerpt(excerpt: &Excerpt) -> String {
    let lines: String = excerpt
        .numbered()
        .map(|(number, code, is_meant)| {
            let line = format!("<span class=\"number\">{number:>4}</span> {}", Quoted(code));
            if is_meant {
                format!("<mark>{line}</mark>\n")
            } else {
                line + "\n"
            }
        })
        .collect();
    let place = format!("{}:{}", excerpt.place, excerpt.line);
    format!(
        "<figure><figcaption>{}</figcaption><pre>{lines}</pre></figure>\n",
        Quoted(&place)
    )
}

fn facts(outcome: &Outcome) -> String {
    let mut facts = Vec::new();
    facts.extend(
        outcome
            .script
            .as_ref()
            .map(|script| format!("in script {script}")),
    );
    facts.extend(parts::moment(outcome));
    facts.push(format!("with seed {}", outcome.test.seed));
    facts.extend(
        outcome
            .test
            .line
            .map(|line| format!("defined in line {line}")),
    );
    format!("<p class=\"facts\">{}</p>\n", Quoted(&facts.join(", ")))
}

/// Seconds before the end of a failed test from which its recording may be played.
const BEFORE_END: f64 = 1.0;

/// Links to the page that plays a failed test: from its beginning, and from shortly before it has failed, at that time.
fn recording(page: &Path, folder: &Path, time: f64) -> String {
    let address = address_below(folder, page);
    let address = Quoted(&address);
    let late = if time > BEFORE_END {
        let from = time - BEFORE_END;
        format!(" or <a href=\"{address}#t={from:.3}\">its last {BEFORE_END} s</a>")
    } else {
        String::new()
    };
    format!("<p class=\"recording\"><a href=\"{address}\">Play the recording</a>{late}</p>\n")
}

/// A link to the file from which a failed test can be run again.
fn captured(file: &Path, folder: &Path) -> String {
    let address = address_below(folder, file);
    let name = file.to_string_lossy();
    format!(
        "<p class=\"recording\"><a href=\"{}\">The capture</a>: <code>swanilda replay {}</code></p>\n",
        Quoted(&address),
        Quoted(&name)
    )
}

/// The address of a file in a page that lies in `folder`.
fn address_below(folder: &Path, file: &Path) -> String {
    // The folder of `report.html` is empty, which is no path.
    let absolute = |path: &Path| std::path::absolute(Path::new(".").join(path));
    let (Ok(folder), Ok(file)) = (absolute(folder), absolute(file)) else {
        return file.to_string_lossy().into_owned();
    };
    let common = folder
        .components()
        .zip(file.components())
        .take_while(|(a, b)| a == b)
        .count();
    let up = folder.components().skip(common).map(|_| "..".to_owned());
    let down = file
        .components()
        .skip(common)
        .map(|part| encoded(&part.as_os_str().to_string_lossy()));
    up.chain(down).collect::<Vec<_>>().join("/")
}

/// RFC 3986: what has a meaning in addresses as the codes of its bytes.
fn encoded(name: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~".contains(&byte);
    let code = |byte: u8| {
        if plain(byte) {
            char::from(byte).to_string()
        } else {
            format!("%{byte:02X}")
        }
    };
    name.bytes().map(code).collect()
}

/// The plot of a golden trace, or a golden picture that differs. The result is part of the test's message.
fn plot(comparison: &Comparison) -> String {
    let (kind, content) = match (comparison.svg(), &comparison.recordings) {
        (Some(svg), _) => ("svg+xml", svg.into_bytes()),
        (None, Recordings::Images { .. }) => match comparison.png() {
            Some(png) => ("png", png),
            None => return String::new(),
        },
        (None, Recordings::Traces { .. }) => return String::new(),
    };
    let about = format!(
        "golden '{}'{}",
        comparison.name,
        if comparison.is_bad() { " differs" } else { "" }
    );
    let open = if comparison.is_bad() { " open" } else { "" };
    format!(
        "<details class=\"plot\"{open}>\n<summary>Plot of {0}</summary>\n\
        <img alt=\"Expected and actual values: {0}\" src=\"data:image/{2};base64,{1}\">\n</details>\n",
        Quoted(&about),
        BASE64.encode(content),
        kind,
    )
}

fn console(lines: &[ConsoleLine]) -> String {
    let line = |line: &ConsoleLine| {
        let text = parts::console_line(line);
        format!(
            "<span class=\"{}\">{}</span>\n",
            Quoted(line.level),
            Quoted(&text)
        )
    };
    if lines.is_empty() {
        return String::new();
    }
    let text: String = lines.iter().map(line).collect();
    let count = plural(lines.len(), "line");
    format!(
        "<details class=\"console\">\n<summary>Console ({count})</summary>\n<pre>{text}</pre>\n</details>\n"
    )
}

fn folded(class: &str, title: &str, text: &str) -> String {
    if text.is_empty() {
        return String::new();
    }
    format!(
        "<details class=\"{class}\">\n<summary>{title}</summary>\n<pre>{}</pre>\n</details>\n",
        Quoted(text)
    )
}

fn plural(count: usize, word: &str) -> String {
    format!("{count} {word}{}", if count == 1 { "" } else { "s" })
}

fn duration(seconds: f64) -> String {
    if seconds < 1.0 {
        format!("{:.1} ms", seconds * 1e3)
    } else {
        format!("{seconds:.2} s")
    }
}

/// Escaped text for any place in the page.
struct Quoted<'a>(&'a str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use fmt::Write;
        self.0.chars().try_for_each(|c| match c {
            '&' => f.write_str("&amp;"),
            '<' => f.write_str("&lt;"),
            '>' => f.write_str("&gt;"),
            '"' => f.write_str("&quot;"),
            '\'' => f.write_str("&#39;"),
            _ => f.write_char(parts::allowed(c)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::parts::sample;
    use super::*;

    #[test]
    fn all_tests_are_there() {
        let page = report(&sample::summary(), Path::new(""));
        assert_eq!(page.matches("<section>").count(), 2);
        assert_eq!(page.matches("<details class=\"test ").count(), 5);
        assert_eq!(
            page.matches(" open>\n<summary><span").count(),
            2,
            "what failed is unfolded"
        );
        for part in [
            "<b>1</b> failed",
            "<b>2</b> not run",
            "2 of 5 tests failed",
            "Console (2 lines)",
            "1.50 s",
        ] {
            assert!(page.contains(part), "{part}");
        }
    }

    #[test]
    fn nothing_a_test_says_is_more_than_text() {
        let page = report(&sample::summary(), Path::new(""));
        assert_eq!(page.matches("<script>").count(), 1, "its own");
        assert!(page.matches("&lt;script&gt;alert(&#39;x&#39;)").count() >= 4);
        assert!(!page.contains('\u{1b}') && !page.contains('\0'));
    }

    #[test]
    fn nothing_comes_from_elsewhere() {
        let page = report(&sample::summary(), Path::new(""));
        for part in ["http:", "https:", "//cdn", "url(", "@import"] {
            assert!(!page.contains(part), "{part}");
        }
    }

    #[test]
    fn a_run_without_tests() {
        assert!(report(&Summary::default(), Path::new("")).contains("<h1>No tests</h1>"));
    }
}
