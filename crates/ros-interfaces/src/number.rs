//! Numbers, arrays of numbers, and their bytes.

/// The order of the bytes of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ByteOrder {
    /// The least significant byte first.
    Little,
    /// The most significant byte first.
    Big,
}

macro_rules! numbers {
    ($($name:ident $word:literal $type:ty),* $(,)?) => {
        /// The primitive types of fixed size, truth values among them.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum NumberType {
            /// One byte; 0 and 1.
            Bool,
            /// A byte of any meaning; its value is a [`Number::UInt8`].
            Byte,
            /// A character of one byte; its value is a [`Number::UInt8`].
            Char,
            $(#[doc = concat!("`", $word, "`.")] $name),*
        }

        /// A number of one of the primitive types.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Number {
            /// A truth value.
            Bool(bool),
            $(#[doc = concat!("A number of type `", $word, "`.")] $name($type)),*
        }

        /// Numbers of one of the primitive types.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Numbers {
            /// Truth values.
            Bool(Vec<bool>),
            $(#[doc = concat!("Numbers of type `", $word, "`.")] $name(Vec<$type>)),*
        }

        impl NumberType {
            /// All types.
            pub const ALL: &[Self] = &[Self::Bool, Self::Byte, Self::Char, $(Self::$name),*];

            /// How texts of interfaces call it.
            #[must_use]
            pub fn word(self) -> &'static str {
                match self {
                    Self::Bool => "bool",
                    Self::Byte => "byte",
                    Self::Char => "char",
                    $(Self::$name => $word),*
                }
            }

            /// Bytes of one number.
            #[must_use]
            pub fn size(self) -> usize {
                match self {
                    Self::Bool | Self::Byte | Self::Char => 1,
                    $(Self::$name => size_of::<$type>()),*
                }
            }

            /// The number 0, or false.
            #[must_use]
            pub fn zero(self) -> Number {
                match self {
                    Self::Bool => Number::Bool(false),
                    Self::Byte | Self::Char => Number::UInt8(0),
                    $(Self::$name => Number::$name(0 as $type)),*
                }
            }

            /// The nearest number: integers lose their upper bits, fractions are cut off.
            #[must_use]
            pub fn of_integer(self, integer: i64) -> Number {
                match self {
                    Self::Bool => Number::Bool(integer != 0),
                    Self::Byte | Self::Char => Number::UInt8(integer as u8),
                    $(Self::$name => Number::$name(integer as $type)),*
                }
            }

            /// The nearest number; integers are limited to what the type has.
            #[must_use]
            pub fn of_float(self, float: f64) -> Number {
                match self {
                    Self::Bool => Number::Bool(float != 0.0),
                    Self::Byte | Self::Char => Number::UInt8(float as u8),
                    $(Self::$name => Number::$name(float as $type)),*
                }
            }

            /// The number that a text says, in the decimal notation of texts of interfaces; integers may be hexadecimal.
            #[must_use]
            pub fn parse(self, text: &str) -> Option<Number> {
                match self {
                    Self::Bool => parse_bool(text).map(Number::Bool),
                    Self::Byte | Self::Char => u8::of_text(text).map(Number::UInt8),
                    $(Self::$name => <$type>::of_text(text).map(Number::$name)),*
                }
            }

            /// `count` times 0.
            #[must_use]
            pub fn zeros(self, count: usize) -> Numbers {
                match self {
                    Self::Bool => Numbers::Bool(vec![false; count]),
                    Self::Byte | Self::Char => Numbers::UInt8(vec![0; count]),
                    $(Self::$name => Numbers::$name(vec![0 as $type; count])),*
                }
            }

            /// Reads a number. None if there are not [`NumberType::size`] bytes.
            #[must_use]
            pub fn read(self, bytes: &[u8], order: ByteOrder) -> Option<Number> {
                Some(match self {
                    Self::Bool => Number::Bool(*bytes.first()? != 0),
                    Self::Byte | Self::Char => Number::UInt8(*bytes.first()?),
                    $(Self::$name => Number::$name(read!($type, bytes, order)?)),*
                })
            }

            /// Reads as many numbers as there are bytes for. None if a number is cut off.
            #[must_use]
            pub fn read_all(self, bytes: &[u8], order: ByteOrder) -> Option<Numbers> {
                if bytes.len() % self.size() != 0 {
                    return None;
                }
                Some(match self {
                    Self::Bool => Numbers::Bool(bytes.iter().map(|&byte| byte != 0).collect()),
                    Self::Byte | Self::Char | Self::UInt8 => Numbers::UInt8(bytes.to_vec()),
                    $(#[allow(unreachable_patterns)] Self::$name => {
                        let all = bytes.chunks_exact(self.size()).map(|one| read!($type, one, order));
                        Numbers::$name(all.collect::<Option<_>>()?)
                    }),*
                })
            }
        }

        impl Number {
            /// The type; a byte and a character are of type `uint8`.
            #[must_use]
            pub fn number_type(self) -> NumberType {
                match self {
                    Self::Bool(_) => NumberType::Bool,
                    $(Self::$name(_) => NumberType::$name),*
                }
            }

            /// As a 64-bit floating-point number.
            #[allow(clippy::cast_lossless, reason = "one rule for all types of numbers")]
            #[must_use]
            pub fn as_f64(self) -> f64 {
                match self {
                    Self::Bool(value) => f64::from(u8::from(value)),
                    $(Self::$name(value) => value as f64),*
                }
            }

            /// As a 64-bit integer; the upper half of `uint64` becomes negative, floating-point numbers are cut off.
            #[allow(clippy::cast_lossless, reason = "one rule for all types of numbers")]
            #[must_use]
            pub fn as_i64(self) -> i64 {
                match self {
                    Self::Bool(value) => i64::from(value),
                    $(Self::$name(value) => value as i64),*
                }
            }

            /// Appends its bytes.
            pub fn write(self, out: &mut Vec<u8>, order: ByteOrder) {
                match self {
                    Self::Bool(value) => out.push(u8::from(value)),
                    $(Self::$name(value) => write!(value, out, order)),*
                }
            }
        }

        impl Numbers {
            /// The type of each; bytes and characters are of type `uint8`.
            #[must_use]
            pub fn number_type(&self) -> NumberType {
                match self {
                    Self::Bool(_) => NumberType::Bool,
                    $(Self::$name(_) => NumberType::$name),*
                }
            }

            /// How many there are.
            #[must_use]
            pub fn len(&self) -> usize {
                match self {
                    Self::Bool(all) => all.len(),
                    $(Self::$name(all) => all.len()),*
                }
            }

            /// One of them, from 0.
            #[must_use]
            pub fn get(&self, index: usize) -> Option<Number> {
                match self {
                    Self::Bool(all) => all.get(index).copied().map(Number::Bool),
                    $(Self::$name(all) => all.get(index).copied().map(Number::$name)),*
                }
            }

            /// Appends a number. False, and nothing done, if it is of another type.
            pub fn push(&mut self, number: Number) -> bool {
                match (self, number) {
                    (Self::Bool(all), Number::Bool(one)) => all.push(one),
                    $((Self::$name(all), Number::$name(one)) => all.push(one),)*
                    _ => return false,
                }
                true
            }

            /// Makes it that long; what is added is 0.
            pub fn resize(&mut self, length: usize) {
                match self {
                    Self::Bool(all) => all.resize(length, false),
                    $(Self::$name(all) => all.resize(length, 0 as $type)),*
                }
            }

            /// Appends the bytes of all.
            pub fn write(&self, out: &mut Vec<u8>, order: ByteOrder) {
                match self {
                    Self::Bool(all) => out.extend(all.iter().map(|&one| u8::from(one))),
                    Self::UInt8(all) => out.extend_from_slice(all),
                    $(#[allow(unreachable_patterns)] Self::$name(all) => {
                        out.reserve(all.len() * size_of::<$type>());
                        for &one in all { write!(one, out, order); }
                    }),*
                }
            }
        }
    };
}

