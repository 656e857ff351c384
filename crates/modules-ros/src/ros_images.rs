//! Images of ROS, both generations: `sensor_msgs/Image`, and what callbacks get of the messages of a topic.
//!
//! Pictures of vision sensors have their lowest row first, those of ROS their highest one: rows change places both ways.

use ros_interfaces::{Array, Number, Numbers, Record, Value};

use super::ros_values::{self, Style};
use super::{ApiError, Result, ros_compressed};
use scene::numbers;
use scene::{Data, Key};

/// The most pixels of a row or column.
const MAX_SIDE: i64 = 1 << 16;

/// Where `image_transport` has the compressed images of a topic: behind its name.
pub(super) const COMPRESSED: &str = "/compressed";

/// What a callback gets of the messages of a topic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Content {
    /// A table.
    Message,
    /// Data, width and height of an image.
    Image,
    /// The same of a compressed one.
    CompressedImage,
}

impl Content {
    /// Of a topic of images, by its name.
    pub(super) fn of_images(topic: &str) -> Self {
        if topic.ends_with(COMPRESSED) {
            Self::CompressedImage
        } else {
            Self::Image
        }
    }

    pub(super) fn is_image(self) -> bool {
        self != Self::Message
    }

    /// What a callback gets of a message.
    pub(super) fn arguments(
        self,
        record: &Record,
        style: Style,
    ) -> std::result::Result<Vec<Data>, String> {
        match self {
            Self::Message => Ok(vec![ros_values::to_data(record, style)]),
            Self::Image => arguments(record),
            Self::CompressedImage => ros_compressed::arguments(record),
        }
    }
}

/// An image with three bytes per pixel, the highest row first.
pub(super) struct Frame {
    pub(super) rows: Vec<u8>,
    pub(super) width: i64,
    pub(super) height: i64,
}

impl Frame {
    /// Of data with the lowest row first.
    ///
    /// # Errors
    /// When the data do not fit the size.
    pub(super) fn new(data: &[u8], width: i64, height: i64) -> Result<Self> {
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
        let rows = data.chunks_exact(row).rev().flatten().copied().collect();
        Ok(Self {
            rows,
            width,
            height,
        })
    }

    /// A message of the image.
    pub(super) fn message(self, stamp: Data, frame_id: &str) -> Data {
        Data::map([
            ("header", header(stamp, frame_id)),
            ("height", Data::Int(self.height)),
            ("width", Data::Int(self.width)),
            ("encoding", Data::text("rgb8")),
            ("step", Data::Int(3 * self.width)),
            ("data", Data::Buffer(self.rows)),
        ])
    }
}

/// The head of a message. An empty string means that no frame was given.
pub(super) fn header(stamp: Data, frame_id: &str) -> Data {
    let frame = (!frame_id.is_empty()).then(|| ("frame_id", Data::text(frame_id)));
    let fields = [("stamp", stamp)].into_iter().chain(frame);
    let key = |name: &str| Key::Text(name.as_bytes().to_vec());
    Data::Map(fields.map(|(name, value)| (key(name), value)).collect())
}

/// What a callback gets of a message: RGB data with the lowest row first, width, height.
fn arguments(record: &Record) -> std::result::Result<Vec<Data>, String> {
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
