//! Any bytes as an XML scene or model, and as the inside of one: it is loaded, or it is refused.
//!
//! `cargo fuzz run xml_scene fuzz/corpus/xml_scene tests/data`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::SceneFile;
use swanilda::scene::Scene;

fuzz_target!(|bytes: &[u8]| {
    let text = [b"<CoppeliaSim>", bytes, b"</CoppeliaSim>"].concat();
    for bytes in [bytes, &text] {
        let Ok(file) = SceneFile::read(bytes) else { continue };
        let mut scene = Scene::new();
        let loaded = file.add_to(&mut scene, true).expect("there is room in an empty scene");
        assert_eq!(scene.len(), loaded.objects.len());
    }
});
