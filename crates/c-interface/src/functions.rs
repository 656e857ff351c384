//! The functions of the interface that scripts do not have: stacks, memory, registration, errors, calls of scripts.

use super::dispatch::Call;
use super::stacks::{as_list, insert, item_type, place, table_info, unfolded};
use super::{registration, scene_functions};
use scene::Data;
use scene::numbers;

/// The results of a function, or why it failed.
pub type Answer = Result<Vec<Data>, String>;
/// A function of the interface that scripts do not have, or not in this form.
pub type Function = fn(&Call<'_>) -> Answer;

/// The functions by their names in the table of symbols.
const FUNCTIONS: &[(&str, Function)] = &[
    ("log", log),
    ("error.set", set_error),
    ("error.take", take_error),
    ("buffer.create", create_buffer),
    ("buffer.release", release_buffer),
    ("stack.create", |call| {
        Ok(vec![Data::Int(call.stacks().add(Vec::new()).into())])
    }),
    ("stack.release", |call| {
        call.stacks().remove(call.int(0)?).map(|_| Vec::new())
    }),
    ("stack.copy", copy_stack),
    ("stack.push", |call| call.push(call.arg(1).clone())),
    ("stack.push_null", |call| call.push(Data::Nil)),
    ("stack.push_text", |call| {
        call.push(Data::Text(call.bytes(1)?.to_vec()))
    }),
    ("stack.push_buffer", |call| {
        call.push(Data::Buffer(call.bytes(1)?.to_vec()))
    }),
    ("stack.push_bytes", |call| {
        call.push(
            call.bytes(1)?
                .iter()
                .map(|&b| i64::from(b))
                .collect::<Vec<_>>()
                .into(),
        )
    }),
    ("stack.push_numbers", |call| match call.arg(1) {
        Data::Nil => Err("NULL was passed for the numbers".into()),
        numbers => call.push(numbers.clone()),
    }),
    ("stack.push_table", |call| {
        call.push(Data::Array(Vec::new()))
    }),
    ("stack.insert", |call| {
        insert(call.stacks().get(call.int(0)?)?).map(|()| Vec::new())
    }),
    ("stack.size", |call| {
        Ok(vec![Data::Int(numbers::count(
            call.stacks().get(call.int(0)?)?.len(),
        ))])
    }),
    ("stack.pop", pop),
    ("stack.move_to_top", move_to_top),
    ("stack.item_type", type_of_item),
    ("stack.is_null", |call| {
        Ok(vec![Data::Bool(
            *call.stacks().top(call.int(0)?)? == Data::Nil,
        )])
    }),
    ("stack.bool", |call| {
        call.found(|top| matches!(top, Data::Bool(_)).then(|| top.clone()))
    }),
    ("stack.int", |call| {
        call.found(|top| rounded(top).map(Data::Int))
    }),
    ("stack.number", |call| {
        call.found(|top| top.as_f64().map(Data::Float))
    }),
    ("stack.string", |call| {
        Ok(vec![
            text_of(call.stacks().top(call.int(0)?)?).unwrap_or(Data::Nil),
        ])
    }),
    ("stack.table_info", |call| {
        Ok(vec![Data::Int(table_info(
            call.stacks().top(call.int(0)?)?,
            call.int(1)?,
        ))])
    }),
    ("stack.bytes", |call| call.found(bytes_of)),
    ("stack.ints", |call| {
        call.found(|top| list_of(top, |item| rounded(item).map(Data::Int)))
    }),
    ("stack.numbers", |call| {
        call.found(|top| list_of(top, |item| item.as_f64().map(Data::Float)))
    }),
    ("stack.four_numbers", |call| {
        call.found(|top| numbers_of(top, 4))
    }),
    ("stack.seven_numbers", |call| {
        call.found(|top| numbers_of(top, 7))
    }),
    ("stack.unfold", unfold),
    ("stack.debug", debug),
    ("stack.pack", |call| {
        let top = call.stacks().top(call.int(0)?)?.clone();
        call.frame.host.call("sim.packTable", &[top])
    }),
    ("stack.unpack", unpack),
];

/// The function of that name.
pub(super) fn find(name: &str) -> Option<Function> {
    let mut functions = FUNCTIONS
        .iter()
        .chain(registration::FUNCTIONS)
        .chain(scene_functions::FUNCTIONS.into_iter().flatten());
    functions
        .find(|(known, _)| *known == name)
        .map(|&(_, function)| function)
}

impl Call<'_> {
    pub(super) fn stacks(&self) -> std::cell::RefMut<'_, super::stacks::Stacks> {
        self.frame.shared.stacks.borrow_mut()
    }

    /// A parameter; nil where there is none.
    pub fn arg(&self, place: usize) -> &Data {
        self.args.get(place).unwrap_or(&Data::Nil)
    }

    /// A parameter that is an integer.
    ///
    /// # Errors
    /// When it is something else.
    pub fn int(&self, place: usize) -> Result<i64, String> {
        match self.arg(place) {
            Data::Int(value) => Ok(*value),
            _ => Err(format!("parameter {} is no integer", place + 1)),
        }
    }

    /// A parameter that is a text.
    ///
    /// # Errors
    /// When it is NULL.
    pub fn bytes(&self, place: usize) -> Result<&[u8], String> {
        match self.arg(place) {
            Data::Text(bytes) | Data::Buffer(bytes) => Ok(bytes),
            _ => Err(format!(
                "NULL was passed for the text that is parameter {}",
                place + 1
            )),
        }
    }

    /// Calls a parameter that is a function without parameters, unless it is NULL.
    pub fn run_callback(&self, place: usize) {
        if let Some(value) = self.values.get(place) {
            value.address.run();
        }
    }

    /// Whether a parameter that is a function is not NULL.
    pub fn has_callback(&self, place: usize) -> bool {
        self.values
            .get(place)
            .is_some_and(|value| !value.address.is_null())
    }

    /// A parameter that is a text, as UTF-8.
    ///
    /// # Errors
    /// When it is NULL.
    pub fn text(&self, place: usize) -> Result<String, String> {
        self.bytes(place)
            .map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    }

    fn push(&self, item: Data) -> Answer {
        self.stacks().get(self.int(0)?)?.push(item);
        Ok(Vec::new())
    }

    /// 1 and what is found in the item on top, or 0.
    fn found(&self, find: impl FnOnce(&Data) -> Option<Data>) -> Answer {
        Ok(match find(self.stacks().top(self.int(0)?)?) {
            Some(value) => vec![Data::Int(1), value],
            None => vec![Data::Int(0)],
        })
    }
}

