//! Values between a Lua stack and [`Data`] (spec: calls 3).

use std::ffi::{CStr, c_int, c_void};

use crate::error::{ApiError, ApiResult};
use crate::function_ref::FunctionRef;
use crate::lua::{Entries, Room, Scalar, Stack, Type};
use scene::{Data, Key};

/// Registry key of the metatable of all buffers of a state.
pub(crate) const BUFFER_METATABLE: &CStr = c"swanilda.buffer";

/// The field of a buffer table that holds its bytes.
pub(crate) const BUFFER_FIELD: &str = "__buff__";

/// Where a state keeps that name as a Lua string. Reading must not make strings: that may collect garbage, and a finalizer may change
/// the very table that is being read.
pub(crate) const BUFFER_FIELD_NAME: &CStr = c"swanilda.buffer_field";

/// Room is made for so many entries before they are seen.
const MAX_HINT: usize = 1 << 10;

/// Maximum nesting of tables.
const MAX_DEPTH: usize = 100;

/// Copies the value at `index`. Nothing is shared, metamethods are not called, a table within itself becomes an empty table.
///
/// # Errors
/// When a table is nested deeper than [`MAX_DEPTH`] levels.
pub(crate) fn read_data(stack: Stack<'_>, index: c_int) -> ApiResult<Data> {
    read(stack, index, &mut Vec::new())
}

/// Keeps the function at `index` alive.
pub(crate) fn read_function(stack: Stack<'_>, index: c_int) -> FunctionRef {
    stack.push_value(index);
    stack.keep_function()
}

fn read(stack: Stack<'_>, index: c_int, above: &mut Vec<*const c_void>) -> ApiResult<Data> {
    Ok(match stack.kind(index) {
        Type::None | Type::Nil => Data::Nil,
        Type::Boolean => Data::Bool(stack.truthy(index)),
        Type::Number => match stack.integer(index) {
            Some(i) => Data::Int(i),
            None => Data::Float(stack.number(index).unwrap_or_default()),
        },
        Type::String => Data::Text(stack.bytes(index).unwrap_or_default()),
        Type::Table => return read_table(stack, stack.absolute(index), above),
        Type::Function => Data::Text(opaque("FUNCTION", stack, index)),
        Type::UserData => Data::Text(opaque("USERDATA", stack, index)),
        Type::LightUserData => Data::Text(opaque("LIGHTUSERDATA", stack, index)),
        Type::Thread => Data::Text(opaque("THREAD", stack, index)),
    })
}

/// A value that cannot leave its state becomes a text that names it.
fn opaque(word: &str, stack: Stack<'_>, index: c_int) -> Vec<u8> {
    format!("<{word} {:p}>", stack.pointer(index)).into_bytes()
}

fn read_table(stack: Stack<'_>, table: c_int, above: &mut Vec<*const c_void>) -> ApiResult<Data> {
    if let Some(bytes) = read_buffer(stack, table) {
        return Ok(Data::Buffer(bytes));
    }
    let address = stack.pointer(table);
    if above.contains(&address) {
        return Ok(Data::Array(Vec::new()));
    }
    if above.len() >= MAX_DEPTH || !stack.reserve(8) {
        return Err(ApiError::TooNested(MAX_DEPTH));
    }
    above.push(address);
    let data = read_entries(stack, table, above);
    above.pop();
    data
}

/// Whether the value at `index`, if there is one, is a buffer.
pub(crate) fn is_buffer(stack: Stack<'_>, index: c_int) -> bool {
    if stack.kind(index) != Type::Table || !stack.push_metatable(index) {
        return false;
    }
    stack.push_registry(BUFFER_METATABLE);
    let is_buffer = stack.same(-1, -2);
    stack.pop(2);
    is_buffer
}

/// The bytes of the table at `table`, when it is a buffer.
pub fn read_buffer(stack: Stack<'_>, table: c_int) -> Option<Vec<u8>> {
    if !is_buffer(stack, table) {
        return None;
    }
    stack.push_registry(BUFFER_FIELD_NAME);
    stack.raw_get(table);
    let bytes = stack.bytes(-1);
    stack.pop(1);
    bytes
}

fn read_entries(stack: Stack<'_>, table: c_int, above: &mut Vec<*const c_void>) -> ApiResult<Data> {
    if let Some(numbers) = stack.list_of_numbers(table, from_scalar) {
        return Ok(Data::Array(numbers));
    }
    let len = stack.raw_len(table);
    // A table with holes may claim any length.
    let mut items = Vec::with_capacity(len.min(MAX_HINT));
    let mut cursor = stack.entries(table);
    while cursor.advance() {
        if items.len() == len
            || stack.integer(cursor.key()) != Some(numbers::count(items.len()) + 1)
        {
            let entries = (1..)
                .zip(items)
                .map(|(i, item)| (Key::Int(i), item))
                .collect();
            return read_remaining(stack, &mut cursor, len, entries, above);
        }
        items.push(read(stack, cursor.value(), above)?);
    }
    if items.len() == len {
        return Ok(Data::Array(items));
    }
    Ok(Data::Map(
        (1..)
            .zip(items)
            .map(|(i, item)| (Key::Int(i), item))
            .collect(),
    ))
}

