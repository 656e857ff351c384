//! Start and end of the simulator of a process, of which several threads of a program take part.
//!
//! One thread says what to start and waits for the end (`simExtLaunchUIThread`). Another one becomes the thread of the simulator
//! (`simExtSimThreadInit`), steps it and ends it (`simExtSimThreadDestroy`); then the next may be started. Any thread may ask for the
//! end (`simExtPostExitRequest`), and whether somebody did (`simExtGetExitRequest`).
//!
//! In CoppeliaSim 4.10 the thread of the simulator says what to start (`simInitialize`, `simLoop`, `simDeinitialize`), and another one
//! may wait for the end (`simRunGui`).

use std::path::PathBuf;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use c_interface::{Answer, Call, Function};
use scene::Data;

use crate::session;

/// The functions by their names in the table of symbols.
pub(crate) const FUNCTIONS: &[(&str, Function)] = &[
    ("launch.run", run),
    ("launch.can_init", |_| {
        answer(matches!(state().phase, Phase::Launched(_)))
    }),
    ("launch.init", |_| init()),
    ("launch.destroy", |_| destroy()),
    ("launch.post_exit", |_| {
        request_exit();
        answer(true)
    }),
    ("launch.exit_is_requested", |_| {
        answer(state().exit_is_requested)
    }),
    ("launch.step", |call| step(*call.arg(0) == Data::Bool(true))),
    ("launch.simulator", run_simulator),
    ("launch.main_script", main_script),
    ("launch.advance", advance),
    ("launch.gui", |_| wait_for_end()),
    ("launch.initialize", initialize),
    ("launch.loop", |call| {
        call.run_callback(0);
        step(call.int(1)? != 0)
    }),
    ("launch.deinitialize", |_| destroy()),
];

/// The parameters that a program may set before the start: what is logged, and what the status bar of the original shows.
const VERBOSITY: [i64; 2] = [121, 122];

/// `sim.simulation_advancing`.
const ADVANCING: i64 = 16;

const BUSY: &str = "a simulator of this process is running: end it first";

/// What to start.
#[derive(Debug, Clone, Default)]
pub(crate) struct Launch {
    /// A scene or model; none for the default scene.
    pub scene: Option<PathBuf>,
    /// The folder of the library.
    pub root: PathBuf,
    /// Whether its add-ons are those of CoppeliaSim 4.1, beside the library.
    pub has_old_add_ons: bool,
    /// What is logged, by name or number.
    pub verbosity: Option<String>,
}

/// How far the simulator of this process is.
#[derive(Debug)]
enum Phase {
    Idle,
    /// A thread may become the simulator's.
    Launched(Launch),
    Running,
}

struct State {
    phase: Phase,
    exit_is_requested: bool,
    /// Whether no simulation runs, as threads beside the simulator's see it.
    is_stopped: bool,
    verbosity: Option<String>,
    /// How many simulators have ended.
    ends: u64,
}

static STATE: Mutex<State> = Mutex::new(State {
    phase: Phase::Idle,
    exit_is_requested: false,
    is_stopped: true,
    verbosity: None,
    ends: 0,
});
static ENDED: Condvar = Condvar::new();

fn state() -> MutexGuard<'static, State> {
    STATE.lock().unwrap_or_else(PoisonError::into_inner)
}

fn answer(yes: bool) -> Answer {
    Ok(vec![Data::Bool(yes)])
}

/// Why a thread has no simulator.
pub(crate) fn why_no_simulator() -> String {
    let text = match state().phase {
        Phase::Idle => {
            "no simulator is running: call simExtLaunchUIThread and simExtSimThreadInit first"
        }
        Phase::Launched(_) => {
            "no simulator is running: a thread has to call simExtSimThreadInit first"
        }
        Phase::Running => {
            "the simulator belongs to the thread that has called simExtSimThreadInit: call it from there"
        }
    };
    text.to_owned()
}

/// Sets a parameter of the simulator that will be started; false where that has to wait for the start.
pub(crate) fn set_before_start(parameter: i64, value: &[u8]) -> bool {
    let mut state = state();
    let is_early = !matches!(state.phase, Phase::Running) && VERBOSITY.contains(&parameter);
    if is_early && parameter == VERBOSITY[0] {
        state.verbosity = Some(String::from_utf8_lossy(value).into_owned());
    }
    is_early
}

