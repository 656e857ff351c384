//! Messages of ROS as tables of Lua and back (spec: ros 3). The same for both generations.

use std::sync::Arc;

use ros_interfaces::{
    Array, Duration, Element, Field, FieldType, Layout, Number, NumberType, Numbers, Record, Shape,
    Time, Value,
};

use scene::numbers;
use scene::{Data, Key};

/// How scripts want to see messages.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Style {
    /// `uint8[]` is a string, not a table.
    pub bytes_as_strings: bool,
}

/// A message as a table with all fields.
pub(super) fn to_data(record: &Record, style: Style) -> Data {
    let entry = |(field, value): (&Field<Arc<Layout>>, &Value)| {
        (
            Key::Text(field.name.as_bytes().to_vec()),
            value_to_data(value, style),
        )
    };
    Data::Map(record.iter().map(entry).collect())
}

/// A value as scripts see it.
pub(super) fn value_to_data(value: &Value, style: Style) -> Data {
    match value {
        Value::Number(number) => number_to_data(*number),
        Value::String(text) => Data::Text(text.clone()),
        Value::Time(time) => time_to_data(*time),
        Value::Duration(duration) => duration_to_data(*duration),
        Value::Record(record) => to_data(record, style),
        Value::Array(array) => array_to_data(array, style),
    }
}

/// `uint32` passes through 32 bits with a sign, and integers of 64 bits are floats, as in the original.
fn number_to_data(number: Number) -> Data {
    match number {
        Number::Bool(value) => Data::Bool(value),
        Number::Int8(value) => Data::Int(value.into()),
        Number::UInt8(value) => Data::Int(value.into()),
        Number::Int16(value) => Data::Int(value.into()),
        Number::UInt16(value) => Data::Int(value.into()),
        Number::Int32(value) => Data::Int(value.into()),
        Number::UInt32(value) => Data::Int(value.cast_signed().into()),
        Number::Int64(value) => Data::Float(value as f64),
        Number::UInt64(value) => Data::Float(value as f64),
        Number::Float32(value) => Data::Float(value.into()),
        Number::Float64(value) => Data::Float(value),
    }
}

/// Times of ROS 1 are seconds.
fn time_to_data(time: Time) -> Data {
    Data::Float(f64::from(time.sec) + f64::from(time.nanosec) * 1e-9)
}

fn duration_to_data(duration: Duration) -> Data {
    Data::Float(f64::from(duration.sec) + f64::from(duration.nanosec) * 1e-9)
}

fn array_to_data(array: &Array, style: Style) -> Data {
    match array {
        Array::Numbers(Numbers::UInt8(bytes)) if style.bytes_as_strings => {
            Data::Text(bytes.clone())
        }
        Array::Numbers(numbers) => Data::Array(
            (0..numbers.len())
                .filter_map(|index| numbers.get(index))
                .map(number_to_data)
                .collect(),
        ),
        Array::Strings(all) => {
            Data::Array(all.iter().map(|text| Data::Text(text.clone())).collect())
        }
        Array::Times(all) => Data::Array(all.iter().map(|time| time_to_data(*time)).collect()),
        Array::Durations(all) => Data::Array(
            all.iter()
                .map(|duration| duration_to_data(*duration))
                .collect(),
        ),
        Array::Records(all) => {
            Data::Array(all.iter().map(|record| to_data(record, style)).collect())
        }
    }
}

/// A table as a message: what is not there keeps its default.
///
/// # Errors
/// An unknown key, or a value of another kind, with the message and the field.
pub(super) fn from_data(layout: &Arc<Layout>, data: &Data, style: Style) -> Result<Record, String> {
    let mut record = Record::new(layout);
    let entries = match data {
        Data::Map(entries) => entries,
        Data::Array(items) if items.is_empty() => return Ok(record),
        Data::Array(_) => return Err(format!("{}: unexpected key: 1", reader_of(layout))),
        _ => return Err(format!("{}: expected a table", reader_of(layout))),
    };
    for (key, value) in entries.iter().filter(|(_, value)| *value != Data::Nil) {
        let name = key_text(key);
        let (_, field) = layout
            .field(&name)
            .ok_or_else(|| format!("{}: unexpected key: {name}", reader_of(layout)))?;
        let value = field_from_data(&field.field_type, value, style)
            .map_err(|problem| problem.of_field(&reader_of(layout), &name))?;
        record
            .set(&name, value)
            .map_err(|error| error.to_string())?;
    }
    Ok(record)
}

