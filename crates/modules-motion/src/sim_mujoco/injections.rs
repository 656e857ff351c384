//! The injections of a simulator.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::{Rc, Weak};

use robot_description::mjcf::Flex;

use super::acts::Undo;
use super::describe::{Described, Kind};
use scene::{Data, Handle};
use script::ScriptCallback;

/// Lives as long as a script.
#[derive(Default)]
pub(super) struct Life;

/// All injections, by their numbers.
#[derive(Default)]
pub(super) struct Injections {
    list: RefCell<BTreeMap<i64, Injection>>,
    last: Cell<i64>,
    /// What was said to have no counterpart.
    named: RefCell<BTreeSet<String>>,
}

/// A piece of a model.
#[derive(Clone)]
pub(super) struct Injection {
    pub kind: Kind,
    pub info: Data,
    pub xml: String,
    pub callback: Option<Rc<ScriptCallback>>,
    life: Weak<Life>,
    pub state: State,
    /// The names of its soft things.
    names: Vec<String>,
    pub made: Made,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// It becomes objects when the physics is about to move the scene.
    Pending,
    /// It has become what it can.
    Done,
}

/// What an injection has become.
#[derive(Debug, Clone, Default)]
pub(super) struct Made {
    pub softs: Vec<(Flex, Handle)>,
    /// What else was added.
    pub objects: Vec<Handle>,
    /// Nodes of soft things that it holds.
    pub pins: Vec<(Handle, usize)>,
    /// Objects that it has changed, as they were before.
    pub undo: Vec<Undo>,
    /// Settings from before: gravity and step.
    pub gravity: Option<[f32; 3]>,
    pub step: Option<f64>,
}

impl Injection {
    pub(super) fn new(
        kind: Kind,
        info: Data,
        xml: String,
        callback: Option<Rc<ScriptCallback>>,
        life: Weak<Life>,
    ) -> Self {
        Self {
            kind,
            info,
            xml,
            callback,
            life,
            state: State::Pending,
            names: Vec::new(),
            made: Made::default(),
        }
    }

    fn has_ended(&self) -> bool {
        self.life.strong_count() == 0
    }
}

impl Injections {
    pub(super) fn add(&self, mut injection: Injection, described: &Described) -> i64 {
        let softs = described.softs.iter();
        injection.names = softs.map(|(flex, _)| flex.name.clone()).collect();
        let id = self.last.get() + 1;
        self.last.set(id);
        self.list.borrow_mut().insert(id, injection);
        id
    }

    pub(super) fn is_empty(&self) -> bool {
        self.list.borrow().is_empty()
    }

    /// Whether something is to be made, or to be taken out.
    pub(super) fn has_work(&self) -> bool {
        let list = self.list.borrow();
        let mut all = list.values();
        all.any(|one| one.has_ended() || one.state == State::Pending)
    }

    /// Whether something soft has that name, of a script that still runs.
    pub(super) fn has_soft(&self, name: &str) -> bool {
        let list = self.list.borrow();
        let mut all = list.values().filter(|one| !one.has_ended());
        all.any(|one| one.names.iter().any(|own| own == name))
    }

    pub(super) fn get(&self, id: i64) -> Option<Injection> {
        self.list.borrow().get(&id).cloned()
    }

    pub(super) fn take(&self, id: i64) -> Option<Injection> {
        self.list.borrow_mut().remove(&id)
    }

    /// Takes those of scripts that have ended.
    pub(super) fn take_ended(&self) -> Vec<Injection> {
        let ended = self.numbers(Injection::has_ended);
        ended.into_iter().filter_map(|id| self.take(id)).collect()
    }

    pub(super) fn pending(&self) -> Vec<i64> {
        self.numbers(|one| one.state == State::Pending)
    }

    fn numbers(&self, which: impl Fn(&Injection) -> bool) -> Vec<i64> {
        let list = self.list.borrow();
        let those = list.iter().filter(|(_, one)| which(one));
        those.map(|(id, _)| *id).collect()
    }

    /// Changes an injection, if it is still there.
    pub(super) fn change(&self, id: i64, change: impl FnOnce(&mut Injection)) {
        self.list.borrow_mut().get_mut(&id).map(change);
    }

    /// What all have become; they are pending again. Those of scripts that have ended are gone.
    pub(super) fn take_made(&self) -> Vec<Injection> {
        let mut taken = self.take_ended();
        for one in self.list.borrow_mut().values_mut() {
            taken.push(one.clone());
            one.state = State::Pending;
            one.made = Made::default();
        }
        taken
    }

    /// All soft things there are.
    pub(super) fn softs(&self) -> Vec<(Flex, Handle)> {
        let list = self.list.borrow();
        let softs = list.values().flat_map(|one| one.made.softs.iter());
        softs.cloned().collect()
    }

    /// Whether something is said for the first time.
    pub(super) fn is_new(&self, text: &str) -> bool {
        self.named.borrow_mut().insert(text.to_owned())
    }
}
