//! Objects, joints, the log and windows.

use super::call::{Call, Failure, Outcome, floats, integer};
use scene::Data;
use script::log::verbosity;

/// `sim.joint_spherical`.
const SPHERICAL: i64 = 12;

/// `sim.colorcomponent_*` of the four colours of a dummy; None for the one that is not used.
const COLOURS: [Option<i64>; 4] = [Some(0), None, Some(2), Some(3)];

/// A position of a window that stands for none, and a colour.
const DEFAULT_PLACE: i64 = 98_765;
const DEFAULT_COLOUR: f64 = -5.0;

pub(super) fn create_dummy(call: &mut Call<'_>) -> Outcome {
    let size = Data::Float(call.data.float()?.into());
    let has_colours = call.data.byte()? != 0;
    let colours = call.data.take(12)?.to_vec();
    let dummy = call.value("sim.createDummy", &[size])?;
    if has_colours {
        for (component, colour) in COLOURS.iter().zip(colours.chunks(3)) {
            let Some(component) = *component else {
                continue;
            };
            let colour: Vec<f64> = colour
                .iter()
                .map(|&value| f64::from(value) / 255.0)
                .collect();
            call.api(
                "sim.setObjectColor",
                &[
                    dummy.clone(),
                    Data::Int(0),
                    Data::Int(component),
                    colour.into(),
                ],
            )?;
        }
    }
    call.write_int(integer(&dummy));
    Ok(())
}

/// The force of a joint by one of two functions. Spherical joints have none.
pub(super) fn joint_force(call: &mut Call<'_>, function: &str) -> Outcome {
    let joint = call.handle()?;
    if call.integer("sim.getJointType", std::slice::from_ref(&joint))? == SPHERICAL {
        return Err(Failure::Text("a spherical joint has no force.".into()));
    }
    let force = call.value(function, &[joint])?;
    call.write_floats(&force);
    Ok(())
}

/// The parent of an object; -1 for none, also where there is no object.
pub(super) fn parent(call: &mut Call<'_>) -> Outcome {
    let object = call.handle()?;
    let parent = call.integer("sim.getObjectParent", &[object]).unwrap_or(-1);
    call.write_int(parent);
    Ok(())
}

/// A child of an object; -1 for none, also where there is no object.
pub(super) fn child(call: &mut Call<'_>) -> Outcome {
    let args = [call.handle()?, call.handle()?];
    let child = call.integer("sim.getObjectChild", &args).unwrap_or(-1);
    call.write_int(child);
    Ok(())
}

/// The objects of a type, in the order of their creation.
pub(super) fn all_of_type(call: &mut Call<'_>) -> Outcome {
    let object_type = call.key.int()?.into();
    let objects: Vec<i64> = {
        let scene = call.host.scene();
        let of_type = scene
            .objects()
            .filter(|object| object.is_of_type(object_type));
        of_type.map(|object| object.handle().raw()).collect()
    };
    call.write_list(&objects);
    Ok(())
}

pub(super) fn distance(call: &mut Call<'_>) -> Outcome {
    let args = [call.handle()?, call.handle()?, Data::Float(0.0)];
    let results = call.api("sim.checkDistance", &args)?;
    let [Data::Int(1), data, ..] = &results[..] else {
        return Err(Failure::Silent);
    };
    // The points on both entities are before the distance.
    call.out.float(*floats(data).get(6).ok_or(Failure::Silent)?);
    Ok(())
}

/// The collection of a name. Where there is none, scripts may have set an integer signal of that name.
pub(super) fn collection(call: &mut Call<'_>) -> Outcome {
    let name = Data::text(&call.name()?);
    let named = call
        .integer("sim.getCollectionHandle", std::slice::from_ref(&name))
        .ok()
        .filter(|&handle| handle >= 0);
    let handle = match named {
        Some(handle) => handle,
        None => call.integer("sim.getInt32Signal", &[name])?,
    };
    call.write_int(handle);
    Ok(())
}

pub(super) fn log(call: &mut Call<'_>) -> Outcome {
    let text = call.name()?;
    call.host.log(verbosity::SCRIPT_INFOS, &text);
    Ok(())
}

/// Opens an auxiliary console.
pub(super) fn open_console(call: &mut Call<'_>) -> Outcome {
    let title = Data::text(&call.name()?);
    let mut next = || Ok::<_, Failure>(i64::from(call.data.int()?));
    let [lines, mode] = [next()?, next()?].map(Data::Int);
    let [place, size] = [[next()?, next()?], [next()?, next()?]];
    let pair = |pair: [i64; 2]| {
        if pair[0] == DEFAULT_PLACE {
            Data::Nil
        } else {
            pair.into()
        }
    };
    let (text, back) = (colour(call)?, colour(call)?);
    let handle = call.integer(
        "sim.auxiliaryConsoleOpen",
        &[title, lines, mode, pair(place), pair(size), text, back],
    )?;
    call.write_int(handle);
    Ok(())
}

/// Three numbers; nil where they stand for the default colour.
fn colour(call: &mut Call<'_>) -> Result<Data, Failure> {
    let colour = call.numbers(3)?;
    let is_default = matches!(&colour, Data::Array(parts) if parts[0].as_f64().is_some_and(|red| red < DEFAULT_COLOUR));
    Ok(if is_default { Data::Nil } else { colour })
}

/// A dialog; without a display there is none, which is a failure.
pub(super) fn display_dialog(call: &mut Call<'_>) -> Outcome {
    let title = Data::text(&call.name()?);
    let text = Data::Text(call.data.text()?.to_vec());
    let style = Data::Int(call.data.int()?.into());
    let handle = call.integer(
        "sim.displayDialog",
        &[title, text, style, Data::Bool(false)],
    )?;
    if handle < 0 {
        return Err(Failure::Text(
            "[simDisplayDialog] there are no dialogs without a display.".into(),
        ));
    }
    call.write_int(handle);
    // The window of the dialog, which nothing else needs.
    call.write_int(-1);
    Ok(())
}
