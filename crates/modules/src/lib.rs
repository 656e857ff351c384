//! The modules beside `sim`: one folder or file for each.
//!
//! Their native functions are here; parts that are better written in Lua are in `lua/`, in a file of the module's name.

mod cbor;
mod lfs;
mod mime;
pub(crate) mod remote;
#[cfg(any(feature = "ros1", feature = "ros2"))]
mod ros_entities;
#[cfg(any(feature = "ros1", feature = "ros2"))]
mod ros_images;
#[cfg(any(feature = "ros1", feature = "ros2"))]
mod ros_values;
mod sim_assimp;
mod sim_convex;
mod sim_eigen;
mod sim_geom;
mod sim_gltf;
mod sim_icp;
mod sim_ik;
mod sim_im;
mod sim_ompl;
mod sim_open_mesh;
pub(crate) mod sim_remote_api;
#[cfg(feature = "ros1")]
mod sim_ros;
#[cfg(feature = "ros2")]
mod sim_ros2;
mod sim_sdf;
mod sim_subprocess;
mod sim_surf_rec;
mod sim_ui;
mod sim_urdf;
mod sim_vision;
mod sim_ws;
pub(crate) mod sim_zmq;
mod socket;
mod swanilda_test;

use std::sync::{Arc, LazyLock};

use crate::api;
use crate::script::{
    ApiError, ApiFn, ApiResult as Result, Args, Cx, FILES, FromScript, Module, Param, Registry, functions,
};

/// All modules. `sim` is the first; the others are in alphabetical order.
pub(crate) static ALL: &[&Module] = &[
    &api::SIM,
    &lfs::LFS,
    &lfs::LFSX,
    &mime::MODULE,
    &cbor::CBOR,
    &cbor::CBOR_HEADS,
    &remote::PYTHON,
    &remote::VISUALIZATION,
    &remote::WS,
    &remote::ZMQ,
    &cbor::SIM_CBOR,
    &sim_assimp::MODULE,
    &sim_convex::MODULE,
    &sim_eigen::MODULE,
    &sim_geom::MODULE,
    &sim_gltf::MODULE,
    &sim_icp::MODULE,
    &sim_ik::MODULE,
    &sim_im::MODULE,
    &sim_ompl::MODULE,
    &sim_open_mesh::MODULE,
    &sim_remote_api::MODULE,
    #[cfg(feature = "ros1")]
    &sim_ros::MODULE,
    #[cfg(feature = "ros2")]
    &sim_ros2::MODULE,
    &sim_sdf::MODULE,
    &sim_subprocess::MODULE,
    &sim_surf_rec::MODULE,
    &sim_ui::MODULE,
    &sim_urdf::MODULE,
    &sim_vision::MODULE,
    &sim_ws::MODULE,
    &sim_zmq::MODULE,
    &socket::CORE,
    &socket::UNIX,
    &socket::SSL,
    &swanilda_test::MODULE,
];

/// All built-in functions and modules. Bound once per process.
pub(crate) fn registry() -> Arc<Registry> {
    static REGISTRY: LazyLock<Arc<Registry>> = LazyLock::new(|| Arc::new(Registry::new(ALL, FILES)));
    REGISTRY.clone()
}
