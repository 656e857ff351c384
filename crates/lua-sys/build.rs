//! Compiles Lua as it comes, with other definitions.

use std::env;

/// Lua seeds the hashes of its strings from the clock and from addresses, so that the order of `pairs` differs from run to run. The
/// expression ends before the argument's parentheses, so that this is no macro with parameters.
const SEED: &str = "luai_makeseed=1395864371u+0*(unsigned)sizeof";

/// The functions of C's library whose results differ between libraries, versions and processors.
const FUNCTIONS: [&str; 14] = [
    "acos", "asin", "atan2", "cos", "cosh", "exp", "log", "log10", "log2", "pow", "sin", "sinh",
    "tan", "tanh",
];

/// Has Lua open and close files by functions of ours; relative to where build scripts run.
const FILES: &str = " -include src/files.h";

#[expect(unsafe_code, reason = "the environment of the compiler")]
#[allow(
    clippy::disallowed_methods,
    reason = "cargo passes the target to a build script in the environment"
)]
fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/files.h");
    let target = env::var("TARGET").expect("Cargo sets it");
    let variable = format!("CFLAGS_{}", target.replace(['-', '.'], "_"));
    let is_microsoft = target.ends_with("msvc");
    let functions = FUNCTIONS.map(|name| definition(name, is_microsoft));
    // There are snapshots on systems like Unix, which ask for open files.
    let files = if target.contains("windows") {
        ""
    } else {
        FILES
    };
    let given = env::var(&variable).unwrap_or_default();
    let flags = format!("{given} -D{SEED}{}{files}", functions.concat());
    // SAFETY: this program has no other thread. The crate that compiles Lua takes flags from the environment only.
    unsafe { env::set_var(&variable, flags) };
    let lua = lua_src::Build::new().build(lua_src::Lua54);
    println!(
        "cargo::rustc-link-search=native={}",
        lua.lib_dir().display()
    );
    for library in lua.libs() {
        // As a whole: mlua, whose functions need these, may come later in the order of the linker.
        println!("cargo::rustc-link-lib=static:+whole-archive={library}");
    }
}

/// A function of ours instead of the C library's, for its declaration as well. Headers of glibc use the names in other ways too, which a
/// macro with parameters leaves alone; Microsoft's do not, whose compiler takes none of those on its command line.
fn definition(name: &str, is_microsoft: bool) -> String {
    let parameters = match (is_microsoft, name) {
        (true, _) => "",
        (false, "atan2" | "pow") => "(x,y)",
        (false, _) => "(x)",
    };
    format!(" -D{name}{parameters}=swanilda_{name}{parameters}")
}
