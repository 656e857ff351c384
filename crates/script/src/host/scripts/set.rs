//! The scripts of a simulator: execution order, callbacks in use, call depth.

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::order::OrderCache;
use crate::budget::Budget;
use crate::host::{Debugger, Detached, Languages, Script, Sim};
use crate::sys_call::SysCall;
use scene::object::script_object::ScriptType;
use scene::{Field, Handle, Mark, Scene, Topics};

/// Changes that can disable a script of the scene, or remove it.
const SCRIPTS: Topics = Topics::TREE.with_fields(&[Field::Script]);

/// The first handle of scripts that are no scene objects.
const FIRST_DETACHED: i64 = 1_010_000;

/// Maximum nesting of calls between scripts: each level uses native stack, and an interpreter only bounds its own recursion.
pub(crate) const MAX_DEPTH: usize = 100;

/// Releases what a script has outside of the host, before its interpreter goes.
pub(crate) type EndOfScript = fn(&Rc<Sim>, &Script);

/// All scripts that have been looked up, and those that are no scene objects.
pub struct ScriptSet {
    /// The languages they can be written in.
    pub(crate) languages: Languages,
    /// Who decides where they stop; set before they start.
    pub debugger: OnceCell<Rc<dyn Debugger>>,
    /// The debugger goes to another moment: code that runs is to end.
    pub(crate) is_abandoned: Cell<bool>,
    /// The memory all of them share.
    pub(crate) budget: Rc<Budget>,
    by_id: RefCell<BTreeMap<i64, Rc<Script>>>,
    /// Those that are no scene objects: few, where there may be thousands of others.
    detached: RefCell<BTreeMap<i64, Rc<Script>>>,
    next_detached: Cell<i64>,
    /// There are, or were, scripts attached to objects; most scenes have none.
    has_attached: Cell<bool>,
    pub(crate) order: RefCell<OrderCache>,
    /// A number that rises when scripts of the scene change, and the changes it knows of.
    edition: Cell<u64>,
    edition_mark: RefCell<Mark>,
    /// Callbacks some script has or had, as bits.
    callbacks_in_use: Cell<u64>,
    /// Script calls in progress, over all states.
    depth: Cell<usize>,
    /// The selection that scripts were last notified of.
    notified_selection: RefCell<Vec<Handle>>,
    /// What random numbers begin with.
    pub(crate) seed: Cell<u32>,
    /// What is to be done when a script ends.
    ends: RefCell<Vec<EndOfScript>>,
    /// Vision sensors whose scripts are looking at the picture now.
    pub(crate) examined_sensors: RefCell<BTreeSet<Handle>>,
}

impl ScriptSet {
    /// No scripts yet, which may use `memory` bytes, and whose random numbers begin with `seed`.
    pub(crate) fn new(languages: Languages, memory: usize, seed: u32) -> Self {
        Self {
            languages,
            seed: Cell::new(seed),
            budget: Rc::new(Budget::new(memory)),
            debugger: OnceCell::new(),
            is_abandoned: Cell::new(false),
            by_id: RefCell::default(),
            detached: RefCell::default(),
            next_detached: Cell::new(FIRST_DETACHED),
            has_attached: Cell::new(false),
            order: RefCell::default(),
            edition: Cell::new(0),
            edition_mark: RefCell::new(Mark::new(SCRIPTS)),
            callbacks_in_use: Cell::new(0),
            depth: Cell::new(0),
            notified_selection: RefCell::default(),
            ends: RefCell::default(),
            examined_sensors: RefCell::default(),
        }
    }

    /// From now on `end` is called when a script ends.
    pub(crate) fn at_end(&self, end: EndOfScript) {
        self.ends.borrow_mut().push(end);
    }

    /// The interpreter of a script is about to go.
    pub(crate) fn announce_end(&self, sim: &Rc<Sim>, script: &Script) {
        let ends = self.ends.borrow().clone();
        ends.iter().for_each(|end| end(sim, script));
    }

    /// The number of changes of scripts of the scene so far, from 1.
    pub(crate) fn edition(&self, scene: &Scene) -> u64 {
        if scene
            .journal()
            .changed_since(&mut self.edition_mark.borrow_mut())
        {
            self.edition.set(self.edition.get() + 1);
        }
        self.edition.get()
    }

    /// Adds a script that is no scene object.
    pub fn add_detached(&self, script_type: ScriptType, detached: Detached) -> Rc<Script> {
        if detached.owner.is_some() {
            self.has_attached.set(true);
        }
        let id = self.next_detached.replace(self.next_detached.get() + 1);
        let script = Rc::new(Script::detached(id, script_type, detached));
        self.add(&script);
        self.forget_order();
        script
    }

