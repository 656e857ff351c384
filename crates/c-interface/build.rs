//! Compiles the libraries whose symbols plugins and programs look up: one C function for each row, which passes its parameters to the
//! simulator.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

#[path = "src/signature.rs"]
mod signature;

use signature::{Param, Size, Symbol, name};

/// The beginning of each C file. A value is what C passes for one parameter.
const HEAD: &str = r"#include <stdbool.h>
#include <stdint.h>
#include <stddef.h>
struct SScriptCallBack;
typedef struct { int64_t integer; double number; void* pointer; } value;
";

/// The library for plugins calls the process that has opened it.
const CONNECTED: &str = r"
typedef int64_t (*entrance)(uint32_t row, value* values, uint32_t count);
static entrance enter = NULL;
void swanilda_connect(entrance e) { enter = e; }
static int64_t call(uint32_t row, value* values, uint32_t count, int64_t failure) {
    return enter ? enter(row, values, count) : failure;
}
";

/// The library for programs calls the simulator's library, which lies beside it.
const LINKED: &str = r"
int64_t swanilda_library_call(uint32_t interface, uint32_t row, value* values, uint32_t count);
static int64_t call(uint32_t row, value* values, uint32_t count, int64_t failure) {
    (void)failure;
    return swanilda_library_call(INTERFACE, row, values, count);
}
";

/// What the simulator's library has, to link against before it exists.
const SIMULATOR: &str =
    "long long swanilda_library_call(unsigned a, unsigned b, void* c, unsigned d) { return -1; }";

/// Makes in `OUT_DIR` the library for plugins, and those for programs; empty files where they are not supported.
#[allow(
    clippy::disallowed_methods,
    reason = "cargo tells a build script its target through the environment"
)]
fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    for file in ["signature.rs", "symbols_410.tsv", "symbols_41.tsv"] {
        println!("cargo:rerun-if-changed=src/{file}");
    }
    let is = |name: &str, value: &str| env::var(name).is_ok_and(|is| is == value);
    let plugins = [CONNECTED, &functions(include_str!("src/symbols_410.tsv"))].concat();
    let is_unix = is("CARGO_CFG_TARGET_FAMILY", "unix");
    compile(is_unix, &out, "libswanilda_plugin.so", &plugins, &[]);
    let is_linux = is("CARGO_CFG_TARGET_OS", "linux");
    compile_for_programs(is_linux, &out);
}

/// One for each version of CoppeliaSim whose library programs load.
fn compile_for_programs(is_supported: bool, out: &Path) {
    compile(is_supported, out, "libswanilda_library.so", SIMULATOR, &[]);
    let folder = format!("-L{}", out.display());
    let link = [
        "-Wl,-soname,libcoppeliaSim.so.1",
        "-Wl,-rpath,$ORIGIN",
        &folder,
        "-lswanilda_library",
    ];
    let for_41 = linked("INTERFACE_41", include_str!("src/symbols_41.tsv"));
    compile(is_supported, out, "libcoppeliaSim_41.so", &for_41, &link);
    let for_410 = linked("INTERFACE_410", include_str!("src/symbols_410.tsv"));
    compile(is_supported, out, "libcoppeliaSim_410.so", &for_410, &link);
}

/// The functions of a table, which call the simulator's library by the number of the table: libraries of different builds notice that
/// they do not belong together. The crate knows the number by `name`.
fn linked(name: &str, table: &'static str) -> String {
    let number = hash(table);
    println!("cargo:rustc-env={name}={number}");
    format!("#define INTERFACE {number}u{LINKED}{}", functions(table))
}

/// FNV-1a, 32 bits.
fn hash(text: &str) -> u32 {
    let step = |hash: u32, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    text.bytes().fold(0x811c_9dc5, step)
}

#[allow(
    clippy::disallowed_methods,
    reason = "cargo tells a build script its target through the environment"
)]
fn compile(is_supported: bool, out: &Path, name: &str, text: &str, link: &[&str]) {
    let library = out.join(name);
    if !is_supported {
        return fs::write(library, b"").expect("the output folder is writable");
    }
    let source = library.with_extension("c");
    fs::write(&source, [HEAD, text].concat()).expect("the output folder is writable");
    let compiler = cc::Build::new()
        .pic(true)
        .opt_level(2)
        .debug(false)
        .cargo_metadata(false)
        .get_compiler();
    let mut command: Command = compiler.to_command();
    let status = command
        .args(["-shared", "-fvisibility=default", "-o"])
        .arg(&library)
        .arg(&source)
        .args(link)
        .status();
    assert!(
        status.is_ok_and(|status| status.success()),
        "the C compiler cannot make {}",
        library.display()
    );
}

fn functions(table: &'static str) -> String {
    let mut text = String::new();
    for (number, row) in signature::rows(table).iter().enumerate() {
        let body = if row.is_missing() {
            missing(row, number)
        } else {
            passing(row, number)
        };
        let params = if row.is_missing() {
            "void".to_owned()
        } else {
            row.c_params()
        };
        writeln!(
            text,
            "{} {}({params}) {{ {body} }}",
            row.c_result(),
            row.symbol
        )
        .expect("strings take all");
    }
    text
}

/// The parameters are unknown: callers may pass any, which C's conventions allow.
fn missing(row: &Symbol, number: usize) -> String {
    let call = format!("call({number}, NULL, 0, 0)");
    match row.result {
        'v' => format!("{call};"),
        'd' | 'f' => format!("{call}; return -1.0;"),
        _ if row.returns_pointer() => format!("{call}; return NULL;"),
        _ => format!("{call}; return -1;"),
    }
}

fn passing(row: &Symbol, number: usize) -> String {
    // The last value is the result where that is a number.
    let values: Vec<String> = row
        .params
        .iter()
        .enumerate()
        .map(|(place, param)| value(param, place))
        .collect();
    let comma = if values.is_empty() { "" } else { ", " };
    let array = format!(
        "value v[] = {{{}{comma}{{0, -1.0, NULL}}}};",
        values.join(", ")
    );
    let failure = if row.returns_pointer() { 0 } else { -1 };
    let call = format!("call({number}, v, {}, {failure})", values.len() + 1);
    match row.result {
        'v' => format!("{array} {call};"),
        'd' | 'f' => {
            let kind = row.c_result();
            format!("{array} {call}; return ({kind})v[{}].number;", values.len())
        }
        _ if row.returns_pointer() => {
            format!("{array} return ({})(intptr_t){call};", row.c_result())
        }
        _ => format!("{array} return ({}){call};", row.c_result()),
    }
}

fn value(param: &Param, place: usize) -> String {
    let name = name(place);
    let count = if param.size == Size::Counted {
        format!("n{name}")
    } else {
        "0".to_owned()
    };
    match (param.is_pointer(), param.ty) {
        (true, _) => format!("{{{count}, 0.0, (void*)(uintptr_t){name}}}"),
        (false, 'd' | 'f') => format!("{{0, {name}, NULL}}"),
        (false, _) => format!("{{{name}, 0.0, NULL}}"),
    }
}