/// The name of what reads a message, which errors begin with.
fn reader_of(layout: &Layout) -> String {
    format!("read__{}", layout.name.to_string().replace('/', "__"))
}

fn key_text(key: &Key) -> String {
    match key {
        Key::Text(text) => String::from_utf8_lossy(text).into_owned(),
        Key::Int(number) => number.to_string(),
        Key::Float(number) => number.to_string(),
        Key::Bool(value) => value.to_string(),
    }
}

/// Why a value is none of a field.
enum Problem {
    /// What was expected in its place.
    Expected(&'static str),
    /// Of a field within: it is described already.
    Within(String),
}

impl Problem {
    fn of_field(self, reader: &str, field: &str) -> String {
        match self {
            Self::Expected(kind) => format!("{reader}: field {field}: expected {kind}"),
            Self::Within(text) => text,
        }
    }
}

fn field_from_data(
    field_type: &FieldType<Arc<Layout>>,
    data: &Data,
    style: Style,
) -> Result<Value, Problem> {
    let element = &field_type.element;
    let mut array = match field_type.shape {
        Shape::Single => return element_from_data(element, data, style),
        _ => array_from_data(element, data, style)?,
    };
    match field_type.shape {
        // Fixed lengths are not checked in the original: what is missing is zero, what is too much is left out.
        Shape::Array(length) => resize(&mut array, element, length),
        Shape::Sequence(Some(bound)) if array.len() > bound => {
            return Err(Problem::Expected("a shorter array"));
        }
        _ => {}
    }
    Ok(Value::Array(array))
}

fn resize(array: &mut Array, element: &Element<Arc<Layout>>, length: usize) {
    let Array::Records(defaults) = Array::of_defaults(element, length) else {
        return match array {
            Array::Numbers(numbers) => numbers.resize(length),
            Array::Strings(all) => all.resize(length, Vec::new()),
            Array::Times(all) => all.resize(length, Time::default()),
            Array::Durations(all) => all.resize(length, Duration::default()),
            Array::Records(_) => {}
        };
    };
    if let Array::Records(all) = array {
        let present = all.len().min(length);
        all.truncate(length);
        all.extend(defaults.into_iter().skip(present));
    }
}

fn element_from_data(
    element: &Element<Arc<Layout>>,
    data: &Data,
    style: Style,
) -> Result<Value, Problem> {
    match element {
        Element::Number(number) => number_from_data(*number, data).map(Value::Number),
        Element::String(bound) | Element::WString(bound) => {
            text_from_data(data, *bound).map(Value::String)
        }
        Element::Time => time_from_data(data).map(Value::Time),
        Element::Duration => duration_from_data(data).map(Value::Duration),
        Element::Nested(layout) => match data {
            Data::Map(_) | Data::Array(_) => from_data(layout, data, style)
                .map(Value::Record)
                .map_err(Problem::Within),
            _ => Err(Problem::Expected("a table")),
        },
    }
}

fn number_from_data(number: NumberType, data: &Data) -> Result<Number, Problem> {
    let expected = match number {
        NumberType::Bool => "bool",
        NumberType::Float32 => "float",
        NumberType::Float64 => "double",
        _ => "integer",
    };
    match (number, data) {
        (NumberType::Bool, Data::Bool(value)) => Ok(Number::Bool(*value)),
        (NumberType::Bool, _) => Err(Problem::Expected(expected)),
        (_, Data::Int(value)) => Ok(number.of_integer(*value)),
        (_, Data::Float(value)) if number.is_float() => Ok(number.of_float(*value)),
        (NumberType::UInt64, Data::Float(value)) => Ok(number.of_float(*value)),
        // Fractions are cut off, and numbers below zero wrap around, as integers do.
        (_, Data::Float(value)) => Ok(number.of_integer(numbers::truncated(*value))),
        _ => Err(Problem::Expected(expected)),
    }
}

/// Empty strings are refused, as in the original: the field is left out instead.
fn text_from_data(data: &Data, bound: Option<usize>) -> Result<Vec<u8>, Problem> {
    match data {
        Data::Text(text) | Data::Buffer(text) if !text.is_empty() => match bound {
            Some(bound) if text.len() > bound => Err(Problem::Expected("a shorter string")),
            _ => Ok(text.clone()),
        },
        _ => Err(Problem::Expected("string")),
    }
}

/// Times before 1970 and numbers that are none are 0, later ones than the type has are its last.
fn time_from_data(data: &Data) -> Result<Time, Problem> {
    let (sec, nanosec) = seconds_from_data(data)?;
    if sec < 0.0 {
        return Ok(Time::default());
    }
    Ok(Time {
        sec: numbers::truncated_u32(sec),
        nanosec,
    })
}

fn duration_from_data(data: &Data) -> Result<Duration, Problem> {
    let (sec, nanosec) = seconds_from_data(data)?;
    Ok(Duration {
        sec: numbers::truncated_i32(sec),
        nanosec: nanosec.cast_signed(),
    })
}

/// Whole seconds, and nanoseconds below 10^9.
fn seconds_from_data(data: &Data) -> Result<(f64, u32), Problem> {
    let seconds = match data {
        Data::Int(value) => *value as f64,
        Data::Float(value) => *value,
        _ => return Err(Problem::Expected("float")),
    };
    let nanosec = ((seconds - seconds.floor()) * 1e9)
        .round()
        .min(999_999_999.0);
    Ok((seconds.floor(), numbers::truncated_u32(nanosec)))
}

fn array_from_data(
    element: &Element<Arc<Layout>>,
    data: &Data,
    style: Style,
) -> Result<Array, Problem> {
    if style.bytes_as_strings
        && matches!(element, Element::Number(number) if number.of_values() == NumberType::UInt8)
    {
        return match data {
            Data::Text(bytes) | Data::Buffer(bytes) if !bytes.is_empty() => {
                Ok(Array::Numbers(Numbers::UInt8(bytes.clone())))
            }
            _ => Err(Problem::Within(
                "string read error when trying to read uint8[]".into(),
            )),
        };
    }
    let items = match data {
        Data::Array(items) => items.as_slice(),
        Data::Map(entries) if entries.is_empty() => &[],
        _ => return Err(Problem::Expected("array")),
    };
    match element {
        Element::Number(number) => numbers_from_data(*number, items),
        Element::String(bound) | Element::WString(bound) => {
            each(items, |item| text_from_data(item, *bound)).map(Array::Strings)
        }
        Element::Time => each(items, time_from_data).map(Array::Times),
        Element::Duration => each(items, duration_from_data).map(Array::Durations),
        Element::Nested(layout) => each(items, |item| match item {
            Data::Map(_) | Data::Array(_) => {
                from_data(layout, item, style).map_err(Problem::Within)
            }
            _ => Err(Problem::Expected("a table")),
        })
        .map(Array::Records),
    }
}

fn each<T>(items: &[Data], read: impl Fn(&Data) -> Result<T, Problem>) -> Result<Vec<T>, Problem> {
    items.iter().map(read).collect()
}

fn numbers_from_data(number: NumberType, items: &[Data]) -> Result<Array, Problem> {
    let mut numbers = number.zeros(0);
    for item in items {
        numbers.push(number_from_data(number, item)?);
    }
    Ok(Array::Numbers(numbers))
}

/// The constants of a type, as a table of names and values.
#[cfg(feature = "ros2")]
pub(super) fn constants(layout: &Layout) -> Data {
    let entry = |constant: &ros_interfaces::Constant| {
        (
            Key::Text(constant.name.as_bytes().to_vec()),
            value_to_data(&constant.value, Style::default()),
        )
    };
    Data::Map(layout.constants.iter().map(entry).collect())
}

#[cfg(test)]
mod tests {
    use ros_interfaces::{Catalogue, Generation, InterfaceKind, TypeName};

