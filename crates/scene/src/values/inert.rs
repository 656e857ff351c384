//! Inert values: stored for scripts without effect, such as display properties and parameters of other physics engines.

use std::collections::BTreeMap;

use crate::{Change, Data, Field, Handle, Scene, SceneResult};

/// Values by property name. Values that were not set are absent; callers supply the default.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct InertValues {
    values: BTreeMap<&'static str, Data>,
}

impl InertValues {
    /// The value of that name, if it was set.
    pub fn get(&self, name: &str) -> Option<&Data> {
        self.values.get(name)
    }

    /// Sets a value; returns whether it changed.
    pub fn set(&mut self, name: &'static str, value: Data) -> bool {
        if self.values.get(name) == Some(&value) {
            return false;
        }
        self.values.insert(name, value);
        true
    }
}

impl Scene {
    /// An inert value of an object, or of the scene (None); None if it was not set.
    ///
    /// # Errors
    /// When the object does not exist.
    pub fn inert_value(&self, owner: Option<Handle>, name: &str) -> SceneResult<Option<&Data>> {
        let values = match owner {
            None => &self.inert,
            Some(handle) => &self.object(handle)?.inert,
        };
        Ok(values.get(name))
    }

    /// Sets an inert value of an object, or of the scene itself (None).
    ///
    /// # Errors
    /// When the object does not exist.
    pub fn set_inert_value(
        &mut self,
        owner: Option<Handle>,
        name: &'static str,
        value: Data,
    ) -> SceneResult<()> {
        let values = match owner {
            None => &mut self.inert,
            Some(handle) => &mut self.object_in_place(handle)?.inert,
        };
        if values.set(name, value) {
            let change = owner.map_or(Change::Settings, |handle| {
                Change::Modified(handle, Field::Inert)
            });
            self.note(change);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Change, Data, Field, Scene};
    use crate::journal::{Topics, Unread};
    use crate::object::dummy::Dummy;
    use crate::{CopyOptions, Kind};

    #[test]
    fn only_new_values_are_changes_and_copies_inherit_them() {
        let mut scene = Scene::new();
        let dummy = scene
            .add("dummy", Kind::Dummy(Dummy::new(0.1)))
            .expect("there is room");
        let mut cursor = scene.journal().follow(Topics::ALL);
        scene.journal().skip(&mut cursor);
        for _ in 0..2 {
            scene
                .set_inert_value(Some(dummy), "assemblyTag", Data::text("a"))
                .expect("the dummy exists");
        }
        let Unread::Changes(changes) = scene.journal().read(&mut cursor) else {
            panic!("nothing was lost")
        };
        assert!(changes.eq(&[Change::Modified(dummy, Field::Inert)]));
        let copies = scene
            .copy_objects(&[dummy], CopyOptions::empty())
            .expect("there is room");
        assert_eq!(
            scene.inert_value(Some(copies[&dummy]), "assemblyTag"),
            Ok(Some(&Data::text("a")))
        );
        assert_eq!(scene.inert_value(None, "assemblyTag"), Ok(None));
    }
}
