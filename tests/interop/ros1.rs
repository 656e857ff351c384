//! simROS with ROS 1 itself: the master and rospy of Debian 12.

use std::process::Command;
use std::time::Duration;

use test_support::process::run_within;
use test_support::skipped_outside_of_ci;

use crate::server::folder;

/// Where Debian's packages are; an environment of another Python does not have them.
const PYTHON: &str = "/usr/bin/python3";

#[test]
#[cfg(target_os = "linux")]
fn topics_services_and_parameters_with_rospy() {
    let has_ros = Command::new(PYTHON)
        .args([
            "-c",
            "import rospy, rosmaster, sensor_msgs.msg, tf2_msgs.msg, std_srvs.srv",
        ])
        .output();
    if !has_ros.is_ok_and(|output| output.status.success()) {
        return skipped_outside_of_ci("Debian's packages of ROS 1 are not installed (see .ci/run)");
    }
    let mut command = Command::new(PYTHON);
    command
        .arg(folder().join("ros1_peers.py"))
        .arg(env!("CARGO_BIN_EXE_swanilda"));
    command
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env_remove("ROS_MASTER_URI")
        .env_remove("ROS_NAMESPACE");
    assert_eq!(
        run_within(&mut command, Duration::from_secs(120)).as_deref(),
        Ok("")
    );
}
