//! Frames that are defined in each other.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use crate::model::Pose;

/// The frame of a model, inside of its scope.
pub const MODEL: &str = "__model__";
/// What all frames are in at last.
pub const WORLD: &str = "world";
/// Length of a chain of frames of which each is defined in the next one.
const MAX_FRAME_CHAIN: usize = 1000;

/// Frames by their full names (`outer::inner::name`).
#[derive(Debug, Default)]
pub struct Frames(BTreeMap<String, Frame>);

#[derive(Debug, Clone)]
pub struct Frame {
    /// The full name of the frame that it is in.
    pub inside: String,
    pub pose: Pose,
    /// The full name of the link or frame that it moves with: its own, for a link.
    pub attached_to: String,
    /// What names mean that the file says.
    pub scope: String,
    /// The name of another frame that it is in, or moves with; or empty.
    pub said_inside: String,
    pub said_attached_to: String,
}

impl Frames {
    /// Adds a frame; the first of a name counts. False if there is one already.
    pub fn add(&mut self, name: String, frame: Frame) -> bool {
        match self.0.entry(name) {
            Entry::Vacant(place) => {
                place.insert(frame);
                true
            }
            Entry::Occupied(_) => false,
        }
    }

    /// Replaces the names that the file says by full ones. The results are those that mean nothing: the default frame is taken for them.
    pub fn resolve_names(&mut self) -> Vec<String> {
        let mut unknown = Vec::new();
        let mut changes = Vec::new();
        for (name, frame) in &self.0 {
            let mut meant = |said: &String| match self.full_name(&frame.scope, said) {
                Some(full) if full != *name => Some(full),
                _ => {
                    unknown.push(said.clone());
                    None
                }
            };
            let inside = (!frame.said_inside.is_empty())
                .then(|| meant(&frame.said_inside))
                .flatten();
            let attached_to = (!frame.said_attached_to.is_empty())
                .then(|| meant(&frame.said_attached_to))
                .flatten();
            changes.push((name.clone(), inside, attached_to));
        }
        for (name, inside, attached_to) in changes {
            if let Some(frame) = self.0.get_mut(&name) {
                frame.inside = inside.unwrap_or_else(|| frame.inside.clone());
                frame.attached_to = attached_to.unwrap_or_else(|| frame.attached_to.clone());
            }
        }
        unknown
    }

    /// Says which link the frame of a model moves with.
    pub fn attach(&mut self, name: &str, link: String) {
        if let Some(frame) = self.0.get_mut(name) {
            frame.attached_to = link;
        }
    }

    /// What a name in a scope means. A name of a model means its frame.
    pub fn full_name(&self, scope: &str, name: &str) -> Option<String> {
        if name == WORLD {
            return Some(WORLD.to_owned());
        }
        let own = format!("{scope}{name}");
        let model = format!("{own}::{MODEL}");
        [own, model]
            .into_iter()
            .find(|name| self.0.contains_key(name))
    }

    /// The pose of a frame in the world; `None` if it is not there, or defined in itself.
    pub fn in_world(&self, name: &str) -> Option<Pose> {
        self.pose_in(name, WORLD)
    }

    /// The pose of a frame in one of those that it is defined in.
    pub fn pose_in(&self, name: &str, outer: &str) -> Option<Pose> {
        let (mut pose, mut at) = (Pose::identity(), name);
        for _ in 0..MAX_FRAME_CHAIN {
            if at == outer {
                return Some(pose);
            }
            let frame = self.0.get(at)?;
            pose = frame.pose * pose;
            at = &frame.inside;
        }
        None
    }

    /// The link that a frame moves with.
    pub fn link_of(&self, name: &str) -> Option<String> {
        let mut at = name;
        for _ in 0..MAX_FRAME_CHAIN {
            if at == WORLD {
                return Some(WORLD.to_owned());
            }
            let frame = self.0.get(at)?;
            if frame.attached_to == at {
                return Some(at.to_owned());
            }
            at = &frame.attached_to;
        }
        None
    }

    /// Moves the frame of a model so that another frame of it lies where the model's would.
    pub fn place_by(&mut self, model: &str, frame: &str) -> bool {
        let Some(inner) = self.pose_in(frame, model) else {
            return false;
        };
        if let Some(frame) = self.0.get_mut(model) {
            frame.pose *= inner.inverse();
        }
        true
    }
}
