//! The simulator of a thread.

use std::cell::RefCell;
use std::mem::ManuallyDrop;

use c_interface::{Attached, attach};
use script::log::verbosity;
use simulator::{CacheFolder, Console, LogLine, Options, ScriptKind, SimulationState, Simulator};

use crate::add_ons;
use crate::launch::Launch;

struct Session {
    simulator: Simulator,
    /// The calls of this thread go to the simulator.
    attached: Attached,
}

thread_local! {
    /// Never dropped by the end of the thread: what a simulator needs may be gone by then.
    static SESSION: RefCell<ManuallyDrop<Option<Session>>> =
        const { RefCell::new(ManuallyDrop::new(None)) };
}

/// After a pass of the loop.
pub(crate) struct Status {
    /// No simulation runs.
    pub is_stopped: bool,
    /// A script asks for the end.
    pub quits: bool,
}

/// Starts a simulator on this thread.
///
/// # Errors
/// When there is one, or the scene cannot be read.
pub(crate) fn begin(launch: &Launch) -> Result<(), String> {
    if SESSION.with_borrow(|session| session.is_some()) {
        return Err("this thread has a simulator already".into());
    }
    let mut simulator = Simulator::builder()
        .options(options(launch))
        .console(Box::new(StandardOutput))
        .build();
    let attached = attach(simulator.c_host());
    let opened = fill(&mut simulator, launch);
    if let Err(reason) = opened {
        drop(attached);
        return Err(reason);
    }
    SESSION.set(ManuallyDrop::new(Some(Session {
        simulator,
        attached,
    })));
    Ok(())
}

fn options(launch: &Launch) -> Options {
    let mut options = Options {
        cache: CacheFolder::User,
        package_dirs: launch
            .scene
            .iter()
            .map(|scene| Simulator::folder_of_scene(scene))
            .collect(),
        // What such programs and their add-ons do is of 4.1.
        sets_up_plans: launch.has_old_add_ons,
        resources: Some(launch.root.clone()).filter(|root| root.is_dir()),
        ..Options::default()
    };
    let level = launch.verbosity.as_deref().and_then(verbosity::from_name);
    options.verbosity = level.unwrap_or(options.verbosity);
    options
}

/// Add-ons start first, as they come with the application; then the scene is opened.
fn fill(simulator: &mut Simulator, launch: &Launch) -> Result<(), String> {
    if launch.has_old_add_ons {
        add_ons::start(simulator, &launch.root)?;
    }
    match &launch.scene {
        Some(scene) => simulator.open(scene, ScriptKind::Customization),
        None => simulator.add_default_objects(),
    }
    .map_err(|error| error.to_string())
}

/// Ends the simulator of this thread.
///
/// # Errors
/// When there is none, or it is running.
pub(crate) fn end() -> Result<(), String> {
    let session = SESSION.with(|session| {
        let mut session = session.try_borrow_mut().map_err(|_| running())?;
        session.take().ok_or_else(crate::launch::why_no_simulator)
    })?;
    drop(session.simulator);
    drop(session.attached);
    Ok(())
}

/// One pass of the loop; a simulation that runs goes on only if `steps_running`. None where this thread has no simulator.
///
/// # Errors
/// When the simulator is within a step already.
pub(crate) fn step(steps_running: bool) -> Result<Option<Status>, String> {
    SESSION.with(|session| {
        let mut session = session.try_borrow_mut().map_err(|_| running())?;
        let Some(Session { simulator, .. }) = &mut **session else {
            return Ok(None);
        };
        if steps_running || !simulator.state().is_advancing() {
            simulator.iterate();
        }
        Ok(Some(Status {
            is_stopped: simulator.state() == SimulationState::Stopped,
            quits: simulator.quit_requested(),
        }))
    })
}

fn running() -> String {
    "the simulator is within a step: call it afterwards".to_owned()
}

/// Output and log of scripts, on the streams of the process.
struct StandardOutput;

impl Console for StandardOutput {
    fn print(&mut self, line: &[u8], _: f64) {
        println!("{}", String::from_utf8_lossy(line));
    }

    fn log(&mut self, line: &LogLine<'_>) {
        if line.status {
            return;
        }
        if verbosity::plain(line.level) <= verbosity::SCRIPT_WARNINGS {
            eprintln!("{}", line.located());
        } else {
            println!("{}", line.located());
        }
    }
}
