//! The scene: objects, handles, poses, names. Pure data and maths: no Lua, no physics, no I/O, no clock.
//!
//! [`Scene`] owns every object in one store indexed by [`Handle`]. Reading gives `&Object`; every mutation is a method of `Scene` and
//! ends in [`Changes`], so that events, caches and the physics learn of it in one place.

pub mod change;
mod collection;
pub mod colour;
mod copy;
mod custom_data;
pub mod data;
mod default_scene;
pub mod dummy;
pub mod dynamics_report;
pub mod engine_params;
mod engine_values;
pub mod error;
pub mod force_sensor;
pub mod handle;
mod hull;
pub mod joint;
pub mod joint_control;
mod joint_dependency;
pub mod joint_motion;
mod joint_params;
mod kept;
mod kind_params;
pub mod mass;
pub mod mesh;
pub mod mesh_box;
mod mesh_islands;
mod object;
mod object_params;
mod path;
pub mod pose;
mod poses;
pub mod primitive;
mod references;
mod restore;
pub mod ruckig;
mod scale;
pub mod script_object;
mod sensor_build;
pub mod sensors;
pub mod settings;
pub mod shape;
pub mod shape_build;
mod shape_geometry;
mod shape_group;
mod shape_params;
mod store;
mod tree;
mod value_type;

pub use change::{Change, Changes, Field};
pub use collection::{Collection, CollectionItem};
pub use copy::CopyOptions;
pub use custom_data::{CustomData, Edit, Edited, Holder, Namespace, ValueType};
pub use data::{Data, Key};
pub use error::{SceneError, SceneResult};
pub use handle::{Handle, Uid, flag, special};
pub use kept::Kept;
pub use object::{Kind, Measured, NOT_MODEL, Object};
pub use path::clean_alias;
pub use pose::Pose;
pub use poses::{Frame, Placement};
pub use settings::{DynamicsSettings, Settings};
pub use store::Scene;
