//! Loads a file into a scene: objects with new handles, then references between them (spec: scene-files 10).

mod button_interfaces;
pub(super) mod cells;
mod collections;
mod common;
mod custom_data;
mod filters;
mod graph;
mod ik_groups;
mod joint;
mod material;
mod mesh;
mod path;
mod references;
mod script;
mod sensors;
mod settings;
mod shape;
mod texture;

use std::collections::BTreeMap;

pub(super) use collections::UNNAMED_COLLECTION;
pub(super) use ik_groups::EXPLICIT as EXPLICIT_IK_GROUP;

use super::{Loaded, LoadedScript, ScriptCode, ScriptSources, read_file};
use crate::ttt::tree::{Class, Object as FileObject};
use crate::ttt::{File, FileError, FileKind, FileResult, Header};
use mesh::Meshes;
use permissions::Permissions;
use scene::object::dummy::{Dummy, LinkType};
use scene::pose::placement::is_valid_pose;
use scene::shape::Shape;
use scene::{Handle, Kind, Scene, SceneResult};
use texture::TextureMap;

/// Data of the file that are needed to interpret a chunk.
struct Context<'a> {
    header: &'a Header,
    file: &'a File,
    meshes: Meshes<'a>,
}

/// From handles of the file to those of the scene. What is missing has gone.
type HandleMap = BTreeMap<i32, Handle>;

/// A file that has been understood, and is not in a scene yet.
pub struct SceneFile {
    file: File,
    kinds: Vec<Kind>,
    attached_sources: Vec<Option<String>>,
}

impl SceneFile {
    /// A binary file or XML.
    ///
    /// # Errors
    /// Describes the fault in the bytes, and its position.
    pub fn read(bytes: &[u8]) -> FileResult<Self> {
        Self::new(read_file(bytes, None, &Permissions::none())?)
    }

    /// The same, with nothing in common with this one.
    ///
    /// # Errors
    /// As [`new`](Self::new), which has taken the same file already.
    pub fn copied(&self) -> FileResult<Self> {
        let source = |kind: &Kind| match kind {
            Kind::Script(script) => script.source.clone(),
            _ => None,
        };
        let sources = ScriptSources {
            objects: self.kinds.iter().map(source).collect(),
            attached: self.attached_sources.clone(),
        };
        Ok(Self::new(self.file.clone())?.with_sources(sources))
    }

    /// Takes the objects and scripts out of a file.
    ///
    /// # Errors
    /// When geometry, a tree of cells or a pose is damaged.
    pub fn new(file: File) -> FileResult<Self> {
        let mut context = Context {
            header: &file.header,
            file: &file,
            meshes: Meshes::new(&file),
        };
        let objects = &file.contents.objects;
        objects.iter().try_for_each(stands_somewhere)?;
        let kinds = objects
            .iter()
            .map(|object| kind_of(&mut context, object))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            file,
            kinds,
            attached_sources: Vec::new(),
        })
    }

    /// With the names of the files that the texts of its scripts are from.
    pub fn with_sources(mut self, sources: ScriptSources) -> Self {
        for (kind, source) in self.kinds.iter_mut().zip(sources.objects) {
            if let Kind::Script(script) = kind {
                script.source = source;
            }
        }
        self.attached_sources = sources.attached;
        self
    }

    /// A model, to be added to a scene; not a scene.
    pub fn is_model(&self) -> bool {
        self.file.contents.model_info.is_some() || self.file.header.kind == FileKind::Model as u8
    }

    /// The file as it was read.
    pub fn file(&self) -> &File {
        &self.file
    }

    /// The scripts, as they would run here. The default main script is not among them.
    pub fn scripts(&self) -> Vec<ScriptCode> {
        let context = Context {
            header: &self.file.header,
            file: &self.file,
            meshes: Meshes::new(&self.file),
        };
        script::texts(&context)
    }

    /// Adds the objects to the scene. With `settings`, those of the scene become those of the file.
    ///
    /// # Errors
    /// When the scene is full.
    pub fn add_to(self, scene: &mut Scene, settings: bool) -> SceneResult<Loaded> {
        let file_is_model = self.is_model();
        let Self {
            file,
            kinds,
            attached_sources,
        } = self;
        let context = Context {
            header: &file.header,
            file: &file,
            meshes: Meshes::new(&file),
        };
        let textures = texture::add(scene, &file.contents.textures)?;
        let objects = file
            .contents
            .objects
            .iter()
            .zip(kinds)
            .map(|(object, kind)| add(scene, &context, object, kind));
        let objects = objects.collect::<SceneResult<Vec<Handle>>>()?;
        let known = file.contents.objects.iter().zip(&objects);
        let map: HandleMap = known
            .filter_map(|(object, handle)| Some((object.common.handles?[0], *handle)))
            .collect();
        let root = place(scene, &file, &objects, &map)?;
        let known_collections = references::connect(scene, &file, &objects, &map)?;
        connect_textures(scene, &objects, &textures, &map)?;
        if settings {
            settings::apply(scene, &file)?;
        }
        for script in &file.contents.scripts {
            script::hand_over(scene, script, &context, &map)?;
        }
        let sources = attached_sources.into_iter().chain(std::iter::repeat(None));
        let scripts = file
            .contents
            .scripts
            .iter()
            .zip(sources)
            .filter_map(|(script, source)| {
                Some(LoadedScript {
                    source,
                    ..script::attached(script, &context, &map)?
                })
            });
        let scripts: Vec<LoadedScript> = scripts.collect();
        let is_attached = |script: &LoadedScript| script.owner.is_some();
        if file_is_model && scripts.iter().any(is_attached) {
            let names = common::names(&file.contents.objects, &objects);
            scene.number_names(&names, &collections::companions(&file))?;
        }
        collections::name(scene, &file, &objects, &known_collections)?;
        references::calculation_objects(scene, &file, &objects, &map, &known_collections.map);
        ik_groups::add(scene, &file, &objects, &map);
        button_interfaces::add(scene, &file, &objects, &map);
        let filters = file
            .contents
            .objects
            .iter()
            .zip(&objects)
            .filter_map(|(o, handle)| filters::script(o, *handle));
        let scripts: Vec<LoadedScript> = scripts.into_iter().chain(filters).collect();
        Ok(Loaded {
            objects,
            root,
            scripts,
        })
    }
}

