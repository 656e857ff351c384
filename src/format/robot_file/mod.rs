//! Descriptions of robots become objects of a scene, by the rules of simURDF (spec: import 1).
//!
//! `robot_description` reads the file. `shapes` makes shapes of geometries, `links` and `joints` put them into the scene, `mesh_files` reads what the
//! description names. Whatever cannot be done is a message; the rest of the robot is there.

mod export;
mod joints;
mod links;
mod mesh_files;
mod place;
mod sensors;
mod shapes;

use std::path::Path;

use bitflags::bitflags;
use robot_description::{Parsed, Robot, urdf};

use super::scene_file::save;
use super::ttt::File;
use crate::permissions::Permissions;
use crate::scene::object::dummy::Dummy;
use crate::scene::{Field, Handle, Kind, ModelFlags, ObjectFlags, Pose, Scene, SceneResult, clean_alias};
pub use export::{ExportOptions, export};
use mesh_files::MeshFiles;
use place::lift_to_ground;

bitflags! {
    /// The options of `simURDF.import`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub struct ImportOptions: i64 {
        const SHOW_COLLISIONS = 0x1;
        const SHOW_JOINTS = 0x2;
        const DECOMPOSE_COLLISIONS = 0x4;
        const CREATE_VISUALS = 0x8;
        const KEEP_POSITION = 0x20;
        const NO_MODEL = 0x40;
        const ALTERNATE_MASKS = 0x80;
        const FREE_JOINTS = 0x100;
        const HULLS_OF_COLLISIONS = 0x200;
        const FRAMES_AT_JOINTS = 0x400;
        const _ = !0;
    }
}

/// A description that has been read, with what its meshes are looked for by.
#[derive(Debug)]
pub struct RobotFile {
    robot: Robot,
    meshes: MeshFiles,
    /// What was wrong in the file, a line each.
    warnings: Vec<String>,
}

/// What an import added.
#[derive(Debug)]
pub struct Imported {
    pub name: String,
    /// The objects without a parent.
    pub roots: Vec<Handle>,
    /// All objects.
    pub objects: Vec<Handle>,
    /// What was guessed, or could not be done.
    pub messages: Vec<String>,
}

impl RobotFile {
    /// Whether a file's name is that of a robot that can be imported.
    pub fn has_name_of(path: &Path) -> bool {
        path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("urdf"))
    }

    /// Reads a file. `replacement` stands for `package://` in it.
    ///
    /// # Errors
    /// When it may not or cannot be read, or is no robot; in words.
    pub fn read(path: &Path, replacement: Option<String>, permissions: &Permissions) -> Result<Self, String> {
        let bytes = permissions.read_file(path).map_err(|error| error.to_string())?;
        let path = std::path::absolute(path).map_err(|error| error.to_string())?;
        Self::parse(&bytes, &path, replacement, permissions)
    }

    /// Reads the text of a file. Relative names in it mean files beside `path`.
    ///
    /// # Errors
    /// When it is no robot; in words.
    pub fn parse(
        text: &[u8],
        path: &Path,
        replacement: Option<String>,
        permissions: &Permissions,
    ) -> Result<Self, String> {
        let Parsed { value: robot, warnings, further_warnings } =
            urdf::read(text).map_err(|error| error.to_string())?;
        let mut warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
        if further_warnings > 0 {
            warnings.push(format!("and {further_warnings} other warnings"));
        }
        Ok(Self { robot, meshes: MeshFiles::new(path, replacement, permissions), warnings })
    }

    /// The robot as a model, and what was guessed or could not be done.
    ///
    /// # Errors
    /// When it has no objects; in words.
    pub fn model(self) -> Result<(File, Vec<String>), String> {
        let mut scene = Scene::new();
        let imported = self.add_to(&mut scene, ImportOptions::default()).map_err(|error| error.to_string())?;
        let base = match imported.roots.as_slice() {
            [base] => *base,
            [] => return Err("the robot has no links".into()),
            several => gathered(&mut scene, several, &imported.name).map_err(|error| error.to_string())?,
        };
        let file = save::model(&scene, base, &[]).map_err(|error| error.to_string())?;
        Ok((file, imported.messages))
    }

    /// Adds the robot to a scene.
    ///
    /// # Errors
    /// When all handles are in use.
    pub fn add_to(self, scene: &mut Scene, options: ImportOptions) -> SceneResult<Imported> {
        let placed = self.robot.link_poses(&joints::first_positions(&self.robot)).unwrap_or_default();
        let mut import = Import {
            scene,
            robot: &self.robot,
            meshes: self.meshes,
            options,
            placed,
            nodes: vec![Node::default(); self.robot.links.len()],
            objects: Vec::new(),
            messages: self.warnings,
        };
        import.add_links()?;
        import.add_sensors()?;
        import.finish()
    }
}

