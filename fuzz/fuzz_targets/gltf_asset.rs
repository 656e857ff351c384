//! Any bytes as a glTF file with its nodes: it is read or refused, and what is read can be written and read again.
//!
//! `cargo fuzz run gltf_asset fuzz/corpus/mesh_gltf`
#![no_main]

use libfuzzer_sys::fuzz_target;
use mesh_files::Limits;
use mesh_files::gltf::Asset;

fuzz_target!(|bytes: &[u8]| {
    let limits = Limits { vertices: 100_000, triangles: 100_000, parts: 1000 };
    let Ok(asset) = Asset::read(bytes, limits, &mut |_| Ok(bytes.to_vec())) else { return };
    // Numbers of 32 bits may become infinite in the file; else it is as sound as the first one.
    let Ok(text) = asset.to_text() else { return };
    if let Ok(again) = Asset::read(text.as_bytes(), limits, &mut |_| Err(String::new())) {
        assert_eq!(again.nodes.len(), asset.nodes.len());
        assert_eq!(again.meshes.len(), asset.meshes.len());
    }
});
