//! Pictures of sensors compared with recorded ones: PNG files beside the tests.

use std::fmt;
use std::io;
use std::path::Path;

use format::picture::{Layout, Picture};
use format::scene_file::write_whole;
use permissions::read_bounded;
use script::test_bench::Snapshot;

/// A larger file is none of ours.
const MAX_SIZE: u64 = 64 << 20;
/// Pixels between the pictures of a comparison.
const GAP: usize = 4;
const GAP_COLOUR: [u8; 3] = [255; 3];
/// Where pixels differ too much.
const DIFFERENT: [u8; 3] = [255, 0, 0];

/// A picture that was recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedImage {
    /// Width and height, pixels.
    pub resolution: [u32; 2],
    /// Red, green, blue of each pixel, the top row first.
    pub pixels: Vec<u8>,
}

/// How a picture differs from the recorded one.
#[derive(Debug, Clone, PartialEq)]
pub enum ImageDifference {
    /// Width and height, pixels.
    Size {
        /// Of the file.
        expected: [u32; 2],
        /// Of the test.
        actual: [u32; 2],
    },
    /// Pixels of which a colour is off by more than the tolerance.
    Pixels {
        /// How many there are.
        off: usize,
        /// Of how many.
        of: usize,
        /// The largest difference of a colour, 1 to 255.
        worst: u8,
        /// Where that is: column and row, from the upper left corner.
        at: [usize; 2],
        /// The difference of a colour that is allowed.
        tolerance: u8,
    },
}

impl fmt::Display for ImageDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { expected, actual } => {
                let [width, height] = actual;
                write!(
                    f,
                    "it has {width}x{height} pixels, expected {}x{}.",
                    expected[0], expected[1]
                )
            }
            Self::Pixels {
                off,
                of,
                worst,
                at,
                tolerance,
            } => {
                write!(
                    f,
                    "{off} of {of} pixels are off by more than {tolerance} of 255, at most by {worst} "
                )?;
                write!(f, "(column {}, row {} from the top).", at[0], at[1])
            }
        }
    }
}

/// Reads a recorded picture; None when there is none.
///
/// # Errors
/// When it is no picture.
pub(super) fn read(path: &Path) -> Result<Option<RecordedImage>, String> {
    match std::fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Ok(data) if data.len() > MAX_SIZE => {
            return Err(format!("the file is larger than {MAX_SIZE} bytes."));
        }
        _ => {}
    }
    let bytes = read_bounded(path).map_err(|error| error.to_string())?;
    let picture = Picture::decode(&bytes, Layout::Rgb).map_err(|error| error.to_string())?;
    let resolution = picture.resolution().map(|side| side as u32);
    Ok(Some(RecordedImage {
        resolution,
        pixels: picture.into_bytes(),
    }))
}

/// Writes a picture, all of it or nothing.
///
/// # Errors
/// When the folder cannot be written.
pub(super) fn write(path: &Path, actual: &Snapshot) -> io::Result<()> {
    let file = encoded(actual.pixels.clone(), actual.resolution).map_err(io::Error::other)?;
    write_whole(path, &file)
}

fn encoded(pixels: Vec<u8>, resolution: [u32; 2]) -> Result<Vec<u8>, String> {
    let picture = Picture::new(pixels, resolution.map(i64::from), Layout::Rgb)
        .map_err(|error| error.to_string())?;
    picture
        .encode("png", 100)
        .map_err(|error| error.to_string())
}

/// The difference between two pictures, where it is larger than allowed.
pub(super) fn compare(expected: &RecordedImage, actual: &Snapshot) -> Option<ImageDifference> {
    if expected.resolution != actual.resolution {
        return Some(ImageDifference::Size {
            expected: expected.resolution,
            actual: actual.resolution,
        });
    }
    let differences: Vec<u8> = differences(&expected.pixels, &actual.pixels).collect();
    let off = differences
        .iter()
        .filter(|difference| **difference > actual.tolerance)
        .count();
    if off as f64 <= actual.share * differences.len() as f64 {
        return None;
    }
    let largest = differences
        .iter()
        .enumerate()
        .max_by_key(|(at, difference)| (**difference, usize::MAX - at));
    let (place, worst) = largest.map_or((0, 0), |(place, worst)| (place, *worst));
    let width = actual.resolution[0] as usize;
    let at = [place % width, place / width];
    Some(ImageDifference::Pixels {
        off,
        of: differences.len(),
        worst,
        at,
        tolerance: actual.tolerance,
    })
}

