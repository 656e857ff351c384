//! Custom data and signals: named values that scripts store on objects, the scene or the application.
//!
//! A value is stored under a tag: the mark of its type followed by its name. Buffers have no mark, so that raw custom data of a name
//! and its buffer property are the same.

use std::collections::HashMap;

use super::numbered::Numbered;
use crate::{Data, Handle, Scene, SceneResult, ValueType};

/// A modification of named values. Names have no mark of a type, tags have one.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit<'a> {
    /// Sets the value with that tag; None removes it.
    Tag(&'a str, Option<Data>),
    /// Sets the value of that name, in place of one of any other type; None removes it, whatever its type.
    Name(&'a str, Option<(ValueType, Data)>),
    /// Removes everything.
    Clear,
}

/// Result of an edit; names have no marks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Edited<'a> {
    /// Nothing changed.
    Nothing,
    /// The value of that name was set.
    Written(&'a str),
    /// The value of that name was removed.
    Removed(&'a str),
    /// The values of these names, which were all, were removed.
    Cleared(Vec<String>),
}

impl Edited<'_> {
    /// Whether anything is different now.
    pub fn any(&self) -> bool {
        *self != Self::Nothing
    }
}

/// Values of one owner, in the order they were created. Looking for a name, or for the value in a position, takes no longer for many values.
#[derive(Clone, Default)]
pub struct CustomData {
    /// By number, which rises with each new value.
    entries: Numbered<Entry>,
    /// The numbers of the values of each name, which are of different types.
    by_name: HashMap<String, Vec<i64>>,
    next: i64,
}

impl std::fmt::Debug for CustomData {
    /// The values, in their order.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.entries.values()).finish()
    }
}

impl PartialEq for CustomData {
    fn eq(&self, other: &Self) -> bool {
        self.entries.values().eq(other.entries.values())
    }
}

/// One value. The tag it is stored under is the mark of its type and its name.
#[derive(Debug, Clone, PartialEq)]
struct Entry {
    ty: ValueType,
    name: String,
    value: Data,
}

impl CustomData {
    /// The value with that tag.
    pub fn get(&self, tag: &str) -> Option<&Data> {
        let (ty, name) = ValueType::split_tag(tag);
        self.named(name)
            .find(|entry| entry.ty == ty)
            .map(|entry| &entry.value)
    }

    /// The value `name` of whatever type.
    pub fn typed(&self, name: &str) -> Option<(ValueType, &Data)> {
        self.all_typed(name).next()
    }

    /// The values `name` of all types, the oldest first: raw custom data may have one of each.
    pub fn all_typed(&self, name: &str) -> impl Iterator<Item = (ValueType, &Data)> {
        self.named(name).map(|entry| (entry.ty, &entry.value))
    }

    /// The tags in the order of their creation.
    pub fn tags(&self) -> impl Iterator<Item = String> {
        self.entries.values().map(|entry| entry.ty.tag(&entry.name))
    }

    /// The names in the order of their creation.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.values().map(|entry| entry.name.as_str())
    }

    /// How many values there are.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The name at a position in the order of their creation.
    pub fn name_at(&self, position: usize) -> Option<&str> {
        self.entries.nth(position).map(|entry| entry.name.as_str())
    }

    /// Does `edit`. Writing what is there already is no change.
    pub fn edit<'a>(&mut self, edit: Edit<'a>) -> Edited<'a> {
        match edit {
            Edit::Tag(tag, value) => {
                let (ty, name) = ValueType::split_tag(tag);
                match value {
                    Some(value) => written(self.set(ty, name, value), name),
                    None => removed(self.remove(name, |of| of == ty), name),
                }
            }
            Edit::Name(name, Some((ty, value))) => {
                let retyped = self.remove(name, |of| of != ty);
                written(self.set(ty, name, value) || retyped, name)
            }
            Edit::Name(name, None) => removed(self.remove(name, |_| true), name),
            Edit::Clear => self.clear(),
        }
    }

    /// The values of a name, the oldest first.
    fn named(&self, name: &str) -> impl Iterator<Item = &Entry> {
        let numbers = self.by_name.get(name).into_iter().flatten();
        numbers.filter_map(|&number| self.entries.get(number))
    }

    fn set(&mut self, ty: ValueType, name: &str, value: Data) -> bool {
        let numbers = self.by_name.get(name).into_iter().flatten();
        let old = numbers
            .copied()
            .find(|&number| self.entries.get(number).is_some_and(|entry| entry.ty == ty));
        if let Some(entry) = old.and_then(|number| self.entries.get_mut(number)) {
            let is_new = entry.value != value;
            entry.value = value;
            return is_new;
        }
        let (number, name) = (self.next, name.to_owned());
        self.next += 1;
        self.by_name.entry(name.clone()).or_default().push(number);
        self.entries.push(number, Entry { ty, name, value });
        true
    }

    /// Removes the values of a name that have such a type; returns whether there were any.
    fn remove(&mut self, name: &str, is_meant: impl Fn(ValueType) -> bool) -> bool {
        let Some(numbers) = self.by_name.get_mut(name) else {
            return false;
        };
        let before = numbers.len();
        numbers.retain(|&number| {
            let is_meant = self
                .entries
                .get(number)
                .is_none_or(|entry| is_meant(entry.ty));
            if is_meant {
                self.entries.remove(number);
            }
            !is_meant
        });
        let removed = numbers.len() != before;
        if numbers.is_empty() {
            self.by_name.remove(name);
        }
        removed
    }

    fn clear(&mut self) -> Edited<'static> {
        let entries = std::mem::take(self).entries;
        let names: Vec<String> = entries.into_values().map(|entry| entry.name).collect();
        if names.is_empty() {
            Edited::Nothing
        } else {
            Edited::Cleared(names)
        }
    }
}

