//! Any bytes as a PLY file, and for each file it names: it is read or refused, and what is read is sound and can be written.
//!
//! `cargo fuzz run mesh_ply fuzz/corpus/mesh_ply`
#![no_main]

#[path = "../mesh_check.rs"]
mod mesh_check;

use libfuzzer_sys::fuzz_target;
use mesh_files::MeshFormat;

fuzz_target!(|bytes: &[u8]| mesh_check::check(bytes, MeshFormat::Ply));
