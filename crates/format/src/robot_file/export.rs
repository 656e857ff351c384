//! A model of the scene as a description of a robot, with mesh files for what is no primitive.

use bitflags::bitflags;
use geometry::primitive::PrimitiveKind;
use mesh_files::{ExportFormat, MeshFile, Part as MeshPart, Written};
use robot_description::{
    Collision, Dynamics, Geometry, Inertial, Joint, JointKind, Limits, Link, Material, Robot,
    Visual, urdf,
};

use scene::joint::{Joint as SceneJoint, JointType};
use scene::shape::{Part, Shape};
use scene::{Handle, Kind, Layers, Object, Pose, Scene, SceneError, SceneResult};

bitflags! {
    /// The options of `simURDF.export`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub struct RobotExportOptions: i64 {
        /// Dummies become small red cubes.
        const SHOW_DUMMIES = 0x1;
        /// Meshes have the frames of their joints.
        const MESHES_AT_JOINTS = 0x2;
        /// The present positions of joints become their zero.
        const KEEP_POSITIONS = 0x4;
        /// Bits of scripts that mean nothing are kept.
        const _ = !0;
    }
}

/// Edge and colour of what stands for a dummy.
const MARK: (f64, [f64; 4]) = (0.01, [1.0, 0.0, 0.0, 1.0]);

/// The files of a model: the description, whose name is `stem` with `.urdf`, and its meshes.
///
/// # Errors
/// When a mesh cannot be written.
pub fn export(
    scene: &Scene,
    base: Handle,
    stem: &str,
    options: RobotExportOptions,
) -> SceneResult<Vec<Written>> {
    let robot = Robot {
        name: scene.object(base)?.alias().to_owned(),
        ..Robot::default()
    };
    let mut export = Export {
        scene,
        options,
        stem,
        robot,
        meshes: Vec::new(),
    };
    export.add_all(base)?;
    let description = Written {
        name: format!("{stem}.urdf"),
        bytes: urdf::write(&export.robot).into_bytes(),
    };
    Ok([vec![description], export.meshes].concat())
}

struct Export<'a> {
    scene: &'a Scene,
    options: RobotExportOptions,
    stem: &'a str,
    robot: Robot,
    meshes: Vec<Written>,
}

/// An object that is to be exported: the link that it belongs to, and its frame in the link's.
struct Pending {
    object: Handle,
    link: usize,
    pose: Pose,
}

