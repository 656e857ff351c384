//! Property values in Rust, on the Lua stack and in storage.

use arrayvec::ArrayString;

use crate::binding::args::{Args, Bytes, FromScript, Table};
use crate::binding::returns::IntoScript;
use crate::binding::sink::Sink;
use crate::binding::source::Source;
use crate::error::{ApiError, ApiResult};
use scene::{Data, Key, ValueType};

/// A Rust type that properties have.
pub trait PropertyValue: Sized {
    /// Its type as scripts know it.
    const TYPE: ValueType;

    /// The value from its stored form; None when that is of another type.
    fn from_data(data: Data) -> Option<Self>;

    /// The value in its stored form.
    fn into_data(self) -> Data;
}

/// The name of a property, which costs no allocation unless it is long.
pub enum PropertyName {
    /// A name that fits without an allocation.
    Short(ArrayString<56>),
    /// Any other name.
    Long(String),
}

impl PropertyName {
    /// The name.
    pub fn as_str(&self) -> &str {
        match self {
            Self::Short(name) => name,
            Self::Long(name) => name,
        }
    }

    /// None for a name that is too long, or not UTF-8.
    fn short(name: &[u8]) -> Option<Self> {
        ArrayString::from(std::str::from_utf8(name).ok()?)
            .ok()
            .map(Self::Short)
    }
}

impl FromScript for PropertyName {
    const TYPE: &'static str = "string";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
        match args.with_bytes(Self::short).flatten() {
            Some(name) => Ok(name),
            None => String::from_script(args).map(Self::Long),
        }
    }
}

/// A string of any bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text(pub Vec<u8>);

/// An integer that is declared to need 64 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Long(pub i64);

/// Two integers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IntPair(pub [i64; 2]);

macro_rules! vectors {
    ($($(#[$doc:meta])* $name:ident[$n:literal] $variant:ident;)*) => { $(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name(pub [f64; $n]);

        impl PropertyValue for $name {
            const TYPE: ValueType = ValueType::$variant;

            fn from_data(data: Data) -> Option<Self> {
                let items: &[Data; $n] = items(&data)?.try_into().ok()?;
                let mut numbers = [0.0; $n];
                for (number, item) in numbers.iter_mut().zip(items) {
                    *number = item.as_f64()?;
                }
                Some(Self(numbers))
            }

            fn into_data(self) -> Data {
                self.0.into()
            }
        }

        impl FromScript for $name {
            const TYPE: &'static str = <[f64; $n] as FromScript>::TYPE;

            fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
                check_table(args)?;
                FromScript::from_script(args).map(Self)
            }
        }

        impl IntoScript for $name {
            const TYPE: &'static str = <[f64; $n] as IntoScript>::TYPE;

                    fn into_script<S: Sink>(self, sink: &mut S) -> ApiResult<()> {
                self.0.into_script(sink)
            }
        }
    )* };
}

vectors! {
    /// Two floats.
    Vector2[2] Vector2;
    /// Three floats.
    Vector3[3] Vector3;
    /// x, y, z, w; kept as written.
    Quaternion[4] Quaternion;
    /// Position and quaternion (x, y, z, qx, qy, qz, qw).
    PoseArray[7] Pose;
    /// Red, green, blue, 0 to 1.
    Color[3] Color;
}

impl Color {
    /// From the 32 bits colours are kept in.
    pub fn from_f32(rgb: [f32; 3]) -> Self {
        Self(rgb.map(f64::from))
    }

    /// To the 32 bits colours are kept in.
    pub fn to_f32(self) -> [f32; 3] {
        self.0.map(numbers::single)
    }
}

macro_rules! values {
    ($($ty:ty = $variant:ident, |$data:pat_param| $value:expr, |$it:ident| $into:expr;)*) => { $(
        impl PropertyValue for $ty {
            const TYPE: ValueType = ValueType::$variant;

            fn from_data(data: Data) -> Option<Self> {
                match data {
                    $data => Some($value),
                    #[allow(unreachable_patterns)]
                    _ => None,
                }
            }

            fn into_data(self) -> Data {
                let $it = self;
                $into
            }
        }
    )* };
}

