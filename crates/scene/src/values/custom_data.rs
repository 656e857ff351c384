//! Custom data and signals: named values that scripts store on objects, the scene or the application.
//!
//! A value is stored under a tag: the mark of its type followed by its name. Buffers have no mark, so that raw custom data of a name
//! and its buffer property are the same.

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

/// Values of one owner, in the order they were created.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CustomData {
    entries: Vec<Entry>,
}

/// One value. The tag it is stored under is the mark of its type and its name.
#[derive(Debug, Clone, PartialEq)]
struct Entry {
    ty: ValueType,
    name: String,
    value: Data,
}

impl Entry {
    fn is(&self, ty: ValueType, name: &str) -> bool {
        self.ty == ty && self.name == name
    }
}

impl CustomData {
    /// The value with that tag.
    pub fn get(&self, tag: &str) -> Option<&Data> {
        let (ty, name) = ValueType::split_tag(tag);
        self.entries
            .iter()
            .find(|entry| entry.is(ty, name))
            .map(|entry| &entry.value)
    }

    /// The value `name` of whatever type.
    pub fn typed(&self, name: &str) -> Option<(ValueType, &Data)> {
        self.entries
            .iter()
            .find(|entry| entry.name == name)
            .map(|entry| (entry.ty, &entry.value))
    }

    /// The tags in the order of their creation.
    pub fn tags(&self) -> impl Iterator<Item = String> {
        self.entries.iter().map(|entry| entry.ty.tag(&entry.name))
    }

    /// The names in the order of their creation.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|entry| entry.name.as_str())
    }

    /// Does `edit`. Writing what is there already is no change.
    pub fn edit<'a>(&mut self, edit: Edit<'a>) -> Edited<'a> {
        match edit {
            Edit::Tag(tag, value) => {
                let (ty, name) = ValueType::split_tag(tag);
                match value {
                    Some(value) => written(self.set(ty, name, value), name),
                    None => removed(self.retain(|entry| !entry.is(ty, name)), name),
                }
            }
            Edit::Name(name, Some((ty, value))) => {
                let retyped = self.retain(|entry| entry.name != name || entry.ty == ty);
                written(self.set(ty, name, value) || retyped, name)
            }
            Edit::Name(name, None) => removed(self.retain(|entry| entry.name != name), name),
            Edit::Clear => self.clear(),
        }
    }

    fn set(&mut self, ty: ValueType, name: &str, value: Data) -> bool {
        match self.entries.iter_mut().find(|entry| entry.is(ty, name)) {
            Some(old) if old.value == value => return false,
            Some(old) => old.value = value,
            None => self.entries.push(Entry {
                ty,
                name: name.to_owned(),
                value,
            }),
        }
        true
    }

    /// Returns whether anything was removed.
    fn retain(&mut self, keep: impl FnMut(&Entry) -> bool) -> bool {
        let before = self.entries.len();
        self.entries.retain(keep);
        self.entries.len() != before
    }

    fn clear(&mut self) -> Edited<'static> {
        let names: Vec<String> = self.entries.drain(..).map(|entry| entry.name).collect();
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
