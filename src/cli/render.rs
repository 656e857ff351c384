//! `swanilda render`: a picture of a scene in a file.

use std::path::PathBuf;
use std::process::ExitCode;

use super::interrupt::Interrupt;
use super::launch::Launch;
use super::progress::Progress;
use super::run::Kind;
use super::setup::{Setup, seconds};
use super::video::picture_size;
use super::{Outcome, say};
use capture::Tape;
use format::picture::{self, Layout, PictureError};
use format::scene_file::write_whole;
use perception::vision::first_camera;
use scene::{Handle, Kind as ObjectKind};
use simulator::{Channels, Picture, RunLimits, Simulator};

/// Exit code when a script raised an error.
const SCRIPT_ERROR: u8 = 1;
/// Width and height where neither the command line nor a vision sensor says otherwise.
const DEFAULT_SIZE: [u32; 2] = [640, 480];
const JPEG_QUALITY: u8 = 90;
/// Millimetres per metre.
const MILLIMETRES: f64 = 1000.0;

/// Render a picture of a scene, as a camera or vision sensor sees it
#[derive(clap::Args)]
pub(super) struct Args {
    /// Scene or model: a Lua file, a CoppeliaSim file, or a folder made by unpack
    scene: PathBuf,
    /// Camera or vision sensor, by its path or handle [default: the first camera of a scene, or where all can be seen]
    #[arg(long, value_name = "PATH")]
    camera: Option<String>,
    /// Width and height in pixels [default: those of the vision sensor, or 640x480]
    #[arg(long, value_name = "WxH", value_parser = picture_size)]
    size: Option<[u32; 2]>,
    /// Simulate so long before
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, value_parser = seconds, allow_negative_numbers = true)]
    time: f64,
    /// File to write: png, jpg, bmp or tga
    #[arg(long, short, value_name = "FILE", default_value = "picture.png")]
    output: PathBuf,
    /// Distances along the axis of the camera in millimetres, 16 bits per pixel (png only); 0 where nothing is
    #[arg(long)]
    depth: bool,
    /// A colour for each object, listed on standard output
    #[arg(long, conflicts_with = "depth")]
    segmentation: bool,
    /// Script type to load a Lua file as
    #[arg(long = "as", value_name = "KIND", default_value = "customization")]
    kind: Kind,
    #[command(flatten)]
    setup: Setup,
}

/// Writes the picture; the exit code reports the outcome.
pub(super) fn render(args: &Args) -> Outcome {
    let limits = RunLimits {
        steps: None,
        time: Some(args.time),
        idle: 0,
        once: false,
    };
    let mut progress = Progress::new(
        limits,
        args.setup.quiet || args.setup.json || args.time == 0.0,
    );
    let mut launch = Launch::new(
        &args.setup,
        None,
        Some(&args.scene),
        &progress,
        None,
        &Tape::default(),
        None,
    )?;
    launch.fill(args.kind.into());
    let Launch {
        mut sim, interrupt, ..
    } = launch;
    args.simulate(&mut sim, &interrupt, &mut progress);
    progress.finish();
    if interrupt.is_requested() {
        return Ok(ExitCode::from(interrupt.exit_code()));
    }
    args.write(&sim)?;
    Ok(if sim.errors() > 0 {
        ExitCode::from(SCRIPT_ERROR)
    } else {
        ExitCode::SUCCESS
    })
}

impl Args {
    /// Runs the simulation up to the time of the picture, or until it pauses or ends.
    fn simulate(&self, sim: &mut Simulator, interrupt: &Interrupt, progress: &mut Progress) {
        if self.time <= 0.0 {
            return;
        }
        sim.start();
        // Half a microsecond: times are sums of steps.
        while sim.time() + 5e-7 < self.time
            && sim.state().is_advancing()
            && !interrupt.is_requested()
        {
            sim.iterate();
            progress.show(sim);
        }
    }

    fn write(&self, sim: &Simulator) -> Result<(), String> {
        let camera = self.camera(sim)?;
        let is_sensor = camera.is_some_and(|camera| is_vision_sensor(sim, camera));
        let size = self.size.or((!is_sensor).then_some(DEFAULT_SIZE));
        let channels = match (self.depth, self.segmentation) {
            (true, _) => Channels::DEPTH,
            (_, true) => Channels::IDS,
            _ => Channels::COLOUR,
        };
        let picture = sim
            .picture(camera, size, channels)
            .map_err(|error| error.to_string())?;
        let planes = sim
            .projection(camera)
            .map_err(|error| error.to_string())?
            .clipping;
        let file = match (self.depth, self.segmentation) {
            (true, _) => self.depth_file(&picture, planes),
            (_, true) => self.colour_file(&picture, segments(sim, &picture)),
            _ => self.colour_file(&picture, picture.colour.clone()),
        };
        let written = file.map_err(|error| error.to_string());
        written
            .and_then(|file| write_whole(&self.output, &file).map_err(|error| error.to_string()))
            .map_err(|reason| format!("cannot write {}: {reason}", self.output.display()))
    }

