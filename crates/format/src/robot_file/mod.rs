//! Descriptions of robots become objects of a scene, by the rules of simURDF (spec: import 1).
//!
//! `read` reads the file: URDF, SDF or MJCF. `shapes` makes shapes of geometries, `links` and `joints` put them into the scene, `mesh_files` reads what the
//! description names. Whatever cannot be done is a message; the rest of the robot is there.

mod bases;
mod between;
mod constraints;
mod export;
mod flexes;
mod joints;
mod links;
mod masks;
mod mesh_files;
mod place;
mod read;
mod ros;
mod sensors;
mod shapes;
mod surfaces;
mod tendons;

use std::collections::BTreeMap;

use bitflags::bitflags;
use robot_description::Robot;
use robot_description::mjcf::{Actuator, Adhesion, Equality, Flex, Site, Tendon};

use super::scene_file::save;
use super::ttt::File;
pub use export::{RobotExportOptions, export};
pub use flexes::{SoftShape, pin_nodes};
pub use joints::{Told, initial_target, motor_of, passive_of};
use masks::Masks;
use mesh_files::MeshFiles;
use place::lift_to_ground;
pub use robot_description::urdf::OF_GAZEBO;
pub use ros::RosRobot;
use scene::object::dummy::Dummy;
use scene::shape::{Fluid, MovingSurface};
use scene::{Field, Handle, Kind, ModelFlags, ObjectFlags, Pose, Scene, SceneResult, clean_alias};
pub use surfaces::values as surface_values;
pub use tendons::resolved as resolved_tendon;

bitflags! {
    /// The options of `simURDF.import`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub struct RobotImportOptions: i64 {
        /// Collision shapes are visible.
        const SHOW_COLLISIONS = 0x1;
        /// Joints are visible.
        const SHOW_JOINTS = 0x2;
        /// Collision meshes that are not convex are decomposed into convex parts.
        const DECOMPOSE_COLLISIONS = 0x4;
        /// Links without visuals get copies of their collision shapes as visuals.
        const CREATE_VISUALS = 0x8;
        /// The robot stays where the file has it; else it is lifted to the ground.
        const KEEP_POSITION = 0x20;
        /// The robot does not become a model.
        const NO_MODEL = 0x40;
        /// Links collide with others of their robot but for their neighbours in the tree: local respondable masks alternate. Else none does.
        const ALTERNATE_MASKS = 0x80;
        /// Joints have no motor.
        const FREE_JOINTS = 0x100;
        /// Collision meshes become their convex hulls.
        const HULLS_OF_COLLISIONS = 0x200;
        /// Shapes have the frames of their joints.
        const FRAMES_AT_JOINTS = 0x400;
        /// Bits of scripts that mean nothing are kept.
        const _ = !0;
    }
}

/// A file that has been read, with what its meshes are looked for by.
#[derive(Debug)]
pub struct RobotFile {
    format: RobotFormat,
    /// Of the robot, or of the world.
    name: String,
    models: Vec<Description>,
    /// m/s², if the file says it.
    gravity: Option<[f64; 3]>,
    meshes: MeshFiles,
    /// What was wrong in the file, a line each.
    warnings: Vec<String>,
}

/// A format of descriptions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RobotFormat {
    /// Unified Robot Description Format.
    Urdf,
    /// Simulation Description Format.
    Sdf,
    /// The format of MuJoCo.
    Mjcf,
}

/// A robot, and what URDF does not have.
#[derive(Debug, Default)]
struct Description {
    robot: Robot,
    /// In the world.
    pose: Pose,
    /// Links that never move, in increasing order.
    fixed: Vec<usize>,
    /// None: joints have the motors that simURDF makes.
    actuators: Option<Vec<Actuator>>,
    sites: Vec<Site>,
    equalities: Vec<Equality>,
    tendons: Vec<Tendon>,
    flexes: Vec<Flex>,
    /// The pairs of links that may touch, in increasing order, if the file says it.
    touching: Option<Vec<[usize; 2]>>,
    /// Pairs of links with a friction of their own.
    pair_frictions: Vec<([usize; 2], f64)>,
    /// The fluid that the bodies are in.
    fluid: Fluid,
    adhesions: Vec<Adhesion>,
    /// Links of whose weight a part is compensated.
    compensations: Vec<(usize, f64)>,
    /// Links whose surface moves, and how, in their frames.
    moving_surfaces: Vec<(usize, MovingSurface)>,
}

