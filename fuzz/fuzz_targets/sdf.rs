//! Any bytes as an SDF file, as the inside of one, and as a file that is included: models whose links have finite frames, or an error.
//!
//! `cargo fuzz run sdf`
#![no_main]

use libfuzzer_sys::fuzz_target;
use robot_description::Pose;
use robot_description::sdf::{self, Included};

fn is_finite(pose: &Pose) -> bool {
    pose.translation.vector.iter().chain(pose.rotation.coords.iter()).all(|x| x.is_finite())
}

fuzz_target!(|bytes: &[u8]| {
    let inside = [b"<sdf version='1.9'><model name='m'>", bytes, b"</model></sdf>"].concat();
    for bytes in [bytes, &inside] {
        let mut include = |_: &str| Ok(Included { bytes: inside.clone(), folder: String::new() });
        let Ok(parsed) = sdf::read(bytes, &mut include) else { continue };
        for model in parsed.value.models {
            let poses = model.robot.link_poses(&model.robot.zero_positions()).expect("as many positions as the joints have");
            assert_eq!(poses.len(), model.robot.links.len());
            assert!(poses.iter().all(is_finite));
        }
    }
});
