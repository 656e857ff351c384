//! The simulators of each thread.
//!
//! A simulator belongs to the thread that made it. Python's objects, which any thread may have, only know its number; the simulators
//! themselves lie in a table of their thread. So nothing has to be locked, and another thread gets a sentence instead of a crash.
//! Branches of a simulator are several numbers of one: one of them is what the memory holds now, of the others there are snapshots.
//! A child process made by `fork` has copies of them whose sockets and threads are not its own: it forgets them.

pub mod branches;
pub mod making;
pub mod recording;

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use pyo3::prelude::*;
use swanilda::{Caller, SimulationState, Simulator, Viewer};

use crate::convert::callables::Callables;
use crate::errors::Error;
use crate::host;
use crate::worlds::branches::Branches;
use crate::worlds::recording::Recording;

thread_local! {
    static WORLDS: RefCell<BTreeMap<u64, Rc<World>>> = const { RefCell::new(BTreeMap::new()) };
    static FORGOTTEN: Cell<bool> = const { Cell::new(false) };
}

static COUNT: AtomicU64 = AtomicU64::new(1);

/// A script as Python sees it: its name for calls, and the functions it has passed.
pub struct Speaker {
    pub caller: Caller,
    pub callables: Rc<Callables>,
}

/// What a simulator and its scripts in Python share.
#[derive(Default)]
pub struct Shared {
    /// By the handle of the script.
    pub speakers: RefCell<BTreeMap<i64, Rc<Speaker>>>,
    /// The first exception of a function that the simulator called, until the call from Python that led to it has returned.
    pub exception: RefCell<Option<PyErr>>,
}

/// One simulator, with its branches.
pub struct World {
    pub number: u64,
    /// The script in whose name Python's main program calls; dropped before the simulator, whose memory is free then.
    pub main: Rc<Speaker>,
    /// Borrowed while it runs.
    pub simulator: RefCell<Simulator>,
    pub shared: Rc<Shared>,
    /// What shows it in browsers.
    pub viewer: RefCell<Option<Viewer>>,
    pub branches: RefCell<Branches>,
    pub recording: RefCell<Option<Recording>>,
}

impl World {
    /// Shows browsers what changed, and does what they ask for, waiting up to `timeout` for that.
    pub fn show(&self, simulator: &mut Simulator, timeout: Duration) {
        if let Some(viewer) = &mut *self.viewer.borrow_mut() {
            viewer.attend(simulator, timeout);
        }
    }

    /// The script with that handle; the main program for None.
    pub fn speaker(&self, script: Option<i64>) -> PyResult<Rc<Speaker>> {
        let Some(handle) = script else {
            return Ok(Rc::clone(&self.main));
        };
        let speaker = self.shared.speakers.borrow().get(&handle).cloned();
        speaker.ok_or_else(|| Error::new_err("the script has ended."))
    }

    /// The exception that a function raised meanwhile, if there is one.
    pub fn raise(&self) -> PyResult<()> {
        self.shared.exception.take().map_or(Ok(()), Err)
    }

    /// Ends the simulation and all scripts, which clean up.
    fn end(&self) -> PyResult<()> {
        let recorded = self.finish_recording();
        let mut simulator = self.borrow()?;
        if simulator.state() != SimulationState::Stopped {
            simulator.stop();
        }
        simulator.clear_scene();
        recorded
    }

    /// The simulator, to run it.
    pub fn borrow(&self) -> PyResult<std::cell::RefMut<'_, Simulator>> {
        let busy =
            "the simulator is in the middle of a step: a function that it calls cannot run it.";
        self.simulator
            .try_borrow_mut()
            .map_err(|_| Error::new_err(busy))
    }
}

/// A number for a new simulator.
pub fn new_number() -> u64 {
    COUNT.fetch_add(1, Ordering::Relaxed)
}

/// Adds a simulator to those of this thread.
pub fn add(world: World) {
    add_as(world.number, &Rc::new(world));
}

/// Adds a branch of a simulator.
pub fn add_as(number: u64, world: &Rc<World>) {
    WORLDS.with_borrow_mut(|worlds| worlds.insert(number, Rc::clone(world)));
}

/// The simulator with that number; its memory is that of the branch.
///
/// # Errors
/// When it is closed, or another thread's, or another process's; or when another branch cannot be left.
pub fn get(number: u64) -> PyResult<Rc<World>> {
    let world = find(number)?;
    world.turn_to(number)?;
    Ok(world)
}

/// The simulator with that number, whatever branch its memory holds.
///
/// # Errors
/// When it is closed, or another thread's, or another process's.
pub fn find(number: u64) -> PyResult<Rc<World>> {
    let found = WORLDS.try_with(|worlds| {
        worlds
            .try_borrow()
            .ok()
            .and_then(|worlds| worlds.get(&number).cloned())
    });
    found.ok().flatten().ok_or_else(|| {
        Error::new_err(if FORGOTTEN.get() {
            "a simulator does not survive a fork: make it in the child process."
        } else {
            "the simulator is closed, or belongs to another thread: each thread makes its own."
        })
    })
}

/// Ends a simulator; its scripts clean up. Nothing happens when it is closed, or another thread's.
pub fn close(number: u64) -> PyResult<()> {
    let Ok(world) = find(number) else {
        return Ok(());
    };
    // Where another branch cannot be left, this one ends without its turn.
    let has_turn = world.turn_to(number);
    if has_turn.is_ok() {
        world.end()?;
    } else if !world.has_branches() {
        return has_turn;
    }
    world.forget(number);
    let removed = WORLDS.with_borrow_mut(|worlds| worlds.remove(&number));
    drop(removed);
    let shared = Rc::clone(&world.shared);
    drop(world);
    shared.exception.take().map_or(Ok(()), Err)
}

/// Ends all simulators of this thread: for the end of Python.
#[pyfunction]
pub fn close_all() {
    let numbers = WORLDS.try_with(|worlds| {
        worlds
            .try_borrow()
            .map(|worlds| worlds.keys().copied().collect::<Vec<_>>())
    });
    for number in numbers.ok().and_then(Result::ok).unwrap_or_default() {
        // Nobody is left who could be told of exceptions; those of scripts are in the log.
        let _ = close(number);
    }
}

/// In a new child process: its copies of the simulators are neither used nor ended.
#[pyfunction]
pub fn forget_after_fork() {
    host::forget_after_fork();
    let forgotten = WORLDS.try_with(|worlds| {
        worlds
            .try_borrow_mut()
            .map(|mut worlds| std::mem::take(&mut *worlds))
    });
    if let Ok(Ok(worlds)) = forgotten {
        FORGOTTEN.set(FORGOTTEN.get() || !worlds.is_empty());
        std::mem::forget(worlds);
    }
}
