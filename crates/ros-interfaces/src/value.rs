//! Values of any type.

use std::sync::Arc;

use crate::{Element, Field, FieldType, Layout, Number, Numbers, Shape, ValueError};

/// A time of ROS 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Time {
    /// Whole seconds.
    pub sec: u32,
    /// Below 10^9.
    pub nanosec: u32,
}

/// A duration of ROS 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Duration {
    /// Whole seconds.
    pub sec: i32,
    /// Below 10^9.
    pub nanosec: i32,
}

/// The value of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number or a truth value.
    Number(Number),
    /// The bytes of a string; UTF-8 by convention, and always for `wstring`.
    String(Vec<u8>),
    /// A time of ROS 1.
    Time(Time),
    /// A duration of ROS 1.
    Duration(Duration),
    /// A nested structure.
    Record(Record),
    /// An array, fixed or not.
    Array(Array),
}

/// The value of a field that is an array.
#[derive(Clone, Debug, PartialEq)]
pub enum Array {
    /// Numbers, one after the other without anything between them.
    Numbers(Numbers),
    /// Strings of both kinds.
    Strings(Vec<Vec<u8>>),
    /// Times of ROS 1.
    Times(Vec<Time>),
    /// Durations of ROS 1.
    Durations(Vec<Duration>),
    /// Nested structures.
    Records(Vec<Record>),
}

impl Array {
    /// How many elements there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(all) => all.len(),
            Self::Strings(all) => all.len(),
            Self::Times(all) => all.len(),
            Self::Durations(all) => all.len(),
            Self::Records(all) => all.len(),
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// `length` elements with default values.
    #[must_use]
    pub fn of_defaults(element: &Element<Arc<Layout>>, length: usize) -> Self {
        match element {
            Element::Number(number) => Self::Numbers(number.zeros(length)),
            Element::String(_) | Element::WString(_) => Self::Strings(vec![Vec::new(); length]),
            Element::Time => Self::Times(vec![Time::default(); length]),
            Element::Duration => Self::Durations(vec![Duration::default(); length]),
            Element::Nested(layout) => {
                Self::Records((0..length).map(|_| Record::new(layout)).collect())
            }
        }
    }

    /// Whether all elements are of this type.
    fn is_of(&self, element: &Element<Arc<Layout>>) -> bool {
        match (self, element) {
            (Self::Numbers(all), Element::Number(number)) => {
                all.number_type() == number.of_values()
            }
            (Self::Strings(all), Element::String(bound) | Element::WString(bound)) => {
                all.iter().all(|text| is_within(text.len(), *bound))
            }
            (Self::Times(_), Element::Time) | (Self::Durations(_), Element::Duration) => true,
            (Self::Records(all), Element::Nested(layout)) => {
                all.iter().all(|record| record.is_of(layout))
            }
            _ => false,
        }
    }
}

impl Value {
    /// The value that a field has if nothing else is said.
    #[must_use]
    pub fn of_field(field: &Field<Arc<Layout>>) -> Self {
        field
            .default
            .clone()
            .unwrap_or_else(|| Self::of_type(&field.field_type))
    }

    /// Zero, an empty string, an empty sequence, or a record of defaults.
    #[must_use]
    pub fn of_type(field_type: &FieldType<Arc<Layout>>) -> Self {
        match field_type.shape {
            Shape::Single => Self::of_element(&field_type.element),
            Shape::Array(length) => Self::Array(Array::of_defaults(&field_type.element, length)),
            Shape::Sequence(_) => Self::Array(Array::of_defaults(&field_type.element, 0)),
        }
    }

    fn of_element(element: &Element<Arc<Layout>>) -> Self {
        match element {
            Element::Number(number) => Self::Number(number.zero()),
            Element::String(_) | Element::WString(_) => Self::String(Vec::new()),
            Element::Time => Self::Time(Time::default()),
            Element::Duration => Self::Duration(Duration::default()),
            Element::Nested(layout) => Self::Record(Record::new(layout)),
        }
    }

