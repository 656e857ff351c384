//! Data that scene and objects carry: numbered blocks of V-REP, lists of handles, tables as properties.

use scene::{Data, numbers};

use super::objects::bytes;
use crate::dispatch::Call;
use crate::functions::{Answer, Function};

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("data.scene", |call| copy(call, "simGetSceneCustomData", 1)),
    ("data.scene_length", |call| {
        length(call, "simGetSceneCustomData")
    }),
    ("data.object", |call| {
        copy(call, "simGetObjectCustomData", 2)
    }),
    ("data.object_length", |call| {
        length(call, "simGetObjectCustomData")
    }),
    ("references.get", references),
    ("references.set", set_references),
    ("property.table", table),
    ("property.set_table", set_table),
];

/// The block of that number.
fn block(call: &Call<'_>, function: &str, keys: usize) -> Result<Vec<u8>, String> {
    let results = call.frame.host().call(function, &call.args[..keys])?;
    Ok(results.into_iter().next().map(bytes).unwrap_or_default())
}

/// Copies the block to the address behind its keys, where the caller has made room for it.
fn copy(call: &Call<'_>, function: &str, keys: usize) -> Answer {
    call.write_at(keys, &block(call, function, keys)?);
    Ok(Vec::new())
}

fn length(call: &Call<'_>, function: &str) -> Answer {
    let bytes = block(call, function, call.args.len())?;
    Ok(vec![Data::Int(numbers::count(bytes.len()))])
}

/// The name of a list of handles, which programs for CoppeliaSim 4.1 cannot give.
fn tag(call: &Call<'_>, place: usize) -> Data {
    match call.arg(place) {
        Data::Text(tag) if call.is_double => Data::Text(tag.clone()),
        _ => Data::text(""),
    }
}

/// How many handles an object refers to, and the handles. Parameters: object, where the list goes, its name, reserved.
fn references(call: &Call<'_>) -> Answer {
    let args = [Data::Int(call.integer_at(0)), tag(call, 1)];
    let results = call.frame.host().call("sim.getReferencedHandles", &args)?;
    let list = results.into_iter().next().unwrap_or(Data::Nil);
    let count = match &list {
        Data::Array(items) => items.len(),
        _ => 0,
    };
    Ok(vec![Data::Int(numbers::count(count)), list])
}

/// Parameters: object, count, handles, their name, reserved.
fn set_references(call: &Call<'_>) -> Answer {
    let args = [
        Data::Int(call.integer_at(0)),
        call.integers_at(2, call.count_at(1)?)?,
        tag(call, 3),
    ];
    call.frame.host().call("sim.setReferencedHandles", &args)
}

/// A table as `simPackTable` packs it.
fn table(call: &Call<'_>) -> Answer {
    let host = call.frame.host();
    let table = host.call("sim.getTableProperty", &call.args)?;
    host.call("sim.packTable", &table)
}

fn set_table(call: &Call<'_>) -> Answer {
    let host = call.frame.host();
    let packed = Data::Buffer(call.bytes(2)?.to_vec());
    let table = host.call("sim.unpackTable", &[packed])?;
    let mut args = call.args[..2].to_vec();
    args.extend(table.into_iter().take(1));
    host.call("sim.setTableProperty", &args)
}
