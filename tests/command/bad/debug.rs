//! Scripts that reach into native functions, by the `debug` library or by bytecode: they get nothing or an error, and the simulator lives on.

use std::fs;
use std::process::Command;

use test_support::process::run_bounded;

/// Runs a scene; what it prints and logs.
fn run(code: &str, args: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let scene = folder.path().join("scene.lua");
    fs::write(&scene, format!("sim = require 'sim'\n{code}")).expect("our own folder is writable");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .current_dir(folder.path())
        .arg("run")
        .arg(&scene)
        .args(["--empty", "--steps", "2"])
        .args(args);
    run_bounded(&mut command).unwrap_or_else(|error| panic!("{error}\nof {code}"))
}

/// The scene prints `alive` at its end, after these lines.
fn assert_prints(code: &str, args: &[&str], expected: &[&str]) {
    let output = run(
        &format!("{code}\nprint('alive')"),
        &[&["--quiet"], args].concat(),
    );
    let expected = [expected, &["alive"]].concat();
    assert_eq!(output.lines().collect::<Vec<_>>(), expected, "of {code}");
}

#[test]
fn native_functions_have_no_upvalues() {
    assert_prints(
        "local gmatch, lines = ('a b'):gmatch('%a'), io.lines('scene.lua')
        for _, f in ipairs{sim.getObjectPosition, next, gmatch, lines, coroutine.create, coroutine.wrap(print)} do
            for i = 1, 4 do
                assert(debug.getupvalue(f, i) == nil and select('#', debug.getupvalue(f, i)) == 0)
                assert(debug.setupvalue(f, i, nil) == nil and debug.setupvalue(f, i, function() end) == nil)
                assert(not pcall(debug.upvaluejoin, f, i, function() return gmatch end, 1))
            end
        end
        print(pcall(sim.getObjectPosition, 1))
        print(gmatch(), type(lines()), type(coroutine.create(print)))
        coroutine.wrap(function() print('runs') end)()",
        &[],
        &["false, -1: in sim.getObjectPosition: object does not exist.", "a, string, thread", "runs"],
    );
}

#[test]
fn lua_functions_keep_theirs() {
    assert_prints(
        "local x, y = 1, 2
        local function f() return x, y end
        print(debug.getupvalue(f, 1))
        print(debug.setupvalue(f, 1, 5), f())
        debug.upvaluejoin(f, 1, f, 2)
        print(f())
        local function named() local inner = 7 print(debug.getlocal(1, 1)) print(debug.setlocal(1, 1, 8)) return inner end
        print(named(), debug.getlocal(named, 1))",
        &[],
        &["x, 1", "x, 5, 2", "2, 2", "inner, 7", "inner", "8, nil"],
    );
}

#[test]
fn frames_of_native_functions_and_temporary_values() {
    assert_prints(
        "table.sort({3, 2, 1}, function(a, b)
            for level = 0, 1 do assert(level == 1 or debug.getlocal(level, 1) == nil) end
            assert(debug.getlocal(2, 1) == nil and debug.setlocal(2, 1, nil) == nil)
            return a < b
        end)
        print((('abc'):gsub('.', function(c)
            for i = 1, 9 do debug.setlocal(2, i, 1) end
            collectgarbage()
            return c .. c
        end)))
        local function spoil() for i = 1, 20 do debug.setlocal(2, i, 5) end return 1 end
        (function() local t = {spoil(), spoil(), spoil()} end)()
        print(#((function() return {spoil(), spoil(), spoil()} end)()))
        local co = coroutine.create(function() coroutine.yield(1, 2) end)
        coroutine.resume(co)
        print(debug.getlocal(co, 0, 1), debug.setlocal(co, 0, 1, print), coroutine.resume(co))",
        &[],
        &["aabbcc", "3", "nil, nil, true"],
    );
}

#[test]
fn userdata_keep_their_metatables() {
    assert_prints(
        "local socket, lfs = require('socket').tcp(), require 'lfs'
        for _, u in ipairs{socket, io.stdout} do
            for _, metatable in ipairs{getmetatable(io.stdout), getmetatable(socket), {}} do
                print(select(2, pcall(debug.setmetatable, u, metatable)))
            end
            assert(not pcall(debug.setmetatable, u, nil))
        end
        print(pcall(lfs.lock, socket, 'r'))
        print(pcall(getmetatable(io.stdout).__gc, socket))
        print(pcall(getmetatable(socket).__gc, io.stdout))
        for _, metamethod in pairs(getmetatable(socket)) do
            if type(metamethod) == 'function' then pcall(metamethod, socket) pcall(metamethod, io.stdout) pcall(metamethod) end
        end
        debug.setmetatable(1, {__index = {half = 0.5}})
        print((1).half, debug.getmetatable(1) ~= nil, debug.getmetatable(io.stdout) == getmetatable(io.stdout))",
        &[],
        &[
            "bad argument #1 to 'debug.setmetatable' (userdata keep their metatables)",
            "bad argument #1 to 'debug.setmetatable' (userdata keep their metatables)",
            "bad argument #1 to 'debug.setmetatable' (userdata keep their metatables)",
            "bad argument #1 to 'debug.setmetatable' (userdata keep their metatables)",
            "bad argument #1 to 'debug.setmetatable' (userdata keep their metatables)",
            "bad argument #1 to 'debug.setmetatable' (userdata keep their metatables)",
            "false, -1: in lfs.lock: not an open file.",
            "false, bad argument #1 to '?' (FILE* expected, got socket)",
            "false, bad argument #1 to '?' (socket expected)",
            "0.5, true, true",
        ],
    );
}

