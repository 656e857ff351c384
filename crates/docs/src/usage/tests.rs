//! What code is found to use.

use super::{Support, uses};

fn names(code: &str) -> Vec<String> {
    uses(code.as_bytes())
        .into_iter()
        .map(|found| found.name)
        .collect()
}

fn supports(code: &str) -> Vec<Support> {
    uses(code.as_bytes())
        .into_iter()
        .map(|found| found.support)
        .collect()
}

#[test]
fn names_lines_and_support() {
    let found =
        uses(b"sim = require 'sim'\nlocal h = sim.getObject('/a') -- sim.f()\nsim.frobnicate()");
    assert_eq!(
        (found[0].name.as_str(), found[0].line, found[0].support),
        ("sim.getObject", 2, Support::Works)
    );
    assert_eq!(
        (found[1].name.as_str(), found[1].line, found[1].support),
        ("sim.frobnicate", 3, Support::Missing)
    );
    assert_eq!(found.len(), 2);
}

#[test]
fn constants_and_functions_of_the_file_do_not_count() {
    assert!(
        names("x = sim.handle_self; sim.mine = 1; function sim.f() end sim.f(sim.mine) print(simulate)").is_empty()
    );
    assert_eq!(names("if sim.getObject == nil then end"), ["sim.getObject"]);
}

#[test]
fn what_works_under_older_names_and_what_is_nil_in_the_original_is_not_missing() {
    let code = "local e = simIK.createEnvironment() simIK.setIkGroupCalculation(e, simIK.createIkGroup(e), simIK.method_damped_least_squares, 0.1, 99)
        sim.resumeThreads(sim.scriptthreadresume_default)";
    assert!(
        supports(code)
            .iter()
            .all(|support| *support == Support::Works)
    );
}

#[test]
fn typos_have_suggestions() {
    let hints = |code: &str| -> Vec<Option<String>> {
        let found = uses(code.as_bytes()).into_iter();
        found.map(|found| found.hint).collect()
    };
    for (code, meant) in [
        ("sim.getObjectHandel('a')", "getObjectHandle"),
        ("simIK.creatGroup(1)", "createGroup"),
        ("print(sim.verbosity_scripterors)", "verbosity_scripterrors"),
        ("simGetObjectHandel('a')", "getObjectHandle"),
        ("function sysCall_actution() end", "sysCall_actuation"),
        ("sysCall_sensin = function() end", "sysCall_sensing"),
    ] {
        assert_eq!(
            hints(code),
            [Some(format!("did you mean {meant}?"))],
            "{code}"
        );
    }
    for code in [
        "function sysCall_actuation() end",
        "function sysCall_mine() end",
        "function sysCall_threadmain() end",
        "print(sim.my_own)",
    ] {
        assert_eq!(names(code), [""; 0], "{code}");
    }
}

#[test]
fn modules_that_are_nowhere_are_missing() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    std::fs::write(folder.path().join("mine.lua"), "").expect("our own folder is writable");
    let missing = |code: &str| -> Vec<String> {
        let found = super::uses_beside(code.as_bytes(), folder.path()).into_iter();
        found.map(|found| found.name).collect()
    };
    assert_eq!(missing("require 'nowhere'"), ["require 'nowhere'"]);
    for code in [
        "require 'mine' require 'sim' require 'simIK' require 'math' require 'socket.http'",
        "package.path = '/x/?.lua' require 'nowhere'",
        "pcall(require, 'nowhere')",
    ] {
        assert_eq!(missing(code), [""; 0], "{code}");
    }
}

#[test]
fn the_next_version_is_named() {
    let found = uses(b"sim = require 'sim-2' local ik = require 'simIK-2' sim.createMarker(1)");
    assert!(matches!(found[0].support, Support::Approximated(how) if how.contains("4.11")));
    for later in &found[1..] {
        let hint = later.hint.as_deref().unwrap_or_default();
        assert!(hint.contains("of CoppeliaSim 4.11"), "{later:?}");
    }
}

#[test]
fn names_a_require_gives() {
    assert_eq!(
        names("local s = require('sim')\ns.getObject('/a')"),
        ["sim.getObject"]
    );
    assert_eq!(names("local cmd=require'mine'\ncmd.f()"), [""; 0]);
    assert_eq!(
        supports("z = require 'simZMQ' z.ctx_new() z.PUB() z.PUB"),
        [Support::Works, Support::Missing]
    );
}

#[test]
fn scripts_in_strings() {
    let found = uses(b"sim.createScript(sim.scripttype_customization, [[\nlocal sim = require 'sim'\nsim.frobnicate()\n]], 0, 'lua')");
    let named: Vec<_> = found
        .iter()
        .map(|one| (one.name.as_str(), one.line))
        .collect();
    assert_eq!(named, [("sim.createScript", 1), ("sim.frobnicate", 3)]);
    assert_eq!(
        names(r#"load("x = 1 sim.frobnicate(\"a\")")"#),
        ["sim.frobnicate"]
    );
    assert_eq!(names("print('sim.frobnicate()')"), [""; 0]);
}

#[test]
fn variables_with_the_names_of_modules() {
    assert_eq!(
        names("local zmq = require 'simZMQ' local socket = zmq.socket(c, 1) socket.frobnicate(1)"),
        ["simZMQ.socket"]
    );
    assert_eq!(names("local a, socket = f() socket.frobnicate()"), [""; 0]);
    assert_eq!(names("function f(socket) socket.frobnicate() end"), [""; 0]);
    assert_eq!(
        names("local socket = require('socket').tcp() socket.frobnicate()"),
        [""; 0]
    );
    assert_eq!(
        supports("socket = require 'socket' socket.connect('a', 1) socket.frobnicate()"),
        [Support::Works, Support::Missing]
    );
}

#[test]
fn modules_that_are_required_side_by_side() {
    for code in [
        "sim, ik = require 'sim', require 'simIK' sim.getObject('/a') ik.createEnvironment() ik.frobnicate() sim.createEnvironment()",
        "local sim, ik = require('sim'), require('simIK') sim.getObject('/a') ik.createEnvironment() ik.frobnicate() sim.createEnvironment()",
        "one, sim, two, ik = f(1, 2), require 'sim', {a = 1, 2}, require 'simIK' sim.getObject('/a') ik.createEnvironment() ik.frobnicate() sim.createEnvironment()",
    ] {
        let wanted = [
            Support::Works,
            Support::Works,
            Support::Missing,
            Support::Missing,
        ];
        assert_eq!(supports(code), wanted, "{code}");
    }
    assert_eq!(names("f(a, require 'simZMQ') a.socket(1)"), [""; 0]);
    assert_eq!(
        names("a = require 'simZMQ', 1 a.socket(1)"),
        ["simZMQ.socket"]
    );
}

#[test]
fn globals_of_v_rep() {
    assert_eq!(
        supports("simAddObjectCustomData(1, 2, 'x') simHandlePath(1, 2)"),
        [Support::Works; 2]
    );
    assert_eq!(supports("simFrobnicate(1)"), [Support::Missing]);
    assert_eq!(
        names("simTime = 1 simTime() print(simulate, sim_handle_all, simple())"),
        [""; 0]
    );
}

#[test]
fn old_names() {
    let found = &uses(b"simGetObjectHandle('a', sim_handle_all)")[..];
    assert_eq!(found.len(), 1);
    assert_eq!(
        (found[0].name.as_str(), found[0].written.as_deref()),
        ("sim.getObjectHandle", Some("simGetObjectHandle"))
    );
    assert_eq!(names("simExtCustomUI_create('')"), ["simUI.create"]);
}
