//! An owned value without a Lua state: between scripts, in custom data, in messages.

/// Any value a script can pass on. Tables with the keys `1..n` are arrays, all others are maps.
#[derive(Debug, Clone, PartialEq)]
pub enum Data {
    /// No value.
    Nil,
    /// A truth value.
    Bool(bool),
    /// A Lua integer.
    Int(i64),
    /// A Lua float.
    Float(f64),
    /// A Lua string: any bytes, not necessarily UTF-8.
    Text(Vec<u8>),
    /// A CoppeliaSim buffer: bytes that stay distinguishable from text.
    Buffer(Vec<u8>),
    /// A table with the keys `1..n`.
    Array(Vec<Data>),
    /// Any other table: its entries, in no particular order.
    Map(Vec<(Key, Data)>),
}

/// A table key that can leave its Lua state.
#[derive(Debug, Clone, PartialEq)]
pub enum Key {
    /// A truth value.
    Bool(bool),
    /// A Lua integer.
    Int(i64),
    /// A Lua float.
    Float(f64),
    /// A Lua string.
    Text(Vec<u8>),
}

impl Data {
    /// Values in one piece of data, of all depths, that decoders accept: a byte may become a table of a hundred, and longer lists would
    /// not fit the memory a script may ask for at once.
    pub const MAX_ITEMS: usize = 1 << 24;

    /// The text `text`, as a script would write it.
    pub fn text(text: &str) -> Self {
        Self::Text(text.as_bytes().to_vec())
    }

    /// A map with text keys.
    pub fn map<const N: usize>(entries: [(&str, Data); N]) -> Self {
        Self::Map(
            entries
                .into_iter()
                .map(|(k, v)| (Key::Text(k.as_bytes().to_vec()), v))
                .collect(),
        )
    }

    /// The entry `name` of a map.
    pub fn field(&self, name: &str) -> Option<&Data> {
        let Self::Map(entries) = self else {
            return None;
        };
        entries
            .iter()
            .find(|(key, _)| matches!(key, Key::Text(k) if k == name.as_bytes()))
            .map(|(_, value)| value)
    }

    /// Lua truth: everything but nil and false.
    pub fn truthy(&self) -> bool {
        !matches!(self, Self::Nil | Self::Bool(false))
    }

    /// How many bytes it takes, roughly: eight for a number.
    pub fn size(&self) -> usize {
        match self {
            Self::Nil | Self::Bool(_) => 1,
            Self::Int(_) | Self::Float(_) => 8,
            Self::Text(bytes) | Self::Buffer(bytes) => bytes.len(),
            Self::Array(items) => items.iter().map(Self::size).sum(),
            Self::Map(entries) => entries
                .iter()
                .map(|(key, value)| key.size() + value.size())
                .sum(),
        }
    }

    /// The number, if this is one.
    pub fn as_f64(&self) -> Option<f64> {
        match *self {
            Self::Int(i) => Some(i as f64),
            Self::Float(f) => Some(f),
            _ => None,
        }
    }
}

impl Key {
    fn size(&self) -> usize {
        if let Self::Text(bytes) = self {
            bytes.len()
        } else {
            8
        }
    }
}

impl From<bool> for Data {
    fn from(value: bool) -> Self {
        Self::Bool(value)
    }
}

impl From<i64> for Data {
    fn from(value: i64) -> Self {
        Self::Int(value)
    }
}

impl From<f64> for Data {
    fn from(value: f64) -> Self {
        Self::Float(value)
    }
}

impl From<String> for Data {
    fn from(value: String) -> Self {
        Self::Text(value.into_bytes())
    }
}

/// Nil without a value.
impl<T: Into<Data>> From<Option<T>> for Data {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Nil, Into::into)
    }
}

impl<T: Into<Data>> From<Vec<T>> for Data {
    fn from(values: Vec<T>) -> Self {
        Self::Array(values.into_iter().map(Into::into).collect())
    }
}

impl<T: Into<Data>, const N: usize> From<[T; N]> for Data {
    fn from(values: [T; N]) -> Self {
        Self::Array(values.into_iter().map(Into::into).collect())
    }
}