/// A model of several trees: below a dummy.
fn gathered(scene: &mut Scene, roots: &[Handle], name: &str) -> SceneResult<Handle> {
    let base = scene.add(&clean_alias(name.as_bytes()), Kind::Dummy(Dummy::new(joints::DUMMY)))?;
    scene.modify(base, Field::ObjectProperty, |object| object.set_model_property(ModelFlags::empty()))?;
    for root in roots {
        scene.set_parent(*root, Some(base), true)?;
    }
    Ok(base)
}

/// An import in progress.
struct Import<'a> {
    scene: &'a mut Scene,
    robot: &'a Robot,
    meshes: MeshFiles,
    options: ImportOptions,
    /// The frames of the links, with all joints at 0, or as near to it as their limits allow.
    placed: Vec<Pose>,
    nodes: Vec<Node>,
    objects: Vec<Handle>,
    messages: Vec<String>,
}

/// What a link became.
#[derive(Debug, Clone, Copy, Default)]
struct Node {
    /// The object that joints, sensors and further links hang on: a shape, else the joint above it.
    carrier: Option<Handle>,
    /// How many links are above it.
    depth: usize,
}

impl Import<'_> {
    fn message(&mut self, text: String) {
        self.messages.push(text);
    }

    /// Adds an object at a pose in the world.
    fn add(&mut self, alias: &str, kind: Kind, pose: Pose, parent: Option<Handle>) -> SceneResult<Handle> {
        let handle = self.scene.add(&clean_alias(alias.as_bytes()), kind)?;
        self.scene.set_world_pose(handle, pose)?;
        self.scene.set_parent(handle, parent, true)?;
        self.objects.push(handle);
        Ok(handle)
    }

    fn finish(mut self) -> SceneResult<Imported> {
        let is_root = |handle: &Handle| self.scene.object(*handle).is_ok_and(|object| object.parent().is_none());
        let roots: Vec<Handle> = self.objects.iter().copied().filter(is_root).collect();
        if !self.options.contains(ImportOptions::KEEP_POSITION) {
            lift_to_ground(self.scene, &self.objects, &roots)?;
        }
        if let ([base], false) = (roots.as_slice(), self.options.contains(ImportOptions::NO_MODEL)) {
            self.make_model(*base)?;
        }
        Ok(Imported { name: self.robot.name.clone(), roots, objects: self.objects, messages: self.messages })
    }

    /// The robot is selected as a whole, and folded in the tree.
    fn make_model(&mut self, base: Handle) -> SceneResult<()> {
        self.scene.modify(base, Field::ObjectProperty, |object| {
            object.set_model_property(ModelFlags::empty());
            object.object_property |= ObjectFlags::COLLAPSED;
        })?;
        for handle in self.objects.iter().copied().filter(|handle| *handle != base) {
            self.scene.modify(handle, Field::ObjectProperty, |object| {
                object.object_property |= ObjectFlags::SELECT_MODEL;
            })?;
        }
        Ok(())
    }
}
