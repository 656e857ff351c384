//! Lua modules in C find Lua's functions in the program that loads them: they must be in its table of symbols, used or not.

use std::env;

#[allow(
    clippy::disallowed_methods,
    reason = "cargo tells a build script its target through the environment"
)]
fn main() {
    println!("cargo:rerun-if-changed=build.rs");
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
