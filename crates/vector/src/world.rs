//! One world: a simulator with what is read and written in it, and its episodes.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::Arc;

use perception::vision::Channels;
use rand_mt::Mt;
use scene::Handle;
use script::log::verbosity;
use script::{Console, LogLine, SimulationState};
use simulator::{Simulator, Snapshot};

use crate::arrays::{Arrays, Item};
use crate::declaration::{Camera, Declaration, Reset};
use crate::expressions::Expressions;
use crate::interruption::StopSign;
use crate::quantities::{Readers, Writers, object};
use crate::recordings::{Recording, Recordings};
use crate::score::Score;
use crate::variations::Variations;

/// How wide the rows of the arrays are. All worlds have the same.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Numbers of each observation.
    pub observations: Vec<usize>,
    /// Numbers of each info.
    pub infos: Vec<usize>,
    /// Numbers of all actions.
    pub actions: usize,
    /// Width and height of each camera's pictures.
    pub images: Vec<[u32; 2]>,
    /// Whether episodes begin with a snapshot.
    pub has_snapshot: bool,
    /// Simulated seconds of an action.
    pub action_duration: f64,
}

/// A simulator and its episodes.
pub(crate) struct World {
    simulator: Simulator,
    recordings: Recordings,
    expressions: Expressions,
    observations: Readers,
    infos: Readers,
    actions: Writers,
    cameras: Vec<Viewpoint>,
    score: Option<Score>,
    /// The number of the statements at the beginning of an episode.
    begin: Option<i64>,
    variations: Variations,
    /// None where the simulation is started again.
    start: Option<Snapshot>,
    random: Mt,
    max_steps: u64,
    steps_per_action: u64,
    steps: u64,
    /// Actions that have not acted yet.
    delayed: VecDeque<Vec<f64>>,
    errors: Errors,
    stop: StopSign,
    declaration: Arc<Declaration>,
    number: u32,
    /// Something has gone wrong since it was made, or last brought back.
    has_failed: bool,
}

/// A camera, and the size of its pictures.
struct Viewpoint {
    camera: Handle,
    size: [u32; 2],
    each_step: bool,
}

/// What calls of scripts return where the error is in the log.
const FAILED: &str = "error in script function";

/// Lines of errors, as the log shows them.
#[derive(Clone, Default)]
struct Errors(Rc<RefCell<Vec<String>>>);

impl Console for Errors {
    fn print(&mut self, _: &[u8], _: f64) {}

    fn log(&mut self, line: &LogLine<'_>) {
        if verbosity::plain(line.level) == verbosity::SCRIPT_ERRORS {
            self.0.borrow_mut().push(line.located());
        }
    }
}

impl World {
    /// Opens the scene and starts the simulation.
    ///
    /// # Errors
    /// When the scene cannot be read, one of its scripts fails, or something that is declared is not there.
    pub(crate) fn new(
        declaration: &Arc<Declaration>,
        number: u32,
        stop: &StopSign,
    ) -> Result<Self, String> {
        stop.check()?;
        let errors = Errors::default();
        let made = Self::made(declaration, number, &errors, stop);
        made.map_err(|reason| errors.explained(reason))
    }

    fn made(
        declaration: &Arc<Declaration>,
        number: u32,
        errors: &Errors,
        stop: &StopSign,
    ) -> Result<Self, String> {
        let console = Box::new(errors.clone());
        let mut simulator = Simulator::with_console(declaration.options.clone(), console);
        simulator
            .open(&declaration.scene, declaration.kind)
            .map_err(|error| error.to_string())?;
        if let Some(step) = declaration.time_step {
            let settings = &mut simulator.scene_mut();
            settings.modify_settings(|settings| settings.time_step = step);
        }
        let expressions = Expressions::declared(&mut simulator, declaration)?;
        let variations = Variations::new(&mut simulator, &expressions, &declaration.variations)?;
        let actions = Writers::new(&mut simulator, &expressions, &declaration.actions)?;
        let score = Score::new(&mut simulator, &expressions, declaration)?;
        let begin = declaration.begin.as_ref().map(|text| {
            expressions.compile(&mut simulator, "the statements at the beginning", "", text)
        });
        let begin = begin.transpose()?;
        simulator.start();
        errors.check(&simulator, 0)?;
        let observations = Readers::new(&mut simulator, &expressions, &declaration.observations)?;
        let infos = Readers::new(&mut simulator, &expressions, &declaration.infos)?;
        let cameras = cameras(&mut simulator, &declaration.cameras)?;
        // What was compiled lies in the memory of the simulator, so it comes last.
        let start = match declaration.reset {
            Reset::Snapshot => Some(simulator.snapshot().map_err(|error| error.to_string())?),
            Reset::Either => simulator.snapshot().ok(),
            Reset::Start => None,
        };
        Ok(Self {
            simulator,
            recordings: Recordings::default(),
            expressions,
            observations,
            infos,
            actions,
            cameras,
            score,
            begin,
            variations,
            start,
            random: Mt::new(declaration.options.seed.wrapping_add(number)),
            max_steps: declaration.max_steps,
            steps_per_action: declaration.steps_per_action,
            steps: 0,
            delayed: VecDeque::new(),
            errors: errors.clone(),
            stop: stop.clone(),
            declaration: Arc::clone(declaration),
            number,
            has_failed: false,
        })
    }

