//! Breakpoints other than plain ones, errors, pauses, and texts that are no files.

use serde_json::json;

use super::SWANILDA;
use super::{file, start};
use test_support::debug_client::{Client, named};

/// Functions that are called in turn, and fail in different ways.
const FAULTS: &str = "\
local M = {}
function M.count(n)
    for i = 1, n do
        local twice = 2 * i
        local same = twice
    end
end

local function fail()
    local t = nil
    return t.x
end

function sysCall_init()
    M.count(4)
    pcall(fail)
    coroutine.resume(coroutine.create(fail))
end

function sysCall_actuation()
    fail()
end
";

#[test]
fn log_points_hit_counts_and_functions() {
    let (_folder, file) = file(FAULTS);
    let mut client = start(&file);
    client.launch(json!({}));
    client.set_breakpoints(
        &file,
        json!([
            {"line": 4, "logMessage": "i is {i}, {i.x.y}"},
            {"line": 5, "hitCondition": "% 2", "condition": "i > 1"},
        ]),
    );
    let names = json!([{"name": "count"}, {"name": "M.nothing"}]);
    client.request("setFunctionBreakpoints", json!({"breakpoints": names}));
    client.run();
    let stopped = client.stopped("function breakpoint");
    assert_eq!(stopped.calls()[0], "count:3");
    client.go("continue", &stopped);
    let stopped = client.stopped("breakpoint");
    assert_eq!(client.evaluate(&stopped, "i"), "3");
    let text = client.output("i is 3, <");
    assert!(text.contains("attempt to index a number value"), "{text}");
    client.go("continue", &stopped);
    client.output("i is 4");
    assert_eq!(client.end(), Some(1));
}

#[test]
fn errors_stop_where_they_are_raised() {
    let (_folder, file) = file(FAULTS);
    let mut client = start(&file);
    client.launch(json!({}));
    client.request(
        "setExceptionBreakpoints",
        json!({"filters": ["uncaught", "caught"]}),
    );
    client.run();
    for caller in ["", "", "sysCall_actuation:21"] {
        let stopped = client.stopped("exception");
        assert_eq!(stopped.calls()[0], "fail:11");
        if !caller.is_empty() {
            assert_eq!(stopped.calls()[1], caller);
        }
        let info = client.request("exceptionInfo", json!({"threadId": stopped.thread}));
        let message = info["description"].as_str().unwrap_or_default();
        assert!(
            message.contains("attempt to index a nil value (local 't')"),
            "{message}"
        );
        assert_eq!(client.evaluate(&stopped, "t == nil"), "true");
        client.go("continue", &stopped);
    }
    assert_eq!(client.end(), Some(1));
}

#[test]
fn a_pause_comes_into_a_loop_without_end() {
    let (_folder, file) = file(
        "local n = 0\nfunction sysCall_init()\n    print('begun')\n    while n >= 0 do\n        n = n + 1\n    end\nend\n",
    );
    let mut client = start(&file);
    client.launch(json!({}));
    client.run();
    client.output("begun");
    let threads = client.request("threads", json!({}));
    let thread = threads["threads"][0]["id"].clone();
    client.request("pause", json!({"threadId": thread}));
    let stopped = client.stopped("pause");
    assert!(stopped.calls()[0].starts_with("sysCall_init:"));
    assert_eq!(client.evaluate(&stopped, "n > 1000"), "true");
    // So does an expression, until somebody cancels it.
    let endless = client.send("evaluate", json!({"expression": "(function() while true do end end)()", "frameId": stopped.frames[0]["id"]}));
    client.send("cancel", json!({"requestId": endless}));
    let answer = client.answer_to(endless);
    assert_eq!(answer["success"], false, "{answer}");
    client.evaluate(&stopped, "n = -10");
    client.go("continue", &stopped);
    assert_eq!(client.end(), Some(0));
}

#[test]
fn a_pause_comes_into_a_line_without_end() {
    let (_folder, file) = file(
        "function sysCall_init()\n    n = 0\n    print('begun')\n    while n >= 0 do n = n + 1 end\nend\n",
    );
    let mut client = start(&file);
    client.launch(json!({}));
    client.run();
    client.output("begun");
    client.request("pause", json!({"threadId": 1}));
    let stopped = client.stopped("pause");
    assert_eq!(stopped.calls(), ["sysCall_init:4"]);
    client.request("terminate", json!({}));
    client.output("ended by the debugger");
    assert_eq!(client.end(), Some(1));
}

#[test]
fn texts_of_the_scene_come_from_the_simulator() {
    let text = "function sysCall_init()\n    local here = 1\nend\n";
    let program = format!(
        "sim = require 'sim'\nfunction sysCall_init()\n    local s = sim.createScript(sim.scripttype_customization, [[{text}]])\n    sim.setObjectAlias(s, 'Inner')\n    sim.initScript(s)\nend\n"
    );
    let (_folder, file) = file(&program);
    let mut client = start(&file);
    client.launch(json!({}));
    client.set_breakpoints(&file, json!([{"line": 5}]));
    client.request(
        "setFunctionBreakpoints",
        json!({"breakpoints": [{"name": "sysCall_init", "condition": "here == nil"}]}),
    );
    client.run();
    let stopped = client.stopped("function breakpoint");
    client.go("continue", &stopped);
    let stopped = client.stopped("breakpoint");
    client.go("continue", &stopped);
    let inner = client.stopped("function breakpoint");
    let source = inner.frames[0]["source"].clone();
    let content = client.request(
        "source",
        json!({"sourceReference": source["sourceReference"], "source": source}),
    );
    assert_eq!(content["content"], text);
    let set = client.request(
        "setBreakpoints",
        json!({"source": source, "breakpoints": [{"line": 1}]}),
    );
    assert_eq!(
        (
            &set["breakpoints"][0]["verified"],
            &set["breakpoints"][0]["line"]
        ),
        (&json!(true), &json!(1))
    );
    let sources = client.request("loadedSources", json!({}));
    assert!(
        sources["sources"]
            .as_array()
            .is_some_and(|all| all.len() >= 2)
    );
    client.request("disconnect", json!({}));
    assert_eq!(client.end(), Some(0));
}

