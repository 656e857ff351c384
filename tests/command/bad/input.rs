//! Whatever a script does, the simulator answers with an error or does it: it never crashes and never hangs.

use std::fs;
use std::process::Command;

use test_support::parallel;
use test_support::process::run_bounded;

/// Runs a scene to its end; what it printed and logged.
fn run(code: &str, args: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let scene = folder.path().join("scene.lua");
    fs::write(&scene, code).expect("our own folder is writable");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    // Functions that write files do so where nobody minds.
    command
        .current_dir(folder.path())
        .arg("run")
        .arg(&scene)
        .args(["--data-dir", "."])
        .args(args);
    let output = run_bounded(&mut command).unwrap_or_else(|error| panic!("{error}\nof {code}"));
    assert!(!output.contains("panicked"), "{output}");
    output
}

fn run_briefly(code: &str) -> String {
    run(code, &["--steps", "5", "--empty"])
}

#[test]
fn text_that_is_no_lua() {
    for code in [
        "x = = 1",
        "(",
        "\u{1b}Lua garbage",
        "\0\0\0",
        "goto nowhere",
        "return return",
        "'unfinished",
    ] {
        let output = run_briefly(code);
        assert!(output.contains("[/Script:error]"), "{code:?}: {output}");
    }
    run_briefly(&"(".repeat(100_000));
    run_briefly(&format!("x = {}1", "-".repeat(100_001)));
}

#[test]
fn errors_in_every_callback() {
    let callbacks = "info init cleanup nonSimulation beforeSimulation afterSimulation actuation sensing suspend suspended \
        resume beforeCopy afterCopy beforeDelete afterDelete afterCreate beforeMainScript msg selChange joint dyn contact \
        trigger vision thread userConfig moduleEntry event ext realTimeIdle beforeSave afterSave afterLoad data";
    let errors = [
        "error('broken')",
        "error({})",
        "error()",
        "error(setmetatable({}, {__tostring = error}))",
        "local x = nil + 1",
    ];
    let cases: Vec<_> = callbacks
        .split_whitespace()
        .flat_map(|callback| errors.map(|error| (callback, error)))
        .collect();
    parallel::map(&cases, |(callback, error)| {
        run_briefly(&format!(
            "sim = require 'sim'
            local done
            function sysCall_{callback}() {error} end
            sysCall_init = sysCall_init or function()
                other = sim.createDummy(0.1)
                sim.copyPasteObjects({{other}}, 0)
                sim.removeObjects({{other}})
                sim.broadcastMsg({{id = 'x'}})
            end"
        ))
    });
}

#[test]
fn recursion_without_end() {
    let within = run_briefly("local function f() return 1 + f() end f()");
    assert!(within.contains("stack overflow"), "{within}");
    let metamethods = run_briefly(
        "t = setmetatable({}, {}) getmetatable(t).__index = function(t, k) return t[k] end print(t.x)",
    );
    assert!(metamethods.contains(":error]"), "{metamethods}");
    run_briefly("local f f = function() return pcall(f) end f()");
    run_briefly("local co co = function() coroutine.wrap(co)() end co()");
    run_briefly("x = string.rep('(', 1e5) .. '1' .. string.rep(')', 1e5) load('return ' .. x)");
    run_briefly("t = {} t.t = t print(t) sim = require 'sim' sim.broadcastMsg(t)");
    run_briefly(
        "t = {} for i = 1, 1e5 do t = {t} end print(#tostring(t)) sim = require 'sim' sim.broadcastMsg(t)",
    );
}

#[test]
fn finalizers_that_change_what_is_being_read() {
    let output = run_briefly(
        "sim = require 'sim'
        cbor = require 'org.conman.cbor'
        local t, grown = {}, 0
        local function grow()
            for key in pairs(t) do t[key] = nil end
            for i = 1, 100 do grown = grown + 1 t['new' .. grown] = tobuffer('y') end
        end
        for _, read in ipairs{sim.packTable, cbor.encode, sim.broadcastMsg} do
            for round = 1, 2 do
                t = {}
                for i = 1, 500 do t['k' .. i] = i % 2 == 0 and tobuffer('x') or {i} end
                for i = 1, 200 do setmetatable({}, {__gc = grow}) end
                local ok, why = pcall(read, t)
                if not ok then print(why) end
            end
        end
        print('alive', grown > 0)",
    );
    assert!(output.contains("alive, true"), "{output}");
    assert!(!output.contains("invalid key"), "{output}");
}

#[test]
fn recursion_across_scripts() {
    let across = run_briefly(
        "sim = require 'sim'
        function ping(depth) return sim.callScriptFunction('pong', other, depth + 1) end
        function sysCall_init()
            other = sim.createScript(sim.scripttype_customization, [[
                sim = require 'sim'
                function pong(depth) return sim.callScriptFunction('ping', back, depth + 1) end
                function setBack(handle) back = handle end
            ]])
            sim.initScript(other)
            sim.callScriptFunction('setBack', other, sim_script_handle)
            print(pcall(ping, 1))
            print('alive')
        end",
    );
    assert!(
        across.contains("false") && across.contains("alive"),
        "{across}"
    );
    run_briefly(
        "sim = require 'sim' function f() sim.callScriptFunction('f', sim.handle_self) end function sysCall_init() f() end",
    );
    run_briefly(
        "sim = require 'sim' function sysCall_afterCreate() sim.createDummy(0.1) end function sysCall_init() sim.createDummy(0.1) end",
    );
    run_briefly(
        "sim = require 'sim' function sysCall_msg() sim.broadcastMsg({id = 'again'}) end function sysCall_init() sim.broadcastMsg({id = 'x'}) end",
    );
    run_briefly("sim = require 'sim' function sysCall_init() sim.initScript(sim.handle_self) end");
    run_briefly("require 'sim-1' package.loaded.scene = nil require 'scene'");
}

