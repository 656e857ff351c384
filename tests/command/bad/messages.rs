//! Whatever scripts say to each other, the simulator passes it on or answers with an error, in bounded time and memory.

use std::fs;
use std::process::Command;

use test_support::process::run_bounded;

/// What a script of the sandbox prints and logs.
fn run(code: &str) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let scene = folder.path().join("scene.lua");
    fs::write(&scene, format!("sim = require 'sim'\n{code}")).expect("our own folder is writable");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .current_dir(folder.path())
        .arg("run")
        .arg(&scene)
        .args(["--data-dir", ".", "--as", "sandbox"]);
    command.args([
        "--empty",
        "--quiet",
        "--no-start",
        "--loops",
        "3",
        "--verbosity",
        "scripterrors",
    ]);
    let output = run_bounded(&mut command).unwrap_or_else(|error| panic!("{error}\nof {code}"));
    assert!(!output.contains("panicked"), "{output}");
    output
}

#[test]
fn long_strings() {
    let output = run("
        local long = string.rep('x', 100 * 1000 * 1000)
        local code = \"function sysCall_msg(m) if m.id == 'long' then print(#m.data) end end\"
        sim.initScript(sim.createScript(sim.scripttype_customization, code, 0, 'lua'))
        sim.broadcastMsg({id = 'long', data = long})
        local d = sim.createDummy(0.1)
        sim.writeCustomStringData(d, 'long', long) print(#sim.readCustomStringData(d, 'long'))
        sim.setStringSignal('long', long) print(#sim.getStringSignal('long'))
        for scheme = 0, 1 do print(#sim.unpackTable(sim.packTable({long}, scheme))[1]) end
        print(pcall(sim.transformBuffer, long, sim.buffer_uint8, 1, 0, sim.buffer_double))
        print(pcall(sim.transformBuffer, long, sim.buffer_uint8, 0, 1, sim.buffer_split))");
    let lines: Vec<&str> = output.lines().collect();
    assert_eq!(lines[..5], ["100000000"; 5], "{output}");
    assert!(
        lines[5..7]
            .iter()
            .all(|line| line.ends_with("the data is too large.")),
        "{output}"
    );
}

#[test]
fn more_elements_than_memory() {
    let output = run("
        local lists = '\\x9f' .. ('\\x80'):rep(17 * 1000 * 1000)
        local packed = '\\5\\1\\1\\0\\0\\1' .. ('\\0'):rep(17 * 1000 * 1000)
        for _, decode in ipairs{sim.unpackTable, require('org.conman.cbor').decode} do print(pcall(decode, lists)) end
        print(pcall(sim.unpackTable, packed))");
    let lines: Vec<&str> = output.lines().collect();
    assert!(
        lines.len() == 3
            && lines
                .iter()
                .all(|line| line.contains("more than 16777216 elements")),
        "{output}"
    );
}

#[test]
fn strange_tables() {
    let output = run("
        local cycle = {id = 'x'} cycle.self = cycle
        local holes = {} for i = 0, 40 do holes[1 << i] = i end
        local deep = {} for _ = 1, 1000 do deep = {deep} end
        local strange = {f = print, co = coroutine.create(print), [print] = 1, [{}] = 2, [0/0 == 0/0] = 3, [1.5] = 4, inf = math.huge, nan = 0/0}
        local meta = setmetatable({1}, {__index = error, __len = error, __pairs = error, __metatable = 'no'})
        local d = sim.createDummy(0.1)
        for _, t in ipairs{cycle, holes, strange, meta} do
            sim.broadcastMsg(t)
            sim.writeCustomTableData(d, 't', t)
            sim.writeCustomTableData(d, 'c', t, {dataType = 'cbor'})
            for scheme = 0, 1 do assert(type(sim.unpackTable(sim.packTable(t, scheme))) == 'table') end
            print(type(sim.readCustomTableData(d, 't')), type(sim.readCustomTableData(d, 'c')))
        end
        print(pcall(sim.broadcastMsg, deep))
        print(pcall(sim.writeCustomTableData, d, 't', deep))
        print(pcall(sim.packTable, deep))");
    let (good, deep) = output.split_at("table, table\n".len() * 4);
    assert_eq!(good, "table, table\n".repeat(4));
    assert_eq!(
        deep.matches("nested deeper than 100 levels").count(),
        3,
        "{deep}"
    );
}

#[test]
fn spoilt_packed_tables() {
    let output = run("
        local table = {1, 2.5, 'text', true, {a = {b = {}}}, k = tobuffer('bytes'), [-7] = 'x'}
        local refused = 0
        for scheme = 0, 1 do
            local bytes = tostring(sim.packTable(table, scheme))
            for at = 1, #bytes do
                for _, byte in ipairs{0, 1, 4, 0x7f, 0x9f, 0xff} do
                    local spoilt = bytes:sub(1, at - 1) .. string.char(byte) .. bytes:sub(at + 1)
                    if not pcall(sim.unpackTable, spoilt) then refused = refused + 1 end
                end
                if not pcall(sim.unpackTable, bytes:sub(1, at - 1)) then refused = refused + 1 end
            end
        end
        print(refused > 100)");
    assert_eq!(output, "true\n");
}

#[test]
fn broadcasts_without_end() {
    for again in [
        "sim.broadcastMsg(m)",
        "pcall(sim.broadcastMsg, m)",
        "pcall(sim.broadcastMsg, m) pcall(sim.broadcastMsg, m)",
    ] {
        let output = run(&format!(
            "local code = \"sim = require 'sim' function sysCall_msg(m) if m.id == 'again' then {again} end end\"
            for _ = 1, 6 do sim.initScript(sim.createScript(sim.scripttype_customization, code, 0, 'lua')) end
            sim.broadcastMsg({{id = 'again'}})
            print('over')"
        ));
        assert!(
            output.contains("too many nested calls between scripts"),
            "{output}"
        );
        assert!(output.ends_with("over\n"), "{output}");
    }
}

#[test]
fn wrong_types() {
    let functions = "broadcastMsg writeCustomStringData readCustomStringData readCustomDataTags writeCustomTableData readCustomTableData \
        setReferencedHandles getReferencedHandles setStringSignal getStringSignal clearStringSignal getSignalName packTable \
        unpackTable packInt32Table unpackInt32Table packFloatTable unpackFloatTable transformBuffer persistentDataWrite \
        persistentDataRead tubeOpen tubeWrite tubeRead tubeStatus tubeClose auxiliaryConsoleOpen auxiliaryConsolePrint \
        auxiliaryConsoleClose getObjectsWithTag";
    let output = run(&format!(
        "local values = {{5, -1, 0/0, math.huge, 2^63, 'x', {{}}, {{1, 'x'}}, true, print, tobuffer('b'), sim.handle_app, sim.handle_scene}}
        for name in ('{functions}'):gmatch('%S+') do
            for _, a in ipairs(values) do for _, b in ipairs(values) do for _, c in ipairs(values) do
                pcall(sim[name], a, b, c) pcall(sim[name], a, b, c, a, b)
            end end end
        end
        print('over')"
    ));
    assert!(output.ends_with("over\n"), "{output}");
}

/// The requests of remote clients, without their sockets.
#[test]
fn spoilt_remote_requests() {
    let harness = include_str!("../../support/remote_requests.lua");
    let output = run(&format!(
        "{harness}
        local cbor = require 'org.conman.cbor'
        local requests = {{
            cbor.encode{{func = 'sim.getObject', args = {{'/Floor'}}, argsL = 1, uuid = 'u', ver = 2, timeout = 600}},
            cbor.encode{{func = 'sim.testCB', args = {{1, 'f@func', 2, 1}}, uuid = 'u'}},
            cbor.encode{{func = '_*executed*_', args = {{8}}, argsL = 1, uuid = 'u'}},
            cbor.encode{{func = 'swanilda.batch', args = {{{{{{func = 'string.rep', args = {{'a', 2}}}}, {{}}}}, true}}, uuid = 'u'}},
        }}
        local count, odd = 0, {{0, 1, 0x1b, 0x3b, 0x5b, 0x5f, 0x7b, 0x9b, 0x9f, 0xbb, 0xbf, 0xc2, 0xd9, 0xf6, 0xfb, 0xff}}
        for _, bytes in ipairs(requests) do
            for at = 1, #bytes do
                ask(bytes:sub(1, at))
                for _, byte in ipairs(odd) do
                    ask(bytes:sub(1, at - 1) .. string.char(byte) .. bytes:sub(at + 1))
                    count = count + 1
                end
            end
        end
        print(count > 3000)
        leave()
        local function answer(request) return (cbor.decode(ask(cbor.encode(request)))) end
        print(answer{{uuid = ('u'):rep(2000), func = 'f'}}.err)
        print(answer{{uuid = 'n', func = 'type', args = {{}}, argsL = math.maxinteger}}.err)
        print(answer{{uuid = 'n', func = 'type', args = {{nil, 1}}, argsL = math.mininteger}}.err)
        print(answer{{uuid = 'n', func = 'string.rep', args = {{'x', 1 << 40}}, argsL = 2}}.err ~= nil)
        print(answer{{uuid = 'n', func = 'string.rep', args = {{'ab', 2}}, argsL = 2}}.ret[1])"
    ));
    let lines: Vec<&str> = output.lines().collect();
    assert_eq!(
        lines[..3],
        ["true", "the uuid is too long", "too many arguments"],
        "{output}"
    );
    assert!(lines[3].contains("value expected"), "{output}");
    assert_eq!(lines[4..], ["true", "abab"], "{output}");
}
