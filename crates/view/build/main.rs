//! Lists the files of the viewer's page, joined and compressed.

mod bundle;
mod editor;
mod page;

use std::env;
use std::path::PathBuf;

#[allow(
    clippy::disallowed_methods,
    reason = "cargo tells a build script its folders through the environment"
)]
fn main() {
    println!("cargo:rerun-if-changed=src/page");
    println!("cargo:rerun-if-changed=build");
    println!("cargo:rerun-if-changed=editor");
    println!("cargo:rerun-if-env-changed={}", editor::SETTING);
    let package = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let mut files = page::files(&package.join("src/page"));
    files.extend(editor::files(&package, &out));
    page::compress(files, &out);
}
