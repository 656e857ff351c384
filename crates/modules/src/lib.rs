//! The modules beside `sim`: one folder or file for each.
//!
//! Their native functions are here; parts that are better written in Lua are in `lua/`, in a file of the module's name.

mod swanilda_test;

use heap::Lazy;
use std::sync::Arc;

use lua_library::FILES;
use script::{ApiError, ApiFn, ApiResult as Result, Cx, Module, Registry, functions};

/// All modules. `sim` is the first; the others are in alphabetical order.
pub static ALL: &[&Module] = &[
    &api::SIM,
    &modules_messaging::lfs::LFS,
    &modules_messaging::lfs::LFSX,
    &modules_messaging::mime::MODULE,
    &modules_messaging::cbor::CBOR,
    &modules_messaging::cbor::CBOR_HEADS,
    &modules_messaging::remote::PYTHON,
    &modules_messaging::remote::VISUALIZATION,
    &modules_messaging::remote::WS,
    &modules_messaging::remote::ZMQ,
    &modules_messaging::cbor::SIM_CBOR,
    &modules_geometry::sim_assimp::MODULE,
    &modules_geometry::sim_convex::MODULE,
    &modules_geometry::sim_eigen::MODULE,
    &modules_geometry::sim_geom::MODULE,
    &modules_geometry::sim_gltf::MODULE,
    &modules_sensing::sim_icp::MODULE,
    &modules_motion::sim_ik::MODULE,
    &modules_sensing::sim_im::MODULE,
    &modules_motion::sim_mujoco::MODULE,
    &modules_motion::sim_ompl::MODULE,
    &modules_geometry::sim_open_mesh::MODULE,
    &modules_windows::sim_qml::MODULE,
    &modules_messaging::sim_remote_api::MODULE,
    #[cfg(feature = "ros1")]
    &modules_ros::sim_ros::MODULE,
    #[cfg(feature = "ros2")]
    &modules_ros::sim_ros2::MODULE,
    #[cfg(feature = "ros2")]
    &modules_ros::sim_ros2::REMOTE,
    #[cfg(feature = "ros2")]
    &modules_ros::sim_ros2::REMOTE_LOCKSTEP,
    #[cfg(feature = "ros2")]
    &modules_ros::sim_ros2::REMOTE_ROBOTS,
    &modules_geometry::sim_sdf::MODULE,
    &modules_motion::sim_soft::MODULE,
    &modules_messaging::sim_subprocess::MODULE,
    &modules_sensing::sim_surf_rec::MODULE,
    &modules_windows::sim_ui::MODULE,
    &modules_geometry::sim_urdf::MODULE,
    &modules_sensing::sim_vision::MODULE,
    &modules_messaging::sim_ws::MODULE,
    &modules_messaging::sim_zmq::MODULE,
    &modules_messaging::socket::CORE,
    &modules_messaging::socket::UNIX,
    &modules_messaging::socket::SSL,
    &api::LIBRARY,
    &swanilda_test::MODULE,
];

/// All built-in functions and modules. Bound once per process.
pub fn registry() -> Arc<Registry> {
    static REGISTRY: Lazy<Arc<Registry>> = Lazy::new(|| Arc::new(Registry::new(ALL, FILES)));
    REGISTRY.clone()
}
