//! Videos that the program `ffmpeg` makes of the pictures it is sent.

use std::fs::File;
use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use tempfile::NamedTempFile;

use super::{VideoError, VideoFile, VideoFormat};
use crate::scene_file::{link_target, part_of};

/// The program, looked for in the folders of `PATH`.
pub const PROGRAM: &str = "ffmpeg";

/// Extensions of files, and what ffmpeg calls the kind.
pub(super) const KINDS: [(&str, &str); 5] = [
    ("mp4", "mp4"),
    ("mkv", "matroska"),
    ("mov", "mov"),
    ("webm", "webm"),
    ("avi", "avi"),
];

/// What ffmpeg calls files with that extension.
pub(super) fn kind(extension: &str) -> Option<&'static str> {
    KINDS
        .iter()
        .find(|(known, _)| *known == extension)
        .map(|(_, kind)| *kind)
}

pub(super) struct Ffmpeg {
    child: Child,
    errors: File,
    part: NamedTempFile,
    path: PathBuf,
}

impl Ffmpeg {
    pub(super) fn start(path: &Path, kind: &str, format: VideoFormat) -> Result<Self, VideoError> {
        let path = link_target(path);
        let part = part_of(&path)?;
        // A pipe would fill up: nobody reads it before the end.
        let errors = tempfile::tempfile()?;
        let mut command = Command::new(PROGRAM);
        command.args(arguments(kind, format)).arg(part.path());
        command
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(errors.try_clone()?);
        // Ctrl-c is for the simulator, which then ends the video.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let extension = super::extension(&path);
        let child = command
            .spawn()
            .map_err(|error| VideoError::NoFfmpeg(extension, error))?;
        Ok(Self {
            child,
            errors,
            part,
            path,
        })
    }

    /// The last line that it wrote about errors.
    fn reason(&mut self) -> VideoError {
        let mut text = Vec::new();
        let read = self
            .errors
            .rewind()
            .and_then(|()| self.errors.read_to_end(&mut text));
        let text = String::from_utf8_lossy(&text);
        let line = text
            .lines()
            .rfind(|line| !line.trim().is_empty())
            .filter(|_| read.is_ok());
        VideoError::Ffmpeg(line.unwrap_or("it does not say why").trim().to_owned())
    }
}

/// Everything but the file. Sides are made even by black pixels, since most players show no video otherwise.
fn arguments(
    kind: &str,
    VideoFormat {
        size: [width, height],
        rate,
    }: VideoFormat,
) -> Vec<String> {
    let input = format!(
        "-f rawvideo -pixel_format rgb24 -video_size {width}x{height} -framerate {rate} -i -"
    );
    let even = "pad=ceil(iw/2)*2:ceil(ih/2)*2";
    // No dates in the file: the same pictures are the same bytes.
    let output =
        format!("-an -vf {even} -pix_fmt yuv420p -fflags +bitexact -flags:v +bitexact -f {kind}");
    let all = format!("-hide_banner -loglevel error -y {input} {output}");
    all.split(' ').map(str::to_owned).collect()
}

impl VideoFile for Ffmpeg {
    fn add(&mut self, picture: &[u8], periods: u64) -> Result<(), VideoError> {
        for _ in 0..periods {
            let stdin = self
                .child
                .stdin
                .as_mut()
                .expect("it is a pipe until the end");
            if stdin.write_all(picture).is_err() {
                // It has ended, and said why.
                let _ = self.child.wait();
                return Err(self.reason());
            }
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<(), VideoError> {
        drop(self.child.stdin.take());
        if !self.child.wait()?.success() {
            return Err(self.reason());
        }
        let (part, path) = (self.part, self.path);
        part.persist(path).map_err(|error| error.error)?;
        Ok(())
    }
}
