//! Sources of the arguments of an API function: a Lua stack, or plain values.
//!
//! Everything is dispatched statically, so that a call from Lua pays nothing for plain values. What only Lua has (functions, objects,
//! coroutines) is an error among plain values. Results go to a [`Sink`](super::sink::Sink).

use std::any::Any;
use std::ffi::c_int;

use super::data::{read_data, read_function};
use crate::error::{ApiError, ApiResult};
use crate::function_ref::FunctionRef;
use crate::lua::{LuaObject, Stack, Type};
use scene::{Data, Key};

/// On whose behalf a function is called.
#[derive(Clone, Copy)]
pub enum Caller<'a> {
    /// The script of a Lua state.
    Lua(Stack<'a>),
    /// The script of an environment of the host.
    Environment(&'a dyn Any),
}

/// A source of arguments, by position from 1.
#[doc(hidden)]
pub trait Source<'a>: Copy {
    fn count(self) -> c_int;
    fn kind(self, position: c_int) -> Type;
    /// The number, or that of a numeric string.
    fn number(self, position: c_int) -> Option<f64>;
    /// The number, when it is an integer; 2.0 and "2" are not.
    fn integer(self, position: c_int) -> Option<i64>;
    fn truthy(self, position: c_int) -> bool;
    /// Reads the bytes of a string, without access to any Lua state.
    fn with_bytes<T>(&self, position: c_int, read: impl FnOnce(&[u8]) -> T + Send) -> Option<T>;
    /// The bytes of a string, or a number in Lua's spelling.
    fn text(self, position: c_int) -> Option<Vec<u8>>;
    /// Length of a list.
    fn list_len(self, position: c_int) -> usize;
    fn number_at(self, position: c_int, i: i64) -> Option<f64>;
    /// Reads elements of a list, from number `first` on; false when one of them is no number.
    fn numbers_into(self, position: c_int, first: i64, out: &mut [f64]) -> bool;
    fn integer_at(self, position: c_int, i: i64) -> Option<i64>;
    /// # Errors
    /// When a table is nested too deeply.
    fn data(self, position: c_int) -> ApiResult<Data>;
    /// # Errors
    /// Where there are no functions.
    fn function(self, position: c_int) -> ApiResult<FunctionRef>;
    fn object(self, position: c_int) -> Option<LuaObject>;
    fn caller(self) -> Caller<'a>;
}

impl<'a> Source<'a> for Stack<'a> {
    fn count(self) -> c_int {
        self.top()
    }

    fn kind(self, position: c_int) -> Type {
        Stack::kind(self, position)
    }

    fn number(self, position: c_int) -> Option<f64> {
        Stack::number(self, position)
    }

    fn integer(self, position: c_int) -> Option<i64> {
        Stack::integer(self, position)
    }

    fn truthy(self, position: c_int) -> bool {
        Stack::truthy(self, position)
    }

    fn with_bytes<T>(&self, position: c_int, read: impl FnOnce(&[u8]) -> T + Send) -> Option<T> {
        Stack::with_bytes(*self, position, read)
    }

    fn text(self, position: c_int) -> Option<Vec<u8>> {
        Stack::text(self, position)
    }

    fn list_len(self, position: c_int) -> usize {
        self.raw_len(position)
    }

    fn number_at(self, position: c_int, i: i64) -> Option<f64> {
        Stack::number_at(self, position, i)
    }

    fn numbers_into(self, position: c_int, first: i64, out: &mut [f64]) -> bool {
        Stack::numbers_into(self, position, first, out)
    }

    fn integer_at(self, position: c_int, i: i64) -> Option<i64> {
        Stack::integer_at(self, position, i)
    }

    fn data(self, position: c_int) -> ApiResult<Data> {
        read_data(self, position)
    }

    fn function(self, position: c_int) -> ApiResult<FunctionRef> {
        Ok(read_function(self, position))
    }

    fn object(self, position: c_int) -> Option<LuaObject> {
        Stack::object(self, position)
    }

    fn caller(self) -> Caller<'a> {
        Caller::Lua(self)
    }
}

/// Arguments as plain values, on behalf of the script of an environment.
#[doc(hidden)]
#[derive(Clone, Copy)]
pub struct Values<'a> {
    values: &'a [Data],
    env: &'a dyn Any,
}

impl<'a> Values<'a> {
    /// `env` is what [`Caller::Environment`] has.
    pub(crate) fn new(values: &'a [Data], env: &'a dyn Any) -> Self {
        Self { values, env }
    }

    fn get(self, position: c_int) -> Option<&'a Data> {
        self.values
            .get(usize::try_from(position).ok()?.checked_sub(1)?)
    }

    /// Element `i` of a list.
    fn element(self, position: c_int, i: i64) -> Option<&'a Data> {
        match self.get(position)? {
            Data::Array(items) => items.get(usize::try_from(i).ok()?.checked_sub(1)?),
            Data::Map(entries) => entries
                .iter()
                .find(|(key, _)| *key == Key::Int(i))
                .map(|(_, value)| value),
            _ => None,
        }
    }
}

