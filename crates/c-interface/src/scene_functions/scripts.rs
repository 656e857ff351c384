//! Calls of script functions with the four tables of V-REP: integers, floats, texts, bytes.

use scene::Data;

use crate::dispatch::Call;
use crate::functions::{Answer, Function};

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("script.call_tables", call_with_tables),
    ("stack.unpack_onto", unpack),
];

/// Parameters: script or its type, `function@name`; integers, floats, texts, bytes, each with its count; and for the results of each
/// kind where the list and its length go.
fn call_with_tables(call: &Call<'_>) -> Answer {
    let counts = [
        call.count_at(3)?,
        call.count_at(5)?,
        call.count_at(7)?,
        call.count_at(9)?,
    ];
    let texts = call.texts_at(6, counts[2])?;
    let args = [
        Data::Text(call.bytes(1)?.to_vec()),
        Data::Int(call.integer_at(0)),
        call.integers_at(2, counts[0])?,
        call.numbers_at(4, counts[1])?,
        Data::Array(texts.into_iter().map(Data::Text).collect()),
        Data::Text(call.list_at(8, counts[3])?),
    ];
    let results = call.frame.host().call("sim._callScriptFunction", &args);
    let results =
        results.map_err(|reason| format!("{}: {reason}", call.text(1).unwrap_or_default()))?;
    let mut results = results.into_iter();
    write_list(call, 10, 'I', results.next());
    write_list(call, 12, call.number_letter(), results.next());
    write_texts(call, 14, results.next());
    write_list(call, 16, 'S', results.next());
    Ok(vec![Data::Int(1)])
}

/// The address of a list that the caller releases, and the number of its items.
fn write_list(call: &Call<'_>, place: usize, ty: char, list: Option<Data>) {
    let mut length = 0;
    let address = call.frame.keep(ty, list, &mut length);
    call.write_at(place, &[address]);
    call.write_at(place + 1, &[i32::try_from(length).unwrap_or(i32::MAX)]);
}

/// The address of a list of addresses of texts. All are one block, which the caller releases once.
fn write_texts(call: &Call<'_>, place: usize, list: Option<Data>) {
    let texts: Vec<Vec<u8>> = match list {
        Some(Data::Array(items)) => items.into_iter().filter_map(text).collect(),
        _ => Vec::new(),
    };
    let address = call.frame.keep_texts(&texts);
    call.write_at(place, &[address]);
    call.write_at(place + 1, &[i32::try_from(texts.len()).unwrap_or(i32::MAX)]);
}

fn text(item: Data) -> Option<Vec<u8>> {
    if let Data::Text(bytes) | Data::Buffer(bytes) = item {
        Some(bytes)
    } else {
        None
    }
}

/// Puts the items of a packed table onto a stack.
fn unpack(call: &Call<'_>) -> Answer {
    let bytes = Data::Buffer(call.bytes(1)?.to_vec());
    let table = call.frame.host().call("sim.unpackTable", &[bytes])?;
    call.stacks().get(call.int(0)?)?.extend(table);
    Ok(Vec::new())
}