fn add(
    scene: &mut Scene,
    context: &Context<'_>,
    object: &FileObject,
    kind: Kind,
) -> SceneResult<Handle> {
    let handle = scene.add(&common::alias(&object.common), kind)?;
    common::fill(scene, context, handle, object)?;
    Ok(handle)
}

fn connect_textures(
    scene: &mut Scene,
    objects: &[Handle],
    textures: &TextureMap,
    map: &HandleMap,
) -> SceneResult<()> {
    for &handle in objects {
        let textured = |shape: &Shape| shape.parts.iter().any(|part| part.texture.is_some());
        if scene.object(handle)?.shape().is_ok_and(textured) {
            texture::connect(scene, handle, textures, map)?;
        }
    }
    Ok(())
}

/// The object's type with its data. Types that are gone, or not yet known, become dummies, so that the tree stays whole.
fn kind_of(context: &mut Context<'_>, object: &FileObject) -> FileResult<Kind> {
    Ok(match &object.class {
        Class::Shape(shape) => {
            let shape = shape::shape(context, shape).map_err(|what| damaged(object, what))?;
            Kind::Shape(Box::new(shape))
        }
        Class::Joint(joint) => Kind::Joint(Box::new(joint::joint(context, joint))),
        Class::ForceSensor(sensor) => Kind::ForceSensor(Box::new(joint::force_sensor(sensor))),
        Class::Dummy(dummy) => Kind::Dummy(joint::dummy(dummy)),
        Class::ProximitySensor(sensor) => {
            Kind::ProximitySensor(Box::new(sensors::proximity_sensor(context, sensor)))
        }
        Class::VisionSensor(sensor) => Kind::VisionSensor(Box::new(sensors::vision_sensor(sensor))),
        Class::Camera(camera) => Kind::Camera(Box::new(sensors::camera(camera))),
        Class::Light(light) => Kind::Light(Box::new(sensors::light(light))),
        Class::Graph(graph) => Kind::Graph(Box::new(graph::graph(graph))),
        Class::OcTree(tree) => Kind::OcTree(Box::new(
            cells::octree(tree).map_err(|what| damaged(object, what))?,
        )),
        Class::PointCloud(cloud) => Kind::PointCloud(Box::new(
            cells::point_cloud(cloud).map_err(|what| damaged(object, what))?,
        )),
        Class::ScriptObject(script) => Kind::Script(Box::new(script::object(script, context))),
        Class::Path(path) => Kind::Path(Box::new(path::path(path))),
        Class::Mirror(_)
        | Class::Mill(_)
        | Class::Marker(_)
        | Class::CustomSceneObject(_)
        | Class::Unknown(_) => {
            let mut dummy = Dummy::new(0.01);
            dummy.link_type = LinkType::Default;
            Kind::Dummy(dummy)
        }
    })
}

fn stands_somewhere(object: &FileObject) -> FileResult<()> {
    match object.common.pose.and_then(|pose| pose.pose()) {
        Some(pose) if !is_valid_pose(&pose) => {
            Err(damaged(object, "the pose of an object is no place".into()))
        }
        _ => Ok(()),
    }
}

fn damaged(object: &FileObject, what: String) -> FileError {
    let name = common::alias(&object.common);
    let path = format!("{} ({name})", String::from_utf8_lossy(&object.class.tag()));
    FileError::Chunk {
        offset: object.offset,
        path,
        what,
    }
}

/// Gives all their parents and their order; the last object without parent is the model.
fn place(
    scene: &mut Scene,
    file: &File,
    objects: &[Handle],
    map: &HandleMap,
) -> SceneResult<Option<Handle>> {
    let parent_of = |at: usize| {
        file.contents.objects[at]
            .common
            .handles
            .and_then(|[_, parent]| map.get(&parent).copied())
    };
    for at in sibling_order(file) {
        match parent_of(at) {
            // A file that makes an object its own ancestor is wrong; the object stays at the top.
            Some(parent) if !scene.is_ancestor_or_self(objects[at], parent) => {
                scene.set_parent(objects[at], Some(parent), false)?;
            }
            _ => scene.set_hierarchy_order(objects[at], -1)?,
        }
    }
    Ok((0..objects.len())
        .rev()
        .find(|at| parent_of(*at).is_none())
        .map(|at| objects[at]))
}

/// The objects as siblings come one after another: as in the file, those that share parent and alias by their numbers.
fn sibling_order(file: &File) -> Vec<usize> {
    let objects = &file.contents.objects;
    let mut namesakes: BTreeMap<(i32, String), Vec<usize>> = BTreeMap::new();
    for (at, object) in objects.iter().enumerate() {
        let parent = object.common.handles.map_or(-1, |[_, parent]| parent);
        namesakes
            .entry((parent, common::alias(&object.common)))
            .or_default()
            .push(at);
    }
    let mut order: Vec<usize> = (0..objects.len()).collect();
    for places in namesakes.into_values().filter(|places| places.len() > 1) {
        let mut sorted = places.clone();
        sorted.sort_by_key(|at| objects[*at].common.child_order.unwrap_or(-1));
        places
            .iter()
            .zip(sorted)
            .for_each(|(place, at)| order[*place] = at);
    }
    order
}