/// For each pixel the largest difference of its colours.
fn differences<'a>(expected: &'a [u8], actual: &'a [u8]) -> impl Iterator<Item = u8> {
    let pixels = expected.chunks_exact(3).zip(actual.chunks_exact(3));
    pixels.map(|(a, b)| {
        a.iter()
            .zip(b)
            .map(|(a, b)| a.abs_diff(*b))
            .max()
            .unwrap_or(0)
    })
}

/// Expected picture, actual picture, and the actual one in pale grey with red where they differ, beside each other; None when they are
/// not of the same size.
pub(super) fn png(expected: &RecordedImage, actual: &Snapshot) -> Option<Vec<u8>> {
    if expected.resolution != actual.resolution {
        return None;
    }
    let marked = differences(&expected.pixels, &actual.pixels).zip(actual.pixels.chunks_exact(3));
    let marked: Vec<u8> = marked
        .flat_map(|(difference, pixel)| mark(difference, pixel, actual.tolerance))
        .collect();
    let (width, height) = (actual.resolution[0] as usize, actual.resolution[1] as usize);
    let gap = GAP_COLOUR.repeat(GAP);
    let mut pixels = Vec::new();
    for row in 0..height {
        let part = 3 * width * row..3 * width * (row + 1);
        pixels.extend(
            [
                &expected.pixels[part.clone()],
                &gap,
                &actual.pixels[part.clone()],
                &gap,
                &marked[part],
            ]
            .concat(),
        );
    }
    encoded(pixels, [(3 * width + 2 * GAP) as u32, height as u32]).ok()
}

fn mark(difference: u8, pixel: &[u8], tolerance: u8) -> [u8; 3] {
    let grey = pixel.iter().map(|&part| u32::from(part)).sum::<u32>() / 3;
    if difference > tolerance {
        DIFFERENT
    } else {
        [(192 + grey / 4) as u8; 3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snapshot(pixels: &[u8], tolerance: u8, share: f64) -> Snapshot {
        Snapshot {
            resolution: [2, 1],
            pixels: pixels.to_vec(),
            tolerance,
            share,
        }
    }

    #[test]
    fn few_or_small_differences_are_allowed() {
        let expected = RecordedImage {
            resolution: [2, 1],
            pixels: vec![10, 20, 30, 40, 50, 60],
        };
        let actual = [10, 20, 32, 40, 59, 60];
        let compared = |tolerance, share| compare(&expected, &snapshot(&actual, tolerance, share));
        let worst = ImageDifference::Pixels {
            off: 1,
            of: 2,
            worst: 9,
            at: [1, 0],
            tolerance: 2,
        };
        assert_eq!(compared(2, 0.0), Some(worst));
        assert_eq!((compared(9, 0.0), compared(2, 0.5)), (None, None));
        assert!(compared(1, 0.5).is_some());
        let larger = RecordedImage {
            resolution: [1, 2],
            ..expected.clone()
        };
        let size = ImageDifference::Size {
            expected: [1, 2],
            actual: [2, 1],
        };
        assert_eq!(compare(&larger, &snapshot(&actual, 0, 1.0)), Some(size));
    }

    #[test]
    fn the_picture_of_a_difference_has_three_parts() {
        let file = png(
            &RecordedImage {
                resolution: [2, 1],
                pixels: vec![0; 6],
            },
            &snapshot(&[0, 0, 0, 9, 0, 0], 3, 0.0),
        )
        .unwrap();
        let picture = Picture::decode(&file, Layout::Rgb).unwrap();
        assert_eq!(picture.resolution(), [14, 1]);
        assert_eq!(picture.into_bytes()[36..], [192, 192, 192, 255, 0, 0]);
    }
}
