//! simROS2 with CycloneDDS under the names of ROS 2.

use crate::web::check;

#[test]
#[cfg(target_os = "linux")]
fn topics_and_services_with_cyclone_dds() {
    check("ros2_peers.py");
}

/// JPEG and PNG in both directions.
#[test]
#[cfg(target_os = "linux")]
fn compressed_images_with_cyclone_dds() {
    check("ros2_images.py");
}

/// Every service and the action of the standard simulation interfaces.
#[test]
#[cfg(target_os = "linux")]
fn simulation_interfaces_with_cyclone_dds() {
    check("ros2_interfaces.py");
}

/// A robot with wheels, an arm, spawned robots and a scene, by their descriptions.
#[test]
#[cfg(target_os = "linux")]
fn robots_with_cyclone_dds() {
    check("ros2_robot.py");
}

/// Ten runs under load, with nodes that answer late and in any order, end in the same state.
#[test]
#[cfg(target_os = "linux")]
fn lock_step_with_cyclone_dds() {
    check("ros2_lockstep.py");
}

/// Fifty topics, peers that come late and go, a simulator that is started again.
#[test]
#[cfg(target_os = "linux")]
fn fifty_topics_with_cyclone_dds() {
    check("ros2_crowd.py");
}

/// Without multicast: one side names the address of the other.
#[test]
#[cfg(target_os = "linux")]
fn static_peers_with_cyclone_dds() {
    check("ros2_static_peers.py");
}

/// Of all datagrams, of discovery too, fifteen of a hundred are lost in each direction.
#[test]
#[cfg(target_os = "linux")]
fn lost_datagrams_between_cyclone_dds_and_us() {
    check("ros2_lossy.py");
}
