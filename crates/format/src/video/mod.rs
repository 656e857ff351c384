//! Videos: pictures one after the other, as GIF, animated WebP, a series of PNG files, or what `ffmpeg` makes of them.

mod ffmpeg;
#[cfg(any(feature = "pictures", feature = "video"))]
mod frames;
#[cfg(feature = "pictures")]
mod gif;
#[cfg(feature = "video")]
mod mp4;
mod series;
#[cfg(all(test, feature = "pictures"))]
mod tests;
#[cfg(feature = "pictures")]
mod webp;

use std::path::Path;

pub use ffmpeg::PROGRAM;

/// Most pictures per second: the steps of GIF are hundredths of a second.
pub const MAX_RATE: f64 = 100.0;

/// Why a video cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum VideoError {
    #[error(
        "unknown kind of video: {0} (known: webp, gif, a series of png files such as out-%05d.png, and with ffmpeg: {known})",
        known = ffmpeg::KINDS.map(|(kind, _)| kind).join(", ")
    )]
    Kind(String),
    #[error(
        "{0} files are made by ffmpeg, which is not there ({1}): install it (apt install ffmpeg, brew install ffmpeg, \
         winget install ffmpeg), build with the feature `video` for .mp4, or write a .webp or .gif"
    )]
    NoFfmpeg(String, std::io::Error),
    #[error("ffmpeg failed: {0}")]
    Ffmpeg(String),
    #[error("the name of a series has one place for the number, such as out-%05d.png")]
    Series,
    #[error("{0}")]
    Io(#[from] std::io::Error),
    #[error("{0}")]
    Picture(#[from] super::picture::PictureError),
    #[cfg(not(feature = "pictures"))]
    #[error("this build makes no {0} files: build Swanilda with the feature `pictures`")]
    LeftOut(String),
    #[cfg(feature = "pictures")]
    #[error("{0}")]
    Gif(#[from] ::gif::EncodingError),
    #[cfg(feature = "pictures")]
    #[error("{0}")]
    WebP(#[from] image_webp::EncodingError),
    #[cfg(feature = "video")]
    #[error("{0}")]
    H264(#[from] openh264::Error),
    #[cfg(feature = "video")]
    #[error("{0}")]
    Mp4(#[from] ::mp4::Error),
}

/// Width and height in pixels, and pictures per second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VideoFormat {
    pub size: [u32; 2],
    pub rate: f64,
}

/// A video that is being written. Nothing but a series is there under its name before it is finished.
pub trait VideoFile {
    /// Adds a picture, RGB with rows from the top, that is shown for as many periods of the rate.
    ///
    /// # Errors
    /// When it cannot be written.
    fn add(&mut self, picture: &[u8], periods: u64) -> Result<(), VideoError>;

    /// Completes the file.
    ///
    /// # Errors
    /// When it cannot be written.
    fn finish(self: Box<Self>) -> Result<(), VideoError>;
}

/// Whether a video with that name is made by another program.
pub fn needs_program(path: &Path) -> bool {
    let extension = extension(path);
    ffmpeg::kind(&extension).is_some() && !(cfg!(feature = "video") && extension == "mp4")
}

/// A video of the kind that the name of the file says.
///
/// # Errors
/// When the kind is unknown, or the file cannot be created.
pub fn create(path: &Path, format: VideoFormat) -> Result<Box<dyn VideoFile>, VideoError> {
    match extension(path).as_str() {
        #[cfg(not(feature = "pictures"))]
        kind @ ("gif" | "webp") => Err(VideoError::LeftOut(kind.to_owned())),
        #[cfg(feature = "pictures")]
        "gif" => Ok(Box::new(gif::Gif::create(path, format)?)),
        #[cfg(feature = "pictures")]
        "webp" => Ok(Box::new(webp::WebP::create(path, format)?)),
        #[cfg(feature = "video")]
        "mp4" => Ok(Box::new(mp4::Mp4::create(path, format)?)),
        "png" => Ok(Box::new(series::Series::create(path, format)?)),
        other => match ffmpeg::kind(other) {
            Some(kind) => Ok(Box::new(ffmpeg::Ffmpeg::start(path, kind, format)?)),
            None => Err(VideoError::Kind(other.to_owned())),
        },
    }
}

fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}
