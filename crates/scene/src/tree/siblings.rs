//! The lists of siblings: who is in which, in which order.
//!
//! Each object has a rank, and ranks rise along a list, so that the place of an object in it is found without going through all of it.

use std::collections::{BTreeMap, BTreeSet};

use crate::object::objects::Objects;
use crate::{Handle, Object, Scene, SceneError, SceneResult};

/// Between the ranks of an object and of the next one that is added at the end.
const STEP: i64 = 1 << 32;
/// Between the ranks of an object and of the next one that is put between it and another, where there is room.
const STEP_BETWEEN: i64 = 1 << 16;
/// Members of a list that are less than this part of it are taken out one by one.
const FEW: usize = 64;

impl Scene {
    /// The list `handle` is a member of: its parent's children, or the roots.
    pub fn siblings(&self, handle: Handle) -> SceneResult<&[Handle]> {
        Ok(self.children_of(self.object(handle)?.parent()))
    }

    /// The children of an object, or the roots (None); none where there is no such object.
    pub(crate) fn children_of(&self, parent: Option<Handle>) -> &[Handle] {
        parent.map_or(&self.roots[..], |parent| {
            self.object(parent).map_or(&[], Object::children)
        })
    }

    /// How many siblings are before `handle`.
    ///
    /// # Errors
    /// When it does not exist.
    pub fn place_among_siblings(&self, handle: Handle) -> SceneResult<usize> {
        let rank = self.object(handle)?.rank;
        Ok(place_of(&self.objects, self.siblings(handle)?, rank))
    }

    /// The number of siblings before `handle` that have the same alias: the index in paths such as `/name[2]`. None for an alias that no
    /// sibling has.
    pub fn child_order(&self, handle: Handle) -> SceneResult<Option<usize>> {
        let object = self.object(handle)?;
        let namesakes = self.namesakes.among(object.alias(), object.parent());
        Ok((namesakes.len() > 1).then(|| place_of(&self.objects, namesakes, object.rank)))
    }

    /// Makes an object that is in no list the last child of `parent`, or the last root.
    pub(crate) fn join_siblings(
        &mut self,
        handle: Handle,
        parent: Option<Handle>,
    ) -> SceneResult<()> {
        let last = self.children_of(parent).last();
        let last_rank = last.map_or(Ok(0), |&last| self.object(last).map(|object| object.rank))?;
        self.list_mut(parent)?.push(handle);
        let object = self.object_mut(handle)?;
        (object.parent, object.rank) = (parent, last_rank + STEP);
        self.note_name(handle)
    }

    /// Takes an object out of its list.
    pub(super) fn leave_siblings(&mut self, handle: Handle) -> SceneResult<()> {
        self.forget_name(handle)?;
        let (place, parent) = (
            self.place_among_siblings(handle)?,
            self.object(handle)?.parent(),
        );
        self.list_mut(parent)?.remove(place);
        Ok(())
    }

    /// Takes objects out of their lists. Their children are removed too, or elsewhere by now: they are not looked up through them any more.
    pub(super) fn leave_together(&mut self, leaving: &BTreeSet<Handle>) -> SceneResult<()> {
        let mut by_parent: BTreeMap<Option<Handle>, Vec<Handle>> = BTreeMap::new();
        for &handle in leaving {
            let siblings = by_parent.entry(self.object(handle)?.parent()).or_default();
            siblings.push(handle);
        }
        for (parent, some) in by_parent {
            self.leave_list(parent, &some, leaving)?;
        }
        leaving.iter().try_for_each(|&handle| {
            self.object_mut(handle)?.parent = None;
            Ok(())
        })
    }

    /// Takes some out of the list of children of `parent`: those in it that are `leaving`.
    fn leave_list(
        &mut self,
        parent: Option<Handle>,
        some: &[Handle],
        leaving: &BTreeSet<Handle>,
    ) -> SceneResult<()> {
        if some.len() < self.children_of(parent).len() / FEW {
            return some
                .iter()
                .try_for_each(|&handle| self.leave_siblings(handle));
        }
        // From the end of the lists of namesakes, where most of those that came last are.
        some.iter()
            .rev()
            .try_for_each(|&handle| self.forget_name(handle))?;
        self.list_mut(parent)?
            .retain(|sibling| !leaving.contains(sibling));
        Ok(())
    }

    /// Moves an object to a place in its list, which has that many members at least.
    pub(super) fn move_among_siblings(&mut self, handle: Handle, place: usize) -> SceneResult<()> {
        let parent = self.object(handle)?.parent();
        self.leave_siblings(handle)?;
        let rank = self.rank_for(parent, place)?;
        self.list_mut(parent)?.insert(place, handle);
        self.object_in_place(handle)?.rank = rank;
        self.note_name(handle)
    }

    /// A rank for an object that is to be put at a place.
    fn rank_for(&mut self, parent: Option<Handle>, place: usize) -> SceneResult<i64> {
        let between = |scene: &Self| {
            let rank =
                |at: usize| Some(scene.object(*scene.children_of(parent).get(at)?).ok()?.rank);
            let (before, after) = (place.checked_sub(1).and_then(rank), rank(place));
            rank_between(before, after)
        };
        if let Some(rank) = between(self) {
            return Ok(rank);
        }
        let siblings = self.children_of(parent).to_vec();
        for (sibling, number) in siblings.into_iter().zip(1..) {
            self.object_in_place(sibling)?.rank = number * STEP;
        }
        between(self).ok_or(SceneError::OperationFailed)
    }

    fn list_mut(&mut self, parent: Option<Handle>) -> SceneResult<&mut Vec<Handle>> {
        match parent {
            // Who hangs on an object moves nothing but those who come and go.
            Some(parent) => Ok(&mut self.object_in_place(parent)?.children),
            None => Ok(&mut self.roots),
        }
    }

    /// Enters the alias of an object, which has its place in the tree.
    pub(super) fn note_name(&mut self, handle: Handle) -> SceneResult<()> {
        let object = self.objects.get(handle)?;
        let place = |namesakes: &[Handle]| place_of(&self.objects, namesakes, object.rank);
        self.namesakes
            .add(object.alias(), object.parent(), handle, place);
        Ok(())
    }

    /// The opposite, before the alias or the place changes.
    pub(super) fn forget_name(&mut self, handle: Handle) -> SceneResult<()> {
        let object = self.objects.get(handle)?;
        let place = |namesakes: &[Handle]| place_of(&self.objects, namesakes, object.rank);
        self.namesakes
            .remove(object.alias(), object.parent(), place);
        Ok(())
    }
}

/// How many of these siblings, which are in their order, have a smaller rank.
fn place_of(objects: &Objects, siblings: &[Handle], rank: i64) -> usize {
    let is_before = |sibling: &Handle| objects.get(*sibling).is_ok_and(|object| object.rank < rank);
    match siblings.split_last() {
        // Most are added at the end, or were added last.
        Some((last, _)) if is_before(last) => siblings.len(),
        _ => siblings.partition_point(is_before),
    }
}

/// A rank between two others, of which one or both are missing at the ends of a list; None where there is no room.
fn rank_between(before: Option<i64>, after: Option<i64>) -> Option<i64> {
    match (before, after) {
        (None, None) => Some(0),
        (Some(before), None) => before.checked_add(STEP),
        (None, Some(after)) => after.checked_sub(STEP),
        (Some(before), Some(after)) => {
            let half = (after - before) / 2;
            (half > 0).then(|| before + half.min(STEP_BETWEEN))
        }
    }
}
