//! Images of vision sensors, lights, textures as bytes.

use scene::Data;

use super::pointers::{area, integers_of};
use crate::dispatch::Call;
use crate::functions::{Answer, Function};

/// Added to a sensor's handle: numbers come as bytes.
const PACKED: i64 = 0x0040_0000;
/// Added to a sensor's handle: one number a pixel.
const GREYSCALE: i64 = 0x0040_0000;

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("camera.image", image),
    ("camera.bytes", bytes),
    ("camera.depth", depth),
    ("camera.set_image", set_image),
    ("camera.set_bytes", set_bytes),
    ("camera.check_image", check_image),
    ("light.get", light),
    ("camera.set_img", set_part),
    ("image.save", save_image),
    ("image.scaled", scaled_image),
    ("image.transform", transform_image),
    ("texture.write", write_texture),
];

/// Red, green, blue of each pixel, 0 to 1, the lowest row first.
fn image(call: &Call<'_>) -> Answer {
    let levels: [[u8; 4]; 256] = std::array::from_fn(|level| (level as f32 / 255.0).to_ne_bytes());
    let pixels = pixels(call)?.into_iter();
    let pixels = pixels.map(|level| levels[usize::from(level)]);
    Ok(vec![Data::Buffer(
        pixels.collect::<Vec<_>>().into_flattened(),
    )])
}

/// Bytes, width and height.
fn bytes(call: &Call<'_>) -> Answer {
    let sensor = call.integer_at(0);
    let function = "sim.getVisionSensorCharImage";
    call.frame.host().call(function, &[Data::Int(sensor)])
}

fn pixels(call: &Call<'_>) -> Result<Vec<u8>, String> {
    match bytes(call)?.into_iter().next() {
        Some(Data::Text(pixels) | Data::Buffer(pixels)) => Ok(pixels),
        _ => Err("there is no image".into()),
    }
}

/// 0 at the near clipping plane to 1 at the far one, or metres where the handle says so; the lowest row first.
fn depth(call: &Call<'_>) -> Answer {
    let sensor = Data::Int(call.integer_at(0) | PACKED);
    let mut results = call
        .frame
        .host()
        .call("sim.getVisionSensorDepthBuffer", &[sensor])?;
    match results.pop() {
        Some(Data::Text(depths) | Data::Buffer(depths)) => Ok(vec![Data::Buffer(depths)]),
        _ => Err("there are no depths".into()),
    }
}

/// How many numbers an image of the sensor has.
fn size(call: &Call<'_>) -> Result<usize, String> {
    let sensor = call.integer_at(0);
    let channels = if sensor & GREYSCALE == 0 { 3 } else { 1 };
    size_of(call, sensor & !(PACKED | GREYSCALE), channels)
}

fn size_of(call: &Call<'_>, sensor: i64, channels: usize) -> Result<usize, String> {
    let args = [Data::Int(sensor)];
    let results = call
        .frame
        .host()
        .call("sim.getVisionSensorResolution", &args)?;
    match results.first().map(integers_of).as_deref() {
        Some(&[width, height]) => Ok(area([width, height]).saturating_mul(channels)),
        _ => Err("there is no such image".into()),
    }
}

fn set_image(call: &Call<'_>) -> Answer {
    let image = call.numbers_at(1, size(call)?)?;
    let args = [Data::Int(call.integer_at(0)), image];
    call.frame.host().call("sim.setVisionSensorImage", &args)
}

fn set_bytes(call: &Call<'_>) -> Answer {
    let image = Data::Text(call.list_at(1, size(call)?)?);
    let args = [Data::Int(call.integer_at(0)), image];
    call.frame
        .host()
        .call("sim.setVisionSensorCharImage", &args)
}

/// The image or the depths of the sensor, with one entity only.
fn check_image(call: &Call<'_>) -> Answer {
    let args = [
        Data::Int(call.integer_at(0)),
        Data::Int(call.integer_at(1)),
        Data::Bool(call.integer_at(2) != 0),
    ];
    call.frame.host().call("sim.checkVisionSensorEx", &args)
}

