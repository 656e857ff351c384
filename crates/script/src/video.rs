//! Videos of a simulation: the one that the user wants, and the one that scripts ask for by parameters.
//!
//! The first picture is taken after the first step, when all that scripts make for the simulation is there. A picture shows the latest state
//! that is not after its time.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;

use super::log::verbosity;
use crate::clock::SimulationState;
use crate::host::Sim;
use format::video::{self, VideoError, VideoFile, VideoFormat};
use heap::resource::Resource;
use perception::vision::{Channels, Viewpoint, first_camera};
use scene::{Handle, Scene, SceneError};

/// `sim.boolparam_video_recording_triggered`.
const TRIGGERED: i64 = 29;
/// `sim.stringparam_video_filename`.
const FILE_NAME: i64 = 1;
/// The file of scripts that name none.
const DEFAULT_FILE: &str = "recording.webp";
/// Width and height where neither the user nor a vision sensor says otherwise.
const DEFAULT_SIZE: [u32; 2] = [640, 480];
/// Pictures per second at most where the user does not say otherwise.
const DEFAULT_RATE: f64 = 30.0;
/// Pictures per second at least.
const MIN_RATE: f64 = 0.001;

/// What a video shows, and how.
#[derive(Debug, Clone, Default)]
pub struct VideoOptions {
    /// Its extension says the kind: webp, gif, png for a series such as `out-%05d.png`; mp4, mkv, mov, webm or avi with ffmpeg.
    pub file: PathBuf,
    /// Where the video is taken from.
    pub from: VideoView,
    /// Width and height in pixels, 4096 each at most; None: those of the vision sensor, or 640 and 480.
    pub size: Option<[u32; 2]>,
    /// Pictures per second of simulation, 100 at most; None: one for each step, 30 at most.
    pub rate: Option<f64>,
}

/// From where a video is taken.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum VideoView {
    /// The first camera of the scene; without one a place from where everything can be seen.
    #[default]
    FirstCamera,
    /// A place from where everything can be seen at first.
    Everything,
    /// A camera or vision sensor, by its path or handle.
    Object(String),
}

/// The videos of a simulator.
#[derive(Default)]
struct Videos {
    // Boxes, since both are taken out for each step.
    of_user: RefCell<Option<Box<Recorder>>>,
    of_scripts: RefCell<Option<Box<Recorder>>>,
}

/// Why a video ends before its time.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct VideoFailure(String);

impl<E: Into<VideoError>> From<E> for VideoFailure {
    fn from(error: E) -> Self {
        Self(error.into().to_string())
    }
}

/// A video that is being taken.
struct Recorder {
    options: VideoOptions,
    /// Simulated since the first picture, seconds.
    elapsed: f64,
    /// Periods of the rate that have pictures.
    shown: u64,
    /// None before the first picture.
    film: Option<Film>,
    failure: Option<VideoFailure>,
}

/// The file of a video, and from where it is seen.
struct Film {
    file: Box<dyn VideoFile>,
    from: Viewpoint,
    format: VideoFormat,
    _resource: Resource,
}

impl Recorder {
    fn new(options: VideoOptions) -> Box<Self> {
        Box::new(Self {
            options,
            elapsed: 0.0,
            shown: 0,
            film: None,
            failure: None,
        })
    }

    /// Takes the pictures of the time until the next step.
    fn take(&mut self, sim: &Sim) {
        if self.failure.is_none() {
            let taken = self.try_take(sim);
            self.failure = taken.err();
        }
    }

    fn try_take(&mut self, sim: &Sim) -> Result<(), VideoFailure> {
        let dt = sim.scene.borrow().settings().time_step;
        let film = match &mut self.film {
            Some(film) => film,
            None => self.film.insert(Film::begin(sim, &self.options, dt)?),
        };
        self.elapsed += dt;
        // A millionth of a picture: times are sums of steps.
        let due = numbers::truncated_u64((self.elapsed * film.format.rate - 1e-6).ceil());
        if due > self.shown {
            let picture = film.picture(sim)?;
            film.file.add(&picture, due - self.shown)?;
            self.shown = due;
        }
        Ok(())
    }

    /// Completes the file; one that failed ends with its last picture.
    fn finish(self) -> Result<(), VideoFailure> {
        let finished = self.film.map_or(Ok(()), |film| film.file.finish());
        self.failure.map_or(Ok(()), Err)?;
        Ok(finished?)
    }
}

impl Film {
    fn begin(sim: &Sim, options: &VideoOptions, dt: f64) -> Result<Self, VideoFailure> {
        let scene = sim.scene.borrow();
        let camera = match &options.from {
            VideoView::Object(name) => Some(find(&scene, name)?),
            VideoView::FirstCamera => first_camera(&scene),
            VideoView::Everything => None,
        };
        let from = Viewpoint::new(&scene, camera).map_err(wrong_camera)?;
        let size = options
            .size
            .or_else(|| from.resolution(&scene))
            .unwrap_or(DEFAULT_SIZE);
        let size = from
            .shot(&scene, size)
            .map_err(wrong_camera)?
            .view
            .resolution;
        let format = VideoFormat {
            size,
            rate: options
                .rate
                .unwrap_or((1.0 / dt).min(DEFAULT_RATE))
                .clamp(MIN_RATE, video::MAX_RATE),
        };
        Ok(Self {
            file: video::create(&options.file, format)?,
            from,
            format,
            _resource: Resource::new(|| format!("the video {}", options.file.display())),
        })
    }

