//! The object tree: parents, order among siblings, enumeration, removal.

use std::collections::{BTreeSet, HashMap, VecDeque};

use crate::pose::placement::normalized;
use crate::{Change, Data, Field, Handle, ModelFlags, Scene, SceneError, SceneResult};

/// Name of the custom data of a shape below which what is touched is a tree of its own: the ground in a file with a robot that hangs on it.
pub const COLLISION_TREE: &str = "collisionTree";
/// Name of the custom data of a shape that are further bits of its respondable mask: shapes of one tree touch that have one of them in common.
pub const COLLISION_BITS: &str = "collisionBits";
/// How many bits [`COLLISION_BITS`] has.
pub const FURTHER_BITS: u32 = 48;

impl Scene {
    /// Root objects in scene order.
    pub fn roots(&self) -> &[Handle] {
        &self.roots
    }

    /// The children of `parent` (None: the roots), each with its [`child_order`](Self::child_order).
    pub fn child_orders(&self, parent: Option<Handle>) -> Vec<(Handle, Option<usize>)> {
        let named = self
            .children_of(parent)
            .iter()
            .filter_map(|&child| Some((child, self.object(child).ok()?.alias())));
        let named: Vec<(Handle, &str)> = named.collect();
        let mut namesakes: HashMap<&str, usize> = HashMap::new();
        named
            .iter()
            .for_each(|(_, alias)| *namesakes.entry(alias).or_default() += 1);
        let mut next: HashMap<&str, usize> = HashMap::new();
        let ordered = named.into_iter().map(|(child, alias)| {
            let order = next.entry(alias).or_default();
            *order += 1;
            (child, (namesakes[alias] > 1).then_some(*order - 1))
        });
        ordered.collect()
    }

    /// Whether `ancestor` is `handle` or lies above it.
    pub fn is_ancestor_or_self(&self, ancestor: Handle, handle: Handle) -> bool {
        let has_children = || {
            self.object(ancestor)
                .is_ok_and(|object| !object.children().is_empty())
        };
        ancestor == handle || has_children() && self.ancestors(handle).any(|h| h == ancestor)
    }

    /// Parent, grandparent, ... up to the root.
    pub fn ancestors(&self, handle: Handle) -> impl Iterator<Item = Handle> {
        let parent = move |h: Handle| self.object(h).ok().and_then(crate::Object::parent);
        std::iter::successors(parent(handle), move |&h| parent(h))
    }

    /// The shape whose tree a shape belongs to where collisions are concerned: the nearest one, itself included, with the custom data [`COLLISION_TREE`], else its
    /// root.
    pub fn collision_root_of(&self, handle: Handle) -> Handle {
        let mut at = handle;
        while let Ok(object) = self.object(at) {
            match object.parent() {
                _ if object.custom_data.typed(COLLISION_TREE).is_some() => return at,
                Some(parent) => at = parent,
                None => return at,
            }
        }
        at
    }

    /// The further bits of the respondable mask of a shape, within its tree; 0 for one without.
    pub fn collision_bits_of(&self, handle: Handle) -> u64 {
        let object = self.object(handle).ok();
        let value = object.and_then(|object| object.custom_data.typed(COLLISION_BITS));
        match value {
            Some((_, Data::Int(bits))) => bits.cast_unsigned() & ((1 << FURTHER_BITS) - 1),
            _ => 0,
        }
    }

    /// The root of the tree `handle` belongs to.
    pub fn root_of(&self, handle: Handle) -> Handle {
        self.ancestors(handle).last().unwrap_or(handle)
    }

    /// Makes `handle` the last child of `parent` (None: the last root). With `keep_in_place` it stays where it is in the world,
    /// otherwise its local pose is kept.
    ///
    /// # Errors
    /// When one of them does not exist, or `handle` is `parent` or an ancestor of it.
    pub fn set_parent(
        &mut self,
        handle: Handle,
        parent: Option<Handle>,
        keep_in_place: bool,
    ) -> SceneResult<()> {
        let old = self.object(handle)?.parent();
        if let Some(parent) = parent {
            self.object(parent)?;
            if self.is_ancestor_or_self(handle, parent) {
                return Err(SceneError::AncestorOfParent);
            }
        }
        if old == parent {
            return Ok(());
        }
        let world = keep_in_place.then(|| self.world_pose(handle)).transpose()?;
        self.leave_siblings(handle)?;
        self.join_siblings(handle, parent)?;
        self.set_dynamic_when_parented(handle)?;
        for end in [old, parent].into_iter().flatten() {
            self.clear_physics_error(end)?;
        }
        if let Some(world) = world {
            let local = self.parent_frame(handle)?.inverse() * world;
            self.object_mut(handle)?.pose = normalized(local);
        }
        self.note(Change::Modified(handle, Field::Parent));
        Ok(())
    }

