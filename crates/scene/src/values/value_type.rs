//! Property types: numbers, names, storage marks, defaults, validation.

use geometry::Finite;

use crate::Data;

macro_rules! value_types {
    ($($variant:ident = $code:literal $word:literal $mark:literal;)*) => {
        /// Type of a property; its number is `sim.propertytype_*`.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum ValueType {
            $(
                #[doc = concat!("`sim.propertytype_", $word, "`.")]
                $variant = $code,
            )*
        }

        impl ValueType {
            const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The type whose constant is `sim.propertytype_<word>`.
            pub fn from_word(word: &str) -> Option<Self> {
                match word { $($word => Some(Self::$variant),)* _ => None }
            }

            /// Suffix of its constant after `sim.propertytype_`.
            pub fn word(self) -> &'static str {
                match self { $(Self::$variant => $word),* }
            }

            /// Prefix of the name in a tag.
            fn mark(self) -> &'static str {
                match self { $(Self::$variant => $mark),* }
            }
        }
    };
}

value_types! {
    Bool = 0 "bool" "&bool&.";
    Int = 1 "int" "&int&.";
    Float = 2 "float" "&dbl&.";
    String = 3 "string" "&str&.";
    Buffer = 4 "buffer" "";
    Vector3 = 5 "vector3" "&vect3&.";
    Quaternion = 6 "quaternion" "&quat&.";
    Pose = 7 "pose" "&pose&.";
    Color = 10 "color" "&col&.";
    FloatArray = 11 "floatarray" "&vect&.";
    Table = 12 "table" "&tbl&.";
    IntArray = 13 "intarray" "&ivect&.";
    Vector2 = 14 "vector2" "&vect2&.";
    IntArray2 = 15 "intarray2" "&ivect2&.";
    Long = 16 "long" "&lng&.";
}

impl ValueType {
    /// The tag of the value `name` of this type.
    pub fn tag(self, name: &str) -> String {
        format!("{}{name}", self.mark())
    }

    /// Type and name of a tag.
    pub fn split_tag(tag: &str) -> (Self, &str) {
        let mut marked = Self::ALL.iter().filter(|ty| !ty.mark().is_empty());
        marked
            .find_map(|&ty| Some((ty, tag.strip_prefix(ty.mark())?)))
            .unwrap_or((Self::Buffer, tag))
    }

    /// The value that a table says in words: numbers of lists are separated by spaces, nothing is false, 0, no text, an empty list, the
    /// origin or no rotation. None when the words are no value of this type.
    pub fn parse(self, text: &str) -> Option<Data> {
        match self {
            Self::Bool => {
                matches!(text, "" | "true" | "false").then_some(Data::Bool(text == "true"))
            }
            Self::Int | Self::Long if text.is_empty() => Some(Data::Int(0)),
            Self::Int | Self::Long => text.parse().ok().map(Data::Int),
            Self::Float if text.is_empty() => Some(Data::Float(0.0)),
            Self::Float => text.parse().ok().map(Data::Float),
            Self::String => Some(Data::text(text)),
            Self::Buffer => text.is_empty().then(|| Data::Buffer(Vec::new())),
            Self::Table => text.is_empty().then(|| Data::Array(Vec::new())),
            Self::FloatArray => list::<f64>(text, &[]),
            Self::Vector2 => list(text, &[0.0; 2]),
            Self::Vector3 | Self::Color => list(text, &[0.0; 3]),
            Self::Quaternion => list(text, &[0.0, 0.0, 0.0, 1.0]),
            Self::Pose => list(text, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
            Self::IntArray => list::<i64>(text, &[]),
            Self::IntArray2 => list::<i64>(text, &[0; 2]),
        }
    }

    /// The value as it is stored in place of `default`: finite numbers, and of a list as many as the default has, if it has any.
    /// None when it cannot be.
    pub fn accept(self, default: &Data, mut value: Data) -> Option<Data> {
        if let (Data::Array(default), Data::Array(items)) = (default, &mut value) {
            if items.len() < default.len() {
                return None;
            }
            if !default.is_empty() {
                items.truncate(default.len());
            }
        }
        (self.is_kind_of(&value) && value.is_finite()).then_some(value)
    }

    /// Whether values differ in size.
    pub fn may_be_large(self) -> bool {
        matches!(
            self,
            Self::String | Self::Buffer | Self::Table | Self::FloatArray | Self::IntArray
        )
    }

    fn is_kind_of(self, value: &Data) -> bool {
        let is_int = |item: &Data| matches!(item, Data::Int(_));
        let is_float = |item: &Data| matches!(item, Data::Float(_));
        match (self, value) {
            (Self::Bool, Data::Bool(_))
            | (Self::Int | Self::Long, Data::Int(_))
            | (Self::Float, Data::Float(_)) => true,
            (Self::String, Data::Text(_)) | (Self::Buffer, Data::Buffer(_)) => true,
            (Self::Table, Data::Array(_) | Data::Map(_)) => true,
            (Self::IntArray | Self::IntArray2, Data::Array(items)) => items.iter().all(is_int),
            (
                Self::FloatArray | Self::Vector2 | Self::Vector3 | Self::Color,
                Data::Array(items),
            ) => items.iter().all(is_float),
            (Self::Quaternion | Self::Pose, Data::Array(items)) => items.iter().all(is_float),
            _ => false,
        }
    }
}

fn list<T: std::str::FromStr + Clone + Into<Data>>(text: &str, empty: &[T]) -> Option<Data> {
    let numbers: Vec<T> = text
        .split_whitespace()
        .map(|word| word.parse().ok())
        .collect::<Option<_>>()?;
    match numbers.len() {
        0 => Some(empty.to_vec().into()),
        length => (empty.is_empty() || length == empty.len()).then(|| numbers.into()),
    }
}

impl Finite for Data {
    /// Whether all numbers in a value, or in a list of values, are finite.
    fn is_finite(&self) -> bool {
        match self {
            Self::Float(number) => number.is_finite(),
            Self::Array(items) => items.as_slice().is_finite(),
            _ => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Data, ValueType};

    #[test]
    fn defaults_are_said_in_words() {
        assert_eq!(
            ValueType::FloatArray.parse("0.02 1"),
            Some(vec![0.02, 1.0].into())
        );
        assert_eq!(ValueType::Color.parse(""), Some([0.0; 3].into()));
        assert_eq!(ValueType::Color.parse("1"), None);
        assert_eq!(ValueType::Int.parse("x"), None);
    }

    #[test]
    fn lists_keep_the_length_of_their_default() {
        let accept =
            |default: Data, value: Vec<f64>| ValueType::FloatArray.accept(&default, value.into());
        assert_eq!(
            accept(vec![0.0; 2].into(), vec![1.0, 2.0, 3.0]),
            Some(vec![1.0, 2.0].into())
        );
        assert_eq!(accept(vec![0.0; 2].into(), vec![1.0]), None);
        assert_eq!(accept(vec![0.0; 2].into(), vec![1.0, f64::NAN]), None);
        assert_eq!(
            accept(Data::Array(vec![]), vec![1.0]),
            Some(vec![1.0].into())
        );
        assert_eq!(
            ValueType::FloatArray.accept(&Data::Array(vec![]), Data::Int(1)),
            None
        );
    }
}
