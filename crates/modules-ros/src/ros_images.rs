//! Images of ROS, both generations: `sensor_msgs/Image` without compression.
//!
//! Pictures of vision sensors have their lowest row first, those of ROS their highest one: rows change places both ways.

use ros_interfaces::{Array, Number, Numbers, Record, Value};

use super::{ApiError, Result};
use scene::numbers;
use scene::{Data, Key};

/// The most pixels of a row or column.
const MAX_SIDE: i64 = 1 << 16;

/// A message of an image with three bytes per pixel, the lowest row first.
///
/// # Errors
/// When the data do not fit the size.
pub(super) fn message(
    data: &[u8],
    width: i64,
    height: i64,
    stamp: Data,
    frame_id: &str,
) -> Result<Data> {
    if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
        return Err(ApiError::Other(format!(
            "invalid size of an image: {width} x {height}"
        )));
    }
    let row = width as usize * 3;
    let needed = row * height as usize;
    if data.len() != needed {
        return Err(ApiError::Other(format!(
            "the image has {} bytes, expected {needed}",
            data.len()
        )));
    }
    let flipped: Vec<u8> = data.chunks_exact(row).rev().flatten().copied().collect();
    // Empty strings mean that none was given.
    let frame = (!frame_id.is_empty()).then(|| ("frame_id", Data::text(frame_id)));
    let header = [("stamp", stamp)].into_iter().chain(frame);
    let key = |name: &str| Key::Text(name.as_bytes().to_vec());
    Ok(Data::map([
        (
            "header",
            Data::Map(header.map(|(name, value)| (key(name), value)).collect()),
        ),
        ("height", Data::Int(height)),
        ("width", Data::Int(width)),
        ("encoding", Data::text("rgb8")),
        ("step", Data::Int(numbers::count(row))),
        ("data", Data::Buffer(flipped)),
    ]))
}

/// What a callback gets of a message: RGB data with the lowest row first, width, height.
pub(super) fn arguments(record: &Record) -> std::result::Result<Vec<Data>, String> {
    let (Some(width), Some(height), Some(step)) = (
        size(record, "width"),
        size(record, "height"),
        size(record, "step"),
    ) else {
        return Err("no image".into());
    };
    let (Some(Value::String(encoding)), Some(Value::Array(Array::Numbers(Numbers::UInt8(data))))) =
        (record.get("encoding"), record.get("data"))
    else {
        return Err("no image".into());
    };
    let channels: &[usize] = match encoding.as_slice() {
        b"rgb8" | b"8UC3" => &[3, 0, 1, 2],
        b"bgr8" => &[3, 2, 1, 0],
        b"rgba8" => &[4, 0, 1, 2],
        b"bgra8" => &[4, 2, 1, 0],
        b"mono8" | b"8UC1" => &[1, 0, 0, 0],
        other => {
            return Err(format!(
                "its encoding '{}' is not supported",
                String::from_utf8_lossy(other)
            ));
        }
    };
    let row = width * channels[0];
    if step < row
        || step
            .checked_mul(height)
            .is_none_or(|size| size > data.len())
        || width == 0
        || height == 0
    {
        return Err("its data do not fit its size".into());
    }
    let mut rgb = Vec::with_capacity(width * height * 3);
    for line in data.chunks_exact(step).take(height).rev() {
        for pixel in line[..row].chunks_exact(channels[0]) {
            rgb.extend(channels[1..].iter().map(|channel| pixel[*channel]));
        }
    }
    Ok(vec![
        Data::Buffer(rgb),
        Data::Int(numbers::count(width)),
        Data::Int(numbers::count(height)),
    ])
}

fn size(record: &Record, name: &str) -> Option<usize> {
    match record.get(name) {
        Some(Value::Number(Number::UInt32(value))) => Some(*value as usize),
        _ => None,
    }
}
