//! Compressed images of ROS, both generations: `sensor_msgs/CompressedImage`, as `compressed_image_transport` writes and reads them.

use format::picture::{Layout, Picture};
use ros_interfaces::{Array, Numbers, Record, Value};

use super::ros_images::{Frame, header};
use super::{ApiError, Result};
use scene::Data;

/// What the pixels of an image from outside take at most: as much as a message without compression.
const MAX_BYTES: u64 = 64 << 20;
/// Encodings with colours, of which a file may have the first and the third exchanged.
const COLOURS: [&str; 8] = [
    "rgb8", "bgr8", "rgba8", "bgra8", "rgb16", "bgr16", "rgba16", "bgra16",
];

/// How images are compressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Compression {
    /// With a quality of 1 to 100.
    Jpeg(u8),
    /// Without loss.
    Png,
}

impl Compression {
    /// By the names that `compressed_image_transport` has for them.
    ///
    /// # Errors
    /// When it is another one.
    pub(super) fn new(format: &str, quality: i64) -> Result<Self> {
        match format {
            "jpeg" => Ok(Self::Jpeg(u8::try_from(quality.clamp(1, 100)).unwrap_or(1))),
            "png" => Ok(Self::Png),
            other => Err(ApiError::Other(format!(
                "images are compressed as 'jpeg' or 'png', not as '{other}'"
            ))),
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Jpeg(_) => "jpeg",
            Self::Png => "png",
        }
    }
}

impl Frame {
    /// A message of the image, compressed.
    ///
    /// # Errors
    /// When the image is larger than files of images are.
    pub(super) fn compressed(
        &self,
        compression: Compression,
        stamp: Data,
        frame_id: &str,
    ) -> Result<Data> {
        let (extension, quality) = match compression {
            Compression::Jpeg(quality) => ("jpg", quality),
            Compression::Png => ("png", 100),
        };
        let size = [self.width, self.height];
        let file = Picture::new(self.rows.clone(), size, Layout::Rgb)
            .and_then(|picture| picture.encode(extension, quality))
            .map_err(|error| ApiError::Other(error.to_string()))?;
        // The encoding before compression, then that of the compressed data: files have their colours as OpenCV reads them.
        let format = format!("rgb8; {} compressed bgr8", compression.word());
        Ok(Data::map([
            ("header", header(stamp, frame_id)),
            ("format", Data::text(&format)),
            ("data", Data::Buffer(file)),
        ]))
    }
}

/// What a callback gets of a message: RGB data with the lowest row first, width, height.
pub(super) fn arguments(record: &Record) -> std::result::Result<Vec<Data>, String> {
    let (Some(Value::String(format)), Some(Value::Array(Array::Numbers(Numbers::UInt8(file))))) =
        (record.get("format"), record.get("data"))
    else {
        return Err("no compressed image".into());
    };
    let picture = Picture::decode_within(file, Layout::Rgb, MAX_BYTES);
    let picture = picture
        .map_err(|error| error.to_string())?
        .flipped(false, true);
    let [width, height] = picture.resolution();
    let mut rgb = picture.into_bytes();
    if is_exchanged(&String::from_utf8_lossy(format)) {
        rgb.chunks_exact_mut(3).for_each(|pixel| pixel.swap(0, 2));
    }
    Ok(vec![Data::Buffer(rgb), Data::Int(width), Data::Int(height)])
}

/// Whether a file has red and blue exchanged: where it is said what was compressed, colours are right only with "compressed bgr".
fn is_exchanged(format: &str) -> bool {
    let said = format.split_once(';');
    said.is_some_and(|(encoding, compressed)| {
        COLOURS.contains(&encoding.trim()) && !compressed.contains("compressed bgr")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame() -> Frame {
        // The lower row is dark, the upper one red.
        let data = [[0; 6], [250, 10, 20, 250, 10, 20]].concat();
        Frame::new(&data, 2, 2).expect("twelve bytes are two by two pixels")
    }

    fn file(compression: Compression) -> (String, Vec<u8>) {
        let message = frame().compressed(compression, Data::Nil, "camera");
        let message = message.expect("a small image");
        match (message.field("format"), message.field("data")) {
            (Some(Data::Text(format)), Some(Data::Buffer(file))) => (
                String::from_utf8(format.clone()).expect("text"),
                file.clone(),
            ),
            other => panic!("{other:?}"),
        }
    }

    fn read(format: &str, file: Vec<u8>) -> std::result::Result<Vec<Data>, String> {
        let mut catalogue = ros_interfaces::Catalogue::new(ros_interfaces::Generation::Ros1);
        let layout = catalogue.layout("sensor_msgs/CompressedImage");
        let message = Data::map([("format", Data::text(format)), ("data", Data::Buffer(file))]);
        let style = crate::ros_values::Style {
            bytes_as_strings: true,
        };
        let record = crate::ros_values::from_data(&layout.expect("built in"), &message, style);
        arguments(&record.expect("its fields"))
    }

    #[test]
    fn images_without_loss_come_back() {
        let (format, file) = file(Compression::Png);
        assert_eq!(format, "rgb8; png compressed bgr8");
        let data = [[0; 6], [250, 10, 20, 250, 10, 20]].concat();
        let expected = vec![Data::Buffer(data), Data::Int(2), Data::Int(2)];
        assert_eq!(read(&format, file), Ok(expected));
    }

    #[test]
    fn jpeg_comes_back_nearly() {
        let (format, file) = file(Compression::Jpeg(100));
        assert_eq!(format, "rgb8; jpeg compressed bgr8");
        match &read(&format, file).expect("just written")[..] {
            [Data::Buffer(rgb), Data::Int(2), Data::Int(2)] => {
                let expected = [[0; 6], [250, 10, 20, 250, 10, 20]].concat();
                let is_near = |(a, b): (&u8, u8)| a.abs_diff(b) < 12;
                assert!(rgb.iter().zip(expected).all(is_near), "{rgb:?}");
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn colours_are_exchanged_where_a_publisher_says_so() {
        let (_, file) = file(Compression::Png);
        let first = |format: &str| match &read(format, file.clone()).expect("a file")[0] {
            Data::Buffer(rgb) => rgb[6],
            other => panic!("{other:?}"),
        };
        for right in [
            "png",
            "rgb8; png compressed bgr8",
            "mono8; png compressed mono8",
        ] {
            assert_eq!(first(right), 250, "{right}");
        }
        assert_eq!(first("rgb8; png compressed rgb8"), 20);
    }

    #[test]
    fn damaged_files_are_refused() {
        for compression in [Compression::Png, Compression::Jpeg(90)] {
            let (format, file) = file(compression);
            for length in 1..file.len() / 2 {
                assert!(read(&format, file[..length].to_vec()).is_err(), "{length}");
            }
        }
    }

    #[test]
    fn other_names_of_formats_are_refused() {
        assert_eq!(
            Compression::new("jpeg", 1000).expect("known"),
            Compression::Jpeg(100)
        );
        assert!(Compression::new("tiff", 90).is_err());
    }
}
