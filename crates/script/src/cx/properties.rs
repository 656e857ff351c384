//! Properties of the application, the scene, objects and scripts, and persistent data.

use std::cell::{Ref, RefMut};

use super::Cx;
use crate::app_storage::{AppStorage, StorageSection};
use crate::error::ApiResult;
use crate::host::AppData;
use crate::property::{Info, PropertyTarget};
use scene::{CustomData, Data, Edit, Namespace, ValueType};

impl Cx<'_> {
    /// The target the calling script means by `raw`.
    ///
    /// # Errors
    /// When there is none.
    pub fn property_target(&self, raw: i64) -> ApiResult<PropertyTarget> {
        self.sim.property_target(raw, self.script())
    }

    /// Value of a property of type `ty`. Reading a random number advances the application's generator, which no event shows.
    ///
    /// # Errors
    /// When there is no such property, or it cannot be read.
    pub fn read_property(
        &self,
        target: &PropertyTarget,
        name: &str,
        ty: ValueType,
    ) -> ApiResult<Data> {
        self.sim.read_property(target, name, ty)
    }

    /// Sets a property; the calling script becomes the owner of a signal.
    ///
    /// # Errors
    /// When there is no such property, or it cannot be written.
    pub fn write_property(
        &mut self,
        target: &PropertyTarget,
        name: &str,
        value: (ValueType, Data),
    ) -> ApiResult<()> {
        self.sim.write_property(target, name, value, self.script())
    }

    /// Removes custom data, a signal or a named parameter.
    ///
    /// # Errors
    /// When there is none, or it cannot be removed.
    pub fn remove_property(&mut self, target: &PropertyTarget, name: &str) -> ApiResult<()> {
        self.sim.remove_property(target, name)
    }

    /// Type and flags of a property; None when there is none of that name.
    pub fn property_info(&self, target: &PropertyTarget, name: &str) -> Option<Info> {
        self.sim.property_info(target, name)
    }

    /// What a property is, in a sentence; empty for those that scripts make.
    pub fn property_description(&self, target: &PropertyTarget, name: &str) -> &'static str {
        self.sim.property_description(target, name)
    }

    /// The property at `index` in the order of enumeration, with its class; None past the end.
    pub fn property_name(
        &self,
        target: &PropertyTarget,
        index: usize,
        prefix: &str,
    ) -> Option<(String, &'static str)> {
        self.sim.property_name(target, index, prefix)
    }

    /// Reads custom data or signals as a whole.
    ///
    /// # Errors
    /// When the target has none or is gone.
    pub fn named_values<R>(
        &self,
        target: &PropertyTarget,
        namespace: Namespace,
        read: impl FnOnce(&CustomData) -> R,
    ) -> ApiResult<R> {
        self.sim.with_named_values(target, namespace, read)
    }

    /// Changes custom data or signals; returns whether anything is different then.
    ///
    /// # Errors
    /// When the target has none or is gone.
    pub fn edit_named_values(
        &mut self,
        target: &PropertyTarget,
        namespace: Namespace,
        edit: Edit<'_>,
    ) -> ApiResult<bool> {
        self.sim.edit_named_values(target, namespace, edit)
    }

    /// Data that scripts store in the application.
    pub fn app(&self) -> Ref<'_, AppData> {
        self.sim.app.borrow()
    }

    /// The same, to change.
    pub fn app_mut(&mut self) -> RefMut<'_, AppData> {
        self.sim.app.borrow_mut()
    }

    /// Bytes in the application's file, which is read at its first use.
    pub fn stored_block(&self, section: StorageSection, tag: &str) -> Option<Vec<u8>> {
        self.sim
            .with_app_storage(|storage| storage.blocks(section).get(tag).cloned())
    }

    /// The tags of the bytes in the application's file, in alphabetical order.
    pub fn stored_tags(&self, section: StorageSection) -> Vec<String> {
        self.sim
            .with_app_storage(|storage| storage.blocks(section).keys().cloned().collect())
    }

    /// Changes what is in the application's file.
    pub fn change_storage<R>(&mut self, change: impl FnOnce(&mut AppStorage) -> R) -> R {
        self.sim.with_app_storage(change)
    }
}
