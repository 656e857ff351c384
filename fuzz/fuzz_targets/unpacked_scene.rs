//! Any bytes in place of one file of an unpacked model: the tree, a mesh (OBJ), a script or binary data. The model is refused, or loaded, and
//! can be saved then.
//!
//! The model and the seeds are made by `python3 fuzz/seeds.py`.
//!
//! `cargo fuzz run unpacked_scene`
#![no_main]

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, Simulator};

struct Unpacked {
    folder: PathBuf,
    /// Its files, with what is in them.
    files: Vec<(PathBuf, Vec<u8>)>,
}

static UNPACKED: OnceLock<Unpacked> = OnceLock::new();

/// A copy of the unpacked model for this process.
fn copy() -> Unpacked {
    let original = Path::new(env!("CARGO_MANIFEST_DIR")).join("unpacked/robot");
    let folder = std::env::temp_dir().join(format!("swanilda-fuzz-{}", std::process::id()));
    let mut files = Vec::new();
    copy_folder(&original, &folder, &mut files);
    files.sort();
    assert!(files.len() > 3, "the model has a tree, meshes and scripts");
    Unpacked { folder, files }
}

fn copy_folder(from: &Path, to: &Path, files: &mut Vec<(PathBuf, Vec<u8>)>) {
    std::fs::create_dir_all(to).expect("temporary folders can be made");
    for entry in std::fs::read_dir(from).expect("made by `python3 fuzz/seeds.py`").flatten() {
        let (source, target) = (entry.path(), to.join(entry.file_name()));
        if source.is_dir() {
            copy_folder(&source, &target, files);
        } else {
            std::fs::copy(&source, &target).expect("our own file");
            files.push((target, std::fs::read(source).expect("our own file")));
        }
    }
}

fuzz_target!(|input: &[u8]| {
    let Some((&which, bytes)) = input.split_first() else { return };
    let unpacked = UNPACKED.get_or_init(copy);
    let (path, original) = &unpacked.files[usize::from(which) % unpacked.files.len()];
    std::fs::write(path, bytes).expect("our own file");
    let mut sim = Simulator::new(Options::default());
    if let Ok(model) = sim.call_api("sim.loadModel", &[Data::text(unpacked.folder.to_str().expect("plain text"))]) {
        sim.call_api("sim.saveModel", &model[..1]).expect("a loaded model can be saved");
    }
    std::fs::write(path, original).expect("our own file");
});
