//! Types as text, in the form that MD5 sums are made of and in the form that connections exchange.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;

use md5::{Digest, Md5};

use crate::types::NestedName;
use crate::{Element, Layout, TypeName};

/// The MD5 sum of a message type, as 32 hexadecimal digits: of its constants and fields, where a nested type counts by its own sum.
#[must_use]
pub fn md5(layout: &Layout) -> String {
    digest(&sum_text(layout, &mut BTreeMap::new()))
}

/// The MD5 sum of a service type.
#[must_use]
pub fn service_md5(request: &Layout, response: &Layout) -> String {
    let mut nested = BTreeMap::new();
    digest(&(sum_text(request, &mut nested) + &sum_text(response, &mut nested)))
}

fn digest(text: &str) -> String {
    Md5::digest(text.as_bytes())
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// `sums` are those of nested types that are known already: a type may occur very often.
fn sum_text(layout: &Layout, sums: &mut BTreeMap<TypeName, String>) -> String {
    let mut lines: Vec<String> = constants(layout).collect();
    for field in &layout.fields {
        let what = match &field.field_type.element {
            Element::Nested(nested) => nested_sum(nested, sums),
            _ => field.field_type.to_string(),
        };
        lines.push(format!("{what} {}", field.name));
    }
    lines.join("\n")
}

fn nested_sum(nested: &Layout, sums: &mut BTreeMap<TypeName, String>) -> String {
    if let Some(known) = sums.get(&nested.name) {
        return known.clone();
    }
    let sum = digest(&sum_text(nested, sums));
    sums.insert(nested.name.clone(), sum.clone());
    sum
}

fn constants(layout: &Layout) -> impl Iterator<Item = String> {
    layout
        .constants
        .iter()
        .map(|constant| format!("{} {}={}", constant.element, constant.name, constant.text))
}

/// The text of a type and of all types nested in it, as publishers send it to subscribers.
#[must_use]
pub fn definition(layout: &Arc<Layout>) -> String {
    let mut text = own_text(layout);
    let mut nested = Vec::new();
    collect_nested(layout, &mut nested);
    for inner in nested {
        let line = "=".repeat(80);
        write!(
            text,
            "\n{line}\nMSG: {}\n{}",
            inner.nested_name(),
            own_text(&inner)
        )
        .expect("a string takes everything");
    }
    text
}

fn own_text(layout: &Layout) -> String {
    let fields = layout
        .fields
        .iter()
        .map(|field| format!("{} {}", field.field_type, field.name));
    constants(layout)
        .chain(fields)
        .map(|line| line + "\n")
        .collect()
}

/// Each type once, in the order of the fields.
fn collect_nested(layout: &Arc<Layout>, found: &mut Vec<Arc<Layout>>) {
    for field in &layout.fields {
        if let Element::Nested(nested) = &field.field_type.element
            && !found.iter().any(|known| known.name == nested.name)
        {
            found.push(nested.clone());
            collect_nested(nested, found);
        }
    }
}
