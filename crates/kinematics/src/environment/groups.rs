//! Groups and their elements.

use super::Environment;
use crate::error::{KinematicsError, Result};
use crate::group::{Element, ElementId, Group, GroupId};
use crate::object::ObjectId;

impl Environment {
    /// Adds a group without elements: enabled, pseudo-inverse, three iterations.
    pub fn create_group(&mut self, name: &str) -> GroupId {
        self.groups.push(Group::new(name));
        GroupId(self.groups.len() - 1)
    }

    /// All groups with their numbers, in the order in which they were created.
    pub fn groups(&self) -> impl Iterator<Item = (GroupId, &Group)> {
        self.groups
            .iter()
            .enumerate()
            .map(|(i, group)| (GroupId(i), group))
    }

    /// The first group with that name.
    pub fn group_named(&self, name: &str) -> Option<GroupId> {
        self.groups()
            .find(|(_, group)| group.name == name)
            .map(|(id, _)| id)
    }

    /// A group of the environment.
    ///
    /// # Errors
    /// When there is no such group.
    pub fn group(&self, id: GroupId) -> Result<&Group> {
        self.groups.get(id.0).ok_or(KinematicsError::NoSuchGroup)
    }

    /// A group of the environment, to be changed.
    ///
    /// # Errors
    /// When there is no such group.
    pub fn group_mut(&mut self, id: GroupId) -> Result<&mut Group> {
        self.groups
            .get_mut(id.0)
            .ok_or(KinematicsError::NoSuchGroup)
    }

    /// A tip of a group, with the partner it has when the group is handled as its target.
    ///
    /// # Errors
    /// When there is no such group or dummy.
    pub fn add_element(&mut self, group: GroupId, tip: ObjectId) -> Result<ElementId> {
        self.partner(tip)?;
        let elements = &mut self.group_mut(group)?.elements;
        elements.push(Some(Element::new(tip)));
        let id = ElementId(elements.len() - 1);
        self.changed();
        Ok(id)
    }

    /// An element of a group.
    ///
    /// # Errors
    /// When there is no such element.
    pub fn element(&self, group: GroupId, element: ElementId) -> Result<&Element> {
        let element = self
            .group(group)?
            .elements
            .get(element.0)
            .and_then(Option::as_ref);
        element.ok_or(KinematicsError::NoSuchElement)
    }

    /// An element of a group, to be changed.
    ///
    /// # Errors
    /// When there is no such element.
    pub fn element_mut(&mut self, group: GroupId, element: ElementId) -> Result<&mut Element> {
        self.changed();
        let element = self
            .group_mut(group)?
            .elements
            .get_mut(element.0)
            .and_then(Option::as_mut);
        element.ok_or(KinematicsError::NoSuchElement)
    }

    /// The element with that tip.
    ///
    /// # Errors
    /// When there is none.
    pub fn element_of_tip(&self, group: GroupId, tip: ObjectId) -> Result<ElementId> {
        let mut elements = self.group(group)?.elements();
        elements
            .find(|(_, element)| element.tip == tip)
            .map(|(id, _)| id)
            .ok_or(KinematicsError::NoSuchElement)
    }
}