values! {
    bool = Bool, |Data::Bool(b)| b, |it| Data::Bool(it);
    i64 = Int, |Data::Int(i)| i, |it| Data::Int(it);
    Long = Long, |Data::Int(i)| Self(i), |it| Data::Int(it.0);
    f64 = Float, |Data::Float(f)| f, |it| Data::Float(it);
    Text = String, |Data::Text(bytes)| Self(bytes), |it| Data::Text(it.0);
    String = String, |Data::Text(bytes)| String::from_utf8_lossy(&bytes).into_owned(), |it| Data::Text(it.into_bytes());
    Bytes = Buffer, |Data::Buffer(bytes)| Self(bytes), |it| Data::Buffer(it.0);
    Table = Table, |table| Self(table), |it| array_part(it.0);
}

impl PropertyValue for Vec<f64> {
    const TYPE: ValueType = ValueType::FloatArray;

    fn from_data(data: Data) -> Option<Self> {
        floats(&data)
    }

    fn into_data(self) -> Data {
        self.into()
    }
}

impl PropertyValue for Vec<i64> {
    const TYPE: ValueType = ValueType::IntArray;

    fn from_data(data: Data) -> Option<Self> {
        integers(&data)
    }

    fn into_data(self) -> Data {
        self.into()
    }
}

impl PropertyValue for IntPair {
    const TYPE: ValueType = ValueType::IntArray2;

    fn from_data(data: Data) -> Option<Self> {
        integers(&data)?.try_into().ok().map(Self)
    }

    fn into_data(self) -> Data {
        self.0.into()
    }
}

fn items(data: &Data) -> Option<&[Data]> {
    if let Data::Array(items) = data {
        Some(items)
    } else {
        None
    }
}

fn floats(data: &Data) -> Option<Vec<f64>> {
    items(data)?.iter().map(Data::as_f64).collect()
}

fn integers(data: &Data) -> Option<Vec<i64>> {
    items(data)?
        .iter()
        .map(|item| {
            if let Data::Int(i) = item {
                Some(*i)
            } else {
                None
            }
        })
        .collect()
}

/// The part of a table with a list and names that CBOR stores: the list.
fn array_part(table: Data) -> Data {
    let Data::Map(entries) = &table else {
        return table;
    };
    let at = |n: i64| {
        entries
            .iter()
            .find(|(key, _)| *key == Key::Int(n))
            .map(|(_, value)| value.clone())
    };
    let list: Vec<Data> = (1..).map_while(at).collect();
    if list.is_empty() {
        table
    } else {
        Data::Array(list)
    }
}

fn check_table<'a>(args: &Args<'a, impl Source<'a>>) -> ApiResult<()> {
    if args.is_table(args.position()) {
        Ok(())
    } else {
        Err(ApiError::ArgumentType)
    }
}

impl FromScript for Text {
    const TYPE: &'static str = "string";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
        Bytes::from_script(args).map(|bytes| Self(bytes.0))
    }
}

impl FromScript for Long {
    const TYPE: &'static str = "int";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
        i64::from_script(args).map(Self)
    }
}

impl FromScript for IntPair {
    const TYPE: &'static str = "int[2]";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
        check_table(args)?;
        <[f64; 2]>::from_script(args).map(|pair| Self(pair.map(numbers::truncated)))
    }
}

impl IntoScript for Text {
    const TYPE: &'static str = "string";

    fn into_script<S: Sink>(self, sink: &mut S) -> ApiResult<()> {
        sink.text(&self.0);
        Ok(())
    }
}

impl IntoScript for Long {
    const TYPE: &'static str = "int";

    fn into_script<S: Sink>(self, sink: &mut S) -> ApiResult<()> {
        self.0.into_script(sink)
    }
}

impl IntoScript for IntPair {
    const TYPE: &'static str = "int[2]";

    fn into_script<S: Sink>(self, sink: &mut S) -> ApiResult<()> {
        self.0.to_vec().into_script(sink)
    }
}

#[cfg(test)]
mod tests {
    use super::{Data, Key, PropertyValue, Table, Vector3};

    #[test]
    fn a_table_with_list_and_names_keeps_its_list() {
        let entries = vec![
            (Key::Int(1), Data::Int(7)),
            (Key::Text(b"k".to_vec()), Data::Nil),
        ];
        assert_eq!(
            Table(Data::Map(entries)).into_data(),
            Data::Array(vec![Data::Int(7)])
        );
    }

    #[test]
    fn stored_values_of_another_size_are_refused() {
        assert_eq!(Vector3::from_data(vec![1.0, 2.0].into()), None);
        assert_eq!(
            Vector3::from_data(vec![1.0, 2.0, 3.0].into()),
            Some(Vector3([1.0, 2.0, 3.0]))
        );
    }
}
