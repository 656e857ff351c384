//! Compiles the library whose symbols plugins look up: one C function for each row, which passes its parameters to the simulator.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

#[path = "src/signature.rs"]
mod signature;

use signature::{Param, Size, Symbol, name};

const ROWS: &str = include_str!("src/symbols.tsv");

/// The beginning of the C file. A value is what C passes for one parameter.
const HEAD: &str = r"#include <stdbool.h>
#include <stdint.h>
#include <stddef.h>
struct SScriptCallBack;
typedef struct { int64_t integer; double number; void* pointer; } value;
typedef int64_t (*entrance)(uint32_t row, value* values, uint32_t count);
static entrance enter = NULL;
void swanilda_connect(entrance e) { enter = e; }
static int64_t call(uint32_t row, value* values, uint32_t count, int64_t failure) {
    return enter ? enter(row, values, count) : failure;
}
";

/// Makes `OUT_DIR/libswanilda_plugin.so`; an empty file where plugins are not supported.
#[allow(
    clippy::disallowed_methods,
    reason = "cargo tells a build script its target through the environment"
)]
fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    compile(&out);
}

#[allow(
    clippy::disallowed_methods,
    reason = "cargo tells a build script its target through the environment"
)]
fn compile(out: &Path) {
    println!("cargo:rerun-if-changed=src/symbols.tsv");
    println!("cargo:rerun-if-changed=src/signature.rs");
    let library = out.join("libswanilda_plugin.so");
    if env::var("CARGO_CFG_TARGET_FAMILY").is_ok_and(|family| family != "unix") {
        return fs::write(library, b"").expect("the output folder is writable");
    }
    let source = out.join("libswanilda_plugin.c");
    fs::write(&source, text()).expect("the output folder is writable");
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
        .status();
    assert!(
        status.is_ok_and(|status| status.success()),
        "the C compiler cannot make {}",
        library.display()
    );
}

fn text() -> String {
    let mut text = String::from(HEAD);
    for (number, row) in signature::rows(ROWS).iter().enumerate() {
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
        'd' => format!("{call}; return -1.0;"),
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
        'd' => format!("{array} {call}; return v[{}].number;", values.len()),
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