#[test]
fn changes_of_properties_stop_after_the_call() {
    let (_folder, file) = file(
        "sim = require 'sim'\nfunction sysCall_actuation()\n    floor = floor or sim.getObject('/Floor')\n    sim.setObjectAlias(floor, 'Ground')\n    sim.setObjectPosition(floor, {0, 0, 1})\nend\n",
    );
    let mut client = start(&file);
    client.launch(json!({"stopOnEntry": true}));
    client.run();
    let stopped = client.stopped("step");
    let objects = client.scope(&stopped, "Objects").1;
    let floor = named(&objects, "/Floor")["variablesReference"].clone();
    let properties = client.variables(&floor);
    assert_eq!(named(&properties, "alias")["value"], "\"Floor\"");
    let new = client.request(
        "setVariable",
        json!({"variablesReference": floor, "name": "layer", "value": "7"}),
    );
    assert_eq!(new["value"], "7");
    let info = client.request(
        "dataBreakpointInfo",
        json!({"variablesReference": floor, "name": "pose"}),
    );
    let id = info["dataId"].clone();
    assert_eq!(id, "/Floor.pose");
    let none = client.request("dataBreakpointInfo", json!({"name": "x"}));
    assert!(none["dataId"].is_null());
    let set = client.request(
        "setDataBreakpoints",
        json!({"breakpoints": [{"dataId": id}, {"dataId": "/Floor.alias"}]}),
    );
    assert_eq!(set["breakpoints"][1]["verified"], true);
    client.go("continue", &stopped);
    let stopped = client.stopped("data breakpoint");
    assert_eq!(stopped.calls()[0], "sysCall_actuation:4");
    client.go("continue", &stopped);
    assert_eq!(
        client.stopped("data breakpoint").calls()[0],
        "sysCall_actuation:5"
    );
    client.request("terminate", json!({}));
    assert_eq!(client.end(), Some(0));
}

#[test]
fn a_restart_begins_again_with_the_same_breakpoints() {
    let (_folder, file) = file(FAULTS);
    let mut client = Client::start(SWANILDA, &[&file.to_string_lossy(), "--", "--time", "0.1"]);
    client.launch(json!({}));
    client.set_breakpoints(&file, json!([{"line": 4, "hitCondition": "2"}]));
    client.run();
    for _ in 0..2 {
        let stopped = client.stopped("breakpoint");
        assert_eq!(client.evaluate(&stopped, "i"), "2");
        client.request("restart", json!({}));
    }
    client.stopped("breakpoint");
    client.request("disconnect", json!({}));
    assert_eq!(client.end(), Some(1));
}

#[test]
fn a_client_comes_to_a_simulation_that_runs_and_goes() {
    let (_folder, file) = file(
        "sim = require 'sim'\nfunction sysCall_init()\n    steps = 0\nend\nfunction sysCall_sensing()\n    steps = steps + 1\n    if done then sim.stopSimulation() end\nend\n",
    );
    let mut client = Client::attach(
        SWANILDA,
        &["run", &file.to_string_lossy(), "--debug", "0", "--quiet"],
    );
    client.request("initialize", json!({}));
    client.request("attach", json!({}));
    client.event("initialized");
    client.set_breakpoints(&file, json!([{"line": 6}]));
    client.run();
    let stopped = client.stopped("breakpoint");
    assert_eq!(client.answer("restart", json!({}))["success"], false);
    client.evaluate(&stopped, "done = true");
    client.request("disconnect", json!({}));
    client.close();
    assert_eq!(client.exit_code(), Some(0));
}

/// A script that makes another one, and calls it.
const CALLER: &str = "\
sim = require 'sim'
function sysCall_init()
    other = sim.createScript(sim.scripttype_customization, [[
function double(x)
    local y = 2 * x
    return y
end
]])
    sim.setObjectAlias(other, 'Inner')
    sim.initScript(other)
end
function sysCall_actuation()
    local a = sim.callScriptFunction('double', other, 4)
    local b = a
end
";

#[test]
fn steps_go_into_other_scripts_over_and_out_of_them() {
    let (_folder, file) = file(CALLER);
    let mut client = start(&file);
    client.launch(json!({}));
    client.set_breakpoints(&file, json!([{"line": 13}]));
    client.run();
    let caller = client.stopped("breakpoint");
    client.go("stepIn", &caller);
    let called = client.stopped("step");
    assert_eq!(called.calls(), ["double:2"]);
    assert_ne!(called.thread, caller.thread);
    assert_eq!(client.evaluate(&called, "x"), "4");
    // The caller waits, and can be looked at.
    let waits = client.at(caller.thread.clone());
    assert_eq!(waits.calls(), ["sysCall_actuation:13"]);
    assert_eq!(client.evaluate(&waits, "other ~= nil and x == nil"), "true");
    client.go("stepOut", &called);
    let back = client.stopped("step");
    assert_eq!(
        (back.calls()[0].as_str(), &back.thread),
        ("sysCall_actuation:14", &caller.thread)
    );
    assert_eq!(client.evaluate(&back, "a"), "8");
    client.go("continue", &back);
    let again = client.stopped("breakpoint");
    client.go("next", &again);
    assert_eq!(client.stopped("step").calls()[0], "sysCall_actuation:14");
    client.request("terminate", json!({}));
    assert_eq!(client.end(), Some(0));
}