    /// RGB, rows from the top.
    fn picture(&self, sim: &Sim) -> Result<Vec<u8>, VideoFailure> {
        let scene = sim.scene.borrow();
        let shot = self
            .from
            .shot(&scene, self.format.size)
            .map_err(wrong_camera)?;
        let picture = sim
            .perception
            .borrow_mut()
            .vision
            .picture(&scene, &shot, Channels::COLOUR);
        let rows: Vec<&[u8]> = picture
            .colour
            .chunks_exact(3 * self.format.size[0] as usize)
            .rev()
            .collect();
        Ok(rows.concat())
    }
}

fn find(scene: &Scene, name: &str) -> Result<Handle, VideoFailure> {
    let by_handle = name
        .parse()
        .ok()
        .and_then(Handle::from_raw)
        .filter(|handle| scene.exists(*handle));
    let path = if name.starts_with('/') {
        name.to_owned()
    } else {
        format!("/{name}")
    };
    let found = by_handle.map_or_else(|| scene.find(&path, None, None), Ok);
    found.map_err(|_| VideoFailure(format!("there is no object {name}")))
}

fn wrong_camera(error: SceneError) -> VideoFailure {
    VideoFailure(match error {
        SceneError::WrongType(_) => "the object is neither a camera nor a vision sensor".to_owned(),
        _ => "the camera is gone".to_owned(),
    })
}

impl Sim {
    fn videos(&self) -> Rc<Videos> {
        self.modules.states.get()
    }

    /// Begins a video with the next step.
    pub fn start_video(&self, options: VideoOptions) {
        self.videos().of_user.replace(Some(Recorder::new(options)));
    }

    /// Why the video of the user has ended.
    pub fn video_failure(&self) -> Option<VideoFailure> {
        let videos = self.videos();
        let of_user = videos.of_user.borrow();
        of_user.as_ref()?.failure.clone()
    }

    /// Completes the video of the user.
    pub fn finish_video(&self) -> Result<(), VideoFailure> {
        let recorder = self.videos().of_user.take();
        recorder.map_or(Ok(()), |recorder| recorder.finish())
    }

    /// Takes pictures after a step, and ends the video of scripts with the simulation.
    pub(crate) fn film(&self) {
        let ends = self.clock.state() == SimulationState::Stopped;
        let of_user = self.videos().of_user.take();
        if let Some(mut recorder) = of_user {
            if !ends {
                recorder.take(self);
            }
            self.videos().of_user.replace(Some(recorder));
        }
        self.film_for_scripts(ends);
    }

    fn film_for_scripts(&self, ends: bool) {
        let wanted = self
            .app
            .borrow()
            .idle_params
            .bools
            .get(&TRIGGERED)
            .copied()
            .unwrap_or_default()
            && !ends;
        let recorder = self.videos().of_scripts.take();
        match (recorder, wanted) {
            (None, false) => {}
            (None, true) => self.continue_video(Recorder::new(VideoOptions {
                file: self.video_file(),
                ..Default::default()
            })),
            (Some(recorder), true) => self.continue_video(recorder),
            (Some(recorder), false) => self.end_video(*recorder),
        }
    }

    /// Takes the next pictures of the video of scripts; it ends when that fails.
    fn continue_video(&self, mut recorder: Box<Recorder>) {
        let file = &recorder.options.file;
        let may = self.options.permissions.check_write(file).and_then(|()| {
            match video::needs_program(file) {
                true => self.options.permissions.check_run(video::PROGRAM),
                false => Ok(()),
            }
        });
        match may {
            Ok(()) => recorder.take(self),
            Err(denied) => recorder.failure = Some(VideoFailure(denied.to_string())),
        }
        match recorder.failure {
            Some(_) => self.end_video(*recorder),
            None => drop(self.videos().of_scripts.replace(Some(recorder))),
        }
    }

    /// Ends the video that scripts record, and completes its file.
    pub fn end_video_of_scripts(&self) {
        let recorder = self.videos().of_scripts.take();
        if let Some(recorder) = recorder {
            self.end_video(*recorder);
        }
    }

    fn end_video(&self, recorder: Recorder) {
        self.app
            .borrow_mut()
            .idle_params
            .bools
            .insert(TRIGGERED, false);
        let file = recorder.options.file.display().to_string();
        if let Err(failure) = recorder.finish() {
            self.log(
                verbosity::ERRORS,
                &format!("cannot write the video {file}: {failure}"),
            );
        }
    }

    /// Where the video of scripts goes.
    fn video_file(&self) -> PathBuf {
        let app = self.app.borrow();
        let name = app
            .idle_params
            .texts
            .get(&FILE_NAME)
            .filter(|name| !name.is_empty());
        name.map_or_else(
            || DEFAULT_FILE.into(),
            |name| String::from_utf8_lossy(name).into_owned().into(),
        )
    }
}
