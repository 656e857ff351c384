//! The memory of a simulator: which code runs inside of it, and snapshots.

use std::cell::RefMut;
use std::ops::{Deref, DerefMut};
use std::rc::Rc;

use heap::Entered;
use scene::Scene;
use script::Sim;

use super::{Error, NativeScripts, Simulator};

/// What lies in the memory of a simulator.
pub(crate) struct Parts {
    /// Dropped before the simulator, to which it has a link.
    pub(crate) native_scripts: Rc<NativeScripts>,
    pub(crate) sim: Rc<Sim>,
}

/// The parts of a simulator while code runs in its memory.
pub(crate) struct Inside<'a> {
    sim: &'a Rc<Sim>,
    _entered: Option<Entered>,
}

impl Deref for Inside<'_> {
    type Target = Rc<Sim>;

    fn deref(&self) -> &Rc<Sim> {
        self.sim
    }
}

/// The scene of a simulator, to write. What is made while this is there lies in the simulator's memory.
pub struct SceneMut<'a> {
    scene: RefMut<'a, Scene>,
    _entered: Option<Entered>,
}

impl Deref for SceneMut<'_> {
    type Target = Scene;

    fn deref(&self) -> &Scene {
        &self.scene
    }
}

impl DerefMut for SceneMut<'_> {
    fn deref_mut(&mut self) -> &mut Scene {
        &mut self.scene
    }
}

/// A simulator as it was at a moment, with scripts, physics and all that is hidden. What did not change is shared with other snapshots.
#[derive(Debug)]
pub struct Snapshot(heap::Snapshot);

impl Snapshot {
    /// Bytes that only this snapshot holds.
    pub fn own_bytes(&self) -> usize {
        self.0.own_bytes()
    }
}

impl Simulator {
    /// In the memory of the simulator until the end of the statement, or of what it is bound to.
    pub(crate) fn inside(&self) -> Inside<'_> {
        Inside {
            sim: &self.parts.sim,
            _entered: self.parts.entered(),
        }
    }

    /// What `work` computes in the memory of the simulator, copied out of it.
    pub(crate) fn copied<T: Clone>(&self, work: impl FnOnce(&Rc<Sim>) -> T) -> T {
        self.parts.copied(|parts| work(&parts.sim))
    }

    /// For a debugger of this simulator: see [`Sim::copied_out`] for what it asks.
    pub fn for_debugger<T>(&mut self, work: impl FnOnce(&Rc<Sim>) -> T) -> T {
        work(&self.parts.sim)
    }

    /// The scene, to write. Do not hold it across other calls.
    pub fn scene_mut(&mut self) -> SceneMut<'_> {
        SceneMut {
            scene: self.parts.sim.scene.borrow_mut(),
            _entered: self.parts.entered(),
        }
    }

    /// The whole simulator as it is now: scene, scripts with their variables and threads, physics, random numbers, all that is pending.
    ///
    /// # Errors
    /// When something is open that a copy of the memory does not reach, such as sockets, files and processes of scripts, which the error
    /// names; or when the program has not declared `swanilda::Allocator` as its global allocator.
    pub fn snapshot(&mut self) -> Result<Snapshot, Error> {
        let heap = self.parts.heap().ok_or_else(no_heap)?;
        let snapshot = heap.snapshot().map_err(|error| refused(&error))?;
        Ok(Snapshot(snapshot))
    }

    /// Brings back what the simulator was: it goes on from there with the same bytes as the first time.
    ///
    /// Values that borrowed from the simulator are gone by then; a [`ScriptRef`](super::ScriptRef) of a script that did not exist yet is
    /// unknown again.
    ///
    /// # Errors
    /// As [`snapshot`](Self::snapshot), and when the snapshot is of another simulator. Then nothing has changed.
    #[expect(unsafe_code, reason = "memory is brought back")]
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        let heap = self.parts.heap().ok_or_else(no_heap)?;
        // SAFETY: nothing borrows from the simulator, since it is borrowed mutably. What its functions return was copied, what lies
        // outside is never freed from inside while there is a snapshot, and what is open is named by `heap::resource`.
        unsafe { heap.restore(&snapshot.0) }.map_err(|error| refused(&error))
    }
}

fn no_heap() -> Error {
    Error::NoSnapshot(
        "there are snapshots only where the program declares `swanilda::Allocator` as its global allocator, on 64-bit systems like Unix."
            .to_owned(),
    )
}

fn refused(error: &heap::RestoreError) -> Error {
    Error::NoSnapshot(format!("{error}."))
}