    /// Whether it is a value of this type, with the length that the type prescribes.
    #[must_use]
    pub fn is_of(&self, field_type: &FieldType<Arc<Layout>>) -> bool {
        match (self, field_type.shape) {
            (Self::Array(array), Shape::Array(length)) => {
                array.len() == length && array.is_of(&field_type.element)
            }
            (Self::Array(array), Shape::Sequence(bound)) => {
                is_within(array.len(), bound) && array.is_of(&field_type.element)
            }
            (_, Shape::Single) => self.is_of_element(&field_type.element),
            _ => false,
        }
    }

    fn is_of_element(&self, element: &Element<Arc<Layout>>) -> bool {
        match (self, element) {
            (Self::Number(number), Element::Number(kind)) => {
                number.number_type() == kind.of_values()
            }
            (Self::String(text), Element::String(bound) | Element::WString(bound)) => {
                is_within(text.len(), *bound)
            }
            (Self::Time(_), Element::Time) | (Self::Duration(_), Element::Duration) => true,
            (Self::Record(record), Element::Nested(layout)) => record.is_of(layout),
            _ => false,
        }
    }
}

fn is_within(length: usize, bound: Option<usize>) -> bool {
    bound.is_none_or(|bound| length <= bound)
}

/// A value of a structure: one for each field of its layout, of the field's type. This always holds, so codecs need not check it.
#[derive(Clone, Debug)]
pub struct Record {
    layout: Arc<Layout>,
    values: Vec<Value>,
}

impl Record {
    /// With default values.
    #[must_use]
    pub fn new(layout: &Arc<Layout>) -> Self {
        Self {
            layout: layout.clone(),
            values: layout.fields.iter().map(Value::of_field).collect(),
        }
    }

    /// With these values, one for each field.
    ///
    /// # Errors
    /// If a value is of another type than its field, or there are more or fewer.
    pub fn with_values(layout: &Arc<Layout>, values: Vec<Value>) -> Result<Self, ValueError> {
        if values.len() != layout.fields.len() {
            let field = format!("number {}", values.len().min(layout.fields.len()) + 1);
            return Err(ValueError::Field {
                layout: layout.name.to_string(),
                field,
            });
        }
        for (field, value) in layout.fields.iter().zip(&values) {
            check(layout, field, value)?;
        }
        Ok(Self {
            layout: layout.clone(),
            values,
        })
    }

    /// Of values that a codec has read by the layout.
    pub(crate) fn of_codec(layout: &Arc<Layout>, values: Vec<Value>) -> Self {
        Self {
            layout: layout.clone(),
            values,
        }
    }

    /// Its type.
    #[must_use]
    pub fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    /// The values, in the order of the layout's fields.
    #[must_use]
    pub fn values(&self) -> &[Value] {
        &self.values
    }

    /// Fields and their values.
    pub fn iter(&self) -> impl Iterator<Item = (&Field<Arc<Layout>>, &Value)> {
        self.layout.fields.iter().zip(&self.values)
    }

    /// The value of a field.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.layout
            .field(name)
            .and_then(|(index, _)| self.values.get(index))
    }

    /// Sets a field.
    ///
    /// # Errors
    /// If there is no such field, or the value is of another type.
    pub fn set(&mut self, name: &str, value: Value) -> Result<(), ValueError> {
        let layout = self.layout.clone();
        let unknown = || ValueError::Field {
            layout: layout.name.to_string(),
            field: name.into(),
        };
        let (index, field) = layout.field(name).ok_or_else(unknown)?;
        check(&layout, field, &value)?;
        self.values[index] = value;
        Ok(())
    }

    /// Whether it was made with this layout; a catalogue returns the same one each time.
    #[must_use]
    pub fn is_of(&self, layout: &Arc<Layout>) -> bool {
        Arc::ptr_eq(&self.layout, layout)
    }
}

impl PartialEq for Record {
    fn eq(&self, other: &Self) -> bool {
        self.is_of(&other.layout) && self.values == other.values
    }
}

fn check(layout: &Layout, field: &Field<Arc<Layout>>, value: &Value) -> Result<(), ValueError> {
    if value.is_of(&field.field_type) {
        return Ok(());
    }
    let expected = field.field_type.to_string();
    Err(ValueError::Type {
        layout: layout.name.to_string(),
        field: field.name.clone(),
        expected,
    })
}
