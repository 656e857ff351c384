//! The engines of a simulator, which have processes, and what happens to them once per loop iteration.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::{Rc, Weak};

use script::{Host, ScriptCallback};

use super::engine::{Arrival, Engine};
use super::message::Message;
use super::process::Process;
use crate::Cx;
use scene::Data;

/// The engines that have loaded an interface, in the order in which they did.
#[derive(Default)]
pub(super) struct Engines {
    last: Cell<i64>,
    running: RefCell<BTreeMap<i64, Rc<Engine>>>,
    version: Cell<Option<[i64; 3]>>,
}

impl Engines {
    pub(super) fn get(&self, number: i64) -> Option<Rc<Engine>> {
        self.running.borrow().get(&number).cloned()
    }

    pub(super) fn all(&self) -> Vec<(i64, Rc<Engine>)> {
        let running = self.running.borrow();
        running
            .iter()
            .map(|(number, engine)| (*number, Rc::clone(engine)))
            .collect()
    }

    /// Ends an engine. Nothing is borrowed while its process ends.
    pub(super) fn stop(&self, number: i64) {
        let engine = self.running.borrow_mut().remove(&number);
        if let Some(engine) = engine {
            engine.close();
        }
    }

    /// The engine that shows a window, and its number for it.
    pub(super) fn of_window(&self, handle: &str) -> Option<(Rc<Engine>, i64)> {
        let of =
            |(_, engine): (i64, Rc<Engine>)| Some((Rc::clone(&engine), engine.window(handle)?));
        self.all().into_iter().find_map(of)
    }

    /// Starts a process, which a replay needs none of.
    ///
    /// # Errors
    /// Why there is none.
    fn start(&self, cx: &Cx) -> Result<Option<Process>, String> {
        let mut running = None;
        let started = cx.permissions().tape().input("starting QML", || {
            let (process, version) = Process::start(cx).map_err(|error| error.to_string())?;
            running = Some(process);
            Ok((version[0], version[1], version[2]))
        });
        let (major, minor, patch) = started.unwrap_or_else(|lost| Err(lost.to_string()))?;
        self.version.set(Some([major, minor, patch]));
        Ok(running)
    }

    /// The version of Qt; None without one.
    pub(super) fn version(&self, cx: &Cx) -> Option<[i64; 3]> {
        if self.version.get().is_none() {
            // Why not is said when an interface is loaded. A process that waits for one would be in the way of snapshots.
            drop(self.start(cx));
        }
        self.version.get()
    }

    /// Loads an interface; its number.
    ///
    /// # Errors
    /// Why interfaces cannot run here, or what is wrong with this one.
    pub(super) fn load(
        &self,
        cx: &Cx,
        handle: String,
        [source, name]: [Data; 2],
        handler: ScriptCallback,
    ) -> Result<i64, NotLoaded> {
        let process = self.start(cx).map_err(NotLoaded::Lacking)?;
        let engine = Engine::new(cx, handle, handler, process);
        engine.send("load", &[source, name]);
        let loaded = engine.wait(cx, |message| match message {
            Message::Loaded => Ok(Ok(())),
            Message::Failed(why) => Ok(Err(why)),
            other => Err(other),
        });
        loaded.and_then(|loaded| loaded).map_err(NotLoaded::Wrong)?;
        let number = self.last.get() + 1;
        self.last.set(number);
        self.running.borrow_mut().insert(number, Rc::new(engine));
        own(cx, self_of(cx), number);
        Ok(number)
    }
}

/// Why an interface is not there.
pub(super) enum NotLoaded {
    /// No interface can run here.
    Lacking(String),
    /// Something is wrong with this one.
    Wrong(String),
}

fn self_of(cx: &Cx) -> Rc<Engines> {
    cx.module_state()
}

/// The engines of a script: they end with it.
#[derive(Default)]
struct Owned(RefCell<Vec<Ownership>>);

struct Ownership {
    engines: Weak<Engines>,
    number: i64,
}

impl Drop for Ownership {
    fn drop(&mut self) {
        if let Some(engines) = self.engines.upgrade() {
            engines.stop(self.number);
        }
    }
}

fn own(cx: &Cx, engines: Rc<Engines>, number: i64) {
    let owned = cx.script_state::<Owned>();
    let mut owned = owned.0.borrow_mut();
    owned.retain(|other| engines.get(other.number).is_some());
    owned.push(Ownership {
        engines: Rc::downgrade(&engines),
        number,
    });
}

/// Sends the processes what persons did, does what they say, and calls the handlers of scripts for their events.
pub(super) fn start_of_iteration(host: &Host) {
    let engines = host.module_state::<Engines>();
    let engines = engines.map_or_else(Vec::new, |engines| engines.all());
    let Some((_, first)) = engines.first() else {
        return;
    };
    let tape = host.options().permissions.tape();
    if !tape.is_replaying() {
        let is_seen = first.is_seen();
        engines
            .iter()
            .for_each(|(_, engine)| engine.send_inputs(is_seen));
    }
    let arrived = tape.poll("messages of QML", 0, || arrivals(&engines));
    for (number, arrival) in arrived.into_iter().flatten() {
        if let Some((_, engine)) = engines.iter().find(|(known, _)| *known == number) {
            engine.handle(arrival);
        }
    }
    for (_, engine) in &engines {
        engine.log_output();
        engine.deliver();
    }
}

/// What has arrived of all engines, if anything has.
fn arrivals(engines: &[(i64, Rc<Engine>)]) -> Option<Vec<(i64, Arrival)>> {
    let of = |(number, engine): &(i64, Rc<Engine>)| {
        let number = *number;
        engine
            .arrivals()
            .into_iter()
            .map(move |arrival| (number, arrival))
    };
    let all: Vec<_> = engines.iter().flat_map(of).collect();
    (!all.is_empty()).then_some(all)
}
