//! What the page says about a property and about temporal properties.

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;

use super::Quoted;
use crate::property::plot;
use crate::{Outcome, PropertyReport, ShownValue};

/// The cases of a property, and the pictures of what it measures.
pub(super) fn section(outcome: &Outcome) -> String {
    let cases = outcome.property.as_ref().map(cases).unwrap_or_default();
    let is_open = outcome.is_bad();
    let signals = plot::of_signals(&outcome.signals);
    let signals = picture("Robustness over time", signals, is_open);
    let samples = outcome.property.as_ref().map(|property| &property.samples);
    let samples = samples.and_then(|samples| plot::of_samples(samples));
    let caption = "Cases: failed ones red, the quarter that is closest to it orange";
    cases + &signals + &picture(caption, samples, is_open)
}

fn cases(property: &PropertyReport) -> String {
    let mut facts = vec![super::plural(property.cases, "case")];
    if property.discarded > 0 {
        facts.push(format!("{} of them discarded", property.discarded));
    }
    if property.robustness.is_finite() {
        facts.push(format!("least robustness {:.6}", property.robustness));
    }
    if property.lines > 0 {
        facts.push(format!(
            "{} of scripts reached",
            super::plural(property.lines, "line")
        ));
    }
    let facts = format!("<p class=\"facts\">{}</p>\n", Quoted(&facts.join(", ")));
    let first = values("The first case that failed", &property.first);
    let simplest = values("The simplest one found", &property.simplest);
    facts + &simplest + &first
}

fn values(title: &str, values: &[ShownValue]) -> String {
    if values.is_empty() {
        return String::new();
    }
    let row = |value: &ShownValue| {
        let line = value.line.map(|line| line.to_string()).unwrap_or_default();
        format!(
            "<tr><td class=\"number\">{line}</td><td><code>{}</code></td><td><code>{}</code></td></tr>\n",
            Quoted(&value.source),
            Quoted(&value.value)
        )
    };
    format!(
        "<figure class=\"values\"><figcaption>{title}</figcaption><table>\n{}</table></figure>\n",
        values.iter().map(row).collect::<String>()
    )
}

fn picture(title: &str, svg: Option<String>, is_open: bool) -> String {
    let Some(svg) = svg else {
        return String::new();
    };
    format!(
        "<details class=\"plot\"{}>\n<summary>{title}</summary>\n<img alt=\"{title}\" src=\"data:image/svg+xml;base64,{}\">\n</details>\n",
        if is_open { " open" } else { "" },
        BASE64.encode(svg)
    )
}
