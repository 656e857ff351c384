//! The documentation of a scriptable function.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Attribute, Expr, ExprLit, Lit, Meta};

/// The lines of a doc comment, each with its place in the source.
pub(crate) struct Doc(Vec<(String, Span)>);

impl Doc {
    pub(crate) fn of(attributes: &[Attribute]) -> Self {
        let comments = attributes
            .iter()
            .filter_map(|attribute| Some((text_of(attribute)?, attribute.span())));
        Self(
            comments
                .flat_map(|(text, span)| lines(&text, span))
                .collect(),
        )
    }

    pub(crate) fn text(&self) -> String {
        self.0
            .iter()
            .map(|(line, _)| line.as_str())
            .collect::<Vec<_>>()
            .join("\n")
    }

    /// # Errors
    /// At the first `@param` that describes none of these parameters.
    pub(crate) fn check_parameters(&self, known: &[&str]) -> syn::Result<()> {
        for (line, span) in &self.0 {
            let Some(described) = line.strip_prefix("@param") else {
                continue;
            };
            let name = described.split_whitespace().next().unwrap_or_default();
            if !known.contains(&name) {
                return Err(syn::Error::new(*span, unknown(name, known)));
            }
        }
        Ok(())
    }
}

fn unknown(name: &str, known: &[&str]) -> String {
    let has = match known {
        [] => "the function has none".to_owned(),
        _ => format!("scripts know them as `{}`", known.join("`, `")),
    };
    format!("`@param {name}` names no parameter of the function: {has}")
}

fn text_of(attribute: &Attribute) -> Option<String> {
    let Meta::NameValue(pair) = &attribute.meta else {
        return None;
    };
    match &pair.value {
        Expr::Lit(ExprLit {
            lit: Lit::Str(text),
            ..
        }) if pair.path.is_ident("doc") => Some(text.value()),
        _ => None,
    }
}

/// An empty comment is an empty line.
fn lines(text: &str, span: Span) -> Vec<(String, Span)> {
    text.split('\n')
        .map(|line| (line.trim().to_owned(), span))
        .collect()
}
