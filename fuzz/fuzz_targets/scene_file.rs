//! Any bytes as a scene or model: it is loaded and can be saved, or it is refused.
//!
//! `cargo fuzz run scene_file fuzz/corpus/scene_file tests/scene_files`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Scene;
use swanilda::SceneFile;

fuzz_target!(|bytes: &[u8]| {
    let Ok(file) = SceneFile::read(bytes) else { return };
    let mut scene = Scene::new();
    let loaded = file.add_to(&mut scene, true).expect("there is room in an empty scene");
    assert_eq!(scene.len(), loaded.objects.len());
});
