//! Saves a scene as a file that CoppeliaSim reads (serialization 25): the inverse of `load`.
//!
//! Written is what the scene holds. Chunks that only programs before 4.5 look at are left out, apart from the geometry frames that
//! early revisions of 4.5.1 still use.

mod button_interfaces;
mod calculation_objects;
mod cells;
mod colour;
mod common;
mod custom_data;
mod edges;
mod graph;
mod ik_groups;
mod mechanics;
mod mesh;
mod path;
mod script;
mod sensors;
mod settings;
mod shape;
mod texture;

use std::collections::BTreeSet;

use super::LoadedScript;
use crate::ttt::chunks::ModelInfo;
use crate::ttt::tree::{Class, Contents, Object as FileObject};
use crate::ttt::{File, FileKind, Header};
use mesh::Pool;
use scene::shape::Shape;
use scene::{Handle, Kind, Object, Pose, Scene, SceneResult};

/// Data of the scene that are needed to write an object.
struct Context<'a> {
    scene: &'a Scene,
    /// The objects that are saved; others cannot be referred to.
    saved: BTreeSet<Handle>,
    pool: Pool,
}

impl Context<'_> {
    /// The handle as the file has it: those of the scene, -1 for what is not saved.
    fn file_handle(&self, handle: Option<Handle>) -> i32 {
        handle
            .filter(|handle| self.saved.contains(handle))
            .map_or(-1, |handle| handle.0.cast_signed())
    }
}

/// The whole scene as a file. `scripts` are those outside of the tree; without a main script among them, the default one is meant.
///
/// # Errors
/// When the tree of the scene is damaged.
pub fn scene(scene: &Scene, scripts: &[LoadedScript]) -> SceneResult<File> {
    let order = depth_first(scene, scene.roots());
    let mut contents = contents(scene, &order, None, scripts)?;
    settings::fill(&mut contents, scene);
    let main = scripts.iter().find(|script| script.owner.is_none());
    contents
        .scripts
        .insert(0, main.map_or_else(script::default_main, script::main));
    Ok(file(FileKind::Scene, contents))
}

/// A model as a file: the tree below `base`, which stands where it is in the world.
///
/// # Errors
/// When there is no such object.
pub fn model(scene: &Scene, base: Handle, scripts: &[LoadedScript]) -> SceneResult<File> {
    let order = depth_first(scene, &[base]);
    let mut contents = contents(scene, &order, Some(base), scripts)?;
    contents.model_info = Some(ModelInfo {
        pose_box_step: Some((
            scene.world_pose(base)?.into(),
            model_size(scene, &order, base)?,
            0.0,
        )),
    });
    Ok(file(FileKind::Model, contents))
}

fn file(kind: FileKind, contents: Contents) -> File {
    File {
        header: Header::current(kind),
        contents,
        skipped: Vec::new(),
    }
}

/// Parents before children, children in their order.
fn depth_first(scene: &Scene, roots: &[Handle]) -> Vec<Handle> {
    let mut order = Vec::new();
    let mut pending: Vec<Handle> = roots.iter().rev().copied().collect();
    while let Some(handle) = pending.pop() {
        order.push(handle);
        if let Ok(object) = scene.object(handle) {
            pending.extend(object.children().iter().rev());
        }
    }
    order
}

fn contents(
    scene: &Scene,
    order: &[Handle],
    base: Option<Handle>,
    scripts: &[LoadedScript],
) -> SceneResult<Contents> {
    let mut context = Context {
        scene,
        saved: order.iter().copied().collect(),
        pool: Pool::default(),
    };
    let objects = order
        .iter()
        .map(|handle| object(&mut context, *handle, base))
        .collect::<SceneResult<Vec<_>>>()?;
    let attached = scripts.iter().filter(|script| {
        script
            .owner
            .is_some_and(|owner| context.saved.contains(&owner))
    });
    let textures = match base {
        None => texture::all(scene, |_| true),
        Some(_) => {
            let used: BTreeSet<i64> = shapes(scene, order).flat_map(Shape::texture_ids).collect();
            texture::all(scene, |id| used.contains(&id))
        }
    };
    Ok(Contents {
        textures,
        scripts: attached.map(script::attached).collect(),
        collections: settings::collections(&context),
        collisions: calculation_objects::collisions(&context),
        distances: calculation_objects::distances(&context),
        ik_groups: ik_groups::groups(&context),
        button_blocks: button_interfaces::blocks(&context, base.is_some()),
        objects,
        mesh_pool: Some(context.pool.arrays.pool),
        ..Contents::default()
    })
}