    /// Some shapes stop being static when they get a parent.
    fn set_dynamic_when_parented(&mut self, handle: Handle) -> SceneResult<()> {
        let object = self.object_mut(handle)?;
        let parented = object.parent.is_some();
        if let crate::Kind::Shape(shape) = &mut object.kind
            && shape.dynamics.dynamic_when_parented
            && parented
        {
            shape.dynamics.is_static = false;
        }
        Ok(())
    }

    /// (Un)linking below a joint or force sensor ends the deviation the physics had left there.
    fn clear_physics_error(&mut self, handle: Handle) -> SceneResult<()> {
        let has_error = match &self.object(handle)?.kind {
            crate::Kind::Joint(joint) => joint.error.is_some(),
            crate::Kind::ForceSensor(sensor) => sensor.error.is_some(),
            _ => false,
        };
        // Where there is none, what hangs on the object has not moved.
        if has_error {
            match &mut self.object_mut(handle)?.kind {
                crate::Kind::Joint(joint) => joint.error = None,
                crate::Kind::ForceSensor(sensor) => sensor.error = None,
                _ => {}
            }
        }
        Ok(())
    }

    /// Moves `handle` to `position` among its siblings; negative positions count from the end.
    ///
    /// # Errors
    /// When the position lies outside of the list.
    pub fn set_hierarchy_order(&mut self, handle: Handle, position: i64) -> SceneResult<()> {
        let len = self.siblings(handle)?.len() as i64;
        let target = if position < 0 {
            len + position
        } else {
            position
        };
        if !(0..len).contains(&target) {
            return Err(SceneError::OperationFailed);
        }
        self.move_among_siblings(handle, target as usize)?;
        self.note(Change::Modified(handle, Field::Parent));
        Ok(())
    }

    /// `base` and everything below it, breadth first, children in order.
    pub fn subtree(&self, base: Handle) -> Vec<Handle> {
        self.breadth_first([base])
    }

    /// Every object, breadth first from the roots.
    pub fn all_breadth_first(&self) -> Vec<Handle> {
        self.breadth_first(self.roots.iter().copied())
    }

    /// `base` (None: the scene) and what is below it, breadth first; with `shallow` only one level below `base`, or the roots.
    ///
    /// # Errors
    /// When `base` does not exist.
    pub fn tree(&self, base: Option<Handle>, shallow: bool) -> SceneResult<Vec<Handle>> {
        Ok(match base {
            Some(base) if shallow => std::iter::once(base)
                .chain(self.object(base)?.children().iter().copied())
                .collect(),
            Some(base) => {
                self.object(base)?;
                self.subtree(base)
            }
            None if shallow => self.roots.clone(),
            None => self.all_breadth_first(),
        })
    }

    fn breadth_first(&self, start: impl IntoIterator<Item = Handle>) -> Vec<Handle> {
        let mut queue: VecDeque<Handle> = start.into_iter().collect();
        let mut out = Vec::new();
        while let Some(handle) = queue.pop_front() {
            out.push(handle);
            if let Ok(object) = self.object(handle) {
                queue.extend(object.children());
            }
        }
        out
    }

    /// Flags of all model bases from `handle` up to its root, OR-ed.
    pub fn calculated_model_property(&self, handle: Handle) -> ModelFlags {
        std::iter::once(handle)
            .chain(self.ancestors(handle))
            .filter_map(|h| self.object(h).ok())
            .filter(|object| object.is_model())
            .fold(ModelFlags::empty(), |flags, object| {
                flags | object.model_property
            })
    }

    /// Removes objects. Their children survive: they go to the nearest surviving ancestor and keep their place in the world, object
    /// by object in the order of their creation.
    ///
    /// # Errors
    /// When a handle is unknown or given twice; nothing is removed then.
    pub fn remove(&mut self, handles: &[Handle]) -> SceneResult<()> {
        let removed: BTreeSet<Handle> = handles.iter().copied().collect();
        if removed.len() != handles.len() || handles.iter().any(|&h| !self.exists(h)) {
            return Err(SceneError::InvalidHandles);
        }
        for orphan in self.children_outside(&removed) {
            let heir = self.ancestors(orphan).find(|h| !removed.contains(h));
            self.set_parent(orphan, heir, true)?;
        }
        self.forget_references(&removed);
        self.leave_together(&removed)?;
        handles.iter().for_each(|&handle| self.erase(handle));
        Ok(())
    }

    fn children_outside(&self, removed: &BTreeSet<Handle>) -> Vec<Handle> {
        let mut orphans: Vec<&crate::Object> = removed
            .iter()
            .filter_map(|&h| self.object(h).ok())
            .flat_map(|object| object.children().iter())
            .filter(|child| !removed.contains(child))
            .filter_map(|&child| self.object(child).ok())
            .collect();
        orphans.sort_by_key(|object| object.uid());
        orphans.into_iter().map(crate::Object::handle).collect()
    }
}
