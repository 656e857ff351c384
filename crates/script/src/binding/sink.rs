//! Destinations of the results of an API function: a Lua stack, or a list of plain values.

use super::data::{push_buffer, push_data};
use crate::error::{ApiError, ApiResult};
use crate::lua::{LuaObject, MAX_LIST_LENGTH, Stack};
use scene::Data;

/// A destination of results.
#[doc(hidden)]
pub trait Sink {
    fn nil(&mut self);
    fn bool(&mut self, value: bool);
    fn int(&mut self, value: i64);
    fn number(&mut self, value: f64);
    fn text(&mut self, bytes: &[u8]);
    fn buffer(&mut self, bytes: &[u8]);
    fn data(&mut self, data: &Data);
    /// # Errors
    /// When the list is too long.
    fn list<T>(&mut self, items: &[T], push: impl Fn(&mut Self, &T)) -> ApiResult<()>;
    /// The same for numbers.
    ///
    /// # Errors
    /// As `list`.
    fn numbers(&mut self, numbers: &[f64]) -> ApiResult<()> {
        self.list(numbers, |sink, &number| sink.number(number))
    }
    /// # Errors
    /// Where there are no objects.
    fn object(&mut self, object: LuaObject) -> ApiResult<()>;
    /// Room for so many values; false where there is none.
    fn reserve(&mut self, count: usize) -> bool;
}

impl Sink for Stack<'_> {
    fn nil(&mut self) {
        self.push_nil();
    }

    fn bool(&mut self, value: bool) {
        self.push_bool(value);
    }

    fn int(&mut self, value: i64) {
        self.push_int(value);
    }

    fn number(&mut self, value: f64) {
        self.push_number(value);
    }

    fn text(&mut self, bytes: &[u8]) {
        self.push_bytes(bytes);
    }

    fn buffer(&mut self, bytes: &[u8]) {
        push_buffer(*self, bytes);
    }

    fn data(&mut self, data: &Data) {
        push_data(*self, data);
    }

    fn list<T>(&mut self, items: &[T], push: impl Fn(&mut Self, &T)) -> ApiResult<()> {
        if items.len() > MAX_LIST_LENGTH {
            return Err(ApiError::Other("not enough memory".into()));
        }
        self.new_table(items.len(), 0);
        for (i, item) in items.iter().enumerate() {
            push(self, item);
            self.raw_set_index(-2, numbers::count(i) + 1);
        }
        Ok(())
    }

    fn numbers(&mut self, numbers: &[f64]) -> ApiResult<()> {
        if numbers.len() > MAX_LIST_LENGTH {
            return Err(ApiError::Other("not enough memory".into()));
        }
        self.push_numbers(numbers);
        Ok(())
    }

    fn object(&mut self, object: LuaObject) -> ApiResult<()> {
        self.push_object(object);
        Ok(())
    }

    fn reserve(&mut self, count: usize) -> bool {
        Stack::reserve(*self, count)
    }
}

impl Sink for Vec<Data> {
    fn nil(&mut self) {
        self.push(Data::Nil);
    }

    fn bool(&mut self, value: bool) {
        self.push(Data::Bool(value));
    }

    fn int(&mut self, value: i64) {
        self.push(Data::Int(value));
    }

    fn number(&mut self, value: f64) {
        self.push(Data::Float(value));
    }

    fn text(&mut self, bytes: &[u8]) {
        self.push(Data::Text(bytes.to_vec()));
    }

    fn buffer(&mut self, bytes: &[u8]) {
        self.push(Data::Buffer(bytes.to_vec()));
    }

    fn data(&mut self, data: &Data) {
        self.push(data.clone());
    }

    fn list<T>(&mut self, items: &[T], push: impl Fn(&mut Self, &T)) -> ApiResult<()> {
        let mut list = Self::with_capacity(items.len());
        items.iter().for_each(|item| push(&mut list, item));
        self.push(Data::Array(list));
        Ok(())
    }

    fn object(&mut self, _: LuaObject) -> ApiResult<()> {
        Err(ApiError::NeedsLua)
    }

    fn reserve(&mut self, _: usize) -> bool {
        true
    }
}