impl<'a> Source<'a> for Values<'a> {
    fn count(self) -> c_int {
        c_int::try_from(self.values.len()).unwrap_or(c_int::MAX)
    }

    fn kind(self, position: c_int) -> Type {
        match self.get(position) {
            None => Type::None,
            Some(Data::Nil) => Type::Nil,
            Some(Data::Bool(_)) => Type::Boolean,
            Some(Data::Int(_) | Data::Float(_)) => Type::Number,
            Some(Data::Text(_)) => Type::String,
            Some(Data::Buffer(_) | Data::Array(_) | Data::Map(_)) => Type::Table,
        }
    }

    fn number(self, position: c_int) -> Option<f64> {
        self.get(position).and_then(number_of)
    }

    fn integer(self, position: c_int) -> Option<i64> {
        self.get(position).and_then(integer_of)
    }

    fn truthy(self, position: c_int) -> bool {
        self.get(position).is_some_and(Data::truthy)
    }

    fn with_bytes<T>(&self, position: c_int, read: impl FnOnce(&[u8]) -> T + Send) -> Option<T> {
        match self.get(position)? {
            Data::Text(bytes) => Some(read(bytes)),
            _ => None,
        }
    }

    fn text(self, position: c_int) -> Option<Vec<u8>> {
        match self.get(position)? {
            Data::Text(bytes) => Some(bytes.clone()),
            Data::Int(number) => Some(number.to_string().into_bytes()),
            Data::Float(number) => Some(float_text(*number).into_bytes()),
            _ => None,
        }
    }

    fn list_len(self, position: c_int) -> usize {
        match self.get(position) {
            Some(Data::Array(items)) => items.len(),
            Some(Data::Map(_)) => (1..)
                .take_while(|&i| self.element(position, i).is_some())
                .count(),
            _ => 0,
        }
    }

    fn number_at(self, position: c_int, i: i64) -> Option<f64> {
        self.element(position, i).and_then(number_of)
    }

    fn numbers_into(self, position: c_int, first: i64, out: &mut [f64]) -> bool {
        (first..).zip(out).all(|(i, number)| {
            self.number_at(position, i)
                .map(|found| *number = found)
                .is_some()
        })
    }

    fn integer_at(self, position: c_int, i: i64) -> Option<i64> {
        self.element(position, i).and_then(integer_of)
    }

    fn data(self, position: c_int) -> ApiResult<Data> {
        Ok(self.get(position).cloned().unwrap_or(Data::Nil))
    }

    fn function(self, _: c_int) -> ApiResult<FunctionRef> {
        Err(ApiError::NeedsLua)
    }

    fn object(self, _: c_int) -> Option<LuaObject> {
        None
    }

    fn caller(self) -> Caller<'a> {
        Caller::Environment(self.env)
    }
}

fn number_of(data: &Data) -> Option<f64> {
    match data {
        Data::Int(number) => Some(numbers::real_of(*number)),
        Data::Float(number) => Some(*number),
        Data::Text(text) => numeral(text).and_then(|number| number_of(&number)),
        _ => None,
    }
}

/// Neither 2.0 nor "2" is one.
fn integer_of(data: &Data) -> Option<i64> {
    if let Data::Int(number) = data {
        Some(*number)
    } else {
        None
    }
}

/// The number in a string, as Lua converts it; hexadecimal ones are integers here.
fn numeral(text: &[u8]) -> Option<Data> {
    let text = std::str::from_utf8(text)
        .ok()?
        .trim_matches([' ', '\t', '\n', '\r', '\x0b', '\x0c']);
    let (sign, digits) = match text.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    if let Some(hexadecimal) = digits
        .strip_prefix("0x")
        .or_else(|| digits.strip_prefix("0X"))
    {
        return i64::from_str_radix(hexadecimal, 16)
            .ok()
            .map(|number| Data::Int(sign * number));
    }
    if !digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return None;
    }
    text.parse()
        .map(Data::Int)
        .or_else(|_| text.parse().map(Data::Float))
        .ok()
}

/// A float in Lua's spelling: 14 digits, and always recognisable as one.
fn float_text(number: f64) -> String {
    const DIGITS: i32 = 14;
    if !number.is_finite() {
        let word = if number.is_nan() { "nan" } else { "inf" };
        return if number.is_sign_negative() {
            format!("-{word}")
        } else {
            word.to_owned()
        };
    }
    let scientific = format!("{number:.*e}", DIGITS as usize - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or_default();
    let trimmed = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    if !(-4..DIGITS).contains(&exponent) {
        let sign = if exponent < 0 { '-' } else { '+' };
        return format!("{}e{sign}{:02}", trimmed(mantissa), exponent.abs());
    }
    let plain = trimmed(&format!(
        "{number:.*}",
        usize::try_from(DIGITS - 1 - exponent).unwrap_or_default()
    ));
    if plain.contains('.') {
        plain
    } else {
        plain + ".0"
    }
}

#[cfg(test)]
mod tests {
    use super::{Data, float_text, numeral};

    #[test]
    fn floats_are_spelt_as_in_lua() {
        for (number, text) in [
            (1.0, "1.0"),
            (0.1, "0.1"),
            (-2.5e-7, "-2.5e-07"),
            (1e15, "1e+15"),
            (123456.75, "123456.75"),
            (1e-4, "0.0001"),
        ] {
            assert_eq!(float_text(number), text);
        }
        assert_eq!(float_text(std::f64::consts::PI), "3.1415926535898");
    }

    #[test]
    fn numerals_are_read_as_in_lua() {
        assert_eq!(numeral(b" 12 "), Some(Data::Int(12)));
        assert_eq!(numeral(b"-0x1F"), Some(Data::Int(-31)));
        assert_eq!(numeral(b".5e1"), Some(Data::Float(5.0)));
        for bad in ["", "x", "inf", "nan", "1 2", "--1"] {
            assert_eq!(numeral(bad.as_bytes()), None, "{bad}");
        }
    }
}
