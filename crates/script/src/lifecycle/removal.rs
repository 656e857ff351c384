//! Adding, copying and removing objects, of which scripts are notified.

use std::collections::BTreeMap;
use std::rc::Rc;

use crate::clock::SimulationState;
use crate::error::ApiResult;
use crate::host::{Script, Sim, state};
use crate::log::verbosity;
use crate::sys_call::SysCall;
use scene::object::script_object::ScriptType;
use scene::{CopyOptions, Data, Handle, Holder, Key, Kind, SceneError};

impl Sim {
    /// Adds an object and notifies everyone.
    ///
    /// # Errors
    /// When the scene is full.
    pub(crate) fn add_object(self: &Rc<Self>, alias: &str, kind: Kind) -> ApiResult<Handle> {
        let handle = self.scene.borrow_mut().add(alias, kind)?;
        self.notify_created(&[handle]);
        Ok(handle)
    }

    /// Notifies everyone of new objects.
    pub(crate) fn notify_created(self: &Rc<Self>, handles: &[Handle]) {
        if self.scripts.may_respond(SysCall::AfterCreate) {
            let list = raw(handles);
            let data = Data::map([
                ("objects", list.clone().into()),
                ("objectHandles", list.into()),
            ]);
            self.broadcast(SysCall::AfterCreate, &[data]);
        }
    }

    /// Copies objects according to the options; copied scripts are new scripts. Returns originals and copies.
    ///
    /// # Errors
    /// When a handle is unknown or the scene is full.
    pub(crate) fn copy_objects(
        self: &Rc<Self>,
        handles: &[Handle],
        options: CopyOptions,
    ) -> ApiResult<BTreeMap<Handle, Handle>> {
        let originals = self.scene.borrow().objects_to_copy(handles, options);
        if originals.is_empty() {
            return Ok(BTreeMap::new());
        }
        let copies = self.with_copy_callbacks(&originals, || {
            Ok(self.scene.borrow_mut().copy_objects(&originals, options)?)
        })?;
        let created: Vec<Handle> = originals
            .iter()
            .filter_map(|original| copies.get(original).copied())
            .collect();
        copies
            .iter()
            .for_each(|(original, copy)| self.scripts.copy_attached(*original, *copy));
        self.notify_created(&created);
        Ok(copies)
    }

    /// Copies objects, of which scripts are notified before and after. Where it fails, no script is notified afterwards.
    ///
    /// # Errors
    /// Those of `copy`.
    pub(crate) fn with_copy_callbacks<R>(
        self: &Rc<Self>,
        originals: &[Handle],
        copy: impl FnOnce() -> ApiResult<R>,
    ) -> ApiResult<R> {
        let data = self.data_for([SysCall::BeforeCopy, SysCall::AfterCopy], || {
            Data::map([
                ("objects", raw(originals).into()),
                ("objectHandles", marked(originals)),
            ])
        });
        self.broadcast(SysCall::BeforeCopy, data.as_slice());
        let copied = copy()?;
        self.broadcast(SysCall::AfterCopy, data.as_slice());
        Ok(copied)
    }

    /// Removes objects: their scripts are cleaned up first, and scripts are notified before and after.
    ///
    /// # Errors
    /// When a handle is unknown or repeated; nothing happens then.
    pub fn remove_objects(self: &Rc<Self>, handles: &[Handle]) -> ApiResult<()> {
        self.check_removable(handles)?;
        let removed: Vec<Handle> = handles
            .iter()
            .copied()
            .filter(|&handle| self.end_scripts_of(handle))
            .collect();
        if removed.len() < handles.len() {
            let text = "object removal can't be triggered from within the object itself: some objects were not removed.";
            self.log(verbosity::ERRORS, text);
        }
        if removed.is_empty() {
            return Ok(());
        }
        let data = self.data_for([SysCall::BeforeDelete, SysCall::AfterDelete], || {
            self.removal_data(&removed)
        });
        self.broadcast(SysCall::BeforeDelete, data.as_slice());
        self.remove_from_scene(removed)?;
        self.broadcast(SysCall::AfterDelete, data.as_slice());
        Ok(())
    }

    /// Removes all objects at the end of the application, if a script has one of the callbacks about that. `notify` calls those that live
    /// that long. Scripts of the objects end without their cleanup.
    pub(crate) fn remove_scene_at_exit(self: &Rc<Self>, notify: impl Fn(SysCall, &[Data])) {
        let all = self.scene.borrow().all_breadth_first();
        let data = self.data_for([SysCall::BeforeDelete, SysCall::AfterDelete], || {
            self.removal_data(&all)
        });
        if let Some(data) = data.filter(|_| !all.is_empty()) {
            let data = [data];
            notify(SysCall::BeforeDelete, &data);
            // The handles were just read, so none is unknown.
            let _ = self.remove_from_scene(all);
            notify(SysCall::AfterDelete, &data);
        }
    }

