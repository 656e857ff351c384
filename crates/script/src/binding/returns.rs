//! Encoding: from the results of an API function to values on a Lua stack.

use super::args::{Bytes, Table};
use super::sink::Sink;
use crate::error::{ApiError, ApiResult};
use scene::{Data, Handle};

/// A type that scripts get back.
pub trait IntoScript {
    /// The type in the words of the reference; empty for nothing.
    const TYPE: &'static str;

    /// Pushes the value, or several, or nothing.
    #[doc(hidden)]
    fn into_script<S: Sink>(self, sink: &mut S) -> ApiResult<()>;
}

macro_rules! values {
    ($($ty:ty, $name:literal, |$value:ident, $sink:ident| $push:expr;)*) => { $(
        impl IntoScript for $ty {
            const TYPE: &'static str = $name;
                    fn into_script<S: Sink>(self, $sink: &mut S) -> ApiResult<()> {
                let $value = self;
                $push;
                Ok(())
            }
        }
    )* };
}

values! {
    bool, "bool", |value, sink| sink.bool(value);
    i64, "int", |value, sink| sink.int(value);
    f64, "float", |value, sink| sink.number(value);
    String, "string", |value, sink| sink.text(value.as_bytes());
    &'static str, "string", |value, sink| sink.text(value.as_bytes());
    Handle, "int", |value, sink| sink.int(value.raw());
    Bytes, "buffer", |value, sink| sink.buffer(&value.0);
    Data, "any", |value, sink| sink.data(&value);
    Table, "table", |value, sink| sink.data(&value.0);
    Nil, "nil", |_value, sink| sink.nil();
    Vec<f64>, "float[]", |value, sink| sink.numbers(&value)?;
    Vec<i64>, "int[]", |value, sink| sink.list(&value, |sink, &v| sink.int(v))?;
    Vec<Handle>, "int[]", |value, sink| sink.list(&value, |sink, v| sink.int(v.raw()))?;
    Vec<String>, "string[]", |value, sink| sink.list(&value, |sink, v| sink.text(v.as_bytes()))?;
}

/// Nothing.
impl IntoScript for () {
    const TYPE: &'static str = "";

    fn into_script<S: Sink>(self, _: &mut S) -> ApiResult<()> {
        Ok(())
    }
}

macro_rules! number_arrays {
    ($($n:literal $name:literal),*) => { $(
        impl IntoScript for [f64; $n] {
            const TYPE: &'static str = $name;
                    fn into_script<S: Sink>(self, sink: &mut S) -> ApiResult<()> {
                sink.numbers(&self)
            }
        }
    )* };
}
number_arrays!(1 "float[1]", 2 "float[2]", 3 "float[3]", 4 "float[4]", 6 "float[6]", 7 "float[7]", 9 "float[9]", 12 "float[12]");

/// An explicit nil, where "no value" and nil differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Nil;

/// Nothing at all when `None`.
impl<T: IntoScript> IntoScript for Option<T> {
    const TYPE: &'static str = T::TYPE;

    fn into_script<S: Sink>(self, sink: &mut S) -> ApiResult<()> {
        self.map_or(Ok(()), |value| value.into_script(sink))
    }
}

/// Several results, as many as there are.
#[derive(Debug, Clone, PartialEq)]
pub struct Results(pub Vec<Data>);

impl IntoScript for Results {
    const TYPE: &'static str = "any...";

    fn into_script<S: Sink>(self, sink: &mut S) -> ApiResult<()> {
        if !sink.reserve(self.0.len() + 8) {
            return Err(ApiError::Other("too many results to return.".into()));
        }
        self.0.iter().for_each(|value| sink.data(value));
        Ok(())
    }
}

macro_rules! tuples {
    ($($($t:ident $i:tt),+;)*) => { $(
        impl<$($t: IntoScript),+> IntoScript for ($($t,)+) {
            /// `#[api]` reads the types of the elements.
            const TYPE: &'static str = "any...";
                    fn into_script<S: Sink>(self, sink: &mut S) -> ApiResult<()> {
                $(self.$i.into_script(sink)?;)+
                Ok(())
            }
        }
    )* };
}
tuples! {
    A 0, B 1;
    A 0, B 1, C 2;
    A 0, B 1, C 2, D 3;
    A 0, B 1, C 2, D 3, E 4;
}
