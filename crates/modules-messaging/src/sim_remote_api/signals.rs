//! Signals, and streams of strings.

use super::call::{Call, Failure, Outcome, bytes};
use scene::Data;

/// Removes a signal; all of its type without a name.
pub(super) fn clear(call: &mut Call<'_>, function: &str) -> Outcome {
    let name = call.key.text()?;
    let all = name.is_empty();
    call.api(
        function,
        &[if all {
            Data::Nil
        } else {
            Data::Text(name.to_vec())
        }],
    )
    .map(drop)
}

/// The value of the string signal that the key names, and its name.
fn signal(call: &mut Call<'_>) -> Result<(Data, Option<Vec<u8>>), Failure> {
    let name = Data::Text(call.key.text()?.to_vec());
    let value = call.api("sim.getStringSignal", std::slice::from_ref(&name))?;
    let value = value
        .first()
        .filter(|value| **value != Data::Nil)
        .map(|value| bytes(value).to_vec());
    Ok((name, value))
}

pub(super) fn read(call: &mut Call<'_>) -> Outcome {
    let (_, value) = signal(call)?;
    call.out.bytes(&value.ok_or(Failure::Silent)?);
    Ok(())
}

pub(super) fn set(call: &mut Call<'_>) -> Outcome {
    let name = Data::Text(call.key.text()?.to_vec());
    let value = Data::Buffer(call.data.rest().to_vec());
    call.api("sim.setStringSignal", &[name, value]).map(drop)
}

pub(super) fn append(call: &mut Call<'_>) -> Outcome {
    let (name, value) = signal(call)?;
    let value = [&value.unwrap_or_default(), call.data.rest()].concat();
    call.api("sim.setStringSignal", &[name, Data::Buffer(value)])
        .map(drop)
}

/// Reads a signal and removes it. A stream ends when there was one.
pub(super) fn take(call: &mut Call<'_>) -> Outcome {
    let (name, value) = signal(call)?;
    call.out.bytes(&value.ok_or(Failure::Silent)?);
    call.ends_stream = true;
    call.api("sim.clearStringSignal", &[name]).map(drop)
}

/// The same for what is written piece by piece: nothing new is no failure.
pub(super) fn read_stream(call: &mut Call<'_>) -> Outcome {
    let (name, value) = signal(call)?;
    let Some(value) = value else { return Ok(()) };
    call.out.bytes(&value);
    call.api("sim.clearStringSignal", &[name]).map(drop)
}
