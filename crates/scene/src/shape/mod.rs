//! Shapes as data: geometry, mass, material, appearance.

pub mod build;
mod contact_pairs;
pub mod decimate;
mod fluid;
pub(crate) mod group;
pub(crate) mod hull_points;
pub(crate) mod mesh_owners;
mod moving_surface;
pub mod options;
pub(crate) mod primitives;
pub mod reshape;
pub mod soft;

use std::rc::Rc;

pub use contact_pairs::{ContactPair, PAIRS};
pub use fluid::{FLUID, Fluid};
use geometry::{BoundingBox, MassProperties, Mesh, PrimitiveKind};
pub use moving_surface::{MovingSurface, SURFACE};

use super::appearance::colour::Colour;
use super::appearance::texture_mapping::TextureMapping;
use super::{InertValues, Pose, Uid};

/// Frictions of the presets for grasping and stable stacks, in the order of [`Material::of_frictions`].
const GRASP_FRICTIONS: [f64; 5] = [1.0, 0.5, 1.0, 1.0, 1.0];

/// A shape: one or several meshes that move as one body.
#[derive(Debug, Clone)]
pub struct Shape {
    /// In the shape frame: one part for a simple shape, several for a compound.
    pub parts: Vec<Part>,
    /// Pose of the bounding box in the shape frame, and its full extents.
    pub bounding_box: BoundingBox,
    /// In the shape frame.
    pub mass: MassProperties,
    /// How physics treats it.
    pub dynamics: ShapeDynamics,
    /// Friction, restitution and damping.
    pub material: Material,
    /// The last velocities of the physics, world axes, at the centre of mass.
    pub velocity: Velocity,
    /// Force applied by scripts since the last dynamics call, N, world axes, at the centre of mass.
    pub force: [f64; 3],
    /// Torque applied by scripts since the last dynamics call, N m, world axes.
    pub torque: [f64; 3],
    /// Of something soft that the physics moves.
    pub soft_form: Option<Rc<soft::SoftForm>>,
}

/// One mesh of a shape.
#[derive(Debug, Clone)]
pub struct Part {
    /// Its identifier once it is in a scene, 0 before.
    pub uid: Uid,
    /// In the frame `pose`; shared between copies.
    pub mesh: Rc<Mesh>,
    /// Frame of the part in the shape frame.
    pub pose: Pose,
    /// Known when physics may use the analytic form ("pure"), which then lies centred in the part's frame.
    pub primitive: Option<Primitive>,
    /// Whether the mesh is convex, so that physics needs no decomposition.
    pub convex: bool,
    /// Mass, centre of mass and inertia in the part's frame.
    pub mass: MassProperties,
    /// Alias of the shape it was before it was grouped; empty if that is not known.
    pub alias: String,
    /// Of a group of groups: the number of the member it is in, then of the member of that member, and so on.
    pub group: Vec<u32>,
    /// Visual attributes.
    pub appearance: Appearance,
    /// The image on the mesh.
    pub texture: Option<Box<TextureMapping>>,
}

/// The analytic form of a part.
#[derive(Debug, Clone, PartialEq)]
pub struct Primitive {
    /// Which primitive it is.
    pub kind: PrimitiveKind,
    /// Full extents along the axes, metres.
    pub size: [f64; 3],
    /// The heights of a height field.
    pub heights: Option<Rc<HeightField>>,
}

/// Heights of a terrain, row by row (y grows with the row), metres.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightField {
    /// Number of heights along x.
    pub columns: usize,
    /// Number of heights along y.
    pub rows: usize,
    /// The heights above the part's frame, metres.
    pub heights: Vec<f64>,
}

/// The velocity of a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Velocity {
    /// Linear velocity, m/s.
    pub linear: [f64; 3],
    /// Angular velocity, rad/s.
    pub angular: [f64; 3],
}

/// Which shapes a shape collides with: those with a common bit, in the low byte within a tree, in the high byte between trees.
/// Higher bits have no meaning; they are stored as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RespondableMask(pub i64);

impl RespondableMask {
    /// Collides with all other shapes.
    pub const ALL: Self = Self(0xffff);
    /// Collides with nothing.
    pub const NONE: Self = Self(0);

    /// The bits that have a meaning.
    pub fn bits(self) -> u16 {
        self.0 as u16
    }
}

/// Dynamic properties of a shape.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeDynamics {
    /// Physics does not move it.
    pub is_static: bool,
    /// Other respondable shapes collide with it.
    pub respondable: bool,
    /// A static shape whose motion by scripts carries over to the bodies that touch it.
    pub kinematic: bool,
    /// At rest until another body touches it.
    pub start_asleep: bool,
    /// Becomes dynamic when it gets a parent.
    pub dynamic_when_parented: bool,
    /// Which shapes it collides with.
    pub respondable_mask: RespondableMask,
    /// Collisions are suspended while this is positive; 0 again when a simulation ends.
    pub respondable_suspend_count: i64,
    /// Velocity at the start of the simulation, world axes.
    pub initial_velocity: Velocity,
}

