//! Hashes of types, by which nodes of ROS 2 (Iron and later) see whether they mean the same by a name (REP 2016, version 1 of the standard).
//!
//! A hash is that of a text: the description of the type and of all types nested in it, as JSON of one form.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;

use ring::digest;

use crate::{Element, Field, Layout, NumberType, Shape};

/// Before the digits of a hash.
const PREFIX: &str = "RIHS01_";
/// Numbers of types of fields (type_description_interfaces/msg/FieldType): of one value, and what is added for arrays.
const NESTED: u8 = 1;
const BOOLEAN: u8 = 15;
const BYTE: u8 = 16;
const STRING: u8 = 17;
const WSTRING: u8 = 18;
const BOUNDED_STRING: u8 = 21;
const BOUNDED_WSTRING: u8 = 22;
const ARRAY: u8 = 48;
const BOUNDED_SEQUENCE: u8 = 96;
const UNBOUNDED_SEQUENCE: u8 = 144;

/// The hash of a type of ROS 2, such as `RIHS01_df66...`.
pub fn type_hash(layout: &Layout) -> String {
    let mut nested = BTreeMap::new();
    add_nested(layout, &mut nested);
    let nested: Vec<_> = nested.values().map(|layout| description(layout)).collect();
    let text = format!(
        "{{\"type_description\": {}, \"referenced_type_descriptions\": [{}]}}",
        description(layout),
        nested.join(", ")
    );
    let hash = digest::digest(&digest::SHA256, text.as_bytes());
    let mut word = PREFIX.to_owned();
    for byte in hash.as_ref() {
        write!(word, "{byte:02x}").expect("texts take everything");
    }
    word
}

/// All types within a type, by name, each once.
fn add_nested(layout: &Layout, found: &mut BTreeMap<String, Arc<Layout>>) {
    for field in &layout.fields {
        if let Element::Nested(inner) = &field.field_type.element
            && found
                .insert(inner.name.to_string(), Arc::clone(inner))
                .is_none()
        {
            add_nested(inner, found);
        }
    }
}

fn description(layout: &Layout) -> String {
    let mut fields: Vec<_> = layout.fields.iter().map(field).collect();
    if fields.is_empty() {
        // A structure without fields has this one in IDL.
        fields.push(field_text(
            "structure_needs_at_least_one_member",
            3,
            0,
            0,
            "",
        ));
    }
    format!(
        "{{\"type_name\": \"{}\", \"fields\": [{}]}}",
        layout.name,
        fields.join(", ")
    )
}

fn field(field: &Field<Arc<Layout>>) -> String {
    let (kind, string_capacity, nested) = match &field.field_type.element {
        Element::Number(number) => (of_number(*number), 0, String::new()),
        Element::String(None) => (STRING, 0, String::new()),
        Element::String(Some(bound)) => (BOUNDED_STRING, *bound, String::new()),
        Element::WString(None) => (WSTRING, 0, String::new()),
        Element::WString(Some(bound)) => (BOUNDED_WSTRING, *bound, String::new()),
        // Types of ROS 1 only.
        Element::Time | Element::Duration => (0, 0, String::new()),
        Element::Nested(inner) => (NESTED, 0, inner.name.to_string()),
    };
    let (added, capacity) = match field.field_type.shape {
        Shape::Single => (0, 0),
        Shape::Array(length) => (ARRAY, length),
        Shape::Sequence(Some(bound)) => (BOUNDED_SEQUENCE, bound),
        Shape::Sequence(None) => (UNBOUNDED_SEQUENCE, 0),
    };
    field_text(
        &field.name,
        kind + added,
        capacity,
        string_capacity,
        &nested,
    )
}

fn field_text(
    name: &str,
    kind: u8,
    capacity: usize,
    string_capacity: usize,
    nested: &str,
) -> String {
    format!(
        "{{\"name\": \"{name}\", \"type\": {{\"type_id\": {kind}, \"capacity\": {capacity}, \"string_capacity\": {string_capacity}, \"nested_type_name\": \"{nested}\"}}}}"
    )
}

/// `char` of a `.msg` file is `uint8` in IDL, and `byte` is `octet`.
fn of_number(number: NumberType) -> u8 {
    match number {
        NumberType::Bool => BOOLEAN,
        NumberType::Byte => BYTE,
        NumberType::Int8 => 2,
        NumberType::UInt8 | NumberType::Char => 3,
        NumberType::Int16 => 4,
        NumberType::UInt16 => 5,
        NumberType::Int32 => 6,
        NumberType::UInt32 => 7,
        NumberType::Int64 => 8,
        NumberType::UInt64 => 9,
        NumberType::Float32 => 10,
        NumberType::Float64 => 11,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Catalogue, Generation};

    /// As `ros2 topic info --verbose` of Jazzy shows them.
    #[test]
    fn hashes_are_those_of_ros() {
        let mut catalogue = Catalogue::new(Generation::Ros2);
        let mut hash = |name| type_hash(&catalogue.layout(name).expect("it is built in"));
        assert_eq!(
            hash("std_msgs/msg/String"),
            "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
        );
        assert_eq!(
            hash("geometry_msgs/msg/Twist"),
            "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"
        );
    }

    #[test]
    fn every_type_has_a_hash_of_its_own() {
        let mut catalogue = Catalogue::new(Generation::Ros2);
        let names = catalogue.names();
        let messages = names
            .iter()
            .filter(|name| name.to_string().contains("/msg/"));
        let hashes: Vec<_> = messages
            .map(|name| type_hash(&catalogue.layout(&name.to_string()).expect("it is built in")))
            .collect();
        let different: std::collections::BTreeSet<_> = hashes.iter().collect();
        assert_eq!(different.len(), hashes.len());
        assert!(hashes.iter().all(|hash| hash.len() == PREFIX.len() + 64));
    }
}