#[test]
fn threads_that_never_yield() {
    let output = run_briefly(
        "function sysCall_thread() while true do end end function sysCall_sensing() print('step') end",
    );
    assert!(output.contains("step"), "{output}");
    run_briefly(
        "function sysCall_thread() while true do coroutine.wrap(function() coroutine.yield() end)() end end",
    );
}

#[test]
fn scripts_that_remove_themselves() {
    let callbacks = [
        "init",
        "actuation",
        "sensing",
        "cleanup",
        "beforeSimulation",
        "afterSimulation",
        "thread",
        "nonSimulation",
    ];
    let removals = [
        "sim.removeObjects({sim_script_handle})",
        "sim.removeObjects({sim_script_handle}, true)",
        "sim.removeObjects(sim.getObjectsInTree(sim.handle_scene))",
        "sim.initScript(sim.handle_self) sim.initScript(sim.handle_self)",
        "sim.closeScene()",
        "sim.loadScene('')",
        "sim.stopSimulation() sim.startSimulation() sim.pauseSimulation() sim.startSimulation()",
    ];
    let cases: Vec<_> = callbacks
        .iter()
        .flat_map(|callback| removals.map(|code| (callback, code)))
        .collect();
    parallel::map(&cases, |(callback, code)| {
        run_briefly(&format!(
            "sim = require 'sim' function sysCall_{callback}() {code} end"
        ))
    });
}

#[test]
fn numbers_beyond_reason() {
    let output = run_briefly(
        "sim = require 'sim'
        function sysCall_init()
            box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
            sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
            for _, x in ipairs{0/0, 1/0, -1/0, 1e308, -1e308, 5e-324} do
                pcall(sim.setObjectPosition, box, {x, 0, 0})
                pcall(sim.setObjectPose, box, {0, 0, x, 0, 0, 0, 0})
                pcall(sim.setObjectPose, box, {x, x, x, x, x, x, x})
                pcall(sim.setObjectMatrix, box, {x, x, x, x, x, x, x, x, x, x, x, x})
                pcall(sim.createPrimitiveShape, sim.primitiveshape_spheroid, {x, x, x})
                pcall(sim.setShapeMass, box, x)
                pcall(sim.createJoint, sim.joint_revolute, sim.jointmode_dynamic, 0, {x, x})
            end
            print('alive')
        end",
    );
    assert!(output.contains("alive"), "{output}");
}

#[test]
fn odd_values_for_every_property() {
    let output = run(
        include_str!("../../support/odd_properties.lua"),
        &["--steps", "5"],
    );
    assert!(output.contains("every property was written"), "{output}");
}

#[test]
fn running_out_of_memory_is_an_error() {
    let output = run_briefly(
        "x = 'x' local ok, why = pcall(function() while true do x = x .. x end end) print(ok, why) x = nil print('alive')",
    );
    assert!(output.contains("alive"), "{output}");
}

#[test]
fn wrong_values_for_every_property() {
    // Not started: some of what is written here stops the simulation for good.
    let output = run(
        "sim = require 'sim'
        local inf, targets = math.huge, {sim.handle_app, sim.handle_scene, sim.handle_self, sim.handle_sandbox, 999999, -77, 2 ^ 53}
        local values = {true, 0, -1, 1 << 62, 0.5, 0 / 0, inf, -inf, '', 'x', ('x'):rep(100000), {}, {0 / 0}, {inf, inf, inf, inf, inf, inf, inf},
            {1}, {1, 2, 3}, {0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0}, {1, 'x'}, {{}}, {a = 1}}
        local long = {} for i = 1, 100000 do long[i] = 1e300 end
        targets[#targets + 1] = sim.createDummy(0.1)
        targets[#targets + 1] = sim.createJoint(sim.joint_revolute_subtype, sim.jointmode_dynamic, 0)
        targets[#targets + 1] = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
        targets[#targets + 1] = sim.createForceSensor(0, {0, 1, 10, 0, 0}, {0.05, 100, 10, 0, 0})
        local count = 0
        local function tryTyped(target, name, value)
            for code = 0, 16 do
                if sim.getPropertySetter(code) then
                    pcall(sim.getPropertySetter(code), target, name, value)
                    pcall(sim.getPropertyGetter(code), target, name)
                end
            end
        end
        local function try(target, name)
            count = count + 1
            for _, value in ipairs(values) do pcall(sim.setProperty, target, name, value) end
            tryTyped(target, name, values[count % #values + 1])
            if count % 50 == 0 then tryTyped(target, name, long) end
        end
        function sysCall_init()
            for _, target in ipairs(targets) do
                local names, index = {'nothing', '', 'customData.', 'signal.', 'customData.a b', 'app.app.layer', ('x'):rep(1000), '\\xff'}, 0
                while true do
                    local ok, name = pcall(sim.getPropertyName, target, index)
                    if not ok or not name then break end
                    names[#names + 1], index = name, index + 1
                end
                for _, name in ipairs(names) do
                    if not name:find('scriptDisabled') then try(target, name) end
                    pcall(sim.removeProperty, target, name)
                    pcall(sim.getPropertyInfo, target, name)
                end
                pcall(sim.getPropertyName, target, -1)
                pcall(sim.getProperties, target)
            end
            print('done', count > 500)
        end",
        &["--no-start", "--empty"],
    );
    assert!(output.contains("done, true"), "{output}");
}