/// Parameters: name of the application, options of windows, scene or model, folder of the library. Returns at the end.
fn run(call: &Call<'_>) -> Answer {
    let path = |place| {
        let text = call.text(place).unwrap_or_default();
        (!text.is_empty()).then(|| PathBuf::from(text))
    };
    let mut state = state();
    if !matches!(state.phase, Phase::Idle) {
        return Err(BUSY.into());
    }
    state.phase = Phase::Launched(Launch {
        scene: path(2),
        root: path(3).unwrap_or_default(),
        has_old_add_ons: true,
        verbosity: state.verbosity.clone(),
    });
    state.exit_is_requested = false;
    let is_going_on = |state: &mut State| match state.phase {
        Phase::Idle => false,
        Phase::Launched(_) => !state.exit_is_requested,
        Phase::Running => true,
    };
    let waited = ENDED.wait_while(state, is_going_on);
    waited.unwrap_or_else(PoisonError::into_inner).phase = Phase::Idle;
    answer(true)
}

fn init() -> Answer {
    let state = state();
    let launch = match &state.phase {
        Phase::Launched(launch) => launch.clone(),
        Phase::Running => return Err(BUSY.into()),
        Phase::Idle => {
            return Err("simExtLaunchUIThread has to be called first, by another thread".into());
        }
    };
    start(state, &launch)
}

/// Starts a simulator on this thread. Meanwhile no other thread can.
fn start(mut state: MutexGuard<'_, State>, launch: &Launch) -> Answer {
    let before = std::mem::replace(&mut state.phase, Phase::Running);
    (state.is_stopped, state.exit_is_requested) = (true, false);
    drop(state);
    session::begin(launch).inspect_err(|_| {
        self::state().phase = before;
        ENDED.notify_all();
    })?;
    answer(true)
}

fn destroy() -> Answer {
    session::end()?;
    let mut state = state();
    state.phase = Phase::Idle;
    state.ends += 1;
    ENDED.notify_all();
    answer(true)
}

/// A whole run on this thread, as programs for V-REP have it. Parameters: name of the application, options of windows, functions to call
/// at the start, in each pass of the loop and at the end; perhaps a delay, and a scene or model. Without a function for the passes they are
/// those of [`step`].
fn run_simulator(call: &Call<'_>) -> Answer {
    let state = state();
    if !matches!(state.phase, Phase::Idle) {
        return Err(BUSY.into());
    }
    let scene = call.text(6).unwrap_or_default();
    let launch = Launch {
        scene: (!scene.is_empty()).then(|| PathBuf::from(scene)),
        root: PathBuf::from("."),
        has_old_add_ons: true,
        verbosity: state.verbosity.clone(),
    };
    start(state, &launch)?;
    call.run_callback(2);
    while !self::state().exit_is_requested {
        step(!call.has_callback(3))?;
        call.run_callback(3);
    }
    call.run_callback(4);
    destroy()
}

/// The step of a simulation that runs, which programs with a loop of their own ask for; 0 as no bit of a failure is set.
fn main_script(call: &Call<'_>) -> Answer {
    if is_advancing(call)? {
        step(true)?;
    }
    Ok(vec![Data::Int(0)])
}

/// [`main_script`] has advanced the time already.
fn advance(call: &Call<'_>) -> Answer {
    answer(is_advancing(call)?)
}

fn is_advancing(call: &Call<'_>) -> Result<bool, String> {
    let state = call.frame.host().call("sim.getSimulationState", &[])?;
    Ok(matches!(state.first(), Some(Data::Int(state)) if state & ADVANCING != 0))
}

/// Parameters: folder of the library, options of windows.
fn initialize(call: &Call<'_>) -> Answer {
    let state = state();
    if !matches!(state.phase, Phase::Idle) {
        return Err(BUSY.into());
    }
    let launch = Launch {
        root: call.text(0).map(PathBuf::from).unwrap_or_default(),
        verbosity: state.verbosity.clone(),
        ..Launch::default()
    };
    start(state, &launch)
}

/// Until the next simulator has ended, or somebody asks for the end while there is none.
fn wait_for_end() -> Answer {
    let state = state();
    let ends = state.ends;
    let is_going_on = |state: &mut State| {
        let is_idle = matches!(state.phase, Phase::Idle);
        state.ends == ends && !(is_idle && state.exit_is_requested)
    };
    drop(ENDED.wait_while(state, is_going_on));
    answer(true)
}

/// Also by a script: `sim.quitSimulator`.
fn request_exit() {
    state().exit_is_requested = true;
    ENDED.notify_all();
}

/// One pass of the loop; a simulation that runs goes on only if `steps_running`. Another thread than the simulator's has nothing to do
/// while no simulation runs.
fn step(steps_running: bool) -> Answer {
    match session::step(steps_running)? {
        Some(status) => {
            state().is_stopped = status.is_stopped;
            if status.quits {
                request_exit();
            }
        }
        None if state().is_stopped => {}
        None => return Err(why_no_simulator()),
    }
    answer(true)
}
