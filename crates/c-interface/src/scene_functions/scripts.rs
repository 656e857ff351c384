//! Scripts: calls of their functions, with a stack or with the four tables of V-REP, their attributes and variables.

use scene::{Data, numbers};

use super::objects::{bytes, items};
use crate::current::ERRORS;
use crate::dispatch::{Call, integer};
use crate::functions::{Answer, Function};

/// Added to a script's handle: a call that fails is not logged.
const SILENT: i64 = 0x0200_0000;
/// The numbers of `sim.getScriptInt32Param`: the type of a script.
const SCRIPT_TYPE: i64 = 10102;

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("script.call", call_with_stack),
    ("script.call_tables", call_with_tables),
    ("script.execute", execute),
    ("script.property", property),
    ("script.by_place", by_place),
    ("script.attribute", attribute),
    ("script.set_variable", set_variable),
    ("script.clear_variable", |call| {
        let name = call.bytes(2)?.to_vec();
        assign(call, name, call.int(1)?, Data::Nil)
    }),
    ("script.hook", register_hook),
    ("stack.unpack_onto", unpack),
    ("api.functions", functions),
];

/// The script and the function, or the text to run, that are meant by the handle or the type of a script and `function@name`.
fn callee(call: &Call<'_>, script: i64, name: &[u8]) -> Result<(i64, Vec<u8>), String> {
    if script < 0 {
        return Ok((script, name.to_vec()));
    }
    let args = [Data::Text(name.to_vec()), Data::Int(script)];
    let mut found = call.frame.host().call("swanilda.library.callee", &args)?;
    let function = found.pop().map(bytes).unwrap_or_default();
    let script = found.first().map_or(script, integer);
    Ok((script, function))
}

fn call_with_stack(call: &Call<'_>) -> Answer {
    let (script, name, stack) = (call.int(0)?, call.text(1)?, call.int(2)?);
    let args = std::mem::take(call.stacks().get(stack)?);
    let (script, is_silent) = if script >= 0 {
        (script & !SILENT, script & SILENT != 0)
    } else {
        (script, false)
    };
    let called = if call.is_double {
        Ok((script, name.clone().into_bytes()))
    } else {
        callee(call, script, name.as_bytes())
    };
    let results = called.and_then(|(script, function)| {
        let function = String::from_utf8_lossy(&function);
        call.frame.host().call_script(script, &function, &args)
    });
    let results = results.map_err(|reason| {
        let text = format!("External call to simCallScriptFunction failed ('{name}'): {reason}");
        if !is_silent {
            call.frame.host().log(call.frame.origin(), ERRORS, &text);
        }
        text
    })?;
    // The function may have released the stack.
    *call.stacks().get(stack)? = results;
    Ok(vec![Data::Int(0)])
}

/// Parameters: script or its type, a text and perhaps `@name` behind it, stack for the values.
fn execute(call: &Call<'_>) -> Answer {
    let (script, text) = if call.is_double {
        (call.int(0)?, call.bytes(1)?.to_vec())
    } else {
        callee(call, call.int(0)?, call.bytes(1)?)?
    };
    let results = call.frame.host().execute(script, &text)?;
    if call.int(2)? > 0 {
        call.stacks().get(call.int(2)?)?.extend(results);
    }
    Ok(vec![Data::Int(0)])
}

/// Its type, and the object that it is attached to.
fn property(call: &Call<'_>) -> Answer {
    let script = Data::Int(call.int(0)?);
    let host = call.frame.host();
    let args = [script.clone(), Data::Int(SCRIPT_TYPE)];
    let mut results = host.call("sim.getScriptInt32Param", &args)?;
    results.truncate(1);
    results.extend(host.call("sim.getObjectAssociatedWithScript", &[script])?);
    Ok(results)
}

/// The handle of a script by its place among all of them, from 0; -1 behind the last one.
fn by_place(call: &Call<'_>) -> Answer {
    let scripts = call.frame.host().call("swanilda.library.scripts", &[])?;
    let scripts: Vec<Data> = scripts.into_iter().take(1).flat_map(items).collect();
    let place = usize::try_from(call.int(0)?).ok();
    let script = place.and_then(|place| scripts.get(place).cloned());
    Ok(vec![script.unwrap_or(Data::Int(-1))])
}

/// The attribute as a number or as an integer, whichever it is.
fn attribute(call: &Call<'_>) -> Answer {
    let results = call
        .frame
        .host()
        .call("sim.getScriptAttribute", &call.args)?;
    Ok(match results.into_iter().next() {
        Some(number @ Data::Float(_)) => vec![number],
        Some(value @ (Data::Int(_) | Data::Bool(_))) => vec![Data::Nil, value],
        _ => return Err("it is no number: use simGetScriptText or simGetScriptName".into()),
    })
}

/// The variable becomes what is on top of the stack; nil without a stack.
fn set_variable(call: &Call<'_>) -> Answer {
    let (script, name, stack) = (call.int(0)?, call.bytes(1)?.to_vec(), call.int(2)?);
    let value = if stack > 0 {
        call.stacks().top(stack)?.clone()
    } else {
        Data::Nil
    };
    assign(call, name, script, value)
}

fn assign(call: &Call<'_>, name: Vec<u8>, script: i64, value: Data) -> Answer {
    let args = [Data::Text(name), Data::Int(script), value];
    call.frame.host().call("sim.setScriptVariable", &args)
}

/// Parameters: script, callback, function of the script, whether it runs before, reserved.
fn register_hook(call: &Call<'_>) -> Answer {
    let args = [
        Data::Text(call.bytes(1)?.to_vec()),
        Data::Text(call.bytes(2)?.to_vec()),
        Data::Bool(call.int(3)? != 0),
    ];
    let host = call.frame.host();
    host.call_script(call.int(0)?, "sim.registerScriptFuncHook", &args)
}

/// Names with a space between them; NULL where there are none.
fn functions(call: &Call<'_>) -> Answer {
    let names = call.frame.host().call("sim.getApiFunc", &call.args)?;
    let names: Vec<Vec<u8>> = names.into_iter().flat_map(items).map(bytes).collect();
    Ok(vec![if names.is_empty() {
        Data::Nil
    } else {
        Data::Text(names.join(&b' '))
    }])
}

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
        call.integers_at(2, counts[0])?,
        call.numbers_at(4, counts[1])?,
        Data::Array(texts.into_iter().map(Data::Text).collect()),
        Data::Text(call.list_at(8, counts[3])?),
    ];
    let (script, function) = callee(call, call.integer_at(0), call.bytes(1)?)?;
    let function = String::from_utf8_lossy(&function);
    let results = call.frame.host().call_script(script, &function, &args);
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
    let is_text = |item: &Data| matches!(item, Data::Text(_) | Data::Buffer(_));
    let texts = list.map_or_else(Vec::new, items).into_iter();
    let texts: Vec<Vec<u8>> = texts.filter(is_text).map(bytes).collect();
    let address = call.frame.keep_texts(&texts);
    call.write_at(place, &[address]);
    call.write_at(place + 1, &[numbers::low_i32(numbers::count(texts.len()))]);
}

/// Puts the items of a packed table onto a stack.
fn unpack(call: &Call<'_>) -> Answer {
    let bytes = Data::Buffer(call.bytes(1)?.to_vec());
    let table = call.frame.host().call("sim.unpackTable", &[bytes])?;
    call.stacks().get(call.int(0)?)?.extend(table);
    Ok(Vec::new())
}
