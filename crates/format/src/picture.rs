//! Pictures as scripts hold them: rows of bytes, and the files they come from and go to (PNG, JPEG, BMP, TGA).
//!
//! Rows keep their order: files begin with the top one, images of vision sensors with the bottom one.

use std::io::Cursor;

#[cfg(feature = "pictures")]
use image::ExtendedColorType;
#[cfg(feature = "pictures")]
use image::codecs::jpeg::JpegEncoder;
use image::imageops::{self, FilterType};
use image::{
    DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits, Rgba32FImage,
    RgbaImage,
};

/// No picture is larger: it could hardly be meant.
const MAX_SIDE: u32 = 16_384;

/// Why a picture cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The number of bytes does not belong to the resolution.
    #[error("the image has {found} bytes, but its resolution asks for {expected}.")]
    Length {
        /// Bytes that were given.
        found: usize,
        /// Bytes that the resolution and the layout ask for.
        expected: usize,
    },
    /// A side has no pixel or too many.
    #[error("the resolution of an image lies between 1 and {MAX_SIDE}.")]
    Resolution,
    /// A file states a size that is not taken from outside.
    #[error("the image is too large: {width} x {height}.")]
    TooLarge {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// Two images that are to become one have sides of different lengths.
    #[error("the images have different sizes.")]
    Sizes,
    /// The extension of a file names no known kind.
    #[error("unknown kind of image: {0} (known: png, jpg, bmp, tga).")]
    Kind(String),
    /// The kind is known, but only to builds with the feature `pictures`.
    #[cfg(not(feature = "pictures"))]
    #[error(
        "this build knows no images but PNG ({0}): build Swanilda with the feature `pictures`."
    )]
    LeftOut(String),
    /// The file is damaged, or cannot be written in this kind.
    #[error("{0}.")]
    Codec(ImageError),
    /// The file cannot be read or written.
    #[error("{0}.")]
    Io(#[from] std::io::Error),
}

impl From<ImageError> for PictureError {
    fn from(error: ImageError) -> Self {
        match error {
            #[cfg(not(feature = "pictures"))]
            ImageError::Unsupported(reason) => Self::LeftOut(reason.to_string()),
            other => Self::Codec(other),
        }
    }
}

/// Bytes per pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Brightness.
    Grey = 1,
    /// Red, green, blue.
    Rgb = 3,
    /// Red, green, blue, opacity.
    Rgba = 4,
}

/// A picture in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    layout: Layout,
    bytes: Vec<u8>,
}

/// A PNG file with 16 bits of grey per pixel, the top row first.
///
/// # Errors
/// When there are not as many values as the resolution says.
pub fn grey_16_bit_png(
    values: Vec<u16>,
    [width, height]: [u32; 2],
) -> Result<Vec<u8>, PictureError> {
    let (found, expected) = (2 * values.len(), 2 * width as usize * height as usize);
    let picture = image::ImageBuffer::<image::Luma<u16>, _>::from_raw(width, height, values)
        .ok_or(PictureError::Length { found, expected })?;
    let mut file = Cursor::new(Vec::new());
    picture.write_to(&mut file, ImageFormat::Png)?;
    Ok(file.into_inner())
}

impl Picture {
    /// A picture of pixels in memory, row by row.
    ///
    /// # Errors
    /// When the resolution is impossible, or the bytes do not fit it.
    pub fn new(
        bytes: Vec<u8>,
        [width, height]: [i64; 2],
        layout: Layout,
    ) -> Result<Self, PictureError> {
        let (width, height) = (side(width)?, side(height)?);
        let expected = width as usize * height as usize * layout as usize;
        if bytes.len() != expected {
            return Err(PictureError::Length {
                found: bytes.len(),
                expected,
            });
        }
        Ok(Self {
            width,
            height,
            layout,
            bytes,
        })
    }

    /// The picture a file holds.
    ///
    /// # Errors
    /// When the bytes are no picture of a known kind, or one that is too large.
    pub fn decode(file: &[u8], layout: Layout) -> Result<Self, PictureError> {
        let mut reader = ImageReader::new(Cursor::new(file)).with_guessed_format()?;
        let mut limits = Limits::default();
        (limits.max_image_width, limits.max_image_height) = (Some(MAX_SIDE), Some(MAX_SIDE));
        reader.limits(limits);
        Ok(Self::from_dynamic(&reader.decode()?, layout))
    }

