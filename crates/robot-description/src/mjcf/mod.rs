//! MJCF, the XML format of MuJoCo (<https://mujoco.readthedocs.io/en/stable/XMLreference.html>): bodies, joints, geoms, actuators, sites, tendons, equality constraints, grids of `<flexcomp>` and composites.
//!
//! Files that a file includes are a part of it, classes of defaults and the settings of `<compiler>` are applied. A body with several joints becomes links
//! without mass between them. What is not understood is a warning with its line.
//!
//! `mjcf-rs` 0.36.1, of rapier's authors, was tried on the 172 files of docs/COMPATIBILITY.md: it refuses 5 (an included file is not called `<mujoco>`) and loses bodies, joints,
//! geoms and sites of 11 without a word (files included in bodies); the other 156 have the bodies, joints, limits, actuators and equality constraints that MuJoCo compiles. It opens what a file
//! includes by itself, so that the script's permissions do not count, tells neither lines nor what it leaves out, leaves inertia from geoms to `rapier3d-mjcf`, and 20 000 nested bodies
//! overflow its stack; so files are read here.

mod actuator;
mod attributes;
mod body;
mod document;
mod element;
mod equality;
mod flex;
mod fragment;
mod geom;
mod inertia;
mod mesh_solid;
mod orientation;
mod surface;
mod tendon;
mod touching;

use crate::model::{Link, Pose, Robot};
use crate::report::{Parsed, ReadError};
use body::Builder;
use document::Document;
use element::Report;

pub use element::Element;
pub use flex::{Flex, FlexForm, FlexPin};
pub use fragment::{Fragment, pose_of_element};

/// What an MJCF file contains.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Model {
    /// Link 0 is the world. A body without joints is fixed to what it is in; one that moves freely hangs on nothing.
    pub robot: Robot,
    /// m/s², if the file says it.
    pub gravity: Option<[f64; 3]>,
    /// Density (kg/m³) and viscosity (Pa s) of the fluid that all bodies are in.
    pub fluid: [f64; 2],
    /// The links that never move, in increasing order: the world, and what is fixed to it.
    pub fixed: Vec<usize>,
    /// The motors.
    pub actuators: Vec<Actuator>,
    /// What lets bodies adhere to what they touch.
    pub adhesions: Vec<Adhesion>,
    /// Links of whose weight a part is compensated, and which part.
    pub compensations: Vec<(usize, f64)>,
    /// Links whose surface moves along them, and how, in their frames: the velocity of the origin in m/s, and the angular one in rad/s.
    pub moving_surfaces: Vec<(usize, [f64; 6])>,
    /// The marked places.
    pub sites: Vec<Site>,
    /// The tendons, whose sites and joints there are.
    pub tendons: Vec<Tendon>,
    /// The soft things.
    pub flexes: Vec<Flex>,
    /// What holds joints or links together beside the tree.
    pub equalities: Vec<Equality>,
    /// The pairs of links that may touch, each in increasing order. None where they are too many to say.
    pub touching: Option<Vec<[usize; 2]>>,
    /// Pairs of links, in increasing order, of which the file says the friction of both together.
    pub pair_frictions: Vec<([usize; 2], f64)>,
}

/// A motor of a joint or a tendon: forces are those on it, positions and speeds its own ones. Of a tendon they are lengths.
#[derive(Debug, Clone, PartialEq)]
pub struct Actuator {
    /// Its name.
    pub name: String,
    /// What it moves.
    pub target: Target,
    /// What it does.
    pub drive: Drive,
    /// The greatest force or torque on the joint, N or N m, if it has one.
    pub effort: Option<f64>,
    /// Force or torque on the joint that is always there, N or N m.
    pub bias: f64,
    /// Lowest and highest force or torque on the joint, if it has them, N or N m.
    pub range: Option<[f64; 2]>,
    /// Lowest and highest position or speed of the joint of its control, if it has them.
    pub control: Option<[f64; 2]>,
    /// Its line in the file, from 1.
    pub line: u32,
}

/// What lets a body adhere to what it touches: with the gain times its control.
#[derive(Debug, Clone, PartialEq)]
pub struct Adhesion {
    /// Its name.
    pub name: String,
    /// The index of the link.
    pub link: usize,
    /// Newtons per unit of its control.
    pub gain: f64,
    /// Lowest and highest control, if it has them.
    pub control: Option<[f64; 2]>,
    /// Lowest and highest force, if it has them, N.
    pub force: Option<[f64; 2]>,
    /// Its line in the file, from 1.
    pub line: u32,
}

/// What an actuator moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// The joint with that index.
    Joint(usize),
    /// The tendon with that index.
    Tendon(usize),
}

/// A tendon: its length, and what acts along it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tendon {
    /// Its name.
    pub name: String,
    /// What its length is measured along: points, or joints.
    pub path: Vec<TendonPart>,
    /// Force per length, N/m; over joints per unit of its length.
    pub stiffness: f64,
    /// Force per speed, N s/m.
    pub damping: f64,
    /// Largest force of dry friction, N.
    pub friction: f64,
    /// Inertia of what moves with it, kg.
    pub armature: f64,
    /// Shortest and longest length at which the spring exerts no force; None for that at first.
    pub rest: Option<[f64; 2]>,
    /// Smallest and largest length, if it has them.
    pub range: Option<[f64; 2]>,
    /// Its line in the file, from 1.
    pub line: u32,
}

