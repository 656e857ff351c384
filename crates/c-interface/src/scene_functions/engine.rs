//! Parameters of physics engines: whether the call succeeded is a parameter.

use scene::Data;

use crate::dispatch::Call;
use crate::functions::{Answer, Function};

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("engine.get_float", |call| {
        get(call, "sim.getEngineFloatParam", Data::Float(-1.0))
    }),
    ("engine.get_int", |call| {
        get(call, "sim.getEngineInt32Param", Data::Int(-1))
    }),
    ("engine.get_bool", |call| {
        get(call, "sim.getEngineBoolParam", Data::Bool(false))
    }),
    ("engine.set_float", |call| {
        set(
            call,
            "sim.setEngineFloatParam",
            Data::Float(call.number_at(3)),
        )
    }),
    ("engine.set_int", |call| {
        set(
            call,
            "sim.setEngineInt32Param",
            Data::Int(call.integer_at(3)),
        )
    }),
    ("engine.set_bool", |call| {
        set(
            call,
            "sim.setEngineBoolParam",
            Data::Bool(call.integer_at(3) != 0),
        )
    }),
];

/// Parameter and object; the address of an object of the engine is not known.
fn target(call: &Call<'_>) -> Result<[Data; 2], String> {
    if call
        .values
        .get(2)
        .is_some_and(|value| !value.address.is_null())
    {
        return Err("an object must be named by its handle".into());
    }
    Ok([0, 1].map(|place| Data::Int(call.integer_at(place))))
}

/// The value, and whether there is one.
fn get(call: &Call<'_>, function: &str, none: Data) -> Answer {
    let results = target(call).and_then(|target| call.frame.host().call(function, &target));
    Ok(match results {
        Ok(results) => vec![results.into_iter().next().unwrap_or(none), Data::Bool(true)],
        Err(reason) => {
            let text = format!("{}: {reason}", call.symbol);
            call.frame.set_last_error(text);
            vec![none, Data::Bool(false)]
        }
    })
}

fn set(call: &Call<'_>, function: &str, value: Data) -> Answer {
    let [parameter, object] = target(call)?;
    call.frame
        .host()
        .call(function, &[parameter, object, value])
}
