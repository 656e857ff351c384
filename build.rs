//! Lists the files that are embedded: the Lua files of `lua/`, by module name, and those of the viewer's page, compressed; and compiles the library
//! for plugins.
//! The folders right below `lua/` are rooms; they are not part of names.

mod bundle;
mod page;
mod plugin;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

#[allow(clippy::disallowed_methods, reason = "cargo tells a build script its folders through the environment")]
fn main() {
    println!("cargo:rerun-if-changed=lua");
    println!("cargo:rerun-if-changed=src/view/page");
    export_lua();
    let package = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    list_lua(&package.join("lua"), &out);
    plugin::compile(&out);
    page::compress(&package.join("src/view/page"), &out);
}

fn list_lua(root: &Path, out: &Path) {
    let mut files = Vec::new();
    for room in fs::read_dir(root).expect("lua/ is part of the package").flatten() {
        let lua = collect(&room.path(), &room.path(), &["lua"]);
        files.extend(lua.into_iter().map(|(name, path)| (name.trim_end_matches(".lua").to_owned(), path)));
    }
    files.sort();
    let mut table = String::from("&[\n");
    for (name, path) in &files {
        writeln!(table, "({name:?}, include_str!({path:?})),").expect("strings take all");
    }
    table.push(']');
    fs::write(out.join("lua_files.rs"), table).expect("the output folder is writable");
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

/// Name, below `root`, and path of every file below `dir` with one of these extensions.
fn collect(root: &Path, dir: &Path, extensions: &[&str]) -> Vec<(String, String)> {
    let mut files = Vec::new();
    for entry in fs::read_dir(dir).expect("what is embedded lies in folders").flatten() {
        let path = entry.path();
        if path.is_dir() {
            files.extend(collect(root, &path, extensions));
        } else if path.extension().is_some_and(|own| extensions.iter().any(|extension| own == *extension)) {
            let name = path.strip_prefix(root).expect("collected below the root");
            let name = name.to_str().expect("our file names are ASCII").replace('\\', "/");
            files.push((name, path.display().to_string()));
        }
    }
    files
}