/// What an import added.
#[derive(Debug)]
pub struct Imported {
    /// Name of the robot or the world.
    pub name: String,
    /// The objects without a parent.
    pub roots: Vec<Handle>,
    /// All objects.
    pub objects: Vec<Handle>,
    /// What was guessed, or could not be done.
    pub messages: Vec<String>,
}

impl RobotFile {
    /// The same with the bases of its robots held in place, as if they were bolted to the floor. What has no joints is no robot, and stays free.
    #[must_use]
    pub fn with_fixed_bases(mut self) -> Self {
        self.models.iter_mut().for_each(Description::fix_bases);
        self
    }

    /// The robot as a model, and what was guessed or could not be done.
    ///
    /// # Errors
    /// When it has no objects; in words.
    pub fn model(self) -> Result<(File, Vec<String>), String> {
        let mut scene = Scene::new();
        let options = match self.format {
            RobotFormat::Urdf => RobotImportOptions::default(),
            RobotFormat::Sdf | RobotFormat::Mjcf => RobotImportOptions::KEEP_POSITION,
        };
        let gravity = self
            .gravity
            .filter(|gravity| gravity.map(numbers::single) != scene.settings().dynamics.gravity);
        let mut imported = self
            .add_to(&mut scene, options)
            .map_err(|error| error.to_string())?;
        if let Some(gravity) = gravity {
            imported.messages.push(format!(
                "its gravity, {gravity:?}, is not a part of a model"
            ));
        }
        let base = match imported.roots.as_slice() {
            [base] => *base,
            [] => return Err(nothing_because(&imported.messages)),
            several => {
                gathered(&mut scene, several, &imported.name).map_err(|error| error.to_string())?
            }
        };
        let file = save::model(&scene, base, &[]).map_err(|error| error.to_string())?;
        Ok((file, imported.messages))
    }

    /// Adds the robots to a scene.
    ///
    /// # Errors
    /// When all handles are in use.
    pub fn add_to(
        mut self,
        scene: &mut Scene,
        options: RobotImportOptions,
    ) -> SceneResult<Imported> {
        let mut all = Imported {
            name: self.name,
            roots: Vec::new(),
            objects: Vec::new(),
            messages: self.warnings,
        };
        for model in &self.models {
            let mut import = Import::new(
                scene,
                self.format,
                model,
                &mut self.meshes,
                options,
                &mut all.messages,
            );
            import.add_links()?;
            import.add_sensors()?;
            import.add_sites()?;
            import.add_tendons()?;
            import.add_flexes()?;
            import.add_constraints()?;
            import.set_pair_frictions()?;
            import.report_dynamics();
            import.report_emptiness();
            let (roots, objects) = import.finish()?;
            all.roots.extend(roots);
            all.objects.extend(objects);
        }
        Ok(all)
    }
}

/// Why a file became no objects: the first things that were said about it.
fn nothing_because(messages: &[String]) -> String {
    const SHOWN: usize = 3;
    let shown = messages[..messages.len().min(SHOWN)].join("; ");
    match messages.len() {
        0 => "there is no robot in it".into(),
        count if count <= SHOWN => format!("there is nothing in it to simulate: {shown}"),
        count => format!(
            "there is nothing in it to simulate: {shown}; and {} other messages",
            count - SHOWN
        ),
    }
}

/// A model of several trees: below a dummy.
fn gathered(scene: &mut Scene, roots: &[Handle], name: &str) -> SceneResult<Handle> {
    let base = scene.add(
        &clean_alias(name.as_bytes()),
        Kind::Dummy(Dummy::new(joints::DUMMY)),
    )?;
    scene.modify(base, Field::ObjectProperty, |object| {
        object.set_model_property(ModelFlags::empty());
    })?;
    for root in roots {
        scene.set_parent(*root, Some(base), true)?;
    }
    Ok(base)
}

