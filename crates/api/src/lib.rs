//! The functions of module `sim`: one file per category of the manual.
//!
//! A function is described once, with `#[api]`; its row is in the table of its file, and the tables are listed here. Names that need no code of
//! their own are in tables: constants, aliases, deprecations, old names, and the reference, which shows what is missing.

mod data;
mod display;
mod files;
mod motion;
mod objects;
mod old;
mod parameters;
mod scripts;
mod sensors;
pub(crate) mod shapes;

use script::{Hooks, Module, Outside};

pub use script::ApiFn;
pub(crate) use script::{ApiError, ApiResult as Result, Args, Cx, FromScript, functions};

/// All native functions, file by file.
const CATEGORIES: &[(&str, &[ApiFn])] = &[
    ("Globals", scripts::global::FUNCTIONS),
    ("Scripts", scripts::script::FUNCTIONS),
    ("What is known of functions", scripts::help::FUNCTIONS),
    ("Older script functions", old::script::FUNCTIONS),
    ("Globals of V-REP", old::globals::FUNCTIONS),
    ("Paths of V-REP", old::paths::FUNCTIONS),
    ("Path planning of V-REP", old::path_planning::FUNCTIONS),
    (
        "Custom user interfaces of V-REP",
        old::button_interfaces::FUNCTIONS,
    ),
    ("Time and chance", scripts::time::FUNCTIONS),
    ("Simulation", scripts::simulation::FUNCTIONS),
    ("Threads", scripts::thread::FUNCTIONS),
    ("Names and paths", objects::alias::FUNCTIONS),
    ("Poses of objects", objects::pose::FUNCTIONS),
    ("Pose maths", objects::pose_maths::FUNCTIONS),
    ("Object tree", objects::tree::FUNCTIONS),
    ("Copies and models", objects::copy::FUNCTIONS),
    ("Object properties", objects::property::FUNCTIONS),
    ("Object parameters", old::object_param::FUNCTIONS),
    ("Collections", objects::collection::FUNCTIONS),
    ("Shapes", shapes::shape::FUNCTIONS),
    ("Mass of shapes", shapes::mass::FUNCTIONS),
    ("Groups of shapes", shapes::group::FUNCTIONS),
    ("Convex and extruded shapes", shapes::convex::FUNCTIONS),
    ("Mesh files", shapes::mesh_file::FUNCTIONS),
    ("Colours", shapes::colour::FUNCTIONS),
    ("Textures", shapes::texture::FUNCTIONS),
    ("Joints", motion::joint::FUNCTIONS),
    ("Joint motion", motion::joint_motion::FUNCTIONS),
    (
        "Old functions of joints and shapes",
        old::joint_shape::FUNCTIONS,
    ),
    ("Dummies", objects::dummy::FUNCTIONS),
    ("Force sensors", sensors::force_sensor::FUNCTIONS),
    ("Proximity sensors", sensors::proximity_sensor::FUNCTIONS),
    ("Collisions and distances", sensors::queries::FUNCTIONS),
    (
        "Collision and distance objects of old scenes",
        old::calculation_objects::FUNCTIONS,
    ),
    (
        "Groups of inverse kinematics of V-REP",
        old::ik_groups::FUNCTIONS,
    ),
    (
        "Postures for groups of inverse kinematics of V-REP",
        old::ik_postures::FUNCTIONS,
    ),
    ("Vision sensors", sensors::vision::FUNCTIONS),
    (
        "Old functions of vision sensors",
        old::vision_sensor::FUNCTIONS,
    ),
    ("Sensor objects", sensors::create::FUNCTIONS),
    ("Ruckig", motion::ruckig::FUNCTIONS),
    ("Time-optimal trajectories", motion::trajectory::FUNCTIONS),
    ("Dynamics", motion::dynamics::FUNCTIONS),
    ("Engine parameters", old::engine_param::FUNCTIONS),
    ("Events", scripts::events::FUNCTIONS),
    ("Images", display::images::FUNCTIONS),
    ("Properties", data::property::FUNCTIONS),
    ("Simulator parameters", parameters::param::FUNCTIONS),
    ("Custom data", data::custom_data::FUNCTIONS),
    ("Signals", old::signal::FUNCTIONS),
    ("Packing", data::packing::FUNCTIONS),
    ("Tubes", old::tube::FUNCTIONS),
    ("Serial ports", files::serial::FUNCTIONS),
    ("Programs", files::program::FUNCTIONS),
    (
        "Consoles, messages of the interface, semaphores",
        display::auxiliary_console::FUNCTIONS,
    ),
    ("Text editors", display::text_editor::FUNCTIONS),
    ("User parameters", old::user_param::FUNCTIONS),
    ("Octrees and point clouds", sensors::voxels::FUNCTIONS),
    (
        "Objects in octrees and point clouds",
        sensors::voxel_objects::FUNCTIONS,
    ),
    ("Scene files", files::scene_file::FUNCTIONS),
    ("Graphs", display::graph::FUNCTIONS),
    ("Drawing objects", display::drawing::FUNCTIONS),
    ("Particles", display::particles::FUNCTIONS),
    ("Display", display::views::FUNCTIONS),
    ("Display", display::window::FUNCTIONS),
    ("Banners and views of cameras", display::banners::FUNCTIONS),
];

/// What calls devices and other programs.
const OUTSIDE: &[&str] = &[
    "sim._serialOpen",
    "sim._serialClose",
    "sim._serialRead",
    "sim._serialRest",
    "sim.serialSend",
    "sim.serialCheck",
    "sim.launchExecutable",
    "sim.systemSemaphore",
];

/// The module `sim`, with the global functions that come along with it.
pub static SIM: Module = Module {
    functions: CATEGORIES,
    constants: include_str!("tables/constants.tsv"),
    aliases: include_str!("tables/aliases.tsv"),
    deprecated: include_str!("tables/deprecated.tsv"),
    reference: include_str!("tables/reference.tsv"),
    old_names: include_str!("tables/old_names.tsv"),
    lua_members: Some("sim/"),
    hooks: Hooks {
        end_of_simulation: Some(files::serial::end_simulation),
        ..Hooks::NONE
    },
    outside: Outside::Only(OUTSIDE),
    ..Module::new("sim")
};

/// The module of functions that only programs call which load the simulator as a library.
pub static LIBRARY: Module = Module {
    inner: &[old::library::FUNCTIONS],
    ..Module::new("swanilda.library")
};

/// `name<TAB>tier` of the reference's functions: T1 is what published code uses most.
pub const TIERS: &str = include_str!("tables/tiers.tsv");
