//! References between objects: tagged lists of handles, links, dependencies; removal of dead references.

use std::collections::BTreeSet;

use crate::object::viewers::Viewers;
use crate::{Change, Field, Handle, Kind, Object, Scene, SceneResult};

/// Lists of handles by tag.
pub type ReferenceLists = Vec<(String, Vec<i64>)>;

/// How references change when their object is copied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum References {
    /// The copy refers to the copies; references to objects that were not copied become -1.
    Following,
    /// The copy refers to the same objects.
    Original,
}

/// Objects that may contain handles of others, so that a removal does not visit all objects.
#[derive(Debug, Default)]
pub(crate) struct Referrers(BTreeSet<Handle>);

impl Referrers {
    /// Notes an object that is new or was changed.
    pub(crate) fn note(&mut self, object: &Object) {
        if object.refers() {
            self.0.insert(object.handle());
        }
    }
}

impl Object {
    /// Whether this object contains handles of others, apart from parent and children.
    fn refers(&self) -> bool {
        let by_kind = match &self.kind {
            Kind::Joint(joint) => joint.dependency.is_some(),
            Kind::Dummy(dummy) => dummy.link.is_some(),
            Kind::Camera(camera) => camera.tracked.is_some(),
            Kind::ProximitySensor(sensor) => sensor.detection.is_some(),
            _ => false,
        };
        by_kind
            || self.viewers != Viewers::All
            || !self.references.is_empty()
            || !self.original_references.is_empty()
    }

    /// The lists of a kind.
    pub fn reference_lists(&self, kind: References) -> &ReferenceLists {
        match kind {
            References::Following => &self.references,
            References::Original => &self.original_references,
        }
    }

    /// The handles referred to under `tag`; -1 for objects that are gone.
    pub fn referenced(&self, kind: References, tag: &str) -> &[i64] {
        self.reference_lists(kind)
            .iter()
            .find(|(t, _)| t == tag)
            .map_or(&[], |(_, list)| list)
    }

    fn forget(&mut self, removed: &BTreeSet<Handle>) {
        let gone = |h: Handle| removed.contains(&h);
        match &mut self.kind {
            Kind::Joint(joint) if joint.dependency.is_some_and(|d| gone(d.master)) => {
                joint.leave_master();
            }
            Kind::Dummy(dummy) if dummy.link.is_some_and(gone) => dummy.link = None,
            Kind::Camera(camera) if camera.tracked.is_some_and(gone) => camera.tracked = None,
            Kind::ProximitySensor(sensor)
                if sensor.detection.is_some_and(|found| gone(found.object)) =>
            {
                sensor.detection = None;
            }
            _ => {}
        }
        self.viewers = self.viewers.without(removed);
        let lists = self
            .references
            .iter_mut()
            .chain(self.original_references.iter_mut());
        for handle in lists.flat_map(|(_, list)| list.iter_mut()) {
            if Handle::from_raw(*handle).is_some_and(gone) {
                *handle = -1;
            }
        }
    }
}

impl Scene {
    /// Sets what `handle` refers to under `tag`; an empty list removes the tag. Unknown handles become -1.
    pub fn set_references(
        &mut self,
        handle: Handle,
        kind: References,
        tag: &str,
        handles: &[i64],
    ) -> SceneResult<()> {
        let known = |raw: i64| {
            self.collections().get(raw).is_ok()
                || Handle::from_raw(raw).is_some_and(|h| h.raw() == raw && self.exists(h))
        };
        let list: Vec<i64> = handles
            .iter()
            .map(|&raw| if known(raw) { raw } else { -1 })
            .collect();
        self.modify(handle, Field::Other, |object| {
            let lists = match kind {
                References::Following => &mut object.references,
                References::Original => &mut object.original_references,
            };
            match lists.iter_mut().find(|(t, _)| t == tag) {
                _ if list.is_empty() => lists.retain(|(t, _)| t != tag),
                Some((_, old)) => *old = list,
                None => lists.push((tag.to_owned(), list)),
            }
        })
    }

    /// Objects that may contain handles of others, apart from parent and children. The removal of those others changes them, which
    /// the journal does not say.
    pub fn referring_objects(&self) -> impl Iterator<Item = Handle> {
        self.referrers.0.iter().copied()
    }

    /// Removes references to objects that are being removed: links, dependencies, selection, collections, lists of handles. The drawing
    /// objects that move with them are removed.
    pub(crate) fn forget_references(&mut self, removed: &BTreeSet<Handle>) {
        if self.selection.forget(removed) {
            self.note(Change::Selection);
        }
        let collections = self.collections.forget(removed);
        self.drawings.forget(removed);
        self.forget_calculations(removed, &collections);
        self.ik_groups.forget(removed);
        self.button_interfaces.forget(removed);
        let objects = &mut self.objects;
        self.referrers.0.retain(|&handle| {
            let referrer = objects.get_in_place(handle);
            referrer.map(|object| object.forget(removed)).is_ok()
        });
    }
}