fn written(changed: bool, name: &str) -> Edited<'_> {
    if changed {
        Edited::Written(name)
    } else {
        Edited::Nothing
    }
}

fn removed(existed: bool, name: &str) -> Edited<'_> {
    if existed {
        Edited::Removed(name)
    } else {
        Edited::Nothing
    }
}

/// The two kinds of named values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Namespace {
    /// Lasting values: they are part of the scene.
    CustomData,
    /// Passing values: they belong to the scripts that set them.
    Signal,
}

/// Who holds named values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Holder {
    /// The application: its values are kept outside of the scene, and outlive it.
    App,
    /// The scene.
    Scene,
    /// An object of the scene.
    Object(Handle),
}

impl Scene {
    /// Named values of an object, or of the scene itself (None).
    pub fn named_values(
        &self,
        owner: Option<Handle>,
        namespace: Namespace,
    ) -> SceneResult<&CustomData> {
        let Some(handle) = owner else {
            return Ok(match namespace {
                Namespace::CustomData => &self.custom_data,
                Namespace::Signal => &self.signals,
            });
        };
        let object = self.object(handle)?;
        Ok(match namespace {
            Namespace::CustomData => &object.custom_data,
            Namespace::Signal => &object.signals,
        })
    }

    /// Changes named values of an object, or of the scene (None); all changes go through here. Returns whether anything changed.
    pub fn edit_named_values(
        &mut self,
        owner: Option<Handle>,
        namespace: Namespace,
        edit: Edit<'_>,
    ) -> SceneResult<bool> {
        let values = match (owner, namespace) {
            (None, Namespace::CustomData) => &mut self.custom_data,
            (None, Namespace::Signal) => &mut self.signals,
            (Some(handle), Namespace::CustomData) => &mut self.object_in_place(handle)?.custom_data,
            (Some(handle), Namespace::Signal) => &mut self.object_in_place(handle)?.signals,
        };
        let edited = values.edit(edit);
        self.journal_mut().note_stored(
            owner.map_or(Holder::Scene, Holder::Object),
            namespace,
            &edited,
        );
        Ok(edited.any())
    }
}

#[cfg(test)]
mod tests {
    use super::{CustomData, Data, Edit, Edited, ValueType};

    #[test]
    fn another_type_takes_the_place_of_the_old_one() {
        let mut data = CustomData::default();
        let int = || Edit::Name("x", Some((ValueType::Int, Data::Int(1))));
        assert_eq!(data.edit(int()), Edited::Written("x"));
        assert_eq!(data.edit(int()), Edited::Nothing);
        let buffer = Data::Buffer(vec![1]);
        assert!(
            data.edit(Edit::Name("x", Some((ValueType::Buffer, buffer.clone()))))
                .any()
        );
        assert!(data.tags().eq(["x"]));
        assert_eq!(data.typed("x"), Some((ValueType::Buffer, &buffer)));
    }

    #[test]
    fn values_keep_the_order_of_their_creation() {
        let mut data = CustomData::default();
        for tag in ["&int&.x", "y", "&dbl&.x", "z"] {
            data.edit(Edit::Tag(tag, Some(Data::Int(1))));
        }
        data.edit(Edit::Tag("y", Some(Data::Int(2))));
        assert!(data.tags().eq(["&int&.x", "y", "&dbl&.x", "z"]));
        assert_eq!(data.typed("x"), Some((ValueType::Int, &Data::Int(1))));
        data.edit(Edit::Name("x", Some((ValueType::Float, Data::Int(3)))));
        assert!(data.tags().eq(["y", "&dbl&.x", "z"]));
        assert_eq!(data.edit(Edit::Name("x", None)), Edited::Removed("x"));
        assert_eq!(data.get("&dbl&.x"), None);
        // One that was removed comes last when it is made again, and equal values are equal however they came about.
        data.edit(Edit::Tag("y", None));
        data.edit(Edit::Tag("y", Some(Data::Int(2))));
        let mut other = CustomData::default();
        other.edit(Edit::Tag("z", Some(Data::Int(1))));
        assert_ne!(data, other);
        other.edit(Edit::Tag("y", Some(Data::Int(2))));
        assert_eq!(data, other);
    }

    #[test]
    fn edits_tell_names_without_marks() {
        let mut data = CustomData::default();
        data.edit(Edit::Name("x", Some((ValueType::Int, Data::Int(1)))));
        data.edit(Edit::Tag("y", Some(Data::Buffer(vec![1]))));
        assert_eq!(data.edit(Edit::Tag("z", None)), Edited::Nothing);
        assert_eq!(data.edit(Edit::Tag("&int&.x", None)), Edited::Removed("x"));
        assert_eq!(data.edit(Edit::Clear), Edited::Cleared(vec!["y".into()]));
        assert_eq!(data.edit(Edit::Clear), Edited::Nothing);
    }

    #[test]
    fn tags_carry_the_type() {
        assert_eq!(ValueType::Float.tag("f"), "&dbl&.f");
        assert_eq!(ValueType::split_tag("&dbl&.f"), (ValueType::Float, "f"));
        assert_eq!(ValueType::split_tag("plain"), (ValueType::Buffer, "plain"));
    }
}
