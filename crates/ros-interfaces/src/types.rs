//! What a type consists of: as a text says it, and with nested types resolved.

use std::fmt;
use std::sync::Arc;

use crate::{NumberType, TypeName, Value};

/// What a field holds, or each element of its array. `N` is how a nested type is known: [`TypeName`] or `Arc<Layout>`.
#[derive(Clone, Debug, PartialEq)]
pub enum Element<N> {
    /// A number or a truth value.
    Number(NumberType),
    /// Bytes that are text by convention, at most so many.
    String(Option<usize>),
    /// Characters of 16 bits on the wire, at most so many; UTF-8 in values.
    WString(Option<usize>),
    /// `time` of ROS 1.
    Time,
    /// `duration` of ROS 1.
    Duration,
    /// Another type.
    Nested(N),
}

/// How many elements a field has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Exactly one, without an array.
    Single,
    /// An array of fixed length.
    Array(usize),
    /// An array of any length, up to a bound.
    Sequence(Option<usize>),
}

/// The type of a field.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldType<N> {
    /// What it holds.
    pub element: Element<N>,
    /// And how many.
    pub shape: Shape,
}

/// A field of a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct Field<N> {
    /// As in the text.
    pub name: String,
    /// Its type.
    pub field_type: FieldType<N>,
    /// The value that the text states; ROS 2 only.
    pub default: Option<Value>,
}

/// A constant of a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// As in the text.
    pub name: String,
    /// A number or a string.
    pub element: Element<TypeName>,
    /// Its value.
    pub value: Value,
    /// The value as it is written, which MD5 sums of ROS 1 depend on.
    pub text: String,
}

/// A structure as its text says it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Structure {
    /// In the order of the text.
    pub constants: Vec<Constant>,
    /// In the order of the text.
    pub fields: Vec<Field<TypeName>>,
}

/// What the text of an interface says: one structure for a message, request and response of a service, goal, result and feedback of an action.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// Its name, which tells the kind.
    pub name: TypeName,
    /// As many as [`crate::InterfaceKind::parts`] says.
    pub parts: Vec<Structure>,
}

/// A type with everything that is needed to encode, decode and convert values: nested types are resolved.
#[derive(Clone, Debug)]
pub struct Layout {
    /// `std_srvs/srv/SetBool_Request` for the request of a service.
    pub name: TypeName,
    /// In the order of the text.
    pub constants: Vec<Constant>,
    /// In the order of the text and of the bytes.
    pub fields: Vec<Field<Arc<Layout>>>,
    /// How many values a record has at least, those of nested records included.
    pub(crate) fixed_values: usize,
    /// How many bytes a record has at least in ROS 1.
    pub(crate) least_size: usize,
}

impl Layout {
    /// Sums over nested types are taken once for each type: a type may be nested in others in very many ways.
    pub(crate) fn new(
        name: TypeName,
        constants: Vec<Constant>,
        fields: Vec<Field<Arc<Layout>>>,
    ) -> Self {
        let sum = |of_field: fn(&FieldType<Arc<Layout>>) -> usize, first: usize| {
            fields
                .iter()
                .map(|field| of_field(&field.field_type))
                .fold(first, usize::saturating_add)
        };
        let (fixed_values, least_size) = (
            sum(FieldType::fixed_values, 1),
            sum(FieldType::least_size, 0),
        );
        Self {
            name,
            constants,
            fields,
            fixed_values,
            least_size,
        }
    }

    /// The field with this name, and its place among the fields.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<(usize, &Field<Arc<Layout>>)> {
        self.fields
            .iter()
            .enumerate()
            .find(|(_, field)| field.name == name)
    }
}

impl FieldType<Arc<Layout>> {
    fn fixed_values(&self) -> usize {
        let each = match &self.element {
            Element::Nested(nested) => nested.fixed_values,
            _ => 1,
        };
        match self.shape {
            Shape::Single => each,
            Shape::Array(length) => each.saturating_mul(length).max(1),
            Shape::Sequence(_) => 1,
        }
    }

    fn least_size(&self) -> usize {
        let each = match &self.element {
            Element::Number(number) => number.size(),
            Element::String(_) | Element::WString(_) => 4,
            Element::Time | Element::Duration => 8,
            Element::Nested(nested) => nested.least_size,
        };
        match self.shape {
            Shape::Single => each,
            Shape::Array(length) => each.saturating_mul(length),
            Shape::Sequence(_) => 4,
        }
    }
}

/// How a text of an interface names a nested type.
pub trait NestedName {
    /// `package/Name`.
    fn nested_name(&self) -> String;
}

impl NestedName for TypeName {
    fn nested_name(&self) -> String {
        self.short()
    }
}

impl NestedName for Arc<Layout> {
    fn nested_name(&self) -> String {
        self.name.short()
    }
}

impl<N: NestedName> fmt::Display for Element<N> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Number(number) => f.write_str(number.word()),
            Self::String(None) => f.write_str("string"),
            Self::String(Some(bound)) => write!(f, "string<={bound}"),
            Self::WString(None) => f.write_str("wstring"),
            Self::WString(Some(bound)) => write!(f, "wstring<={bound}"),
            Self::Time => f.write_str("time"),
            Self::Duration => f.write_str("duration"),
            Self::Nested(name) => f.write_str(&name.nested_name()),
        }
    }
}

impl<N: NestedName> fmt::Display for FieldType<N> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.shape {
            Shape::Single => self.element.fmt(f),
            Shape::Array(length) => write!(f, "{}[{length}]", self.element),
            Shape::Sequence(None) => write!(f, "{}[]", self.element),
            Shape::Sequence(Some(bound)) => write!(f, "{}[<={bound}]", self.element),
        }
    }
}