/// An integer as it is, a number a little off as well.
fn rounded(data: &Data) -> Option<i64> {
    match *data {
        Data::Int(value) => Some(value),
        Data::Float(value) => Some(numbers::truncated(value + 0.1_f64.copysign(value))),
        _ => None,
    }
}

fn text_of(data: &Data) -> Option<Data> {
    matches!(data, Data::Text(_) | Data::Buffer(_)).then(|| data.clone())
}

fn bytes_of(data: &Data) -> Option<Data> {
    match data {
        Data::Text(bytes) | Data::Buffer(bytes) => Some(
            bytes
                .iter()
                .map(|&byte| i64::from(byte))
                .collect::<Vec<_>>()
                .into(),
        ),
        _ => list_of(data, |item| rounded(item).map(Data::Int)),
    }
}

fn list_of(data: &Data, convert: impl Fn(&Data) -> Option<Data>) -> Option<Data> {
    as_list(data)?
        .iter()
        .map(convert)
        .collect::<Option<Vec<_>>>()
        .map(Data::Array)
}

/// A list of so many numbers.
fn numbers_of(data: &Data, count: usize) -> Option<Data> {
    let list = list_of(data, |item| item.as_f64().map(Data::Float));
    list.filter(|list| matches!(list, Data::Array(items) if items.len() == count))
}

