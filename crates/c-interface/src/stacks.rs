//! Stacks of values, by which plugins and scripts exchange arguments and results.

use std::collections::BTreeMap;

use scene::numbers;
use scene::{Data, Key};

/// The stacks of a simulator, by handle.
#[derive(Debug, Default)]
pub(super) struct Stacks {
    stacks: BTreeMap<i32, Vec<Data>>,
    last: i32,
}

/// The type of a value, as plugins number it.
const NULL: i64 = 0;
const DOUBLE: i64 = 1;
const BOOL: i64 = 2;
const STRING: i64 = 3;
const TABLE: i64 = 4;
const INTEGER: i64 = 9;

/// Answers about tables that are no counts.
const MAP: i64 = -2;
const NO_TABLE: i64 = -3;

impl Stacks {
    /// A new stack with these items; its handle, which is greater than 0.
    pub fn add(&mut self, items: Vec<Data>) -> i32 {
        self.last = self.last.checked_add(1).unwrap_or(1);
        while self.stacks.contains_key(&self.last) {
            self.last = self.last.checked_add(1).unwrap_or(1);
        }
        self.stacks.insert(self.last, items);
        self.last
    }

    /// Removes a stack; its items.
    pub fn remove(&mut self, handle: i64) -> Result<Vec<Data>, String> {
        let handle = i32::try_from(handle).ok();
        handle
            .and_then(|handle| self.stacks.remove(&handle))
            .ok_or_else(no_stack)
    }

    pub fn get(&mut self, handle: i64) -> Result<&mut Vec<Data>, String> {
        let handle = i32::try_from(handle).ok();
        handle
            .and_then(|handle| self.stacks.get_mut(&handle))
            .ok_or_else(no_stack)
    }

    pub fn top(&mut self, handle: i64) -> Result<&mut Data, String> {
        self.get(handle)?
            .last_mut()
            .ok_or_else(|| "the stack is empty".to_owned())
    }
}

fn no_stack() -> String {
    "there is no such stack".to_owned()
}

/// The place of an item; a negative index counts from the end.
pub(super) fn place(items: &[Data], index: i64) -> Result<usize, String> {
    let place = if index < 0 {
        index.saturating_add(numbers::count(items.len()))
    } else {
        index
    };
    usize::try_from(place)
        .ok()
        .filter(|&place| place < items.len())
        .ok_or_else(|| "there is no such item".to_owned())
}

/// Puts the value on top into the table below, under the key between them.
pub(super) fn insert(items: &mut Vec<Data>) -> Result<(), String> {
    let [.., table, key, _] = items.as_mut_slice() else {
        return Err("a table, a key and a value are needed".into());
    };
    let key = as_key(key).ok_or("this is no key of a table")?;
    let entries = match table {
        Data::Array(list) if matches!(key, Key::Int(next) if next == numbers::count(list.len()) + 1) => {
            None
        }
        Data::Array(list) => {
            *table = Data::Map((1..).map(Key::Int).zip(std::mem::take(list)).collect());
            Some(table)
        }
        Data::Map(_) => Some(table),
        _ => return Err("there is no table below key and value".into()),
    };
    if let Some(Data::Map(entries)) = entries {
        entries.retain(|(known, _)| *known != key);
    }
    let value = items.pop().unwrap_or(Data::Nil);
    items.pop();
    match items.last_mut() {
        Some(Data::Array(list)) => list.push(value),
        Some(Data::Map(_)) if value == Data::Nil => {}
        Some(Data::Map(entries)) => entries.push((key, value)),
        _ => {}
    }
    Ok(())
}

fn as_key(data: &Data) -> Option<Key> {
    Some(match data {
        Data::Int(key) => Key::Int(*key),
        Data::Float(key) if key.fract() == 0.0 && key.abs() < 9e15 => {
            Key::Int(numbers::truncated(*key))
        }
        Data::Float(key) if !key.is_nan() => Key::Float(*key),
        Data::Bool(key) => Key::Bool(*key),
        Data::Text(key) | Data::Buffer(key) => Key::Text(key.clone()),
        _ => return None,
    })
}

/// The items of a table with the keys 1 to n, in whatever order they were put in; None for all else.
pub(super) fn as_list(data: &Data) -> Option<Vec<Data>> {
    let entries = match data {
        Data::Array(items) => return Some(items.clone()),
        Data::Map(entries) => entries,
        _ => return None,
    };
    let number = |key: &Key| {
        if let Key::Int(number) = key {
            usize::try_from(*number).ok()
        } else {
            None
        }
    };
    let mut items = vec![None; entries.len()];
    for (key, value) in entries {
        *number(key).and_then(|number| items.get_mut(number.checked_sub(1)?))? =
            Some(value.clone());
    }
    items.into_iter().collect()
}