/// A part of the path of a tendon.
#[derive(Debug, Clone, PartialEq)]
pub enum TendonPart {
    /// It goes straight to the site of that name from the one before.
    Site(String),
    /// A new branch begins, whose length counts divided by this.
    Pulley(f64),
    /// The position of the joint of that name, times this, is a part of the length.
    Joint(String, f64),
}

/// What an actuator does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drive {
    /// Moves the joint to a position: force on the joint per error, and per speed.
    Position {
        /// N/m or N m/rad.
        stiffness: f64,
        /// N s/m or N m s/rad.
        damping: f64,
    },
    /// Moves the joint at a speed: force per error of it.
    Velocity {
        /// N s/m or N m s/rad.
        damping: f64,
    },
    /// Exerts a force.
    Force,
}

/// A marked place on a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// Its name.
    pub name: String,
    /// The index of its link.
    pub link: usize,
    /// In the link's frame.
    pub pose: Pose,
}

/// What holds joints or links together, beside the joints of the tree.
#[derive(Debug, Clone, PartialEq)]
pub enum Equality {
    /// The position of a joint is a polynomial of that of another one, both counted from where they are at first; of no other one: a constant.
    Joint {
        /// Index of the joint.
        joint: usize,
        /// Index of the joint that it follows, if any.
        master: Option<usize>,
        /// Coefficients, the constant first.
        polynomial: [f64; 5],
        /// Its line in the file, from 1.
        line: u32,
    },
    /// A point of a link, in the frames of both, stays at that of the other one.
    Connect {
        /// Indices of the two links.
        links: [usize; 2],
        /// The point in the frame of each link, metres.
        points: [[f64; 3]; 2],
        /// Its line in the file, from 1.
        line: u32,
    },
    /// A frame of a link, in the frames of both, stays at that of the other one.
    Weld {
        /// Indices of the two links.
        links: [usize; 2],
        /// The frame in the frame of each link.
        frames: [Pose; 2],
        /// Its line in the file, from 1.
        line: u32,
    },
}

/// The triangles of a mesh file, metres.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Triangles {
    /// Positions of the vertices.
    pub vertices: Vec<[f64; 3]>,
    /// Indices of vertices; those that are not there are not looked at.
    pub corners: Vec<[u32; 3]>,
}

/// The files that a model names.
pub trait Files {
    /// The text of a file that is included; its name is relative to the folder of the model.
    ///
    /// # Errors
    /// When it cannot be had; in words.
    fn include(&mut self, name: &str) -> Result<Vec<u8>, String>;

    /// The triangles of a mesh: for bodies whose mass follows from their geoms.
    ///
    /// # Errors
    /// When they cannot be had; in words.
    fn triangles(&mut self, file: &str) -> Result<Triangles, String>;
}

/// Whether a text is MJCF: its first element is `<mujoco>`.
pub fn is_mjcf(bytes: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(64 << 10)]).into_owned();
    let mut rest = start.as_str();
    loop {
        rest = rest.trim_start_matches(|c: char| c == '\u{feff}' || c.is_whitespace());
        let end = if rest.starts_with("<!--") {
            "-->"
        } else if rest.starts_with("<?") || rest.starts_with("<!") {
            ">"
        } else {
            return rest
                .strip_prefix("<mujoco")
                .is_some_and(|rest| rest.starts_with([' ', '>', '/', '\n', '\r', '\t']));
        };
        let Some(at) = rest.find(end) else {
            return false;
        };
        rest = &rest[at + end.len()..];
    }
}

/// Reads an MJCF file.
///
/// # Errors
///
/// If it is no XML, does not begin with `<mujoco>`, or exceeds a limit.
pub fn read(bytes: &[u8], files: &mut dyn Files) -> Result<Parsed<Model>, ReadError> {
    let mut report = Report::default();
    let root = element::read(bytes, files, &mut report)?;
    let document = Document::new(&root, &mut report);
    let mut builder = Builder::new(&document, &root, files, report);
    for world in root.named("worldbody") {
        builder.add_world(world);
    }
    builder.finish_masses(&root);
    builder.leave_out_untouched();
    builder.find_touching_pairs();
    let (mut model, mut report) = builder.into_parts();
    // The world itself is a link.
    let world = |link: &Link| link.visuals.is_empty() && link.collisions.is_empty();
    if let [] | [_] = model.robot.links.as_slice()
        && model.robot.links.iter().all(world)
        && model.flexes.is_empty()
    {
        report.warn(&root, "has no body and no geom");
    }
    model.robot.name = root.attribute("model").unwrap_or("mujoco").to_owned();
    (model.gravity, model.fluid) = (document.gravity, document.fluid);
    model.tendons = tendon::read(&root, &document, &model, &mut report);
    model.actuators = actuator::read(&root, &document, &model, &mut report);
    model.adhesions = surface::adhesions(&root, &document, &model, &mut report);
    model.equalities = equality::read(&root, &model, &mut report);
    Ok(report.finish(model))
}