fn shapes<'a>(scene: &'a Scene, order: &[Handle]) -> impl Iterator<Item = &'a Shape> {
    order
        .iter()
        .filter_map(|handle| scene.object(*handle).ok()?.shape().ok())
}

fn object(
    context: &mut Context<'_>,
    handle: Handle,
    base: Option<Handle>,
) -> SceneResult<FileObject> {
    let object = context.scene.object(handle)?;
    let mut common = common::common(context, object)?;
    if base == Some(handle) {
        // A model stands in the world, whatever it was part of.
        common.pose = Some(context.scene.world_pose(handle)?.into());
        (common.handles, common.child_order) = (Some([handle.0.cast_signed(), -1]), Some(-1));
    }
    Ok(FileObject {
        offset: 0,
        common,
        class: class(context, object),
    })
}

fn class(context: &mut Context<'_>, object: &Object) -> Class {
    let mut colour = colour::colour(&object.colour);
    colour.extension_string = Some(object.colour_extension.as_str().into());
    let colour = Some(colour);
    match &object.kind {
        Kind::Shape(shape) => Class::Shape(Box::new(shape::shape(context, shape))),
        Kind::Joint(joint) => Class::Joint(Box::new(mechanics::joint(context, joint, colour))),
        Kind::ForceSensor(sensor) => {
            Class::ForceSensor(Box::new(mechanics::force_sensor(sensor, colour)))
        }
        Kind::Dummy(dummy) => Class::Dummy(Box::new(mechanics::dummy(context, dummy, colour))),
        Kind::ProximitySensor(sensor) => {
            Class::ProximitySensor(Box::new(sensors::proximity_sensor(context, sensor, colour)))
        }
        Kind::Path(path) => Class::Path(Box::new(path::path(path, colour))),
        Kind::VisionSensor(sensor) => {
            Class::VisionSensor(Box::new(sensors::vision_sensor(context, sensor, colour)))
        }
        Kind::Camera(camera) => Class::Camera(Box::new(sensors::camera(context, camera, colour))),
        Kind::Light(light) => Class::Light(Box::new(sensors::light(light, colour))),
        Kind::Graph(graph) => Class::Graph(Box::new(graph::graph(context, graph, colour))),
        Kind::OcTree(tree) => Class::OcTree(Box::new(cells::octree(tree, colour))),
        Kind::PointCloud(cloud) => Class::PointCloud(Box::new(cells::point_cloud(cloud, colour))),
        Kind::Script(script) => {
            Class::ScriptObject(Box::new(script::object(script, object.handle(), colour)))
        }
    }
}

/// Extents of the box around the shapes of a model, along the axes of its base.
fn model_size(scene: &Scene, order: &[Handle], base: Handle) -> SceneResult<[f64; 3]> {
    let into_base = scene.world_pose(base)?.inverse();
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for handle in order {
        let Ok(shape) = scene.object(*handle)?.shape() else {
            continue;
        };
        let frame: Pose = into_base * scene.world_pose(*handle)? * shape.bounding_box.pose;
        for corner in 0..8 {
            let half = std::array::from_fn(|axis| {
                let side: f64 = shape.bounding_box.size[axis];
                if corner >> axis & 1 == 1 {
                    side / 2.0
                } else {
                    -side / 2.0
                }
            });
            let point: [f64; 3] = (frame * nalgebra::Point3::from(half)).into();
            (0..3).for_each(|axis| {
                (low[axis], high[axis]) = (low[axis].min(point[axis]), high[axis].max(point[axis]));
            });
        }
    }
    Ok(std::array::from_fn(|axis| {
        (high[axis] - low[axis]).max(0.0)
    }))
}