    /// The argument of two callbacks, before and after something, if a script has one of them. Where none has, none can come to have one in
    /// between: only callbacks run then.
    fn data_for(&self, calls: [SysCall; 2], data: impl FnOnce() -> Data) -> Option<Data> {
        self.scripts.may_respond_to_any(&calls).then(data)
    }

    /// Removes objects with their scripts and signals. Callbacks may have removed some of them already.
    fn remove_from_scene(&self, mut handles: Vec<Handle>) -> ApiResult<()> {
        handles.retain(|&handle| self.scene.borrow().exists(handle));
        self.scene.borrow_mut().remove(&handles)?;
        for handle in handles {
            self.scripts.remove_those_of(handle);
            self.signal_owners
                .borrow_mut()
                .forget(Holder::Object(handle));
        }
        Ok(())
    }

    fn check_removable(&self, handles: &[Handle]) -> ApiResult<()> {
        let scene = self.scene.borrow();
        let mut unique = handles.to_vec();
        unique.sort_unstable();
        unique.dedup();
        let valid = unique.len() == handles.len() && handles.iter().all(|&h| scene.exists(h));
        if valid {
            Ok(())
        } else {
            Err(SceneError::InvalidHandles.into())
        }
    }

    /// Cleans up the script an object is, if it is one; false when that script is executing.
    fn end_scripts_of(self: &Rc<Self>, handle: Handle) -> bool {
        let mut scripts = self.scripts.attached_to(handle);
        scripts.extend(self.scripts.get(handle.raw()));
        if scripts.iter().any(|script| script.depth() > 0) {
            return false;
        }
        for script in scripts {
            self.end(&script);
            script.set_state(state::ENDED);
            script.removed.set(true);
        }
        true
    }

    fn removal_data(&self, handles: &[Handle]) -> Data {
        let all = handles.len() == self.scene.borrow().len();
        Data::map([
            ("objects", raw(handles).into()),
            ("allObjects", all.into()),
            ("objectHandles", marked(handles)),
        ])
    }

    /// Removes a script that is attached to an object or to none: a customization script at the end of the loop iteration, a simulation
    /// script at once, but not while a simulation runs.
    pub(crate) fn remove_attached_script(self: &Rc<Self>, script: &Rc<Script>) {
        match script.script_type {
            ScriptType::Customization => self
                .removals
                .delayed_scripts
                .borrow_mut()
                .push(Rc::clone(script)),
            ScriptType::Simulation if self.clock.state() == SimulationState::Stopped => {
                if script.depth() > 0 {
                    self.removals
                        .delayed_scripts
                        .borrow_mut()
                        .push(Rc::clone(script));
                } else {
                    self.end_attached_script(script);
                }
            }
            _ => {}
        }
    }

    fn end_attached_script(self: &Rc<Self>, script: &Rc<Script>) {
        if !script.removed.get() {
            self.end(script);
            script.removed.set(true);
            self.scripts.remove_detached(script.id);
        }
    }

    /// Removes the objects and scripts whose removal was deferred.
    pub(crate) fn remove_delayed(self: &Rc<Self>) {
        for script in self.removals.delayed_scripts.take() {
            self.end_attached_script(&script);
        }
        let mut handles = self.removals.take_delayed();
        if handles.is_empty() {
            return;
        }
        handles.retain(|&h| self.scene.borrow().exists(h));
        if let Err(error) = self.remove_objects(&handles) {
            self.log(verbosity::ERRORS, &error.to_string());
        }
    }

    /// Removes the objects that were created during the simulation, if the scene is set to do so.
    pub(crate) fn remove_new_objects(self: &Rc<Self>) {
        let new = self.removals.take_new(&self.scene.borrow());
        if !new.is_empty() && self.scene.borrow().settings().remove_new_objects_at_end {
            // The handles were just read, so none is unknown or repeated.
            let _ = self.remove_objects(&new);
        }
    }
}

fn raw(handles: &[Handle]) -> Vec<i64> {
    handles.iter().map(|handle| handle.raw()).collect()
}

/// A map from each handle to true.
fn marked(handles: &[Handle]) -> Data {
    Data::Map(
        handles
            .iter()
            .map(|handle| (Key::Int(handle.raw()), Data::Bool(true)))
            .collect(),
    )
}
