//! Encoding: from the results of an API function to values on a Lua stack.

use super::args::{Bytes, Table};
use super::data::{push_buffer, push_data};
use crate::scene::{Data, Handle};
use crate::script::error::{ApiError, ApiResult};
use crate::script::lua::{LONGEST_LIST, Stack};

/// A type that scripts get back.
pub trait IntoScript {
    /// The type in the words of the reference; empty for nothing.
    const TYPE: &'static str;

    /// Pushes the value, or several, or nothing.
    #[doc(hidden)]
    #[allow(private_interfaces)]
    fn into_script(self, stack: Stack<'_>) -> ApiResult<()>;
}

macro_rules! values {
    ($($ty:ty, $name:literal, |$value:ident, $stack:ident| $push:expr;)*) => { $(
        impl IntoScript for $ty {
            const TYPE: &'static str = $name;
            #[allow(private_interfaces)]
            fn into_script(self, $stack: Stack<'_>) -> ApiResult<()> {
                let $value = self;
                $push;
                Ok(())
            }
        }
    )* };
}

values! {
    bool, "bool", |value, stack| stack.push_bool(value);
    i64, "int", |value, stack| stack.push_int(value);
    f64, "float", |value, stack| stack.push_number(value);
    String, "string", |value, stack| stack.push_bytes(value.as_bytes());
    &'static str, "string", |value, stack| stack.push_bytes(value.as_bytes());
    Handle, "int", |value, stack| stack.push_int(value.raw());
    Bytes, "buffer", |value, stack| push_buffer(stack, &value.0);
    Data, "any", |value, stack| push_data(stack, &value);
    Table, "table", |value, stack| push_data(stack, &value.0);
    Nil, "nil", |_value, stack| stack.push_nil();
    Vec<f64>, "float[]", |value, stack| push_list(stack, &value, |&v| stack.push_number(v))?;
    Vec<i64>, "int[]", |value, stack| push_list(stack, &value, |&v| stack.push_int(v))?;
    Vec<Handle>, "int[]", |value, stack| push_list(stack, &value, |v| stack.push_int(v.raw()))?;
    Vec<String>, "string[]", |value, stack| push_list(stack, &value, |v| stack.push_bytes(v.as_bytes()))?;
}

/// Nothing.
impl IntoScript for () {
    const TYPE: &'static str = "";

    #[allow(private_interfaces)]
    fn into_script(self, _: Stack<'_>) -> ApiResult<()> {
        Ok(())
    }
}

fn push_list<T>(stack: Stack<'_>, list: &[T], push: impl Fn(&T)) -> ApiResult<()> {
    if list.len() > LONGEST_LIST {
        return Err(ApiError::Other("not enough memory".into()));
    }
    stack.new_table(list.len(), 0);
    for (i, item) in list.iter().enumerate() {
        push(item);
        stack.raw_set_index(-2, i as i64 + 1);
    }
    Ok(())
}

macro_rules! number_arrays {
    ($($n:literal $name:literal),*) => { $(
        impl IntoScript for [f64; $n] {
            const TYPE: &'static str = $name;
            #[allow(private_interfaces)]
            fn into_script(self, stack: Stack<'_>) -> ApiResult<()> {
                push_list(stack, &self, |&v| stack.push_number(v))
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

    #[allow(private_interfaces)]
    fn into_script(self, stack: Stack<'_>) -> ApiResult<()> {
        self.map_or(Ok(()), |value| value.into_script(stack))
    }
}

/// Several results, as many as there are.
#[derive(Debug, Clone, PartialEq)]
pub struct Results(pub Vec<Data>);

impl IntoScript for Results {
    const TYPE: &'static str = "any...";

    #[allow(private_interfaces)]
    fn into_script(self, stack: Stack<'_>) -> ApiResult<()> {
        if !stack.reserve(self.0.len() + 8) {
            return Err(ApiError::Other("too many results to return.".into()));
        }
        self.0.iter().for_each(|value| push_data(stack, value));
        Ok(())
    }
}

macro_rules! tuples {
    ($($($t:ident $i:tt),+;)*) => { $(
        impl<$($t: IntoScript),+> IntoScript for ($($t,)+) {
            /// `#[api]` reads the types of the elements.
            const TYPE: &'static str = "any...";
            #[allow(private_interfaces)]
            fn into_script(self, stack: Stack<'_>) -> ApiResult<()> {
                $(self.$i.into_script(stack)?;)+
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
