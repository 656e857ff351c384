//! Calls of functions in scripts (spec: legacy-remote-api 5.4).

use super::call::{Call, Failure, Outcome, bytes, described, floats, integer};
use scene::Data;
use scene::object::script_object::ScriptType;
use wire::simx::{FieldReader, Violation};

/// The arguments as the function receives them.
fn arguments(data: &mut FieldReader<'_>) -> Result<[Data; 4], Violation> {
    let (ints, floats, strings, length) = (data.size()?, data.size()?, data.size()?, data.size()?);
    // Sizes are checked against the data before anything is allocated.
    let ints = (0..ints)
        .map(|_| Ok(Data::Int(data.int()?.into())))
        .collect::<Result<Vec<_>, _>>()?;
    let floats = (0..floats)
        .map(|_| Ok(Data::Float(data.float()?.into())))
        .collect::<Result<Vec<_>, _>>()?;
    let strings = (0..strings)
        .map(|_| Ok(Data::Text(data.text()?.to_vec())))
        .collect::<Result<Vec<_>, _>>()?;
    let buffer = data.take(length)?.to_vec();
    Ok([
        Data::Array(ints),
        Data::Array(floats),
        Data::Array(strings),
        Data::Text(buffer),
    ])
}

/// Calls a function of a script with four tables of values, and returns as many.
pub(super) fn call(call: &mut Call<'_>) -> Outcome {
    let script = i64::from(call.key.int()?);
    let (object, function) = (call.name()?, call.name()?);
    let arguments = arguments(&mut call.data)?;
    let handle = match ScriptType::from_number(script) {
        Some(_) => call.integer("sim.getScript", &[Data::Int(script), Data::text(&object)])?,
        None => script,
    };
    let results = call.host.call_function(handle, &function, &arguments);
    let results = results.map_err(|error| described("sim.callScriptFunction", &error))?;
    let [ints, floats_, strings, buffer, ..] = &results[..] else {
        return Err(unexpected(&function, &object));
    };
    let lists = [ints, floats_, strings].map(items);
    let ([Some(ints), Some(numbers), Some(strings)], Data::Text(buffer) | Data::Buffer(buffer)) =
        (lists, buffer)
    else {
        return Err(unexpected(&function, &object));
    };
    if !ints.iter().chain(numbers).all(is_number) || !strings.iter().all(is_text) {
        return Err(unexpected(&function, &object));
    }
    [ints.len(), numbers.len(), strings.len(), buffer.len()]
        .into_iter()
        .for_each(|size| call.out.size(size));
    ints.iter().for_each(|value| call.write_int(integer(value)));
    numbers
        .iter()
        .flat_map(floats)
        .for_each(|value| call.out.float(value));
    strings.iter().for_each(|text| call.out.text(bytes(text)));
    call.out.bytes(buffer);
    Ok(())
}

/// The elements of a table without other keys.
fn items(value: &Data) -> Option<&[Data]> {
    match value {
        Data::Array(items) => Some(items),
        _ => None,
    }
}

fn is_number(value: &Data) -> bool {
    matches!(value, Data::Int(_) | Data::Float(_))
}

fn is_text(value: &Data) -> bool {
    matches!(value, Data::Text(_) | Data::Buffer(_))
}

fn unexpected(function: &str, object: &str) -> Failure {
    Failure::Text(format!(
        "simCallScriptFunctionEx on {function}@{object}: the function must return a table of integers, a table of numbers, a table of \
         strings and a string."
    ))
}
