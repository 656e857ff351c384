//! Which objects are seen.

use scene::sensor::Entity;
use scene::{Handle, Kind, ModelFlags, Object, ObjectFlags, Scene, SpecialFlags};

/// Which objects a picture shows, of those on the visible layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subjects {
    /// All, as cameras show them.
    Visible,
    /// All that are renderable, as sensors see them.
    Renderable,
    /// This object, renderable or not.
    Object(Handle),
    /// The renderable objects of the collection with this handle, or all of its objects if it says so.
    Collection(i64),
}

/// An object that is seen.
pub(super) struct Subject {
    pub handle: Handle,
    /// It has no depth.
    pub depth_invisible: bool,
}

impl From<Entity> for Subjects {
    fn from(entity: Entity) -> Self {
        match entity {
            Entity::ALL => Self::Renderable,
            _ => entity
                .object()
                .map_or(Self::Collection(entity.raw()), Self::Object),
        }
    }
}

impl Subjects {
    /// The objects that a camera or vision sensor sees, in the order of their handles. An object or collection that does not exist shows
    /// nothing.
    pub(super) fn objects(self, scene: &Scene, viewer: Option<Handle>) -> Vec<Subject> {
        let candidates: Vec<&Object> = match self {
            Self::Visible | Self::Renderable => scene.objects().collect(),
            Self::Object(handle) => scene.object(handle).into_iter().collect(),
            Self::Collection(collection) => {
                let members = scene.collection_objects(collection).unwrap_or_default();
                members
                    .into_iter()
                    .filter_map(|handle| scene.object(handle).ok())
                    .collect()
            }
        };
        let needs_flag = self.needs_flag(scene);
        let is_seen = |object: &&Object| {
            has_looks(object)
                && (!needs_flag || is_renderable(scene, object))
                && scene.is_visible(object.handle()).unwrap_or(false)
                && object.viewers.include(scene, viewer)
        };
        candidates
            .into_iter()
            .filter(is_seen)
            .map(Subject::new)
            .collect()
    }

    fn needs_flag(self, scene: &Scene) -> bool {
        match self {
            Self::Visible | Self::Object(_) => false,
            Self::Renderable => true,
            Self::Collection(handle) => scene
                .collections()
                .get(handle)
                .is_ok_and(|collection| !collection.overrides),
        }
    }
}

impl Subject {
    fn new(object: &Object) -> Self {
        let depth_invisible = object
            .object_property
            .contains(ObjectFlags::DEPTH_INVISIBLE);
        Self {
            handle: object.handle(),
            depth_invisible,
        }
    }
}

fn has_looks(object: &Object) -> bool {
    matches!(
        object.kind,
        Kind::Shape(_) | Kind::OcTree(_) | Kind::PointCloud(_)
    )
}

fn is_renderable(scene: &Scene, object: &Object) -> bool {
    object.special_property.contains(SpecialFlags::RENDERABLE)
        && !scene
            .calculated_model_property(object.handle())
            .contains(ModelFlags::NOT_RENDERABLE)
}