    /// The camera of the command line, or the first of the scene.
    fn camera(&self, sim: &Simulator) -> Result<Option<Handle>, String> {
        let scene = sim.scene();
        let Some(name) = &self.camera else {
            if self.is_model() {
                return Ok(None);
            }
            return Ok(first_camera(&scene));
        };
        let by_handle = name
            .parse()
            .ok()
            .and_then(Handle::from_raw)
            .filter(|handle| scene.exists(*handle));
        let path = if name.starts_with('/') {
            name.clone()
        } else {
            format!("/{name}")
        };
        let camera = by_handle.map_or_else(|| scene.find(&path, None, None), Ok);
        let camera =
            camera.map_err(|_| format!("there is no object {name} in {}", self.scene.display()))?;
        match scene.object(camera).map(|object| &object.kind) {
            Ok(ObjectKind::Camera(_) | ObjectKind::VisionSensor(_)) => Ok(Some(camera)),
            _ => Err(format!("{name} is neither a camera nor a vision sensor")),
        }
    }

    /// Whether the file holds a model, which the camera of the default scene does not look at.
    fn is_model(&self) -> bool {
        self.scene
            .extension()
            .is_some_and(|extension| extension.eq_ignore_ascii_case("ttm"))
    }

    fn extension(&self) -> String {
        self.output
            .extension()
            .unwrap_or_default()
            .to_string_lossy()
            .to_lowercase()
    }

    fn colour_file(&self, picture: &Picture, pixels: Vec<u8>) -> Result<Vec<u8>, PictureError> {
        let resolution = picture.resolution.map(i64::from);
        let upright = picture::Picture::new(pixels, resolution, Layout::Rgb)?.flipped(false, true);
        upright.encode(&self.extension(), JPEG_QUALITY)
    }

    fn depth_file(
        &self,
        picture: &Picture,
        [near, far]: [f64; 2],
    ) -> Result<Vec<u8>, PictureError> {
        if self.extension() != "png" {
            return Err(PictureError::Kind(format!(
                "{} for depths",
                self.extension()
            )));
        }
        let millimetres = |depth: f32| match depth {
            1.0 => 0,
            _ => (MILLIMETRES * (near + f64::from(depth) * (far - near)) + 0.5) as u16,
        };
        let rows = picture
            .depth
            .chunks_exact(picture.resolution[0] as usize)
            .rev();
        picture::grey_16_bit_png(
            rows.flatten().copied().map(millimetres).collect(),
            picture.resolution,
        )
    }
}

fn is_vision_sensor(sim: &Simulator, handle: Handle) -> bool {
    sim.scene()
        .object(handle)
        .is_ok_and(|object| object.vision_sensor().is_ok())
}

/// A colour for each object that is seen, which are listed on standard output.
fn segments(sim: &Simulator, picture: &Picture) -> Vec<u8> {
    let mut seen: Vec<u32> = picture
        .ids
        .iter()
        .copied()
        .filter(|id| *id != Picture::NOTHING)
        .collect();
    seen.sort_unstable();
    seen.dedup();
    let scene = sim.scene();
    for (number, id) in seen.iter().enumerate() {
        let [red, green, blue] = distinct_colour(number);
        let path = scene.short_path(Handle(*id)).unwrap_or_default();
        say(format!("#{red:02x}{green:02x}{blue:02x} {path}\n").as_bytes());
    }
    let colour = |id: &u32| seen.binary_search(id).map_or([0; 3], distinct_colour);
    picture.ids.iter().flat_map(colour).collect()
}

/// Colours that are far from those before them: the hue advances by the golden section, and every third one is darker.
fn distinct_colour(number: usize) -> [u8; 3] {
    const GOLDEN_SECTION: f64 = 0.618_033_988_749_895;
    let hue = (0.1 + GOLDEN_SECTION * number as f64).fract();
    let value = [255.0, 190.0, 125.0][number % 3];
    // Red, green and blue rise and fall around the circle of hues, a third of it apart.
    [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|shift| {
        let distance = ((hue + shift).fract() - 0.5).abs() * 6.0;
        (value * (0.15 + 0.85 * (distance - 1.0).clamp(0.0, 1.0))) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_differ() {
        let colours: Vec<[u8; 3]> = (0..30).map(distinct_colour).collect();
        for (at, colour) in colours.iter().enumerate() {
            assert!(!colours[..at].contains(colour) && *colour != [0; 3], "{at}");
        }
    }
}
