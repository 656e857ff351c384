//! What scripts can call as `sim`: one file per category of the manual.
//!
//! A function is said once, with `#[api]`; its row joins the table of its file, and the tables join here. Names that need no code of
//! their own stand in tables: constants, aliases, deprecations, old names, and the reference that tells what is missing.

mod data;
mod display;
mod files;
mod motion;
mod objects;
mod old;
mod parameters;
mod scripts;
mod sensors;
mod shapes;

use std::collections::HashMap;

use crate::script::{Bound, FILES, Member, Registry};

pub(crate) use crate::script::{ApiError, ApiResult as Result, functions};
pub use crate::script::{ApiFn, Args, Cx, FromScript, IntoScript, Param};

/// All native functions, file by file.
pub const CATEGORIES: &[(&str, &[ApiFn])] = &[
    ("Globals", scripts::global::FUNCTIONS),
    ("Scripts", scripts::script::FUNCTIONS),
    ("Older script functions", old::script::FUNCTIONS),
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
    ("Colours", shapes::colour::FUNCTIONS),
    ("Textures", shapes::texture::FUNCTIONS),
    ("Joints", motion::joint::FUNCTIONS),
    ("Joint motion", motion::joint_motion::FUNCTIONS),
    ("Old functions of joints and shapes", old::joint_shape::FUNCTIONS),
    ("Dummies", objects::dummy::FUNCTIONS),
    ("Force sensors", sensors::force_sensor::FUNCTIONS),
    ("Sensors", sensors::state::FUNCTIONS),
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
    ("Consoles, messages of the interface, semaphores", display::auxiliary_console::FUNCTIONS),
    ("User parameters", old::user_param::FUNCTIONS),
    ("Octrees and point clouds", sensors::voxels::FUNCTIONS),
    ("Objects in octrees and point clouds", sensors::voxel_objects::FUNCTIONS),
    ("Scene files", files::scene_file::FUNCTIONS),
    ("Graphs", display::graph::FUNCTIONS),
    ("Display", display::drawing::FUNCTIONS),
];

/// `name<TAB>value` of every constant of `sim`.
pub(crate) const CONSTANTS: &str = include_str!("tables/constants.tsv");
/// `old<TAB>new`: names that do exactly what another does.
pub(crate) const ALIASES: &str = include_str!("tables/aliases.tsv");
/// `name<TAB>replacement`: names that log their deprecation at the first call.
pub(crate) const DEPRECATED: &str = include_str!("tables/deprecated.tsv");
/// `simName<TAB>name`: old global names that follow no rule.
const OLD_NAMES: &str = include_str!("tables/old_names.tsv");
/// `name<TAB>category<TAB>deprecated<TAB>signature` of every function CoppeliaSim's reference has.
pub(crate) const REFERENCE: &str = include_str!("tables/reference.tsv");
/// `name<TAB>tier` of the reference's functions: T1 is what published code uses most.
pub(crate) const TIERS: &str = include_str!("tables/tiers.tsv");

/// Puts the members of `sim` and the global functions into `registry`.
pub(crate) fn add_to(registry: &mut Registry) {
    let notices = notices();
    add_missing(registry);
    add_constants(registry);
    add_lua_functions(registry, &notices);
    for function in CATEGORIES.iter().flat_map(|(_, functions)| *functions) {
        match function.name.strip_prefix("sim.") {
            Some(name) => {
                registry.members.insert(name, native(function.name, function, &notices));
            }
            None => registry.globals.push(Bound { name: function.name, function, deprecation: None }),
        }
    }
    add_aliases(registry, &notices);
    registry.old_names = pairs(OLD_NAMES).collect();
}

type Notices = HashMap<&'static str, &'static str>;

/// The line logged at the first call of a deprecated name. Made once per process and kept.
fn notices() -> Notices {
    pairs(DEPRECATED).map(|(name, replacement)| (name, notice(name, replacement))).collect()
}

fn notice(name: &str, replacement: &str) -> &'static str {
    let advice = match replacement {
        "" => " and the related functionality will disappear in a future release.".to_owned(),
        _ => format!(". please use {replacement} instead."),
    };
    Box::leak(
        format!("sim.{name} is deprecated{advice} (control verbosity via notifyDeprecated in usrset.txt)")
            .into_boxed_str(),
    )
}

fn native(name: &'static str, function: &'static ApiFn, notices: &Notices) -> Member {
    let deprecation = name.strip_prefix("sim.").and_then(|member| notices.get(member)).copied();
    Member::Native(Bound { name, function, deprecation })
}

fn add_missing(registry: &mut Registry) {
    for (name, _) in REFERENCE.lines().filter_map(|line| line.split_once('\t')) {
        registry.members.insert(name, Member::Missing { name });
    }
}

fn add_constants(registry: &mut Registry) {
    for (name, value) in pairs(CONSTANTS) {
        let value = value.parse().expect("constants.tsv holds integers");
        registry.members.insert(name, Member::Constant(value));
    }
}

/// Module name and text of all embedded Lua files.
pub(crate) fn embedded_files() -> impl Iterator<Item = (&'static str, &'static str)> {
    FILES.iter().copied()
}

/// Module name and text of the files in `lua/library/sim`.
pub(crate) fn lua_files() -> impl Iterator<Item = (&'static str, &'static str)> {
    embedded_files().filter(|(module, _)| module.starts_with("sim/"))
}

/// Functions of the files in `lua/library/sim`: each is a line `function M.name(`.
fn add_lua_functions(registry: &mut Registry, notices: &Notices) {
    for (module, source) in lua_files() {
        for name in
            source.lines().filter_map(|line| line.strip_prefix("function M.")).filter_map(|l| l.split('(').next())
        {
            let deprecation = notices.get(name).copied();
            registry.members.insert(name, Member::Lua { module, function: name, deprecation });
        }
    }
}

fn add_aliases(registry: &mut Registry, notices: &Notices) {
    for (old, new) in pairs(ALIASES) {
        let global = registry.globals.iter().find(|bound| bound.name == new).map(|bound| bound.function);
        let member = match (registry.members.get(new).filter(|_| old != new), global) {
            (Some(Member::Native(bound)), _) => native(full_name(old), bound.function, notices),
            (None, Some(function)) => native(full_name(old), function, notices),
            (Some(Member::Lua { module, function, .. }), _) => {
                Member::Lua { module, function, deprecation: notices.get(old).copied() }
            }
            _ => continue,
        };
        registry.members.insert(old, member);
    }
}

fn full_name(member: &str) -> &'static str {
    Box::leak(format!("sim.{member}").into_boxed_str())
}

pub(crate) fn pairs(table: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    table.lines().filter_map(|line| line.split_once('\t'))
}
