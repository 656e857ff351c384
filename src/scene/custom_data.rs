//! Named values that scripts keep with objects, the scene or the application: custom data and signals.
//!
//! A value is stored under a tag: the mark of its type followed by its name. Buffers have no mark, so that raw custom data of a name
//! and its buffer property are the same.

use super::{Change, Data, Field, Handle, Scene, SceneResult};

macro_rules! value_types {
    ($($variant:ident = $code:literal $word:literal $mark:literal;)*) => {
        /// Type of a property; its number is `sim.propertytype_*`.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum ValueType { $($variant = $code),* }

        impl ValueType {
            const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The type whose constant is `sim.propertytype_<word>`.
            pub fn from_word(word: &str) -> Option<Self> {
                match word { $($word => Some(Self::$variant),)* _ => None }
            }

            /// What precedes the name in a tag.
            fn mark(self) -> &'static str {
                match self { $(Self::$variant => $mark),* }
            }
        }
    };
}

value_types! {
    Bool = 0 "bool" "&bool&.";
    Int = 1 "int" "&int&.";
    Float = 2 "float" "&dbl&.";
    String = 3 "string" "&str&.";
    Buffer = 4 "buffer" "";
    Vector3 = 5 "vector3" "&vect3&.";
    Quaternion = 6 "quaternion" "&quat&.";
    Pose = 7 "pose" "&pose&.";
    Color = 10 "color" "&col&.";
    FloatArray = 11 "floatarray" "&vect&.";
    Table = 12 "table" "&tbl&.";
    IntArray = 13 "intarray" "&ivect&.";
    Vector2 = 14 "vector2" "&vect2&.";
    IntArray2 = 15 "intarray2" "&ivect2&.";
    Long = 16 "long" "&lng&.";
}

impl ValueType {
    /// The tag of the value `name` of this type.
    pub fn tag(self, name: &str) -> String {
        format!("{}{name}", self.mark())
    }

    /// Type and name of a tag.
    pub fn split_tag(tag: &str) -> (Self, &str) {
        let marked = Self::ALL.iter().filter(|ty| !ty.mark().is_empty());
        marked.filter_map(|&ty| Some((ty, tag.strip_prefix(ty.mark())?))).next().unwrap_or((Self::Buffer, tag))
    }
}

/// Values of one owner, in the order they were created.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CustomData {
    entries: Vec<(String, Data)>,
}

impl CustomData {
    /// The value with that tag.
    pub fn get(&self, tag: &str) -> Option<&Data> {
        self.entries.iter().find(|(t, _)| t == tag).map(|(_, value)| value)
    }

    /// Sets the value with that tag; tells whether anything changed.
    pub fn set(&mut self, tag: &str, value: Data) -> bool {
        match self.entries.iter_mut().find(|(t, _)| t == tag) {
            Some((_, old)) if *old == value => false,
            Some((_, old)) => {
                *old = value;
                true
            }
            None => {
                self.entries.push((tag.to_owned(), value));
                true
            }
        }
    }

    /// Removes a tag; tells whether it existed.
    pub fn remove(&mut self, tag: &str) -> bool {
        let before = self.entries.len();
        self.entries.retain(|(t, _)| t != tag);
        self.entries.len() != before
    }

    pub fn clear(&mut self) {
        self.entries.clear();
    }

    /// The tags in the order of their creation.
    pub fn tags(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|(tag, _)| tag.as_str())
    }

    /// The value `name` of whatever type.
    pub fn typed(&self, name: &str) -> Option<(ValueType, &Data)> {
        self.entries.iter().find_map(|(tag, value)| {
            let (ty, tagged) = ValueType::split_tag(tag);
            (tagged == name).then_some((ty, value))
        })
    }

    /// Sets `name` to a value of type `ty`, in place of one of any other type; tells whether anything changed.
    pub fn set_typed(&mut self, name: &str, ty: ValueType, value: Data) -> bool {
        let tag = ty.tag(name);
        self.entries.retain(|(t, _)| *t == tag || ValueType::split_tag(t).1 != name);
        self.set(&tag, value)
    }

    /// Removes `name` of whatever type; tells whether it existed.
    pub fn remove_typed(&mut self, name: &str) -> bool {
        let before = self.entries.len();
        self.entries.retain(|(tag, _)| ValueType::split_tag(tag).1 != name);
        self.entries.len() != before
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

impl Scene {
    /// Named values of an object, or of the scene itself (None).
    pub fn named_values(&self, owner: Option<Handle>, namespace: Namespace) -> SceneResult<&CustomData> {
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

    /// Changes named values; `change` tells whether it did anything, and so does the result.
    pub fn change_named_values(
        &mut self,
        owner: Option<Handle>,
        namespace: Namespace,
        change: impl FnOnce(&mut CustomData) -> bool,
    ) -> SceneResult<bool> {
        let values = match (owner, namespace) {
            (None, Namespace::CustomData) => &mut self.custom_data,
            (None, Namespace::Signal) => &mut self.signals,
            (Some(handle), Namespace::CustomData) => &mut self.object_mut(handle)?.custom_data,
            (Some(handle), Namespace::Signal) => &mut self.object_mut(handle)?.signals,
        };
        let changed = change(values);
        if changed {
            self.note_named_values(owner, namespace);
        }
        Ok(changed)
    }

    fn note_named_values(&mut self, owner: Option<Handle>, namespace: Namespace) {
        let field = match namespace {
            Namespace::CustomData => Field::CustomData,
            Namespace::Signal => Field::Signal,
        };
        let change = owner.map_or(Change::Settings, |handle| Change::Modified(handle, field));
        self.changes_mut().note(change);
    }
}

#[cfg(test)]
mod tests {
    use super::{CustomData, Data, ValueType};

    #[test]
    fn another_type_takes_the_place_of_the_old_one() {
        let mut data = CustomData::default();
        assert!(data.set_typed("x", ValueType::Int, Data::Int(1)));
        assert!(!data.set_typed("x", ValueType::Int, Data::Int(1)));
        assert!(data.set_typed("x", ValueType::Buffer, Data::Buffer(vec![1])));
        assert_eq!(data.tags().collect::<Vec<_>>(), ["x"]);
        assert_eq!(data.typed("x"), Some((ValueType::Buffer, &Data::Buffer(vec![1]))));
    }

    #[test]
    fn tags_carry_the_type() {
        assert_eq!(ValueType::Float.tag("f"), "&dbl&.f");
        assert_eq!(ValueType::split_tag("&dbl&.f"), (ValueType::Float, "f"));
        assert_eq!(ValueType::split_tag("plain"), (ValueType::Buffer, "plain"));
    }
}