#[test]
fn the_registry_is_what_is_public_in_it() {
    assert_prints(
        "local registry = debug.getregistry()
        print(registry[2] == _G, registry._LOADED == package.loaded, registry._PRELOAD == package.preload)
        local function walk(value, seen)
            assert(type(value) ~= 'userdata' or io.type(value), 'a userdata of the host')
            if type(value) ~= 'table' or seen[value] then return end
            seen[value] = true
            for k, v in next, value do walk(k, seen) walk(v, seen) end
        end
        walk(registry, {})
        for k in pairs(registry) do registry[k] = nil end
        print(sim.createDummy(0.1) >= 0, type(require('socket').tcp()), #tostring(sim.packTable({1})) > 0)",
        &[],
        &["true, true, true", "true, userdata, true"],
    );
}

#[test]
fn hooks_of_scripts() {
    assert_prints(
        "local count = 0
        local co = coroutine.create(function() for i = 1, 1e5 do count = count + 1 end return 'ends' end)
        debug.sethook(co, function() for i = 1, 9 do debug.setlocal(2, i, nil) debug.getlocal(2, i) end end, 'crl', 100)
        print(coroutine.resume(co))
        local dummy = sim.createDummy(0.1)
        debug.sethook(function() for i = 1, 9 do debug.setlocal(2, i, 'x') end end, 'cr')
        local x = sim.getObjectPosition(dummy)[1]
        debug.sethook()
        print(x, (debug.gethook()))",
        &[],
        &["true, ends", "0., nil"],
    );
}

/// Bytecode that was changed makes Lua itself crash: it is refused before it is looked at.
#[test]
fn no_bytecode_without_unsafe() {
    assert_prints(
        "local code = string.dump(function() return 'ran' end)
        local file = io.open('compiled.lua', 'wb')
        file:write(code)
        file:close()
        print(load(code))
        print(load(code, 'name', 'bt'))
        print(load(function() local part = code code = nil return part end))
        print(load('return 1', 'text', 'b'))
        print(loadfile('compiled.lua'))
        print(loadfile('compiled.lua', 'b'))
        print(pcall(dofile, 'compiled.lua'))
        package.path = './?.lua;' .. package.path
        print(select(2, pcall(require, 'compiled')))
        print(load('return ...', 'text', 't', {})(4), load('return 5')(), load('return x', 'text', 'bt', {x = 6})())
        print(select(2, load('return =')))
        print(pcall(load, 'return 1', 'text', {}))
        print(loadstring(string.dump(function() end)))",
        &["--no-unsafe", "--allow-write=."],
        &[
            "nil, attempt to load a binary chunk (mode is 't')",
            "nil, attempt to load a binary chunk (mode is 't')",
            "nil, attempt to load a binary chunk (mode is 't')",
            "nil, bytecode is not allowed: run with --allow-native",
            "nil, attempt to load a binary chunk (mode is 't')",
            "nil, bytecode is not allowed: run with --allow-native",
            "false, attempt to load a binary chunk (mode is 't')",
            "error loading module 'compiled' from file './compiled.lua':",
            "\tattempt to load a binary chunk (mode is 't')",
            "4, 5, 6",
            "[string \"return =\"]:1: unexpected symbol near '='",
            // One function with two names.
            "false, bad argument #3 to 'loadstring' (string expected, got table)",
            "nil, attempt to load a binary chunk (mode is 't')",
        ],
    );
}

/// Files and modules of text load as ever.
#[test]
fn text_without_unsafe() {
    assert_prints(
        "local function write(name, text) local file = io.open(name, 'w') file:write(text) file:close() end
        write('answer.lua', 'local name, path = ... coroutine.yield() return name .. path')
        write('part.lua', 'coroutine.yield(1) return 2, 3')
        write('broken.lua', 'return =')
        package.path = './?.lua;' .. package.path
        local step = coroutine.wrap(function() return dofile('part.lua') end)
        print(step(), step())
        print(pcall(require, 'broken'))
        print((select(2, pcall(require, 'no_such_module')):gsub('\\n.*', '')))
        print(pcall(dofile, 'broken.lua'))",
        &["--no-unsafe", "--allow-write=."],
        &[
            "1, 2, 3",
            "false, error loading module 'broken' from file './broken.lua':",
            "\t./broken.lua:1: unexpected symbol near '='",
            "module 'no_such_module' not found:",
            "false, broken.lua:1: unexpected symbol near '='",
        ],
    );
}