macro_rules! read {
    ($type:ty, $bytes:expr, $order:expr) => {
        $bytes.first_chunk().map(|&bytes| match $order {
            ByteOrder::Little => <$type>::from_le_bytes(bytes),
            ByteOrder::Big => <$type>::from_be_bytes(bytes),
        })
    };
}

macro_rules! write {
    ($value:expr, $out:expr, $order:expr) => {
        match $order {
            ByteOrder::Little => $out.extend_from_slice(&$value.to_le_bytes()),
            ByteOrder::Big => $out.extend_from_slice(&$value.to_be_bytes()),
        }
    };
}

numbers! {
    Int8 "int8" i8, UInt8 "uint8" u8, Int16 "int16" i16, UInt16 "uint16" u16, Int32 "int32" i32, UInt32 "uint32" u32,
    Int64 "int64" i64, UInt64 "uint64" u64, Float32 "float32" f32, Float64 "float64" f64,
}

impl NumberType {
    /// The type with this word.
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|candidate| candidate.word() == word)
    }

    /// The type of its values: `uint8` for bytes and characters, else itself.
    #[must_use]
    pub fn of_values(self) -> Self {
        match self {
            Self::Byte | Self::Char => Self::UInt8,
            other => other,
        }
    }

    /// Whether it has fractions.
    #[must_use]
    pub fn is_float(self) -> bool {
        matches!(self, Self::Float32 | Self::Float64)
    }
}

