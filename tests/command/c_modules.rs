//! Lua modules in C, compiled by the test and loaded by the command from the folder of the scene.
#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::Command;

use test_support::process::run_bounded;

fn compile(library: &Path) {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/support/c_module.c");
    let mut command = Command::new("cc");
    match cfg!(target_os = "macos") {
        true => command.args(["-bundle", "-undefined", "dynamic_lookup"]),
        false => command.args(["-shared", "-fPIC"]),
    };
    let output = command
        .args(["-Wall", "-Werror", "-o"])
        .arg(library)
        .arg(source)
        .output()
        .expect("there is a C compiler");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

/// Runs a scene that has the module beside it; what it prints.
fn run(code: &str, args: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    compile(&folder.path().join("c_module.so"));
    fs::create_dir(folder.path().join("sub")).expect("our own folder is writable");
    fs::write(
        folder.path().join("sub/lua_part.lua"),
        "return require('c_module').add(20, 22)",
    )
    .expect("it is");
    let scene = folder.path().join("scene.lua");
    fs::write(&scene, format!("sim = require 'sim'\n{code}")).expect("it is");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .arg("run")
        .arg(&scene)
        .args(["--quiet", "--empty", "--time", "1"])
        .args(args);
    run_bounded(&mut command).unwrap_or_else(|error| panic!("{error}\nof {code}"))
}

fn assert_prints(code: &str, expected: &[&str]) {
    let output = run(code, &[]);
    assert_eq!(output.lines().collect::<Vec<_>>(), expected, "of {code}");
}

#[test]
fn functions_and_userdata() {
    assert_prints(
        "m = require 'c_module'
        print(m.add(2, 3), (require 'sub.lua_part'))
        local counter = m.counter(41)
        print(counter:increment(), tostring(counter), type(counter), m.living())
        counter = nil
        collectgarbage()
        print(m.living())
        print((require 'c_module.inner'))
        print(package.searchpath('c_module', package.cpath):match('c_module%.so$'), package.cpath:match('^[^;]*/(%?%.so);'))
        print(pcall(require, 'no_module') == false)",
        &["5, 42", "42, counter at 42, userdata, 1", "0", "7", "c_module.so, ?.so", "true"],
    );
}

#[test]
fn errors_go_through_c_both_ways() {
    assert_prints(
        "m = require 'c_module'
        print(pcall(m.fail, 'no'))
        print(pcall(m.apply, sim.getObjectPosition, -99))
        print(m.protect(sim.getObjectPosition, -99))
        print(m.protect(error, 'plain', 0))
        print(m.protect(m.fail, 'inner'))
        print(pcall(m.counter))
        print(pcall(m.apply) == false)
        print(pcall(m.apply(function() return m.counter(1).increment end), 5))",
        &[
            "false, C says: no",
            "false, -1: in sim.getObjectPosition: object does not exist.",
            "false, -1: in sim.getObjectPosition: object does not exist.",
            "false, plain",
            "false, C says: inner",
            "false, bad argument #1 to 'c_module.counter' (number expected, got no value)",
            "true",
            "false, bad argument #1 to '?' (c_module.counter expected, got number)",
        ],
    );
}

#[test]
fn yields_go_through_c() {
    assert_prints(
        "m = require 'c_module'
        local co = coroutine.wrap(function(a) return 'end', m.yield(a + 1) end)
        print(co(1))
        print(co('resumed'))
        function sysCall_thread()
            local before = sim.getSimulationTime()
            m.apply(sim.step)
            print(m.protect(function() sim.step() return 'stepped' end))
            print(m.protect(function() sim.step() error('after a step', 0) end))
            print(sim.getSimulationTime() > before)
            -- Pre-emption waits until C allows it.
            print(m.apply(function() local n = 0 for i = 1, 1000000 do n = n + 1 end return n end))
        end",
        &[
            "2",
            "end, resumed",
            "true, stepped",
            "false, after a step",
            "true",
            "1000000",
        ],
    );
}

#[test]
fn a_callback_may_be_a_c_function() {
    assert_prints(
        "m = require 'c_module'
        local counters = {}
        function sysCall_actuation() counters[#counters + 1] = m.counter(#counters) end
        function sysCall_afterSimulation()
            print(#counters > 10, m.living() == #counters)
        end
        sim.registerScriptFuncHook('sysCall_sensing', m.living, true)",
        &["true, true"],
    );
}

#[test]
fn no_unsafe_loads_none() {
    let output = run(
        "print(pcall(require, 'c_module') == false, pcall(package.loadlib, 'x', 'y') == false)",
        &["--no-unsafe"],
    );
    assert_eq!(output.trim(), "true, true");
}