    use super::*;

    const TEXT: &str = "int32 a\nuint32 b\nint64 c\nfloat32 d\nbool e\nstring f\nuint8[] g\nfloat64[3] h\nstring[] i\n";

    fn layout() -> Arc<Layout> {
        let mut catalogue = Catalogue::new(Generation::Ros2);
        let name = TypeName::new("test_msgs", InterfaceKind::Message, "Tested").expect("a name");
        catalogue.add_text(&name, TEXT).expect("a text");
        catalogue.layout_of(&name).expect("a layout")
    }

    fn read(entries: &[(&str, Data)]) -> Result<Record, String> {
        let entries = entries
            .iter()
            .map(|(key, value)| (Key::Text(key.as_bytes().to_vec()), value.clone()));
        from_data(&layout(), &Data::Map(entries.collect()), Style::default())
    }

    #[test]
    fn a_table_has_all_fields_and_is_read_back() {
        let record = Record::new(&layout());
        let data = to_data(&record, Style::default());
        assert_eq!(
            data.field("c"),
            Some(&Data::Float(0.0)),
            "64 bits are floats"
        );
        assert_eq!(
            data.field("h"),
            Some(&Data::Array(vec![Data::Float(0.0); 3]))
        );
        let changed = read(&[
            ("a", Data::Int(-3)),
            ("b", Data::Int(-1)),
            ("g", Data::Array(vec![Data::Int(200)])),
        ]);
        let data = to_data(&changed.expect("a message"), Style::default());
        assert_eq!(
            (data.field("a"), data.field("b")),
            (Some(&Data::Int(-3)), Some(&Data::Int(-1)))
        );
    }

