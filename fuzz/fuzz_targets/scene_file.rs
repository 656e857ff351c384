//! Any bytes as a scene or model: they are refused, or loaded, saved and read again.
//!
//! Seeds: `python3 fuzz/seeds.py`, which writes `fuzz/corpus/scene_file`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::SceneFile;
use swanilda::scene::Scene;

fuzz_target!(|bytes: &[u8]| {
    let Ok(file) = SceneFile::read(bytes) else { return };
    let mut scene = Scene::new();
    let loaded = file.add_to(&mut scene, true).expect("there is room in an empty scene");
    assert_eq!(scene.len(), loaded.objects.len());
    let saved = SceneFile::bytes_of(&scene, &loaded.scripts).expect("a loaded scene can be saved");
    assert!(SceneFile::read(&saved).is_ok(), "a saved scene can be read");
});
