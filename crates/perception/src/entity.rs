//! Who takes part in a query: an object, a collection, or all objects with a flag (spec: sensors 2).

use std::collections::BTreeSet;

use scene::{
    Handle, Kind, ModelFlags, Object, Scene, SceneError, SceneResult, SpecialFlags, special,
};

/// Purpose of a query. Objects have a flag for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Collision detection.
    Collision,
    /// Measurement of distances.
    Distance,
    /// Detection by proximity sensors.
    Detection,
}

impl Purpose {
    fn flag(self) -> SpecialFlags {
        match self {
            Self::Collision => SpecialFlags::COLLIDABLE,
            Self::Distance => SpecialFlags::MEASURABLE,
            Self::Detection => SpecialFlags::DETECTABLE,
        }
    }

    /// The flag of a model that overrides those of its objects.
    fn excluded_by(self) -> ModelFlags {
        match self {
            Self::Collision => ModelFlags::NOT_COLLIDABLE,
            Self::Distance => ModelFlags::NOT_MEASURABLE,
            Self::Detection => ModelFlags::NOT_DETECTABLE,
        }
    }

    /// Whether an object has the flag, and no model above it that overrides it.
    pub fn includes(self, scene: &Scene, object: &Object) -> bool {
        is_solid(&object.kind)
            && object.special_property.intersects(self.flag())
            && !scene
                .calculated_model_property(object.handle())
                .intersects(self.excluded_by())
    }
}

/// Whether an object of that type has something that queries can find.
pub(super) fn is_solid(kind: &Kind) -> bool {
    matches!(
        kind,
        Kind::Shape(_) | Kind::OcTree(_) | Kind::PointCloud(_) | Kind::Dummy(_)
    )
}

/// Entity named by a script.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Entity {
    /// An object.
    Object(Handle),
    /// A collection, by its handle.
    Collection(i64),
    /// All objects with the flag of the purpose.
    All,
}

impl Entity {
    /// The object or collection with that handle.
    ///
    /// # Errors
    /// When there is none.
    pub fn named(scene: &Scene, raw: i64) -> SceneResult<Self> {
        if let Some(object) = Handle::from_raw(raw).filter(|&handle| scene.exists(handle)) {
            return Ok(Self::Object(object));
        }
        scene
            .collections()
            .get(raw)
            .map(|_| Self::Collection(raw))
            .map_err(|_| SceneError::NoSuchEntity)
    }

    /// The same, or `sim.handle_all`.
    ///
    /// # Errors
    /// When there is no such object or collection.
    pub fn named_or_all(scene: &Scene, raw: i64) -> SceneResult<Self> {
        if raw == special::ALL {
            Ok(Self::All)
        } else {
            Self::named(scene, raw)
        }
    }

    /// The objects that take part. Flags of an object that is named alone do not count.
    pub fn group(self, scene: &Scene, purpose: Purpose) -> Group {
        match self {
            Self::All => Group::All {
                except: BTreeSet::new(),
            },
            _ => Group::List(self.objects(scene, purpose)),
        }
    }

    /// The same as a list, in the order of the scene.
    pub(super) fn objects(self, scene: &Scene, purpose: Purpose) -> Vec<Handle> {
        match self {
            Self::Object(object) => vec![object],
            Self::Collection(collection) => members(scene, collection, purpose),
            Self::All => {
                let included = scene
                    .objects()
                    .filter(|object| purpose.includes(scene, object));
                included.map(Object::handle).collect()
            }
        }
    }

    /// The objects that take part against `self` where `other` was named.
    pub(crate) fn opponents(self, scene: &Scene, other: Self, purpose: Purpose) -> Group {
        if other != Self::All {
            return other.group(scene, purpose);
        }
        let except = match self {
            Self::Object(object) => BTreeSet::from([object]),
            Self::Collection(collection) => scene
                .collection_objects(collection)
                .unwrap_or_default()
                .into_iter()
                .collect(),
            Self::All => BTreeSet::new(),
        };
        Group::All { except }
    }
}

/// The members of a collection that count: those with the flag, or all of those that can, if the collection overrides flags.
fn members(scene: &Scene, collection: i64, purpose: Purpose) -> Vec<Handle> {
    let Ok(overrides) = scene
        .collections()
        .get(collection)
        .map(|collection| collection.overrides)
    else {
        return Vec::new();
    };
    let mut members = scene.collection_objects(collection).unwrap_or_default();
    let counts = |object: &Object| {
        if overrides {
            is_solid(&object.kind)
        } else {
            purpose.includes(scene, object)
        }
    };
    members.retain(|&member| scene.object(member).is_ok_and(counts));
    members
}

/// The objects on one side of a query.
#[derive(Debug, Clone, PartialEq)]
pub enum Group {
    /// In the order of the scene.
    List(Vec<Handle>),
    /// All objects with the flag, except for some.
    All {
        /// Objects that do not count.
        except: BTreeSet<Handle>,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::cuboid;
    use scene::object::dummy::Dummy;
    use scene::{CollectionItem, Field, ItemOptions, Members};

    #[test]
    fn a_model_switches_off_what_is_below() {
        let mut scene = Scene::new();
        let (base, link) = (cuboid(&mut scene, 0.0), cuboid(&mut scene, 0.0));
        scene.set_parent(link, Some(base), true).unwrap();
        let includes =
            |scene: &Scene, purpose: Purpose| purpose.includes(scene, scene.object(link).unwrap());
        assert!(includes(&scene, Purpose::Collision));
        let flags = ModelFlags::NOT_COLLIDABLE | ModelFlags::NOT_DETECTABLE;
        scene
            .modify(base, Field::ModelProperty, |object| {
                object.set_model_property(flags);
            })
            .unwrap();
        assert!(!includes(&scene, Purpose::Collision) && !includes(&scene, Purpose::Detection));
        assert!(includes(&scene, Purpose::Distance));
    }

    #[test]
    fn collections_override_flags_if_they_say_so() {
        let mut scene = Scene::new();
        let (shape, dummy) = (
            cuboid(&mut scene, 0.0),
            scene.add("dummy", Kind::Dummy(Dummy::new(0.01))).unwrap(),
        );
        // Nothing of a camera can be found, whatever flags say.
        scene.add("camera", Kind::Camera(Box::default())).unwrap();
        for (overrides, expected) in [(false, vec![shape]), (true, vec![shape, dummy])] {
            let collection = scene.collections_mut().add(overrides, None);
            let all = CollectionItem::new(Members::All, ItemOptions::empty());
            scene
                .collections_mut()
                .get_mut(collection)
                .unwrap()
                .items
                .push(all);
            let entity = Entity::named(&scene, collection).unwrap();
            assert_eq!(
                entity.group(&scene, Purpose::Detection),
                Group::List(expected)
            );
        }
        assert_eq!(
            Entity::Object(dummy).group(&scene, Purpose::Detection),
            Group::List(vec![dummy])
        );
    }

    #[test]
    fn unknown_entities_are_refused() {
        let scene = Scene::new();
        for raw in [12345, 2_000_000, i64::MAX, i64::MIN, -1, special::ALL] {
            assert_eq!(
                Entity::named(&scene, raw),
                Err(SceneError::NoSuchEntity),
                "{raw}"
            );
        }
        assert_eq!(Entity::named_or_all(&scene, special::ALL), Ok(Entity::All));
    }
}