    pub(crate) fn layout(&self) -> Layout {
        Layout {
            observations: self.observations.widths(),
            infos: self.infos.widths(),
            actions: self.actions.width(),
            images: self.cameras.iter().map(|view| view.size).collect(),
            has_snapshot: self.start.is_some(),
            action_duration: self.simulator.scene().settings().time_step
                * self.steps_per_action as f64,
        }
    }

    /// What the episodes from now on follow from.
    pub(crate) fn set_seed(&mut self, seed: u32) {
        self.random = Mt::new(seed);
    }

    /// Begins an episode, and writes what is observed.
    ///
    /// # Errors
    /// When a script fails, or what is declared in Lua, or something cannot be read any more.
    pub(crate) fn begin(&mut self, number: usize, arrays: &Arrays) -> Result<(), String> {
        self.errors.0.borrow_mut().clear();
        let begun = self.begin_episode(number, arrays);
        begun.map_err(|reason| self.noted(reason))
    }

    fn begin_episode(&mut self, number: usize, arrays: &Arrays) -> Result<(), String> {
        self.stop.check()?;
        self.finish_recording()?;
        self.start_again()?;
        let errors = self.simulator.errors();
        let delay =
            self.variations
                .apply(&mut self.simulator, &self.expressions, &mut self.random)?;
        self.delayed = std::iter::repeat_n(vec![0.0; self.actions.width()], delay).collect();
        if let Some(begin) = self.begin {
            self.expressions.run(&mut self.simulator, begin, &[])?;
        }
        self.errors.check(&self.simulator, errors)?;
        self.recordings.begin(&self.simulator)?;
        self.steps = 0;
        self.observe(number, arrays)?;
        arrays.rewards.set(number, 0.0);
        arrays.terminated.set(number, 0);
        arrays.truncated.set(number, 0);
        Ok(())
    }

    /// The simulation at its start, with random numbers of its own.
    fn start_again(&mut self) -> Result<(), String> {
        let seed = self.random.next_u32();
        if let Some(start) = &self.start {
            let restored = self.simulator.restore(start);
            restored.map_err(|error| error.to_string())?;
            return self
                .simulator
                .set_seed(seed)
                .map_err(|error| error.to_string());
        }
        if std::mem::take(&mut self.has_failed) {
            self.make_again()?;
        }
        if self.simulator.state() != SimulationState::Stopped {
            self.simulator.stop();
        }
        let seeded = self.simulator.set_seed(seed);
        seeded.map_err(|error| error.to_string())?;
        let errors = self.simulator.errors();
        self.simulator.start();
        self.errors.check(&self.simulator, errors)
    }

    /// Opens the scene again: scripts that have failed do not begin anew with the simulation.
    fn make_again(&mut self) -> Result<(), String> {
        let mut again = Self::made(&self.declaration, self.number, &self.errors, &self.stop)?;
        std::mem::swap(&mut self.random, &mut again.random);
        std::mem::swap(&mut self.recordings, &mut again.recordings);
        *self = again;
        Ok(())
    }

    /// Acts, steps, and writes what is observed. An episode also ends where a script stops the simulation.
    ///
    /// # Errors
    /// As [`begin`](Self::begin).
    pub(crate) fn step(&mut self, number: usize, arrays: &Arrays) -> Result<(), String> {
        self.errors.0.borrow_mut().clear();
        let stepped = self.act_and_observe(number, arrays);
        stepped.map_err(|reason| self.noted(reason))
    }

    /// Notes that the episode has failed; why, as users are to read it.
    fn noted(&mut self, reason: String) -> String {
        self.has_failed = true;
        let reason = self.errors.explained(reason);
        self.recordings.mark_failure(&reason);
        reason
    }

