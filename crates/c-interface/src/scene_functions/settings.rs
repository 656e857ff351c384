//! Settings of the application and of the scene, the selection, what has no counterpart of its own in scripts.

use scene::{Data, numbers};

use super::pointers::integers_of;
use crate::dispatch::Call;
use crate::functions::{Answer, Function};

/// The parameter of the time step, among those of `sim.setFloatParam`.
const TIME_STEP: i64 = 1;
/// Properties of a script: its text.
const SCRIPT_TEXT: i64 = 10110;
/// The scene as the target of properties, and its passes for each picture.
const SCENE: i64 = -12;
const PASSES: &str = "stepsPerRendering";
/// What a configuration of a tree begins with: a mark, and how many bytes follow.
const CONFIGURATION: &[u8; 8] = b"swaconf1";

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("parameter.set_text", set_text),
    ("simulation.set_time_step", set_time_step),
    ("value.copy", |call| match call.arg(0) {
        Data::Nil => Err("NULL was passed for the values".into()),
        values => Ok(vec![values.clone()]),
    }),
    ("selection.get", |call| {
        call.write_at(0, &selection(call)?);
        Ok(Vec::new())
    }),
    ("selection.size", |call| {
        Ok(vec![Data::Int(numbers::count(selection(call)?.len()))])
    }),
    ("selection.last", |call| {
        let last = selection(call)?.pop().unwrap_or(-1);
        Ok(vec![Data::Int(last.into())])
    }),
    ("selection.scale", |call| {
        let args = [selected(call)?, call.arg(0).clone(), call.arg(1).clone()];
        call.frame.host().call("sim.scaleObjects", &args)
    }),
    ("selection.delete", |call| {
        call.frame
            .host()
            .call("sim.removeObjects", &[selected(call)?])
    }),
    ("selection.copy", copy_selection),
    ("simulation.passes", passes),
    ("simulation.set_passes", set_passes),
    ("file.exists", file_exists),
    ("script.text", |call| {
        let args = [Data::Int(call.integer_at(0)), Data::Int(SCRIPT_TEXT)];
        call.frame.host().call("sim.getScriptStringParam", &args)
    }),
    ("joint.max_force", max_force),
    ("tree.get", configuration),
    ("tree.set", set_configuration),
    ("drawing.add", add_drawing_item),
    ("particle.add", add_particle),
];

fn set_text(call: &Call<'_>) -> Answer {
    let args = [
        Data::Int(call.integer_at(0)),
        Data::Text(call.bytes(1)?.to_vec()),
    ];
    call.frame.host().call("sim.setStringParam", &args)
}

fn set_time_step(call: &Call<'_>) -> Answer {
    let args = [Data::Int(TIME_STEP), Data::Float(call.number_at(0))];
    call.frame.host().call("sim.setFloatParam", &args)
}

fn selection(call: &Call<'_>) -> Result<Vec<i32>, String> {
    let results = call.frame.host().call("sim.getObjectSel", &[])?;
    Ok(results.first().map(integers_of).unwrap_or_default())
}

/// The selected objects.
fn selected(call: &Call<'_>) -> Result<Data, String> {
    let objects = selection(call)?.into_iter().map(i64::from);
    Ok(objects.collect::<Vec<_>>().into())
}

/// The copies are selected instead.
fn copy_selection(call: &Call<'_>) -> Answer {
    let args = [selected(call)?, Data::Int(0)];
    let host = call.frame.host();
    let copies = host.call("sim.copyPasteObjects", &args)?;
    host.call("sim.setObjectSel", &copies[..copies.len().min(1)])?;
    Ok(Vec::new())
}

fn passes(call: &Call<'_>) -> Answer {
    let args = [Data::Int(SCENE), Data::text(PASSES)];
    call.frame.host().call("sim.getIntProperty", &args)
}

fn set_passes(call: &Call<'_>) -> Answer {
    let args = [Data::Int(SCENE), Data::text(PASSES), call.arg(0).clone()];
    call.frame.host().call("sim.setIntProperty", &args)
}

/// Whether there is such a file, which is no folder.
fn file_exists(call: &Call<'_>) -> Answer {
    let args = [Data::Text(call.bytes(0)?.to_vec()), Data::text("mode")];
    let kind = call.frame.host().call("lfs.attributes", &args)?;
    Ok(vec![Data::Bool(kind.first() == Some(&Data::text("file")))])
}

/// The force of a motor without the sign that it has since 4.3.
fn max_force(call: &Call<'_>) -> Answer {
    let args = [Data::Int(call.integer_at(0))];
    let results = call.frame.host().call("sim.getJointMaxForce", &args)?;
    let force = results.first().and_then(Data::as_f64).unwrap_or_default();
    Ok(vec![Data::Float(force.abs())])
}

/// The configuration of a tree with its length before it: in C nothing else says how long it is.
fn configuration(call: &Call<'_>) -> Answer {
    let args = [Data::Int(call.integer_at(0))];
    let results = call.frame.host().call("sim.getConfigurationTree", &args)?;
    let Some(Data::Text(bytes) | Data::Buffer(bytes)) = results.into_iter().next() else {
        return Err("there is no configuration".into());
    };
    let length = (bytes.len() as u64).to_ne_bytes();
    Ok(vec![Data::Buffer(
        [&CONFIGURATION[..], &length, &bytes].concat(),
    )])
}

fn set_configuration(call: &Call<'_>) -> Answer {
    let head = call.list_at::<u8>(0, 16)?;
    let length = match head.split_first_chunk() {
        Some((CONFIGURATION, length)) => length.try_into().map(u64::from_ne_bytes).ok(),
        _ => None,
    };
    let length = length.and_then(|length| usize::try_from(length).ok());
    let length = length.ok_or("this is no configuration of simGetConfigurationTree")?;
    let mut bytes = call.list_at::<u8>(0, length.saturating_add(16))?;
    let args = [Data::Buffer(bytes.split_off(16))];
    call.frame.host().call("sim.setConfigurationTree", &args)
}

fn add_drawing_item(call: &Call<'_>) -> Answer {
    let size = "swanilda.library.drawingItemSize";
    add_item(call, size, "sim.addDrawingObjectItem")
}

fn add_particle(call: &Call<'_>) -> Answer {
    let size = "swanilda.library.particleItemSize";
    add_item(call, size, "sim.addParticleObjectItem")
}

/// An item has as many numbers as the type of its object says. NULL removes all.
fn add_item(call: &Call<'_>, size: &str, function: &str) -> Answer {
    let object = Data::Int(call.integer_at(0));
    let mut args = vec![object.clone()];
    if !call
        .values
        .get(1)
        .is_none_or(|value| value.address.is_null())
    {
        let size = call.frame.host().call(size, &[object])?;
        let size = size.first().and_then(Data::as_f64).unwrap_or_default();
        args.push(call.numbers_at(1, numbers::index(size))?);
    }
    call.frame.host().call(function, &args)
}
