//! Animated WebP without loss: the container around still pictures (WebP Container Specification, "Animation").

use std::io::{BufWriter, Seek, SeekFrom, Write};
use std::path::Path;

use image_webp::{ColorType, WebPEncoder};

use super::frames::{Frame, Frames};
use super::{VideoError, VideoFile, VideoFormat};
use crate::scene_file::WholeFile;

/// Longest time that a frame is shown, seconds; the file has 24 bits for its milliseconds.
const MAX_FRAME_DURATION: f64 = 3600.0;
/// Flag of the header: this is an animation.
const ANIMATION: u8 = 1 << 1;
/// Flag of a frame: it replaces what was there, also where it is transparent.
const NO_BLENDING: u8 = 1 << 1;
/// Bytes of the file of a still picture before its only chunk.
const STILL_HEAD: usize = 12;

pub(super) struct WebP {
    file: BufWriter<WholeFile>,
    frames: Frames,
    rate: f64,
    /// Bytes after the head of the file.
    length: u64,
}

impl WebP {
    pub(super) fn create(
        path: &Path,
        VideoFormat { size, rate }: VideoFormat,
    ) -> Result<Self, VideoError> {
        let file = BufWriter::new(WholeFile::create(path)?);
        let mut video = Self {
            file,
            frames: Frames::new(size[0], rate, MAX_FRAME_DURATION),
            rate,
            length: 4,
        };
        // The length comes at the end.
        video.file.write_all(b"RIFF\0\0\0\0WEBP")?;
        let mut header = vec![ANIMATION, 0, 0, 0];
        size.iter()
            .for_each(|side| header.extend(three_bytes(side - 1)));
        video.write_chunk(b"VP8X", &[&header])?;
        // The background is black, and the animation repeats for ever.
        video.write_chunk(b"ANIM", &[&[0, 0, 0, 255, 0, 0]])?;
        Ok(video)
    }

    fn write(&mut self, frame: &Frame) -> Result<(), VideoError> {
        let mut still = Vec::new();
        WebPEncoder::new(&mut still).encode(
            &frame.pixels,
            frame.size[0],
            frame.size[1],
            ColorType::Rgb8,
        )?;
        let duration = u32::try_from(frame.duration(self.rate, 1000.0)).unwrap_or(u32::MAX);
        let [left, top, width, height] = [
            frame.place[0] / 2,
            frame.place[1] / 2,
            frame.size[0] - 1,
            frame.size[1] - 1,
        ]
        .map(three_bytes);
        let head = [left, top, width, height, three_bytes(duration)].concat();
        let picture = &still[STILL_HEAD..];
        self.write_chunk(b"ANMF", &[&head, &[NO_BLENDING], picture])
    }

    fn write_chunk(&mut self, name: &[u8; 4], parts: &[&[u8]]) -> Result<(), VideoError> {
        let length: usize = parts.iter().map(|part| part.len()).sum();
        self.file.write_all(name)?;
        self.file.write_all(&four_bytes(length as u64)?)?;
        parts
            .iter()
            .try_for_each(|part| self.file.write_all(part))?;
        // Chunks begin at even places.
        self.file.write_all(&[0][..length % 2])?;
        self.length += (8 + length + length % 2) as u64;
        Ok(())
    }
}

impl VideoFile for WebP {
    fn add(&mut self, picture: &[u8], periods: u64) -> Result<(), VideoError> {
        self.frames
            .add(picture, periods)
            .map_or(Ok(()), |frame| self.write(&frame))
    }

    fn finish(mut self: Box<Self>) -> Result<(), VideoError> {
        self.frames
            .finish()
            .map_or(Ok(()), |frame| self.write(&frame))?;
        self.file.seek(SeekFrom::Start(4))?;
        self.file.write_all(&four_bytes(self.length)?)?;
        Ok(self
            .file
            .into_inner()
            .map_err(std::io::IntoInnerError::into_error)?
            .finish()?)
    }
}

fn three_bytes(number: u32) -> [u8; 3] {
    let [a, b, c, _] = number.min(0xff_ffff).to_le_bytes();
    [a, b, c]
}

/// # Errors
/// When a file gets larger than the format allows.
fn four_bytes(length: u64) -> Result<[u8; 4], std::io::Error> {
    let too_large = |_| std::io::Error::other("a WebP file has 4 GiB at most");
    u32::try_from(length)
        .map(u32::to_le_bytes)
        .map_err(too_large)
}