    /// The picture of a PNG or JPEG file that somebody else has sent: the size it states is refused before memory is taken, if the pixels
    /// have more than `max_bytes`.
    ///
    /// # Errors
    /// When the bytes are no such picture, or one that is too large.
    pub fn decode_within(
        file: &[u8],
        layout: Layout,
        max_bytes: u64,
    ) -> Result<Self, PictureError> {
        let format = image::guess_format(file)?;
        if !matches!(format, ImageFormat::Png | ImageFormat::Jpeg) {
            return Err(PictureError::Kind(format!("{format:?}").to_lowercase()));
        }
        let mut reader = ImageReader::with_format(Cursor::new(file), format);
        let mut limits = Limits::default();
        (limits.max_image_width, limits.max_image_height) = (Some(MAX_SIDE), Some(MAX_SIDE));
        limits.max_alloc = Some(max_bytes);
        reader.limits(limits);
        let decoder = reader.into_decoder()?;
        let (width, height) = decoder.dimensions();
        let needed = u64::from(width) * u64::from(height) * layout as u64;
        if needed.max(decoder.total_bytes()) > max_bytes {
            return Err(PictureError::TooLarge { width, height });
        }
        Ok(Self::from_dynamic(
            &DynamicImage::from_decoder(decoder)?,
            layout,
        ))
    }

    /// Whether the bytes begin like a picture of a known kind.
    pub fn is_file(bytes: &[u8]) -> bool {
        image::guess_format(bytes).is_ok()
    }

    /// The picture as a file of the kind `extension` names; `quality` is that of JPEG, 1 to 100.
    ///
    /// # Errors
    /// When there is no such kind.
    #[cfg_attr(
        not(feature = "pictures"),
        allow(unused_variables, reason = "there is no JPEG")
    )]
    pub fn encode(&self, extension: &str, quality: u8) -> Result<Vec<u8>, PictureError> {
        let format = ImageFormat::from_extension(extension).filter(ImageFormat::can_write);
        let mut file = Cursor::new(Vec::new());
        match format {
            None => return Err(PictureError::Kind(extension.to_owned())),
            // JPEG knows no transparency.
            #[cfg(feature = "pictures")]
            Some(ImageFormat::Jpeg) => {
                let rgb = self.to_dynamic().into_rgb8();
                let mut encoder = JpegEncoder::new_with_quality(&mut file, quality);
                encoder.encode(&rgb, self.width, self.height, ExtendedColorType::Rgb8)?;
            }
            Some(format) => self.to_dynamic().write_to(&mut file, format)?,
        }
        Ok(file.into_inner())
    }

    /// The picture in another size; with `keep_aspect` as large as fits.
    ///
    /// # Errors
    /// When the resolution is impossible.
    pub fn scaled(
        &self,
        size: [i64; 2],
        keep_aspect: bool,
        layout: Layout,
    ) -> Result<Self, PictureError> {
        let (width, height) = (side(size[0])?, side(size[1])?);
        let picture = match self.layout {
            Layout::Rgba => self.multiplied_by_alpha().into(),
            Layout::Grey | Layout::Rgb => self.to_dynamic(),
        };
        let scaled = match keep_aspect {
            true => picture.resize(width, height, FilterType::Triangle),
            false => picture.resize_exact(width, height, FilterType::Triangle),
        };
        Ok(match scaled {
            DynamicImage::ImageRgba32F(scaled) => Self::from_dynamic(&truncated(&scaled), layout),
            scaled => Self::from_dynamic(&scaled, layout),
        })
    }

    /// The pixels with colours multiplied by their alpha, so that transparent ones weigh nothing in a mean.
    fn multiplied_by_alpha(&self) -> Rgba32FImage {
        let mut pixels = self.to_dynamic().into_rgba32f();
        for image::Rgba([red, green, blue, alpha]) in pixels.pixels_mut() {
            [red, green, blue]
                .into_iter()
                .for_each(|colour| *colour *= *alpha);
        }
        pixels
    }

    /// This picture and another of the same layout and the same height side by side, or, with the same width, this one first and the
    /// other's rows after it.
    ///
    /// # Errors
    /// When their sizes do not fit.
    pub fn beside(&self, other: &Self, horizontally: bool) -> Result<Self, PictureError> {
        let (own, others) = (self.resolution(), other.resolution());
        let (along, across) = if horizontally { (0, 1) } else { (1, 0) };
        if own[across] != others[across] || self.layout != other.layout {
            return Err(PictureError::Sizes);
        }
        let mut size = own;
        size[along] += others[along];
        let rows = |picture: &Self| picture.width as usize * picture.layout as usize;
        let bytes = if horizontally {
            let pairs = self
                .bytes
                .chunks(rows(self))
                .zip(other.bytes.chunks(rows(other)));
            pairs
                .flat_map(|(left, right)| [left, right].concat())
                .collect()
        } else {
            [self.bytes.as_slice(), &other.bytes].concat()
        };
        Self::new(bytes, size, self.layout)
    }

    /// The picture mirrored left to right, top to bottom, or both.
    pub fn flipped(&self, horizontally: bool, vertically: bool) -> Self {
        let mut picture = self.to_dynamic();
        if horizontally {
            imageops::flip_horizontal_in_place(&mut picture);
        }
        if vertically {
            imageops::flip_vertical_in_place(&mut picture);
        }
        Self::from_dynamic(&picture, self.layout)
    }

    /// Columns and rows.
    pub fn resolution(&self) -> [i64; 2] {
        [self.width.into(), self.height.into()]
    }

    /// The pixels row by row, in the picture's layout.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    fn to_dynamic(&self) -> DynamicImage {
        let (width, height, bytes) = (self.width, self.height, self.bytes.clone());
        let picture = match self.layout {
            Layout::Grey => {
                image::GrayImage::from_raw(width, height, bytes).map(DynamicImage::from)
            }
            Layout::Rgb => image::RgbImage::from_raw(width, height, bytes).map(DynamicImage::from),
            Layout::Rgba => RgbaImage::from_raw(width, height, bytes).map(DynamicImage::from),
        };
        picture.expect("the length was checked when the picture was made")
    }

    fn from_dynamic(picture: &DynamicImage, layout: Layout) -> Self {
        let bytes = match layout {
            Layout::Grey => picture.to_luma8().into_raw(),
            Layout::Rgb => picture.to_rgb8().into_raw(),
            Layout::Rgba => picture.to_rgba8().into_raw(),
        };
        Self {
            width: picture.width(),
            height: picture.height(),
            layout,
            bytes,
        }
    }
}

