//! Markdown pages: one per category, and an index.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::approximated::difference;
use super::modules;
use super::row::FunctionDoc;

/// The pages of `docs/api`.
pub(super) fn pages(functions: &[FunctionDoc]) -> Vec<(String, String)> {
    let mut categories: BTreeMap<&str, Vec<&FunctionDoc>> = BTreeMap::new();
    for function in functions {
        categories
            .entry(&function.category)
            .or_default()
            .push(function);
    }
    let mut pages = vec![("docs/api/README.md".to_owned(), index(&categories))];
    for (category, functions) in &categories {
        pages.push((
            format!("docs/api/{}.md", slug(category)),
            page(category, functions),
        ));
    }
    pages
}

fn index(categories: &BTreeMap<&str, Vec<&FunctionDoc>>) -> String {
    let count: usize = categories.values().map(Vec::len).sum();
    let mut out = format!(
        "# Functions for scripts\n\nGenerated from the sources: `UPDATE=1 cargo test --test repository generated`. {count} names in {} \
         categories. In a terminal: `swanilda api NAME`. Properties have \
         [a page of their own](../PROPERTIES.md).\n",
        categories.len()
    );
    for (category, functions) in categories {
        let _ = write!(out, "\n## [{category}]({}.md)\n\n", slug(category));
        let links = functions
            .iter()
            .map(|f| format!("[{}]({}.md#{})", f.name, slug(category), anchor(&f.name)));
        let _ = writeln!(out, "{}", links.collect::<Vec<_>>().join(" · "));
    }
    let links = modules::names().map(|name| format!("[{name}](modules.md#{})", anchor(&name)));
    let _ = write!(
        out,
        "\n## [Modules](modules.md)\n\n{}\n",
        links.collect::<Vec<_>>().join(" · ")
    );
    out
}

fn page(category: &str, functions: &[&FunctionDoc]) -> String {
    let mut out = format!("# {category}\n\n[All categories](README.md)\n");
    for function in functions {
        let _ = write!(out, "\n## {}\n\n{}", function.name, body(function));
    }
    out
}

pub(super) fn body(function: &FunctionDoc) -> String {
    let mut out = String::new();
    if let Some(replacement) = &function.deprecated {
        let advice = if replacement.is_empty() {
            String::new()
        } else {
            format!("; use `{replacement}`")
        };
        let _ = write!(out, "**Deprecated**{advice}.\n\n");
    }
    if let Some(name) = &function.alias_of {
        let _ = write!(out, "Another name for `{name}`.\n\n");
    }
    if let Some(how) = difference(&function.name) {
        let _ = write!(out, "**Approximated**: {how}.\n\n");
    }
    let _ = write!(out, "```\n{}\n```\n", function.signature());
    if function.alias_of.is_some() {
        return out;
    }
    if !function.text.is_empty() {
        let _ = write!(out, "\n{}\n", function.text);
    }
    let parameters = function
        .parameters
        .iter()
        .filter(|p| !p.text.is_empty())
        .map(|p| item(&p.name, &p.text));
    let results = function
        .results
        .iter()
        .filter(|r| !r.text.is_empty())
        .map(|r| format!("- → {}", &item(&r.name, &r.text)[2..]));
    let items: String = parameters.chain(results).collect();
    if !items.is_empty() {
        let _ = write!(out, "\n{items}");
    }
    out
}

fn item(name: &str, text: &str) -> String {
    format!("- `{name}`: {text}\n")
}

/// One function for a terminal.
pub fn function_text(function: &FunctionDoc) -> String {
    format!(
        "{} ({})\n\n{}",
        function.name,
        function.category,
        body(function).replace("```\n", "")
    )
}

fn slug(category: &str) -> String {
    category.to_lowercase().replace(' ', "-")
}

/// The anchor of a heading in Markdown viewers.
fn anchor(heading: &str) -> String {
    heading.to_lowercase().replace('.', "")
}