/// The state, and the colours without the one that is not used.
fn light(call: &Call<'_>) -> Answer {
    let args = [Data::Int(call.integer_at(0))];
    let mut results = call.frame.host().call("sim.getLightParameters", &args)?;
    if results.len() > 1 {
        results.remove(1);
    }
    Ok(results)
}

/// Parameters: sensor, pixels, options, corner, width and height of the part; no such part: the whole image. Option 1: one number a
/// pixel; option 2: depths as floats.
fn set_part(call: &Call<'_>) -> Answer {
    let (sensor, options) = (call.integer_at(0), call.integer_at(2));
    let of_part = |place: usize| match call.arg(place) {
        Data::Nil => Data::from([0, 0]),
        numbers => numbers.clone(),
    };
    let (corner, part) = (of_part(3), of_part(4));
    let pixels = match integers_of(&part)[..] {
        [width, height] if width > 0 && height > 0 => area([width, height]),
        _ => size_of(call, sensor, 1)?,
    };
    let bytes = match options & 3 {
        0 => 3,
        1 => 1,
        _ => 4,
    };
    let args = [
        Data::Int(sensor),
        Data::Text(call.list_at(1, pixels.saturating_mul(bytes))?),
        Data::Int(options),
        corner,
        part,
    ];
    call.frame.host().call("sim.setVisionSensorImg", &args)
}

/// The pixels of an image by the address of its width and height; option 1: they have an alpha channel.
fn pixels_at(call: &Call<'_>, place: usize, sides: usize, options: i64) -> Result<Data, String> {
    let sides = call.list_at::<i32>(sides, 2)?;
    let channels = if options & 1 == 0 { 3 } else { 4 };
    let count = area([sides[0], sides[1]]).saturating_mul(channels);
    Ok(Data::Buffer(call.list_at(place, count)?))
}

/// Parameters: pixels, width and height, those that are wanted and that the result has, options.
fn scaled_image(call: &Call<'_>) -> Answer {
    let args = [
        pixels_at(call, 0, 1, call.integer_at(3))?,
        call.integers_at(1, 2)?,
        call.integers_at(2, 2)?,
        Data::Int(call.integer_at(3)),
    ];
    call.frame.host().call("sim.getScaledImage", &args)
}

/// Parameters: pixels, which are changed, width and height, options.
fn transform_image(call: &Call<'_>) -> Answer {
    let args = [
        pixels_at(call, 0, 1, call.integer_at(2))?,
        call.integers_at(1, 2)?,
        Data::Int(call.integer_at(2)),
    ];
    let results = call.frame.host().call("sim.transformImage", &args)?;
    match results.first() {
        Some(Data::Text(pixels) | Data::Buffer(pixels)) => call.write_at(0, pixels),
        _ => return Err("there is no image".into()),
    }
    Ok(Vec::new())
}

/// Parameters: pixels, width and height, options, file, quality. Option 1: pixels have an alpha channel.
fn save_image(call: &Call<'_>) -> Answer {
    let args = [
        pixels_at(call, 0, 1, call.integer_at(2))?,
        call.integers_at(1, 2)?,
        Data::Int(call.integer_at(2)),
        Data::Text(call.bytes(3)?.to_vec()),
        Data::Int(call.integer_at(4)),
    ];
    call.frame.host().call("sim.saveImage", &args)
}

/// Parameters: texture, options, pixels, corner, size, interpolation. Without a size the pixels are those of the whole texture.
fn write_texture(call: &Call<'_>) -> Answer {
    let place = |place| call.integer_at(place);
    let (width, height) = (call.count_at(5)?, call.count_at(6)?);
    if width == 0 || height == 0 {
        return Err("the size of the part is needed".into());
    }
    let count = width.saturating_mul(height).saturating_mul(3);
    let args = [
        Data::Int(place(0)),
        Data::Int(place(1)),
        Data::Text(call.list_at(2, count)?),
        Data::Int(place(3)),
        Data::Int(place(4)),
        Data::Int(place(5)),
        Data::Int(place(6)),
        Data::Float(call.number_at(7)),
    ];
    call.frame.host().call("sim.writeTexture", &args)
}