impl Export<'_> {
    fn add_all(&mut self, base: Handle) -> SceneResult<()> {
        self.add_link(String::new());
        let mut pending = vec![Pending {
            object: base,
            link: 0,
            pose: Pose::identity(),
        }];
        let mut next = 0;
        while let Some(Pending { object, link, pose }) = pending.get(next) {
            let object = self.scene.object(*object)?;
            let (link, pose) = self.add_object(object, *link, *pose)?;
            for child in object.children() {
                pending.push(Pending {
                    object: *child,
                    link,
                    pose: pose * self.scene.object(*child)?.pose(),
                });
            }
            next += 1;
        }
        self.name_links();
        Ok(())
    }

    /// Adds what an object consists of. The results are the link that its children belong to, and the frame they are in.
    fn add_object(
        &mut self,
        object: &Object,
        link: usize,
        pose: Pose,
    ) -> SceneResult<(usize, Pose)> {
        match &object.kind {
            Kind::Shape(shape) => self.add_shape(object, shape, link, pose),
            Kind::Joint(joint) => Ok(self.add_joint(object, joint, link, pose)),
            Kind::ForceSensor(_) => Ok((self.fix(object.alias(), link, pose), Pose::identity())),
            Kind::Dummy(_) if self.options.contains(RobotExportOptions::SHOW_DUMMIES) => {
                let link = self.fix(object.alias(), link, pose);
                self.robot.links[link].visuals.push(mark(object.alias()));
                Ok((link, Pose::identity()))
            }
            _ => Ok((link, pose)),
        }
    }

    fn add_link(&mut self, name: String) -> usize {
        self.robot.links.push(Link {
            name,
            ..Link::default()
        });
        self.robot.links.len() - 1
    }

    /// A link of its own that is fixed to another one.
    fn fix(&mut self, name: &str, parent: usize, origin: Pose) -> usize {
        let child = self.add_link(String::new());
        self.robot
            .joints
            .push(joint_of(name, JointKind::Fixed, [parent, child], origin));
        child
    }

    fn add_joint(
        &mut self,
        object: &Object,
        joint: &SceneJoint,
        link: usize,
        pose: Pose,
    ) -> (usize, Pose) {
        let kind = match joint.joint_type {
            JointType::Revolute if joint.cyclic => JointKind::Continuous,
            JointType::Revolute => JointKind::Revolute,
            JointType::Prismatic => JointKind::Prismatic,
            JointType::Spherical => JointKind::Spherical,
        };
        let child = self.add_link(String::new());
        let is_kept = self.options.contains(RobotExportOptions::KEEP_POSITIONS);
        let origin = if is_kept {
            pose * joint.ideal_pose()
        } else {
            pose
        };
        let zero = if is_kept { joint.position } else { 0.0 };
        let mut described = joint_of(object.alias(), kind, [link, child], origin);
        if joint.joint_type != JointType::Spherical {
            described.limits = limits(joint, zero);
        }
        self.robot.joints.push(described);
        (child, Pose::identity())
    }

    /// A shape belongs to the link that it is below, unless that has a body already and this is another one.
    fn add_shape(
        &mut self,
        object: &Object,
        shape: &Shape,
        link: usize,
        pose: Pose,
    ) -> SceneResult<(usize, Pose)> {
        let is_body = !shape.dynamics.is_static;
        let (link, pose) = match is_body && self.robot.links[link].inertial.is_some() {
            true => (
                self.fix(&format!("{}_joint", object.alias()), link, pose),
                Pose::identity(),
            ),
            false => (link, pose),
        };
        if self.robot.links[link].name.is_empty() {
            self.robot.links[link].name = link_name(object.alias()).to_owned();
        }
        if is_body {
            self.robot.links[link].inertial = Some(inertial(shape, pose));
        }
        let is_seen = object.layer.intersects(Layers::SHOWN_BY_DEFAULT);
        for (number, part) in shape.parts.iter().enumerate() {
            let (origin, geometry) = self.geometry(object, part, number, pose)?;
            let name = String::new();
            if shape.dynamics.respondable {
                let collision = Collision {
                    name: name.clone(),
                    pose: origin,
                    geometry: geometry.clone(),
                    line: 0,
                };
                self.robot.links[link].collisions.push(collision);
            }
            if is_seen {
                let material = Some(material(object, part, number));
                self.robot.links[link].visuals.push(Visual {
                    name,
                    pose: origin,
                    geometry,
                    material,
                    line: 0,
                });
            }
        }
        Ok((link, pose))
    }

    /// The geometry of a part in the link's frame: a primitive, or a mesh file. `pose` is that of its shape.
    fn geometry(
        &mut self,
        object: &Object,
        part: &Part,
        number: usize,
        pose: Pose,
    ) -> SceneResult<(Pose, Geometry)> {
        let placed = pose * part.pose;
        if let Some(geometry) = primitive(part) {
            return Ok((placed, geometry));
        }
        let (origin, in_file) = match self.options.contains(RobotExportOptions::MESHES_AT_JOINTS) {
            true => (Pose::identity(), placed),
            false => (placed, Pose::identity()),
        };
        let moved = |vertex: &[f64; 3]| (in_file * nalgebra::Point3::from(*vertex)).into();
        let vertices = part.mesh.vertices.iter().map(moved).collect();
        let mesh = MeshPart {
            vertices,
            triangles: part.mesh.triangles.clone(),
            ..MeshPart::default()
        };
        let name = format!(
            "{}_{}_{number}_{}.obj",
            self.stem,
            object.alias(),
            object.handle().raw()
        );
        let file = MeshFile {
            parts: vec![mesh],
            ..MeshFile::default()
        };
        let written = mesh_files::write(&file, ExportFormat::Obj, &name);
        let written = written
            .map_err(|error| SceneError::Refused(format!("'{}': {error}", object.alias())))?;
        self.meshes.extend(written);
        Ok((
            origin,
            Geometry::Mesh {
                file: name,
                scale: [1.0; 3],
            },
        ))
    }

    /// Links without a shape get names, and equal names numbers.
    fn name_links(&mut self) {
        let mut used = std::collections::BTreeSet::new();
        for index in 0..self.robot.links.len() {
            let mut name = self.robot.links[index].name.clone();
            if name.is_empty() {
                let joint = self.robot.joints.iter().find(|joint| joint.child == index);
                name = joint.map_or_else(
                    || "base_link".to_owned(),
                    |joint| format!("{}_link", joint.name),
                );
            }
            self.robot.links[index].name = unique(&mut used, name);
        }
        let mut used = std::collections::BTreeSet::new();
        for joint in &mut self.robot.joints {
            joint.name = unique(&mut used, std::mem::take(&mut joint.name));
        }
    }
}