pub(super) fn item_type(data: &Data) -> i64 {
    match data {
        Data::Nil => NULL,
        Data::Float(_) => DOUBLE,
        Data::Bool(_) => BOOL,
        Data::Text(_) | Data::Buffer(_) => STRING,
        Data::Array(_) | Data::Map(_) => TABLE,
        Data::Int(_) => INTEGER,
    }
}

/// What plugins ask about a table: 0 its size, 1 to 5 whether all values are of a type.
pub(super) fn table_info(data: &Data, info: i64) -> i64 {
    if let (0, Data::Text(bytes) | Data::Buffer(bytes)) = (info, data) {
        return numbers::count(bytes.len());
    }
    if !matches!(data, Data::Array(_) | Data::Map(_)) {
        return NO_TABLE;
    }
    let Some(items) = as_list(data) else {
        return if info == 0 { MAP } else { 0 };
    };
    let all =
        |wanted: &[i64]| i64::from(items.iter().all(|item| wanted.contains(&item_type(item))));
    match info {
        0 => numbers::count(items.len()),
        1 => all(&[NULL]),
        2 => all(&[DOUBLE, INTEGER]),
        3 => all(&[BOOL]),
        4 => all(&[STRING]),
        5 => all(&[TABLE]),
        _ => 0,
    }
}

/// Keys and values of a table in turn, the bytes of a text like a list of numbers.
pub(super) fn unfolded(data: &Data) -> Option<Vec<Data>> {
    let listed = |items: Vec<Data>| {
        let pairs = (1..).map(Data::Int).zip(items);
        pairs.flat_map(|(key, value)| [key, value]).collect()
    };
    match data {
        Data::Text(bytes) | Data::Buffer(bytes) => Some(listed(
            bytes.iter().map(|&byte| Data::Int(byte.into())).collect(),
        )),
        Data::Map(entries) if as_list(data).is_none() => Some(
            entries
                .iter()
                .flat_map(|(key, value)| [of_key(key), value.clone()])
                .collect(),
        ),
        _ => as_list(data).map(listed),
    }
}

fn of_key(key: &Key) -> Data {
    match key {
        Key::Bool(key) => Data::Bool(*key),
        Key::Int(key) => Data::Int(*key),
        Key::Float(key) => Data::Float(*key),
        Key::Text(key) => Data::Text(key.clone()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str) -> Data {
        Data::text(text)
    }

    #[test]
    fn tables_grow_by_keys_in_any_order() {
        let mut items = vec![Data::Array(Vec::new())];
        for (key, value) in [(2, 20), (1, 10)] {
            items.extend([Data::Int(key), Data::Int(value)]);
            insert(&mut items).expect("key and value are there");
        }
        assert_eq!(as_list(&items[0]), Some(vec![Data::Int(10), Data::Int(20)]));
        items.extend([text("a"), Data::Bool(true)]);
        insert(&mut items).expect("key and value are there");
        assert_eq!((as_list(&items[0]), table_info(&items[0], 0)), (None, -2));
        assert!(
            insert(&mut items).is_err()
                && insert(&mut vec![Data::Nil, Data::Int(1), Data::Nil]).is_err()
        );
        items.extend([Data::Float(f64::NAN), Data::Nil]);
        assert!(insert(&mut items).is_err());
    }

    /// As the functions of the interface say it: counts, -2 for maps, -3 for what is no table.
    #[test]
    fn what_plugins_learn_of_tables() {
        let list = Data::from([1, 2, 3]);
        assert_eq!(
            (
                table_info(&list, 0),
                table_info(&list, 2),
                table_info(&list, 3)
            ),
            (3, 1, 0)
        );
        assert_eq!(table_info(&Data::Array(Vec::new()), 0), 0);
        assert_eq!(table_info(&Data::Int(5), 0), -3);
        let map = Data::map([("a", Data::Int(1))]);
        assert_eq!(table_info(&map, 0), -2);
        assert_eq!(unfolded(&map), Some(vec![text("a"), Data::Int(1)]));
        assert_eq!(
            unfolded(&text("A")),
            Some(vec![Data::Int(1), Data::Int(65)])
        );
        assert_eq!(unfolded(&Data::Nil), None);
    }

    #[test]
    fn handles_are_never_zero_and_stale_ones_are_refused() {
        let mut stacks = Stacks {
            last: i32::MAX,
            ..Stacks::default()
        };
        let handle = i64::from(stacks.add(vec![Data::Nil]));
        assert!(handle > 0 && stacks.get(handle).is_ok());
        assert!(
            stacks.remove(handle).is_ok()
                && stacks.remove(handle).is_err()
                && stacks.get(i64::MAX).is_err()
        );
        assert!(
            place(&[Data::Nil], -1).is_ok()
                && place(&[Data::Nil], -2).is_err()
                && place(&[], 0).is_err()
        );
        assert!(place(&[], i64::MIN).is_err());
    }
}
