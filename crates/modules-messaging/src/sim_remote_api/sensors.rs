//! Sensors and their pictures.

use super::call::{Call, Failure, Outcome, bytes, floats, integer};
use scene::Data;
use scene::numbers;

/// Option of the functions for images: a byte per pixel.
const GREY: i64 = 1;

pub(super) fn colour_image(call: &mut Call<'_>) -> Outcome {
    image(call, false)
}

/// The mean of red, green and blue.
pub(super) fn grey_image(call: &mut Call<'_>) -> Outcome {
    image(call, true)
}

fn image(call: &mut Call<'_>, is_grey: bool) -> Outcome {
    let sensor = call.handle()?;
    let results = call.api("sim.getVisionSensorImg", &[sensor])?;
    let [image, resolution, ..] = &results[..] else {
        return Err(Failure::Silent);
    };
    write_resolution(call, resolution);
    let pixels = bytes(image);
    if is_grey {
        let mean = |pixel: &[u8]| {
            (pixel.iter().map(|&value| u32::from(value)).sum::<u32>() / 3).to_le_bytes()[0]
        };
        call.out
            .bytes(&pixels.chunks_exact(3).map(mean).collect::<Vec<u8>>());
    } else {
        call.out.bytes(pixels);
    }
    Ok(())
}

fn write_resolution(call: &mut Call<'_>, resolution: &Data) {
    if let Data::Array(sides) = resolution {
        sides
            .iter()
            .take(2)
            .for_each(|side| call.write_int(integer(side)));
    }
}

pub(super) fn set_colour_image(call: &mut Call<'_>) -> Outcome {
    set_image(call, 0)
}

pub(super) fn set_grey_image(call: &mut Call<'_>) -> Outcome {
    set_image(call, GREY)
}

fn set_image(call: &mut Call<'_>, options: i64) -> Outcome {
    let sensor = call.handle()?;
    let image = Data::Buffer(call.data.rest().to_vec());
    call.api(
        "sim.setVisionSensorImg",
        &[sensor, image, Data::Int(options)],
    )
    .map(drop)
}

/// Depths from 0 (near) to 1 (far).
pub(super) fn depth(call: &mut Call<'_>) -> Outcome {
    let sensor = call.handle()?;
    let results = call.api("sim.getVisionSensorDepth", &[sensor])?;
    let [depths, resolution, ..] = &results[..] else {
        return Err(Failure::Silent);
    };
    write_resolution(call, resolution);
    for depth in bytes(depths).chunks_exact(4) {
        // The chunks are as long as asked for.
        call.out
            .float(f32::from_le_bytes(depth.try_into().unwrap_or_default()));
    }
    Ok(())
}

pub(super) fn proximity(call: &mut Call<'_>) -> Outcome {
    let sensor = call.handle()?;
    let results = call.api("sim.readProximitySensor", &[sensor])?;
    let [
        Data::Int(state @ 0..=1),
        _distance,
        point,
        object,
        normal,
        ..,
    ] = &results[..]
    else {
        return Err(Failure::Silent);
    };
    call.out.byte(state.to_le_bytes()[0]);
    call.write_floats(point);
    call.write_int(integer(object));
    call.write_floats(normal);
    Ok(())
}

pub(super) fn force(call: &mut Call<'_>) -> Outcome {
    let sensor = call.handle()?;
    let results = call.api("sim.readForceSensor", &[sensor])?;
    let [state, force, torque, ..] = &results[..] else {
        return Err(Failure::Silent);
    };
    call.out.byte(integer(state).to_le_bytes()[0]);
    call.write_floats(force);
    call.write_floats(torque);
    Ok(())
}

/// What the scripts of a vision sensor found: packets of numbers.
pub(super) fn vision(call: &mut Call<'_>) -> Outcome {
    let sensor = call.handle()?;
    let results = call.api("sim.readVisionSensor", &[sensor])?;
    let Some((Data::Int(state @ 0..=1), packets)) = results.split_first() else {
        return Err(Failure::Silent);
    };
    call.out.byte(state.to_le_bytes()[0]);
    let mut packets: Vec<Vec<f32>> = packets.iter().map(floats).collect();
    // Scripts get empty packets besides those there are.
    while packets.last().is_some_and(Vec::is_empty) {
        packets.pop();
    }
    call.write_list(
        &packets
            .iter()
            .map(|packet| numbers::count(packet.len()))
            .collect::<Vec<_>>(),
    );
    packets
        .into_iter()
        .flatten()
        .for_each(|value| call.out.float(value));
    Ok(())
}
