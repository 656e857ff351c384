//! Any bytes as a URDF file, and as the inside of one: a robot whose links have finite frames and that is read again as it is written, or an error.
//!
//! `cargo fuzz run urdf`
#![no_main]

use libfuzzer_sys::fuzz_target;
use robot_description::{Pose, urdf};

fn is_finite(pose: &Pose) -> bool {
    pose.translation.vector.iter().chain(pose.rotation.coords.iter()).all(|x| x.is_finite())
}

fuzz_target!(|bytes: &[u8]| {
    let inside = [b"<robot name='r'><link name='a'/><link name='b'/>", bytes, b"</robot>"].concat();
    for bytes in [bytes, &inside] {
        let Ok(parsed) = urdf::read(bytes) else { continue };
        let robot = parsed.value;
        let poses = robot.link_poses(&robot.zero_positions()).expect("as many positions as the joints have");
        assert_eq!(poses.len(), robot.links.len());
        assert!(poses.iter().all(is_finite));
        let inertials = robot.links.iter().filter_map(|link| link.inertial.as_ref());
        assert!(inertials.flat_map(|inertial| inertial.inertia.iter().chain([&inertial.mass])).all(|x| x.is_finite()));
        let again = urdf::read(urdf::write(&robot).as_bytes()).expect("what is written is a robot").value;
        assert_eq!((again.links.len(), again.joints.len()), (robot.links.len(), robot.joints.len()));
    }
});