impl Default for ShapeDynamics {
    fn default() -> Self {
        Self {
            is_static: true,
            respondable: false,
            kinematic: false,
            start_asleep: false,
            dynamic_when_parented: false,
            respondable_mask: RespondableMask::ALL,
            respondable_suspend_count: 0,
            initial_velocity: Velocity::default(),
        }
    }
}

/// Surface properties: those the physics here uses, and those of other engines as they were set.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Bullet 2.78's ("old") friction.
    pub friction: f64,
    /// Coefficient of restitution, 0 to 1.
    pub restitution: f64,
    /// Part of the linear velocity that is lost per second, 0 to 1.
    pub linear_damping: f64,
    /// Part of the angular velocity that is lost per second, 0 to 1.
    pub angular_damping: f64,
    /// Parameters of physics engines that have no field.
    pub engine_values: InertValues,
}

impl Material {
    /// Number of the first preset, `sim.dynmat_default`.
    pub(crate) const FIRST_PRESET: i64 = 2_310_013;

    /// A material with the frictions of Bullet 2.78, Bullet 2.83, ODE, and Newton's static and kinetic one.
    fn of_frictions([friction, others @ ..]: [f64; 5]) -> Self {
        let mut engine_values = InertValues::default();
        let names = [
            "bullet.friction",
            "ode.friction",
            "newton.staticFriction",
            "newton.kineticFriction",
        ];
        for (name, friction) in names.into_iter().zip(others) {
            engine_values.set(name, friction.into());
        }
        Self {
            friction,
            restitution: 0.0,
            linear_damping: 0.0,
            angular_damping: 0.0,
            engine_values,
        }
    }

    /// A material whose friction with another one of its kind is that coefficient. MuJoCo takes the larger one of two, the other engines multiply them:
    /// with them it is the root, so that two different ones have the geometric mean.
    pub fn of_friction(coefficient: f64) -> Self {
        let coefficient = coefficient.max(0.0);
        let root = coefficient.sqrt();
        let mut material = Self::of_frictions([root; 5]);
        let values = &mut material.engine_values;
        values.set("vortex.linearPrimaryAxisFrictionValue", root.into());
        let sliding_spinning_rolling = [coefficient, 0.005, 0.0001];
        values.set("mujoco.friction", sliding_spinning_rolling.into());
        material
    }

    /// The preset with that number (`sim.dynmat_*`), if there is one (spec: dynamics 5).
    pub fn preset(id: i64) -> Option<Self> {
        Some(Self::of_frictions(
            match id.checked_sub(Self::FIRST_PRESET)? {
                0 => [0.71, 0.71, 0.71, 0.5, 0.5],
                1 => [1.0, 1.0, 1.0, 2.0, 2.0],
                2 => [0.41, 0.2, 0.41, 0.17, 0.17],
                3 => [0.0; 5],
                4 | 5 | 7 => GRASP_FRICTIONS,
                6 | 8 => [1.0; 5],
                _ => return None,
            },
        ))
    }

    /// The material of new primitives.
    pub(crate) fn rest_stack_grasp() -> Self {
        Self::of_frictions(GRASP_FRICTIONS)
    }
}

impl Default for Material {
    /// The material of a mesh.
    fn default() -> Self {
        Self::of_frictions([0.71, 0.71, 0.71, 0.5, 0.5])
    }
}

/// Visual attributes of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Appearance {
    /// Name by which scripts address the colour; may be empty.
    pub colour_name: String,
    /// Settings of renderers.
    pub colour_extension: String,
    /// Colour and opacity.
    pub colour: Colour,
    /// Faces are visible from the front only.
    pub culling: bool,
    /// Only the edges of triangles are drawn.
    pub wireframe: bool,
    /// Edges are drawn on top of the faces.
    pub edges: bool,
    /// Of the edges, those that belong to one triangle only are not seen.
    pub edge_borders_hidden: bool,
    /// Faces at a smaller angle are shaded smoothly, radians.
    pub shading_angle: f64,
    /// Edges between faces at a smaller angle are not drawn, radians.
    pub edge_angle: f64,
}

impl Appearance {
    /// Default attributes with a colour: red, green, blue, 0 to 1.
    pub fn new(ambient_diffuse: [f32; 3]) -> Self {
        Self {
            colour_name: String::new(),
            colour_extension: String::new(),
            colour: Colour::new(ambient_diffuse),
            culling: false,
            wireframe: false,
            edges: false,
            edge_borders_hidden: false,
            shading_angle: 30f64.to_radians(),
            edge_angle: 30f64.to_radians(),
        }
    }
}

impl Shape {
    /// Whether it has several parts.
    pub fn is_compound(&self) -> bool {
        self.parts.len() > 1
    }

    /// Whether all parts are primitives for physics.
    pub fn is_pure(&self) -> bool {
        self.parts.iter().all(|part| part.primitive.is_some())
    }

    /// Whether all parts are convex.
    pub fn is_convex(&self) -> bool {
        self.parts.iter().all(|part| part.convex)
    }
}
