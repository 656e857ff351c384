//! Scripts that are no scene objects: main script, sandbox, add-ons, and those attached to objects in scenes before 4.7.

use std::rc::Rc;

use super::order::ScriptList;
use super::script::{Detached, Script};
use super::set::ScriptSet;
use scene::Handle;
use scene::object::script_object::{ExecutionPriority, ScriptObject, ScriptType};

impl ScriptSet {
    /// Attaches a script to an object, as scenes before 4.7 have it.
    pub(crate) fn attach(
        &self,
        owner: Handle,
        script: &ScriptObject,
        exec_order: i64,
    ) -> Rc<Script> {
        self.add_detached(
            script.script_type,
            Detached {
                code: script.code.clone(),
                language: script.language.clone(),
                disabled: script.disabled,
                priority: ExecutionPriority::from_order(exec_order),
                owner: Some(owner),
                source: script.source.clone(),
                ..Detached::default()
            },
        )
    }

    /// A new script without an object; returns its handle.
    pub(crate) fn add_without_object(&self, script_type: ScriptType) -> i64 {
        let detached = Detached {
            priority: ExecutionPriority::Normal,
            ..Detached::default()
        };
        self.add_detached(script_type, detached).id
    }

    /// Attaches a script that is no object to an object, or to none.
    pub(crate) fn reattach(&self, script: &Script, owner: Option<Handle>) {
        script.detached.borrow_mut().owner = owner;
        self.note_attached();
    }

    /// Attaches to a copy what is attached to its original.
    pub(crate) fn copy_attached(&self, original: Handle, copy: Handle) {
        for script in self.attached_to(original) {
            let detached = Detached {
                owner: Some(copy),
                ..script.detached.borrow().clone()
            };
            self.add_detached(script.script_type, detached);
        }
    }

    pub(super) fn detached_of(&self, script_type: ScriptType) -> ScriptList {
        let mut list = self.all_detached();
        list.retain(|script| script.script_type == script_type);
        list.sort_by_key(|script| script.detached.borrow().priority);
        list.into()
    }

    pub(super) fn add_on(&self, name: &str) -> Option<Rc<Script>> {
        let mut add_ons = self
            .all_detached()
            .into_iter()
            .filter(|s| s.script_type == ScriptType::AddOn);
        add_ons.find(|script| {
            script
                .detached
                .borrow()
                .name
                .trim_end_matches("@addOnScript")
                == name
        })
    }

    /// Closes every interpreter. A script and its interpreter know each other: without this neither would ever go.
    pub fn close_all(&self) {
        self.all()
            .iter()
            .for_each(|script| drop(script.runtime.take()));
    }
}
