//! Lists the Lua files of `lua/` for embedding: module name and path.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

#[allow(clippy::disallowed_methods, reason = "cargo tells a build script its folders through the environment")]
fn main() {
    println!("cargo:rerun-if-changed=lua");
    export_lua();
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it")).join("lua");
    let mut files = Vec::new();
    collect(&root, &mut files);
    files.sort();
    let mut table = String::from("&[\n");
    for file in &files {
        let name = file.strip_prefix(&root).expect("collected below the root").with_extension("");
        let name = name.to_str().expect("our file names are ASCII").replace('\\', "/");
        writeln!(table, "({name:?}, include_str!({:?})),", file.display().to_string()).expect("strings take all");
    }
    table.push(']');
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it")).join("lua_files.rs");
    fs::write(out, table).expect("the output folder is writable");
}

/// Lua modules in C find Lua's functions in the program that loads them: they must be in its table of symbols, used or not.
#[allow(clippy::disallowed_methods, reason = "cargo tells a build script its target through the environment")]
fn export_lua() {
    let family = env::var("CARGO_CFG_TARGET_FAMILY").unwrap_or_default();
    let vendor = env::var("CARGO_CFG_TARGET_VENDOR").unwrap_or_default();
    let option = match (family.as_str(), vendor.as_str()) {
        (_, "apple") => "-exported_symbol,_",
        ("unix", _) => "--export-dynamic-symbol=",
        _ => return,
    };
    for prefix in ["lua_", "luaL_"] {
        println!("cargo:rustc-link-arg-bins=-Wl,{option}{prefix}*");
    }
}

fn collect(dir: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(dir).expect("lua/ is part of the package").flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "lua") {
            files.push(path);
        }
    }
}