/// The name, with a number if it is used already.
fn unique(used: &mut std::collections::BTreeSet<String>, name: String) -> String {
    let numbered = (1..).map(|number| format!("{name}_{number}"));
    let free = std::iter::once(name.clone())
        .chain(numbered)
        .find(|name| !used.contains(name))
        .unwrap_or(name);
    used.insert(free.clone());
    free
}

/// Shapes that simURDF made are named after their links.
fn link_name(alias: &str) -> &str {
    alias
        .strip_suffix("_respondable")
        .or_else(|| alias.strip_suffix("_visual"))
        .unwrap_or(alias)
}

fn joint_of(name: &str, kind: JointKind, [parent, child]: [usize; 2], origin: Pose) -> Joint {
    Joint {
        name: name.to_owned(),
        kind,
        parent,
        child,
        origin,
        child_pose: Pose::identity(),
        axis: [0.0, 0.0, 1.0],
        limits: Limits::default(),
        dynamics: Dynamics::default(),
        mimic: None,
        reference: 0.0,
        line: 0,
    }
}

/// The limits of a joint whose position `zero` becomes 0.
fn limits(joint: &SceneJoint, zero: f64) -> Limits {
    let interval = (!joint.cyclic).then_some([joint.min - zero, joint.min + joint.range - zero]);
    Limits {
        lower: interval.map(|[lower, _]| lower),
        upper: interval.map(|[_, upper]| upper),
        effort: Some(joint.target_force.abs()),
        velocity: Some(joint.max_vel),
    }
}

/// `pose` is that of the shape in the link's frame.
fn inertial(shape: &Shape, pose: Pose) -> Inertial {
    let [x, y, z] = shape.mass.com;
    let [xx, xy, xz, _, yy, yz, _, _, zz] = shape.mass.absolute_inertia();
    Inertial {
        pose: pose * Pose::translation(x, y, z),
        mass: shape.mass.mass,
        inertia: [xx, xy, xz, yy, yz, zz],
    }
}

/// The primitives that URDF has.
fn primitive(part: &Part) -> Option<Geometry> {
    let primitive = part.primitive.as_ref()?;
    let [x, y, z] = primitive.size;
    match primitive.kind {
        PrimitiveKind::Cuboid => Some(Geometry::Box {
            size: primitive.size,
        }),
        PrimitiveKind::Spheroid if x == y && y == z => Some(Geometry::Sphere { radius: x / 2.0 }),
        PrimitiveKind::Cylinder if x == y => Some(Geometry::Cylinder {
            radius: x / 2.0,
            length: z,
        }),
        _ => None,
    }
}

fn material(object: &Object, part: &Part, number: usize) -> Material {
    let [red, green, blue] = part.appearance.colour.ambient_diffuse.map(f64::from);
    let opacity = f64::from(part.appearance.colour.opacity);
    Material {
        name: format!("{}_{number}_material", object.alias()),
        color: Some([red, green, blue, opacity]),
        texture: None,
    }
}

fn mark(name: &str) -> Visual {
    let (edge, color) = MARK;
    let material = Material {
        name: format!("{name}_mark"),
        color: Some(color),
        texture: None,
    };
    Visual {
        name: String::new(),
        pose: Pose::identity(),
        geometry: Geometry::Box { size: [edge; 3] },
        material: Some(material),
        line: 0,
    }
}
