//! The options about videos.

use std::path::{Path, PathBuf};

use simulator::{Simulator, VideoOptions, VideoView};

/// Where the help text lists them.
const HEADING: &str = "Video";
/// Pictures per second at most.
const MAX_RATE: f64 = 100.0;

/// A video of the run.
#[derive(clap::Args)]
pub(in crate::cli) struct VideoArgs {
    /// Write a video of the simulation: webp, gif, a series of png files such as out-%05d.png; with ffmpeg mp4, mkv, mov, webm or avi
    #[arg(long, value_name = "FILE", help_heading = HEADING)]
    video: Option<PathBuf>,
    /// Camera or vision sensor, by its path or handle [default: the first camera of a scene, or where all can be seen]
    #[arg(long, value_name = "PATH", help_heading = HEADING, requires = "video")]
    video_camera: Option<String>,
    /// Width and height in pixels [default: those of the vision sensor, or 640x480]
    #[arg(long, value_name = "WxH", value_parser = picture_size, help_heading = HEADING, requires = "video")]
    video_size: Option<[u32; 2]>,
    /// Pictures per second of simulation [default: one for each step, 30 at most]
    #[arg(long, value_name = "N", value_parser = rate, help_heading = HEADING, requires = "video", allow_negative_numbers = true)]
    video_fps: Option<f64>,
}

impl VideoArgs {
    pub(in crate::cli) fn is_asked_for(&self) -> bool {
        self.video.is_some()
    }

    /// The video begins with the simulation.
    pub(in crate::cli) fn start(&self, sim: &mut Simulator, scene: &Path) {
        let Some(file) = self.video.clone() else {
            return;
        };
        // The camera of the default scene does not look at models.
        let is_model = scene
            .extension()
            .is_some_and(|extension| extension.eq_ignore_ascii_case("ttm"));
        let from = match &self.video_camera {
            Some(camera) => VideoView::Object(camera.clone()),
            None if is_model => VideoView::Everything,
            None => VideoView::FirstCamera,
        };
        sim.start_video(VideoOptions {
            file,
            from,
            size: self.video_size,
            rate: self.video_fps,
        });
    }

    /// Completes the file.
    ///
    /// # Errors
    /// When there is none, or not all of it.
    pub(in crate::cli) fn finish(&self, sim: &mut Simulator) -> Result<(), String> {
        let file = self.video.as_deref().unwrap_or(Path::new(""));
        sim.finish_video()
            .map_err(|failure| format!("cannot write {}: {failure}", file.display()))
    }
}

/// Width and height: two whole numbers with an x between them.
pub(in crate::cli) fn picture_size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=4096).contains(side));
    let sides = text
        .split_once('x')
        .and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| {
        "width and height are needed, such as 640x480, each from 1 to 4096".to_owned()
    })
}

fn rate(text: &str) -> Result<f64, String> {
    let rate = text
        .parse()
        .ok()
        .filter(|rate| (0.001..=MAX_RATE).contains(rate));
    rate.ok_or_else(|| "a number of pictures per second is needed, 0.001 to 100".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_sides() {
        assert_eq!(picture_size("640x480"), Ok([640, 480]));
        for wrong in [
            "", "640", "640x", "x480", "0x1", "1x4097", "-1x5", "1x2x3", "1.5x2",
        ] {
            assert!(picture_size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn rates_are_positive() {
        assert_eq!(rate("29.97"), Ok(29.97));
        for wrong in ["", "0", "-1", "NaN", "inf", "1e9"] {
            assert!(rate(wrong).is_err(), "{wrong}");
        }
    }
}