    #[test]
    fn errors_name_message_field_and_kind() {
        let error = |key, value| read(&[(key, value)]).expect_err("an error");
        assert_eq!(
            error("z", Data::Int(1)),
            "read__test_msgs__msg__Tested: unexpected key: z"
        );
        assert_eq!(
            error("a", Data::text("1")),
            "read__test_msgs__msg__Tested: field a: expected integer"
        );
        assert_eq!(
            error("d", Data::Bool(true)),
            "read__test_msgs__msg__Tested: field d: expected float"
        );
        assert_eq!(
            error("e", Data::Int(1)),
            "read__test_msgs__msg__Tested: field e: expected bool"
        );
        assert_eq!(
            error("f", Data::text("")),
            "read__test_msgs__msg__Tested: field f: expected string"
        );
        assert_eq!(
            error("i", Data::Int(1)),
            "read__test_msgs__msg__Tested: field i: expected array"
        );
        let wrong = Data::Array(vec![Data::text("x")]);
        assert_eq!(
            error("h", wrong),
            "read__test_msgs__msg__Tested: field h: expected double"
        );
    }

    #[test]
    fn bytes_are_strings_if_a_script_says_so() {
        let style = Style {
            bytes_as_strings: true,
        };
        let data = Data::map([("g", Data::Buffer(vec![0, 255, 3]))]);
        let record = from_data(&layout(), &data, style).expect("a message");
        assert_eq!(
            to_data(&record, style).field("g"),
            Some(&Data::Text(vec![0, 255, 3]))
        );
        let empty = from_data(&layout(), &Data::map([("g", Data::text(""))]), style);
        assert_eq!(
            empty,
            Err("string read error when trying to read uint8[]".into())
        );
    }

    #[test]
    fn fixed_arrays_get_their_length() {
        let short = read(&[("h", Data::Array(vec![Data::Int(1)]))]).expect("a message");
        let expected = Data::Array(vec![Data::Float(1.0), Data::Float(0.0), Data::Float(0.0)]);
        assert_eq!(
            to_data(&short, Style::default()).field("h"),
            Some(&expected)
        );
    }
}
