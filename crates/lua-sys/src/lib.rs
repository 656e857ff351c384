//! Lua 5.4, compiled with definitions that make runs repeatable in every build: the seed of its string hashes is fixed, and `math` and the
//! operator `^` use the functions below instead of those of the C library.
//!
//! mlua would compile Lua itself, and definitions could reach it by the environment of the whole build only, which a dependency or
//! `cargo install` does not have. With the feature `external` it leaves that to this crate.
//!
//! The C library's functions are not the same in glibc, musl and macOS, and glibc chooses among several by the processor. Those of
//! `libm` are portable Rust without fused operations, so that they have the same bits everywhere.
//!
//! Files that Lua opens are named by [`heap::resource`] until it closes them.

#![expect(unsafe_code, reason = "functions for C")]

#[cfg(unix)]
mod files;

// Cargo is to link the library with it.
use mlua_sys as _;

/// Exports functions under the names by which Lua was compiled.
macro_rules! export {
    ($($name:ident: $function:ident($($argument:ident),*);)*) => { $(
        #[doc = concat!("`", stringify!($function), "` for Lua.")]
        // SAFETY: nothing else has a name that begins like this.
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($($argument: f64),*) -> f64 {
            libm::$function($($argument),*)
        }
    )* };
}

export! {
    swanilda_acos: acos(x);
    swanilda_asin: asin(x);
    swanilda_atan2: atan2(y, x);
    swanilda_cos: cos(x);
    swanilda_cosh: cosh(x);
    swanilda_exp: exp(x);
    swanilda_log: log(x);
    swanilda_log10: log10(x);
    swanilda_log2: log2(x);
    swanilda_pow: pow(x, y);
    swanilda_sin: sin(x);
    swanilda_sinh: sinh(x);
    swanilda_tan: tan(x);
    swanilda_tanh: tanh(x);
}