/// Bytes of a picture of floats; fractions of a byte are cut, as the original does.
fn truncated(picture: &Rgba32FImage) -> DynamicImage {
    let byte = |value: f32| numbers::level((value * 255.0 + 1e-3).into());
    let bytes = RgbaImage::from_fn(picture.width(), picture.height(), |x, y| {
        image::Rgba(picture.get_pixel(x, y).0.map(byte))
    });
    bytes.into()
}

fn side(pixels: i64) -> Result<u32, PictureError> {
    u32::try_from(pixels)
        .ok()
        .filter(|side| (1..=MAX_SIDE).contains(side))
        .ok_or(PictureError::Resolution)
}

#[cfg(test)]
mod tests {
    use super::{Layout, Picture, PictureError};

    fn picture() -> Picture {
        Picture::new((0..12).collect(), [2, 2], Layout::Rgb)
            .expect("twelve bytes are two by two pixels")
    }

    #[test]
    fn files_without_loss_come_back() {
        for kind in ["png", "bmp", "tga"] {
            let file = picture().encode(kind, 90).expect("a known kind");
            if kind != "tga" {
                // TGA files have no mark at their beginning.
                assert_eq!(
                    Picture::decode(&file, Layout::Rgb).expect("a file just written"),
                    picture(),
                    "{kind}"
                );
            }
        }
        assert!(picture().encode("xyz", 90).is_err());
    }

    #[test]
    fn files_of_others_are_bounded() {
        let file = picture().encode("png", 90).expect("a known kind");
        let decoded = |file: &[u8], max_bytes| Picture::decode_within(file, Layout::Rgb, max_bytes);
        assert_eq!(decoded(&file, 12).expect("it fits"), picture());
        assert!(matches!(
            decoded(&file, 11),
            Err(PictureError::TooLarge {
                width: 2,
                height: 2
            })
        ));
        for length in 0..file.len() - 12 {
            assert!(decoded(&file[..length], 1 << 20).is_err(), "{length}");
        }
        // No other kinds: this one is not what images of robots are sent in.
        let other = picture().encode("bmp", 90).expect("a known kind");
        assert!(decoded(&other, 1 << 20).is_err());
    }

    #[test]
    fn nonsense_is_refused() {
        assert!(Picture::decode(b"\x89PNG\r\n\x1a\nnot a picture", Layout::Rgb).is_err());
        assert!(Picture::new(vec![0; 11], [2, 2], Layout::Rgb).is_err());
        assert!(Picture::new(Vec::new(), [0, 2], Layout::Rgb).is_err());
        assert!(Picture::new(Vec::new(), [i64::MAX, i64::MAX], Layout::Rgb).is_err());
    }
}
