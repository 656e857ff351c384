//! Geometry and appearance of objects, prepared for drawing. Cached until the object changes.

use std::collections::BTreeMap;
use std::rc::Rc;

use rendering::{Material, Mesh};

use super::surfaces::Surfaces;
use super::voxels;
use scene::appearance::texture_mapping::TextureSource;
use scene::{Change, Cursor, Field, Handle, Kind, Object, Pose, Scene, Topic, Topics, Unread};

/// Changes of what an object looks like.
const APPEARANCE_TOPICS: Topics = Topics::NONE
    .with(Topic::Added)
    .with(Topic::Removed)
    .with_fields(&[Field::Geometry, Field::Appearance, Field::Texture]);

/// Prepared geometry and appearance of an object.
#[derive(Default)]
pub(super) struct Model {
    pub parts: Vec<ModelPart>,
    pub points: Option<ModelPoints>,
    pub lines: Option<ModelLines>,
    /// It shows what a vision sensor sees, which may be different in each picture.
    pub is_screen: bool,
}

/// A mesh of a model.
pub(super) struct ModelPart {
    pub mesh: Rc<Mesh>,
    pub material: Material,
    /// The same without light, in the auxiliary colour.
    pub auxiliary: Material,
    /// In the frame of the object.
    pub pose: Pose,
}

/// Points of a fixed size on the picture.
pub(super) struct ModelPoints {
    /// In the frame of the object, metres.
    pub positions: Vec<[f64; 3]>,
    pub colours: Vec<[f32; 3]>,
    pub auxiliary: Vec<[f32; 3]>,
    /// Pixels.
    pub size: f32,
    pub overlay: bool,
}

/// Line segments of a fixed width on the picture.
pub(super) struct ModelLines {
    /// In the frame of the object, metres.
    pub segments: Vec<[[f64; 3]; 2]>,
    pub colours: Vec<[f32; 3]>,
    pub auxiliary: Vec<[f32; 3]>,
    /// Pixels.
    pub width: f32,
    pub overlay: bool,
}

/// The models of the objects that were drawn.
#[derive(Default)]
pub(super) struct Models {
    cursor: Option<Cursor>,
    by_object: BTreeMap<Handle, Model>,
    surfaces: Surfaces,
    /// Models were forgotten, and with them perhaps the last use of a mesh.
    may_drop: bool,
}

impl Models {
    /// Forgets what has changed since the last call.
    pub(super) fn follow(&mut self, scene: &Scene) {
        let cursor = self
            .cursor
            .get_or_insert_with(|| scene.journal().follow(APPEARANCE_TOPICS));
        match scene.journal().read(cursor) {
            Unread::Everything => {
                self.by_object.clear();
                self.may_drop = true;
            }
            Unread::Changes(changes) => {
                for changed in changes.filter_map(concerned) {
                    self.may_drop |= self.by_object.remove(&changed).is_some();
                }
            }
        }
    }

    /// Makes sure there are models of these objects.
    pub(super) fn prepare(&mut self, scene: &Scene, objects: &[Handle]) {
        for &handle in objects {
            let stale = self
                .by_object
                .get(&handle)
                .is_none_or(|model| model.is_screen);
            if stale && let Ok(object) = scene.object(handle) {
                let model = self.model(scene, object);
                self.by_object.insert(handle, model);
            }
        }
        // Not before there are new models: they often use the same meshes.
        if std::mem::take(&mut self.may_drop) {
            self.surfaces.drop_unused();
        }
    }

    pub(super) fn get(&self, handle: Handle) -> Option<&Model> {
        self.by_object.get(&handle)
    }

    /// How many meshes are prepared for drawing.
    #[cfg(test)]
    pub(super) fn prepared_meshes(&self) -> usize {
        self.surfaces.prepared_meshes()
    }

    /// How many images are prepared for drawing.
    #[cfg(test)]
    pub(super) fn prepared_images(&self) -> usize {
        self.surfaces.prepared_images()
    }

    fn model(&mut self, scene: &Scene, object: &Object) -> Model {
        match &object.kind {
            Kind::Shape(shape) => Model {
                parts: shape
                    .parts
                    .iter()
                    .filter_map(|part| self.surfaces.part(scene, part))
                    .collect(),
                is_screen: shape.parts.iter().any(|part| {
                    part.texture
                        .as_ref()
                        .is_some_and(|texture| matches!(texture.source, TextureSource::Sensor(_)))
                }),
                ..Model::default()
            },
            Kind::OcTree(octree) => voxels::octree(octree, &object.colour),
            Kind::PointCloud(cloud) => voxels::point_cloud(cloud, &object.colour),
            _ => Model::default(),
        }
    }
}

fn concerned(change: &Change) -> Option<Handle> {
    match change {
        Change::Added(handle) | Change::Removed(handle, _) | Change::Modified(handle, _) => {
            Some(*handle)
        }
        _ => None,
    }
}