    pub(crate) fn add(&self, script: &Rc<Script>) {
        self.by_id.borrow_mut().insert(script.id, Rc::clone(script));
        if script.object.is_none() {
            self.detached
                .borrow_mut()
                .insert(script.id, Rc::clone(script));
        }
    }

    /// The script with that handle, if it has been looked up before.
    pub(crate) fn get(&self, id: i64) -> Option<Rc<Script>> {
        self.by_id.borrow().get(&id).cloned()
    }

    /// All scripts by handle: objects first, then those that are none, in the order of their creation.
    pub(crate) fn all(&self) -> Vec<Rc<Script>> {
        self.by_id.borrow().values().cloned().collect()
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.by_id.borrow().len()
    }

    /// Shows all scripts in the order of [`all`](Self::all), while none comes or goes.
    pub(crate) fn for_each(&self, look: impl FnMut(&Rc<Script>)) {
        self.by_id.borrow().values().for_each(look);
    }

    /// The one script of that type without an object: main or sandbox.
    pub fn detached(&self, script_type: ScriptType) -> Option<Rc<Script>> {
        self.detached
            .borrow()
            .values()
            .find(|script| script.script_type == script_type)
            .cloned()
    }

    /// All scripts that are no objects, in the order of their creation.
    pub(crate) fn all_detached(&self) -> Vec<Rc<Script>> {
        self.detached.borrow().values().cloned().collect()
    }

    /// The old scripts attached to an object, simulation scripts first.
    pub(crate) fn attached_to(&self, object: Handle) -> Vec<Rc<Script>> {
        if !self.has_attached.get() {
            return Vec::new();
        }
        let scripts = self.detached.borrow();
        let mut attached: Vec<_> = scripts
            .values()
            .filter(|script| script.owner() == Some(object))
            .cloned()
            .collect();
        attached.sort_by_key(|script| script.script_type != ScriptType::Simulation);
        attached
    }

    /// The objects that have old scripts attached to them.
    pub(crate) fn owners(&self) -> BTreeSet<Handle> {
        if !self.has_attached.get() {
            return BTreeSet::new();
        }
        self.detached
            .borrow()
            .values()
            .filter_map(|script| script.owner())
            .collect()
    }

    /// Removes the script an object was, and those attached to it.
    pub(crate) fn remove_those_of(&self, object: Handle) {
        self.by_id.borrow_mut().remove(&object.raw());
        for attached in self.attached_to(object) {
            self.by_id.borrow_mut().remove(&attached.id);
            self.detached.borrow_mut().remove(&attached.id);
        }
    }

    /// Removes a script that is no object.
    pub(crate) fn remove_detached(&self, id: i64) {
        self.by_id.borrow_mut().remove(&id);
        self.detached.borrow_mut().remove(&id);
        self.forget_order();
    }

    /// Notes that a script without an object got one.
    pub(crate) fn note_attached(&self) {
        self.has_attached.set(true);
        self.forget_order();
    }

    /// A priority has changed, or a script without an object came.
    pub(crate) fn forget_order(&self) {
        self.order.borrow_mut().forget();
    }

    /// Remembers that some script has these callbacks, so that the others need not be offered to anyone.
    pub(crate) fn note_callbacks(&self, bits: u64) {
        self.callbacks_in_use
            .set(self.callbacks_in_use.get() | bits);
    }

    /// Whether a script can respond to `call`: one has or had the callback, or the call starts scripts.
    pub(crate) fn may_respond(&self, call: SysCall) -> bool {
        call.wakes() || self.callbacks_in_use.get() & call.bit() != 0
    }

    pub(crate) fn may_respond_to_any(&self, calls: &[SysCall]) -> bool {
        calls.iter().any(|&call| self.may_respond(call))
    }

    /// Script calls in progress, over all states.
    pub(crate) fn depth(&self) -> usize {
        self.depth.get()
    }

    /// Counts a call that begins; false when calls nest too deep.
    pub(crate) fn enter(&self) -> bool {
        self.depth.replace(self.depth.get() + 1) < MAX_DEPTH
    }

    pub(crate) fn leave(&self) {
        self.depth.set(self.depth.get() - 1);
    }

    /// Notes the selection scripts are notified of; false when it is the one they know.
    pub(crate) fn note_selection(&self, selection: &[Handle]) -> bool {
        let mut notified = self.notified_selection.borrow_mut();
        let differs = *notified != selection;
        if differs {
            *notified = selection.to_vec();
        }
        differs
    }
}
