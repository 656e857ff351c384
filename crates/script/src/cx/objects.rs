//! Creation and removal of objects, with the notifications of scripts.

use std::collections::BTreeMap;

use super::Cx;
use crate::error::ApiResult;
use scene::{CopyOptions, Handle, Kind};

impl Cx<'_> {
    /// Adds an object and notifies the scripts.
    ///
    /// # Errors
    /// When the scene is full.
    pub fn add_object(&mut self, alias: &str, kind: Kind) -> ApiResult<Handle> {
        self.sim.add_object(alias, kind)
    }

    /// Notifies the scripts of objects that were added to the scene.
    pub fn notify_created(&mut self, handles: &[Handle]) {
        self.sim.notify_created(handles);
    }

    /// Copies objects; returns originals and copies.
    ///
    /// # Errors
    /// When a handle is unknown or the scene is full.
    pub fn copy_objects(
        &mut self,
        handles: &[Handle],
        options: CopyOptions,
    ) -> ApiResult<BTreeMap<Handle, Handle>> {
        self.sim.copy_objects(handles, options)
    }

    /// Removes objects: their scripts are cleaned up first, and all scripts are notified before and after.
    ///
    /// # Errors
    /// When a handle is unknown or occurs twice; nothing happens then.
    pub fn remove_objects(&mut self, handles: &[Handle]) -> ApiResult<()> {
        self.sim.remove_objects(handles)
    }

    /// Marks objects to be removed at the end of the loop iteration.
    pub fn remove_objects_later(&mut self, handles: &[Handle]) {
        self.sim.removals.delay(handles);
    }
}
