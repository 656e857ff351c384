//! Animated GIF: 256 colours for each picture, times in hundredths of a second.

use std::io::BufWriter;
use std::path::Path;

use gif::{DisposalMethod, Encoder, Repeat};

use super::frames::{Frame, Frames};
use super::{VideoError, VideoFile, VideoFormat};
use crate::scene_file::WholeFile;

/// From 1, slow and with the best colours, to 30.
const SPEED: i32 = 10;
/// Longest time that a frame is shown, seconds; the file has 16 bits for its hundredths.
const MAX_FRAME_DURATION: f64 = 600.0;

pub(super) struct Gif {
    encoder: Encoder<BufWriter<WholeFile>>,
    frames: Frames,
    rate: f64,
}

impl Gif {
    pub(super) fn create(
        path: &Path,
        VideoFormat { size, rate }: VideoFormat,
    ) -> Result<Self, VideoError> {
        let side =
            |side| u16::try_from(side).map_err(|_| super::super::picture::PictureError::Resolution);
        let (width, height) = (side(size[0])?, side(size[1])?);
        let mut encoder =
            Encoder::new(BufWriter::new(WholeFile::create(path)?), width, height, &[])?;
        encoder.set_repeat(Repeat::Infinite)?;
        Ok(Self {
            encoder,
            frames: Frames::new(size[0], rate, MAX_FRAME_DURATION),
            rate,
        })
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "the sides of the film were checked when it was begun, and a frame lies within"
    )]
    fn write(&mut self, frame: &Frame) -> Result<(), VideoError> {
        let [width, height] = frame.size.map(|side| side as u16);
        let mut picture = gif::Frame::from_rgb_speed(width, height, &frame.pixels, SPEED);
        [picture.left, picture.top] = frame.place.map(|place| place as u16);
        picture.dispose = DisposalMethod::Keep;
        picture.delay = u16::try_from(frame.duration(self.rate, 100.0)).unwrap_or(u16::MAX);
        Ok(self.encoder.write_frame(&picture)?)
    }
}

impl VideoFile for Gif {
    fn add(&mut self, picture: &[u8], periods: u64) -> Result<(), VideoError> {
        self.frames
            .add(picture, periods)
            .map_or(Ok(()), |frame| self.write(&frame))
    }

    fn finish(mut self: Box<Self>) -> Result<(), VideoError> {
        self.frames
            .finish()
            .map_or(Ok(()), |frame| self.write(&frame))?;
        let file = self
            .encoder
            .into_inner()?
            .into_inner()
            .map_err(std::io::IntoInnerError::into_error)?;
        Ok(file.finish()?)
    }
}
