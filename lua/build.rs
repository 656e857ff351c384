//! Lists the Lua files that are embedded, by module name.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

#[allow(
    clippy::disallowed_methods,
    reason = "cargo tells a build script its folders through the environment"
)]
fn main() {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let mut files = Vec::new();
    for folder in fs::read_dir(root)
        .expect("the package's folder is readable")
        .flatten()
    {
        if folder.path().is_dir() {
            println!("cargo:rerun-if-changed={}", folder.path().display());
            collect(&folder.path(), &folder.path(), &mut files);
        }
    }
    files.sort();
    let mut table = String::from("&[\n");
    for (name, path) in &files {
        writeln!(table, "({name:?}, include_str!({path:?})),").expect("strings take all");
    }
    table.push(']');
    fs::write(out.join("lua_files.rs"), table).expect("the output folder is writable");
}

/// Adds the module name, below `root`, and the path of every Lua file below `folder`.
fn collect(root: &Path, folder: &Path, files: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(folder)
        .expect("the package's folders are readable")
        .flatten()
    {
        let path = entry.path();
        if path.is_dir() {
            collect(root, &path, files);
        } else if path.extension().is_some_and(|extension| extension == "lua") {
            let name = path
                .strip_prefix(root)
                .expect("collected below the root")
                .with_extension("");
            let name = name
                .to_str()
                .expect("our file names are ASCII")
                .replace('\\', "/");
            files.push((name, path.display().to_string()));
        }
    }
}