fn log(call: &Call<'_>) -> Answer {
    let origin = call
        .text(0)
        .unwrap_or_else(|_| call.frame.origin().to_owned());
    call.frame.host.log(&origin, call.int(1)?, &call.text(2)?);
    Ok(Vec::new())
}

fn set_error(call: &Call<'_>) -> Answer {
    let text = call.text(1)?;
    call.frame.shared.last_error.replace(Some(text.clone()));
    call.frame.shared.raised.replace(Some(text));
    Ok(Vec::new())
}

fn take_error(call: &Call<'_>) -> Answer {
    let error = call.frame.shared.last_error.take();
    Ok(vec![Data::text(error.as_deref().unwrap_or("No error."))])
}

fn create_buffer(call: &Call<'_>) -> Answer {
    let size = call.int(0)?;
    let size = usize::try_from(size).map_err(|_| format!("{size} is no number of bytes"))?;
    Ok(vec![Data::Buffer(vec![0; size])])
}

fn release_buffer(call: &Call<'_>) -> Answer {
    let mut buffers = call.frame.shared.buffers.borrow_mut();
    let released = usize::try_from(call.int(0)?).is_ok_and(|address| buffers.release(address));
    if released {
        Ok(Vec::new())
    } else {
        Err("the simulator has no buffer there".into())
    }
}

fn copy_stack(call: &Call<'_>) -> Answer {
    let mut stacks = call.stacks();
    let items = stacks.get(call.int(0)?)?.clone();
    Ok(vec![Data::Int(stacks.add(items).into())])
}

fn pop(call: &Call<'_>) -> Answer {
    let mut stacks = call.stacks();
    let items = stacks.get(call.int(0)?)?;
    let size = match call.int(1)? {
        0 => 0,
        count => usize::try_from(count)
            .ok()
            .and_then(|count| items.len().checked_sub(count))
            .ok_or("too many items")?,
    };
    items.truncate(size);
    Ok(vec![Data::Int(numbers::count(size))])
}

fn move_to_top(call: &Call<'_>) -> Answer {
    let mut stacks = call.stacks();
    let items = stacks.get(call.int(0)?)?;
    let item = items.remove(place(items, call.int(1)?)?);
    items.push(item);
    Ok(Vec::new())
}

fn type_of_item(call: &Call<'_>) -> Answer {
    let mut stacks = call.stacks();
    let items = stacks.get(call.int(0)?)?;
    Ok(vec![Data::Int(item_type(
        &items[place(items, call.int(1)?)?],
    ))])
}

fn unfold(call: &Call<'_>) -> Answer {
    let mut stacks = call.stacks();
    let items = stacks.get(call.int(0)?)?;
    let parts = items
        .last()
        .and_then(unfolded)
        .ok_or("there is no table on top")?;
    items.pop();
    items.extend(parts);
    Ok(Vec::new())
}

fn debug(call: &Call<'_>) -> Answer {
    let text = format!(
        "stack {}: {:?}",
        call.int(0)?,
        call.stacks().get(call.int(0)?)?
    );
    call.frame
        .host
        .log(call.frame.origin(), super::current::INFOS, &text);
    Ok(Vec::new())
}

fn unpack(call: &Call<'_>) -> Answer {
    let table = call
        .frame
        .host
        .call("sim.unpackTable", &[call.arg(0).clone()])?;
    Ok(vec![Data::Int(call.stacks().add(table).into())])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dispatch::integer;

    /// Integers are read from numbers that are a little off.
    #[test]
    fn integers_from_numbers() {
        for (number, integer) in [
            (2.0, 2),
            (1.95, 2),
            (-1.95, -2),
            (2.5, 2),
            (f64::NAN, 0),
            (1e300, i64::MAX),
        ] {
            assert_eq!(rounded(&Data::Float(number)), Some(integer), "{number}");
        }
        assert_eq!(rounded(&Data::text("x")), None);
        assert_eq!(integer(&Data::Bool(true)), 1);
    }
}