/// An import in progress.
struct Import<'a> {
    scene: &'a mut Scene,
    format: RobotFormat,
    model: &'a Description,
    robot: &'a Robot,
    meshes: &'a mut MeshFiles,
    options: RobotImportOptions,
    /// The frames of the links, with all joints where they are at first, or as near to it as their limits allow.
    placed: Vec<Pose>,
    /// Those positions, of joints that have one number.
    first: Vec<f64>,
    nodes: Vec<Node>,
    /// Masks of links, where the file says which of them touch.
    masks: BTreeMap<usize, Masks>,
    /// What the joints became.
    joints: Vec<Option<Handle>>,
    /// What the sites became, by their names.
    sites: BTreeMap<String, Handle>,
    objects: Vec<Handle>,
    messages: &'a mut Vec<String>,
}

/// What a link became.
#[derive(Debug, Clone, Copy, Default)]
struct Node {
    /// The object that joints, sensors and further links hang on: a shape, else the joint above it.
    carrier: Option<Handle>,
    /// How many links are above it.
    depth: usize,
}

impl<'a> Import<'a> {
    fn new(
        scene: &'a mut Scene,
        format: RobotFormat,
        model: &'a Description,
        meshes: &'a mut MeshFiles,
        options: RobotImportOptions,
        messages: &'a mut Vec<String>,
    ) -> Self {
        let robot = &model.robot;
        let first = joints::first_positions(robot);
        let placed = robot.link_poses(&first).unwrap_or_default();
        Self {
            scene,
            format,
            model,
            robot,
            meshes,
            options,
            placed: placed.into_iter().map(|pose| model.pose * pose).collect(),
            first: robot.joint_positions(&first).unwrap_or_default(),
            nodes: vec![Node::default(); robot.links.len()],
            masks: BTreeMap::new(),
            joints: vec![None; robot.joints.len()],
            sites: BTreeMap::new(),
            objects: Vec::new(),
            messages,
        }
    }

    fn message(&mut self, text: String) {
        self.messages.push(text);
    }

    /// Adds an object at a pose in the world.
    fn add(
        &mut self,
        alias: &str,
        kind: Kind,
        pose: Pose,
        parent: Option<Handle>,
    ) -> SceneResult<Handle> {
        let handle = self.scene.add(&clean_alias(alias.as_bytes()), kind)?;
        self.scene.set_world_pose(handle, pose)?;
        self.scene.set_parent(handle, parent, true)?;
        self.objects.push(handle);
        Ok(handle)
    }

    /// A file of which nothing was made says why: its links have nothing to see, to touch or to weigh.
    fn report_emptiness(&mut self) {
        if !self.objects.is_empty() {
            return;
        }
        for link in &self.robot.links {
            let is_empty = link.visuals.is_empty() && link.collisions.is_empty();
            if is_empty && link.inertial.is_none() && link.line > 0 {
                self.messages.push(format!(
                    "line {}, <{}>: '{}' has nothing to see, to touch or to weigh",
                    link.line,
                    self.format.link_element(),
                    link.name
                ));
            }
        }
    }

    fn finish(mut self) -> SceneResult<(Vec<Handle>, Vec<Handle>)> {
        let is_root = |handle: &Handle| {
            self.scene
                .object(*handle)
                .is_ok_and(|object| object.parent().is_none())
        };
        let roots: Vec<Handle> = self.objects.iter().copied().filter(is_root).collect();
        if !self.options.contains(RobotImportOptions::KEEP_POSITION) {
            lift_to_ground(self.scene, &self.objects, &roots)?;
        }
        if let ([base], false) = (
            roots.as_slice(),
            self.options.contains(RobotImportOptions::NO_MODEL),
        ) {
            self.make_model(*base)?;
        }
        Ok((roots, self.objects))
    }

    /// The robot is selected as a whole, and folded in the tree.
    fn make_model(&mut self, base: Handle) -> SceneResult<()> {
        self.scene.modify(base, Field::ObjectProperty, |object| {
            object.set_model_property(ModelFlags::empty());
            object.object_property |= ObjectFlags::COLLAPSED;
        })?;
        for handle in self
            .objects
            .iter()
            .copied()
            .filter(|handle| *handle != base)
        {
            self.scene.modify(handle, Field::ObjectProperty, |object| {
                object.object_property |= ObjectFlags::SELECT_MODEL;
            })?;
        }
        Ok(())
    }
}
