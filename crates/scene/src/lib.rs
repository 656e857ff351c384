//! The scene: objects, handles, poses, names. Pure data and maths: no Lua, no physics, no I/O, no clock.
//!
//! [`Scene`] owns every object in one store indexed by [`Handle`]. Reading gives `&Object`; every mutation is a method of `Scene` and
//! is recorded in the [`Journal`], which events, caches and the physics read.

pub mod appearance;
pub mod drawing;
pub mod error;
pub mod graph;
pub mod joint;
pub mod journal;
pub mod object;
pub mod parameters;
pub mod path_object;
pub mod pose;
pub mod sensor;
pub mod shape;
pub mod simulation;
mod store;
pub mod tree;
pub mod values;
pub mod voxels;

pub use geometry::Pose;
pub use numbers;

pub use error::{SceneError, SceneResult};
pub use journal::{Change, Counters, Cursor, Field, Journal, Mark, Topic, Topics, Unread};
pub use object::flags::{
    DynamicFlags, ForbiddenMovements, Layers, ModelFlags, ObjectFlags, PreferredAxes, SpecialFlags,
};
pub use object::handle::{Handle, Uid, flag, special};
pub use object::movement::Movement;
pub use object::{Kind, MeasuredVelocity, Object};
pub use pose::placement::{Frame, Placement};
pub use simulation::settings::{Calculations, DynamicsSettings, Settings};
pub use store::{FIRST_MESH_UID, Scene};
pub use tree::collection::{
    Collection, CollectionItem, CollectionOptions, Collections, ItemOptions, Members,
};
pub use tree::copy::CopyOptions;
pub use tree::hierarchy::{COLLISION_BITS, COLLISION_TREE, FURTHER_BITS};
pub use tree::old_names::{alternative_name, is_legal as is_legal_old_name, suffix as name_suffix};
pub use tree::path::clean_alias;
pub use tree::references::{ReferenceLists, References};
pub use values::custom_data::{CustomData, Edit, Edited, Holder, Namespace};
pub use values::data::{Data, Key};
pub use values::inert::InertValues;
pub use values::value_type::ValueType;