/// Reads the entries from that of the cursor on, of a table that is no list in order, behind those that were read.
fn read_remaining(
    stack: Stack<'_>,
    cursor: &mut Entries<'_>,
    len: usize,
    mut entries: Vec<(Key, Data)>,
    above: &mut Vec<*const c_void>,
) -> ApiResult<Data> {
    let mut array = true;
    loop {
        let key = read_key(stack, cursor.key());
        array = array && matches!(key, Key::Int(i) if i >= 1 && numbers::place_of(i) <= len);
        entries.push((key, read(stack, cursor.value(), above)?));
        if !cursor.advance() {
            break;
        }
    }
    if !array || entries.len() != len {
        return Ok(Data::Map(entries));
    }
    entries.sort_by_key(|(key, _)| if let Key::Int(i) = key { *i } else { 0 });
    Ok(Data::Array(
        entries.into_iter().map(|(_, value)| value).collect(),
    ))
}

fn from_scalar(value: Scalar) -> Data {
    match value {
        Scalar::Nil => Data::Nil,
        Scalar::Bool(b) => Data::Bool(b),
        Scalar::Int(i) => Data::Int(i),
        Scalar::Number(f) => Data::Float(f),
    }
}

/// The value, when it has no memory of its own.
fn as_scalar(data: &Data) -> Option<Scalar> {
    Some(match data {
        Data::Nil => Scalar::Nil,
        Data::Bool(b) => Scalar::Bool(*b),
        Data::Int(i) => Scalar::Int(*i),
        Data::Float(f) => Scalar::Number(*f),
        _ => return None,
    })
}

fn read_key(stack: Stack<'_>, index: c_int) -> Key {
    match stack.kind(index) {
        Type::Boolean => Key::Bool(stack.truthy(index)),
        Type::Number => match stack.integer(index) {
            Some(i) => Key::Int(i),
            None => Key::Float(stack.number(index).unwrap_or_default()),
        },
        // A C string on its way through the original: it ends at the first NUL.
        Type::String => {
            let up_to_nul = |text: &[u8]| {
                text.split(|&byte| byte == 0)
                    .next()
                    .unwrap_or_default()
                    .to_vec()
            };
            Key::Text(stack.with_bytes(index, up_to_nul).unwrap_or_default())
        }
        Type::Function => Key::Text(opaque("FUNCTION", stack, index)),
        Type::Thread => Key::Text(opaque("THREAD", stack, index)),
        Type::Table => Key::Text(opaque("TABLE", stack, index)),
        _ => Key::Text(opaque("USERDATA", stack, index)),
    }
}

/// Pushes `data`. Where Lua's stack is full, a nested table becomes nil, so that the program goes on.
pub(crate) fn push_data(stack: Stack<'_>, data: &Data) {
    push(stack, stack.room(), data);
}

fn push<'a>(stack: Stack<'a>, room: Room<'a>, data: &Data) {
    match data {
        Data::Nil => room.push(Scalar::Nil),
        Data::Bool(b) => room.push(Scalar::Bool(*b)),
        Data::Int(i) => room.push(Scalar::Int(*i)),
        Data::Float(f) => room.push(Scalar::Number(*f)),
        Data::Text(bytes) => room.push_bytes(bytes),
        Data::Buffer(bytes) if stack.reserve(8) => push_buffer(stack, bytes),
        Data::Buffer(_) => room.push(Scalar::Nil),
        Data::Array(items) => match room.new_table(items.len(), 0) {
            Ok(table) => {
                for (i, item) in (1..).zip(items) {
                    match as_scalar(item) {
                        Some(scalar) => table.set_scalar(i, scalar),
                        None => table.set_item(i, |room| push(stack, room, item)),
                    }
                }
            }
            Err(room) => room.push(Scalar::Nil),
        },
        Data::Map(entries) => match room.new_table(0, entries.len()) {
            Ok(table) => {
                for (key, value) in entries {
                    let value = |room| push(stack, room, value);
                    match key {
                        Key::Bool(b) => table.set_entry(Scalar::Bool(*b), value),
                        Key::Int(i) => table.set_entry(Scalar::Int(*i), value),
                        Key::Float(f) => table.set_entry(Scalar::Number(*f), value),
                        Key::Text(text) => table.set_field(text, value),
                    }
                }
            }
            Err(room) => room.push(Scalar::Nil),
        },
    }
}

/// Pushes a buffer.
pub fn push_buffer(stack: Stack<'_>, bytes: &[u8]) {
    stack.new_table(0, 1);
    stack.push_bytes(bytes);
    stack.raw_set_field(-2, BUFFER_FIELD);
    if stack.push_registry(BUFFER_METATABLE) == Type::Table {
        stack.set_metatable(-2);
    } else {
        stack.pop(1);
    }
}
