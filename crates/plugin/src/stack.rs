//! Values on a stack of the simulator.

use super::Value;
use super::interface::Interface;

/// Deepest table that is read.
const MAX_DEPTH: usize = 100;

/// Types of items, as the interface numbers them.
const DOUBLE: i32 = 1;
const BOOL: i32 = 2;
const STRING: i32 = 3;
const TABLE: i32 = 4;
const INTEGER: i32 = 9;

/// Takes all values off a stack; the first one was at the bottom.
pub(super) fn take(interface: &Interface, stack: i32) -> Vec<Value> {
    let mut values: Vec<Value> = (0..(interface.size)(stack))
        .map(|_| pop(interface, stack, 0))
        .collect();
    values.reverse();
    values
}

/// Takes the value on top.
fn pop(interface: &Interface, stack: i32, depth: usize) -> Value {
    let value = match (interface.item_type)(stack, -1) {
        BOOL => {
            let mut value = 0;
            (interface.get_bool)(stack, &mut value);
            Value::Bool(value != 0)
        }
        INTEGER => {
            let mut value = 0;
            (interface.get_int)(stack, &mut value);
            Value::Int(value)
        }
        DOUBLE => {
            let mut value = 0.0;
            (interface.get_double)(stack, &mut value);
            Value::Float(value)
        }
        STRING => Value::Text(interface.text(stack)),
        TABLE if depth < MAX_DEPTH => return pop_table(interface, stack, depth),
        _ => Value::Nil,
    };
    (interface.pop)(stack, 1);
    value
}

fn pop_table(interface: &Interface, stack: i32, depth: usize) -> Value {
    let is_list = (interface.table_info)(stack, 0) >= 0;
    let below = (interface.size)(stack) - 1;
    (interface.unfold)(stack);
    let mut entries = Vec::new();
    while (interface.size)(stack) > below {
        let value = pop(interface, stack, depth + 1);
        entries.push((pop(interface, stack, depth + 1), value));
    }
    entries.reverse();
    if is_list {
        Value::Array(entries.into_iter().map(|(_, value)| value).collect())
    } else {
        Value::Map(entries)
    }
}

/// Puts a value onto a stack.
pub(super) fn push(interface: &Interface, stack: i32, value: &Value) {
    match value {
        Value::Nil => {
            (interface.push_null)(stack);
        }
        Value::Bool(value) => {
            (interface.push_bool)(stack, *value);
        }
        Value::Int(value) => {
            (interface.push_int)(stack, *value);
        }
        Value::Float(value) => {
            (interface.push_double)(stack, *value);
        }
        // A length of 0 means a text that ends with NUL.
        Value::Text(bytes) if bytes.is_empty() => {
            (interface.push_text)(stack, c"".as_ptr());
        }
        Value::Text(bytes) => {
            let length = i32::try_from(bytes.len()).unwrap_or(i32::MAX);
            (interface.push_string)(stack, bytes.as_ptr().cast(), length);
        }
        Value::Array(items) => {
            (interface.push_table)(stack);
            for (key, item) in (1..).zip(items) {
                insert(interface, stack, &Value::Int(key), item);
            }
        }
        Value::Map(entries) => {
            (interface.push_table)(stack);
            entries
                .iter()
                .for_each(|(key, item)| insert(interface, stack, key, item));
        }
    }
}

fn insert(interface: &Interface, stack: i32, key: &Value, item: &Value) {
    push(interface, stack, key);
    push(interface, stack, item);
    (interface.insert)(stack);
}
