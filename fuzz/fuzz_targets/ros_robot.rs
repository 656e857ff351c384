//! Any bytes as what a robot has to do with ROS 2: tags of URDF and SDF, parameters in YAML, settings in TOML. Numbers are finite, and lines are of the text.
//!
//! `cargo fuzz run ros_robot`
#![no_main]

use libfuzzer_sys::fuzz_target;
use robot_description::ros;

fuzz_target!(|bytes: &[u8]| {
    let inside = [b"<robot name='r'><gazebo reference='a'>", bytes, b"</gazebo></robot>"].concat();
    let read = [
        ros::of_urdf(bytes).ok(),
        ros::of_urdf(&inside).ok(),
        ros::of_sdf(bytes).ok(),
        Some(ros::of_yaml(bytes)),
        ros::of_toml(bytes).ok(),
    ];
    let lines = bytes.iter().filter(|byte| **byte == b'\n').count() + 1;
    for parsed in read.into_iter().flatten() {
        assert!(parsed.warnings.iter().all(|warning| warning.line as usize <= lines));
        let mut interface = parsed.value;
        interface.add_usual_controllers();
        for value in interface.parts.iter().flat_map(|part| part.values.values()) {
            assert!(!matches!(value, ros::Value::Number(number) if !number.is_finite()));
        }
    }
});
