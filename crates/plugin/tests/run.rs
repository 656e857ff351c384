//! The example as scripts use it: loaded by a simulator in this process.
#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

/// A library is used by one simulator at a time, and tests run side by side.
static LIBRARY: Mutex<()> = Mutex::new(());

/// What cargo has built before it runs tests.
fn example() -> PathBuf {
    let test = std::env::current_exe().expect("the test is a file");
    let target = test
        .parent()
        .and_then(Path::parent)
        .expect("tests are in target/PROFILE/deps");
    target.join("examples").join(format!(
        "{}rust_plugin{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    ))
}

/// What `code` returns where `simRust` is the plugin.
fn results(code: &str) -> Vec<Data> {
    let _alone = LIBRARY.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let library = format!(
        "{}simRust{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    );
    std::fs::copy(example(), folder.path().join(library)).expect("the example is built");
    let options = Options {
        plugin_dirs: vec![folder.path().to_owned()],
        ..Options::default()
    };
    let mut simulator = Simulator::builder().options(options).build();
    let code = format!("sim = require 'sim' simRust = loadPlugin 'simRust' {code}");
    let script = simulator
        .add_script(ScriptKind::Customization, "test", code.as_bytes())
        .expect("the script starts");
    simulator
        .call(&script, "answer", &[])
        .expect("the function succeeds")
}

fn text(text: &str) -> Data {
    Data::text(text)
}

#[test]
fn values_go_in_and_out() {
    assert_eq!(
        results("function answer() return simRust.func('Hello') end"),
        [text("Hello to you too!")]
    );
    let values = results(
        "function answer() return simRust.echo(nil, true, -3, 2.5, 'a\\0b', '', {1, {2}}, {a = {b = 'c'}}) end",
    );
    let table = Data::Array(vec![Data::Int(1), Data::from([2])]);
    let map = Data::map([("a", Data::map([("b", text("c"))]))]);
    let expected = [
        Data::Nil,
        true.into(),
        Data::Int(-3),
        Data::Float(2.5),
        Data::Text(b"a\0b".to_vec()),
        text(""),
        table,
        map,
    ];
    assert_eq!(values, expected);
}

#[test]
fn errors_and_panics_are_errors_of_the_script() {
    let outcome = results(
        "function answer() return select(2, pcall(simRust.fail)), select(2, pcall(simRust.panic, 1)), simRust.func('Hello') end",
    );
    let texts: Vec<String> = outcome.iter().map(|data| format!("{data:?}")).collect();
    assert_eq!(outcome.len(), 3, "{texts:?}");
    let Data::Text(error) = &outcome[0] else {
        panic!("{texts:?}")
    };
    assert!(
        String::from_utf8_lossy(error).ends_with("no good (c: simSetLastError)"),
        "{texts:?}"
    );
    let Data::Text(error) = &outcome[1] else {
        panic!("{texts:?}")
    };
    assert!(
        String::from_utf8_lossy(error).contains("the plugin's function has panicked"),
        "{texts:?}"
    );
    assert_eq!(outcome[2], text("Hello to you too!"));
}

#[test]
fn plugins_call_scripts() {
    let code = "function double(x, t) t.x = 2 * x return t, 'k' end
        function answer() return simRust.ask('double', 21, {}) end";
    assert_eq!(
        results(code),
        [Data::map([("x", Data::Int(42))]), text("k")]
    );
    let Data::Text(error) =
        &results("function answer() return select(2, pcall(simRust.ask, 'nobody')) end")[0]
    else {
        panic!("an error is a text")
    };
    assert!(String::from_utf8_lossy(error).contains("the call of nobody failed."));
}