impl Numbers {
    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A number in the text of an interface.
trait OfText: Sized {
    fn of_text(text: &str) -> Option<Self>;
}

macro_rules! integers_of_text {
    ($($type:ty),*) => {
        $(impl OfText for $type {
            fn of_text(text: &str) -> Option<Self> {
                text.parse().ok().or_else(|| Self::try_from(parse_hexadecimal(text)?).ok())
            }
        })*
    };
}
integers_of_text!(i8, u8, i16, u16, i32, u32, i64, u64);

macro_rules! floats_of_text {
    ($($type:ty),*) => {
        $(impl OfText for $type {
            fn of_text(text: &str) -> Option<Self> {
                text.parse().ok()
            }
        })*
    };
}
floats_of_text!(f32, f64);

/// `0x1f`, with a sign perhaps.
fn parse_hexadecimal(text: &str) -> Option<i128> {
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    let digits = digits
        .strip_prefix("0x")
        .or_else(|| digits.strip_prefix("0X"))?;
    u64::from_str_radix(digits, 16)
        .ok()
        .map(|magnitude| sign * i128::from(magnitude))
}

fn parse_bool(text: &str) -> Option<bool> {
    match text {
        "true" | "True" | "1" => Some(true),
        "false" | "False" | "0" => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_they_are_written_in_both_orders() {
        for &kind in NumberType::ALL {
            for order in [ByteOrder::Little, ByteOrder::Big] {
                let number = kind.of_integer(1);
                let mut bytes = Vec::new();
                number.write(&mut bytes, order);
                assert_eq!(bytes.len(), kind.size());
                assert_eq!(kind.read(&bytes, order), Some(number));
                assert_eq!(kind.read(&bytes[1..], order), None);
                let all = kind
                    .read_all(&bytes.repeat(3), order)
                    .expect("three numbers");
                assert_eq!((all.len(), all.get(2)), (3, Some(number)));
            }
        }
        assert_eq!(
            NumberType::UInt32.read(&[1, 2, 3, 4], ByteOrder::Big),
            Some(Number::UInt32(0x0102_0304))
        );
    }

    #[test]
    fn texts_of_numbers() {
        assert_eq!(NumberType::UInt8.parse("0x1F"), Some(Number::UInt8(31)));
        assert_eq!(NumberType::Int8.parse("-128"), Some(Number::Int8(-128)));
        assert_eq!(
            NumberType::UInt64.parse("18446744073709551615"),
            Some(Number::UInt64(u64::MAX))
        );
        assert_eq!(NumberType::Bool.parse("True"), Some(Number::Bool(true)));
        for (kind, text) in [
            (NumberType::UInt8, "256"),
            (NumberType::Int32, "1.5"),
            (NumberType::Bool, "2"),
            (NumberType::Float64, "x"),
        ] {
            assert_eq!(kind.parse(text), None);
        }
    }
}
