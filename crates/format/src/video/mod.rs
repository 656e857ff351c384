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
    /// The extension names no known kind.
    Kind(String),
    #[error(
        "{0} files are made by ffmpeg, which is not there ({1}): install it (apt install ffmpeg, brew install ffmpeg, \
         winget install ffmpeg), build with the feature `video` for .mp4, or write a .webp or .gif"
    )]
    /// The kind of file, and why ffmpeg could not be started.
    NoFfmpeg(String, std::io::Error),
    /// ffmpeg ended with an error, in its words.
    #[error("ffmpeg failed: {0}")]
    Ffmpeg(String),
    /// The name of a series of pictures has no place for the number, or several.
    #[error("the name of a series has one place for the number, such as out-%05d.png")]
    Series,
    /// A file cannot be written.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// A picture of a series cannot be written.
    #[error("{0}")]
    Picture(#[from] super::picture::PictureError),
    /// The kind is known, but only to builds with the feature `pictures`.
    #[cfg(not(feature = "pictures"))]
    #[error("this build makes no {0} files: build Swanilda with the feature `pictures`")]
    LeftOut(String),
    /// A GIF cannot be encoded.
    #[cfg(feature = "pictures")]
    #[error("{0}")]
    Gif(#[from] ::gif::EncodingError),
    /// A WebP animation cannot be encoded.
    #[cfg(feature = "pictures")]
    #[error("{0}")]
    WebP(#[from] image_webp::EncodingError),
    /// H.264 cannot be encoded.
    #[cfg(feature = "video")]
    #[error("{0}")]
    H264(#[from] openh264::Error),
    /// An MP4 container cannot be written.
    #[cfg(feature = "video")]
    #[error("{0}")]
    Mp4(#[from] ::mp4::Error),
}

/// Width and height in pixels, and pictures per second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VideoFormat {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Pictures per second.
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
    path.extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase()
}
