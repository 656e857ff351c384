//! Any bytes as an MJCF file, as the inside of one, and as a file that is included: links that have finite frames, or an error.
//!
//! `cargo fuzz run mjcf`
#![no_main]

use libfuzzer_sys::fuzz_target;
use robot_description::Pose;
use robot_description::mjcf::{self, Files, Triangles};

struct Same(Vec<u8>);

impl Files for Same {
    fn include(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Ok(self.0.clone())
    }

    fn triangles(&mut self, _: &str) -> Result<Triangles, String> {
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Ok(Triangles { vertices, corners: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 9]] })
    }
}

fn is_finite(pose: &Pose) -> bool {
    pose.translation.vector.iter().chain(pose.rotation.coords.iter()).all(|x| x.is_finite())
}

fuzz_target!(|bytes: &[u8]| {
    let inside = [b"<mujoco><worldbody><body>", bytes, b"</body></worldbody></mujoco>"].concat();
    for bytes in [bytes, &inside] {
        let Ok(parsed) = mjcf::read(bytes, &mut Same(inside.clone())) else { continue };
        let robot = parsed.value.robot;
        let poses = robot.link_poses(&robot.zero_positions()).expect("as many positions as the joints have");
        assert_eq!(poses.len(), robot.links.len());
        assert!(poses.iter().all(is_finite));
        let inertials = robot.links.iter().filter_map(|link| link.inertial.as_ref());
        assert!(inertials.flat_map(|inertial| inertial.inertia.iter().chain([&inertial.mass])).all(|x| x.is_finite()));
    }
});