    /// Records the next episode in a file.
    ///
    /// # Errors
    /// When it cannot be written.
    pub(crate) fn record(&mut self, recording: &Recording) -> Result<(), String> {
        self.recordings.open(recording)
    }

    /// Completes the recording of the present episode, if there is one.
    ///
    /// # Errors
    /// When it could not be written, at any time.
    pub(crate) fn finish_recording(&mut self) -> Result<(), String> {
        self.recordings.finish(&self.simulator)
    }

    fn act_and_observe(&mut self, number: usize, arrays: &Arrays) -> Result<(), String> {
        self.stop.check()?;
        let errors = self.simulator.errors();
        let given = arrays.actions.read(number);
        self.delayed.push_back(given.clone());
        let acts = self.delayed.pop_front().unwrap_or_default();
        self.actions
            .write(&mut self.simulator, &self.expressions, &acts)?;
        self.advance()?;
        self.errors.check(&self.simulator, errors)?;
        self.steps += 1;
        let observed = self.observe(number, arrays)?;
        let (reward, terminated) = match &self.score {
            Some(score) => score.of(&mut self.simulator, &self.expressions, observed, given)?,
            None => (0.0, false),
        };
        let is_over = terminated || self.simulator.state().is_stopping();
        arrays.rewards.set(number, reward);
        arrays.terminated.set(number, is_over.into());
        let is_long = self.max_steps > 0 && self.steps >= self.max_steps;
        arrays.truncated.set(number, is_long.into());
        Ok(())
    }

    /// Makes the steps of an action, fewer where a script ends the simulation.
    fn advance(&mut self) -> Result<(), String> {
        for step in 0..self.steps_per_action {
            if step > 0 && self.simulator.state().is_stopping() {
                break;
            }
            self.stop.check()?;
            self.simulator.step(1);
        }
        Ok(())
    }

    fn observe(&mut self, number: usize, arrays: &Arrays) -> Result<Vec<f64>, String> {
        let observed = self
            .observations
            .read(&mut self.simulator, &self.expressions)?;
        arrays.observations.write(number, &observed);
        let infos = self.infos.read(&mut self.simulator, &self.expressions)?;
        arrays.infos.write(number, &infos);
        for at in 0..self.cameras.len() {
            if self.cameras[at].each_step {
                self.draw(number, at, arrays)?;
            }
        }
        Ok(observed)
    }

    /// Draws the picture of the camera at that place.
    ///
    /// # Errors
    /// When the camera is gone.
    pub(crate) fn draw(&self, number: usize, camera: usize, arrays: &Arrays) -> Result<(), String> {
        let view = &self.cameras[camera];
        let picture = self
            .simulator
            .picture(Some(view.camera), Some(view.size), Channels::COLOUR);
        let picture = picture.map_err(|error| error.to_string())?;
        // Pictures of simulators begin with the lowest row.
        let width = scene::numbers::place(view.size[0]);
        let rows = picture.colour.chunks(3 * width).rev();
        let cells = arrays.images[camera].row(number);
        for (cell, level) in cells.iter().zip(rows.flatten()) {
            level.set(cell);
        }
        Ok(())
    }
}

impl Drop for World {
    /// An episode that nobody ended has its recording all the same.
    fn drop(&mut self) {
        // Nobody is left who could be told of errors.
        let _ = self.finish_recording();
    }
}

impl Errors {
    /// A reason that only says that a script has failed becomes what the log says.
    fn explained(&self, reason: String) -> String {
        let lines = self.0.borrow();
        let logged = lines.first().filter(|_| reason.contains(FAILED));
        logged.cloned().unwrap_or(reason)
    }

    /// The first error of scripts since there were `before`.
    fn check(&self, simulator: &Simulator, before: u64) -> Result<(), String> {
        if simulator.errors() == before {
            return Ok(());
        }
        let lines = self.0.borrow();
        Err(lines
            .first()
            .cloned()
            .unwrap_or_else(|| "a script has failed.".to_owned()))
    }
}

fn cameras(simulator: &mut Simulator, cameras: &[Camera]) -> Result<Vec<Viewpoint>, String> {
    let of = |camera: &Camera| {
        let handle = object(simulator, &camera.path)?;
        let handle = Handle::from_raw(handle).ok_or("there is no such object.")?;
        let view = simulator.projection(Some(handle));
        let view = view.map_err(|error| format!("'{}': {error}", camera.path))?;
        Ok(Viewpoint {
            camera: handle,
            size: camera.resolution.unwrap_or(view.resolution),
            each_step: camera.each_step,
        })
    };
    cameras.iter().map(of).collect()
}
