//! Every function answers wrong arguments with an error: it never crashes and never hangs.

use std::fs;
use std::process::Command;

use docs::{self, FunctionDoc};
use test_support::parallel;
use test_support::process::run_bounded;

/// These end the program, or wait for the wall clock as long as they are told.
const NOT_CALLED: &[&str] = &["quitSimulator", "sim.quitSimulator", "sim.wait"];

/// What the chunk prints and logs, in a process of its own: one that crashes takes nothing with it.
fn run(code: &str) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let scene = folder.path().join("scene.lua");
    fs::write(&scene, code).expect("our own folder is writable");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    // Functions that write files do so where nobody minds.
    command
        .current_dir(folder.path())
        .arg("run")
        .arg(&scene)
        .args(["--data-dir", ".", "--as", "sandbox"]);
    command.args(["--no-start", "--loops", "1", "--quiet"]);
    let output = run_bounded(&mut command).unwrap_or_else(|error| panic!("{error}"));
    assert!(!output.contains("panicked"), "{output}");
    output
}

#[test]
fn wrong_arguments_for_every_function() {
    let functions: Vec<FunctionDoc> = docs::functions()
        .into_iter()
        .filter(|f| !NOT_CALLED.contains(&&*f.name))
        .collect();
    assert!(functions.len() > 100, "the table of functions is read");
    let chunks: Vec<&[FunctionDoc]> = functions.chunks(functions.len().div_ceil(8)).collect();
    parallel::map(&chunks, |chunk| {
        let names: Vec<String> = chunk
            .iter()
            .map(|f| format!("{{'{}', {}}}", f.name, f.parameters.len()))
            .collect();
        let code = CALL_WRONGLY.replace("FUNCTIONS", &names.join(", "));
        let output = run(&code);
        let last = output
            .lines()
            .rev()
            .find(|line| line.starts_with("calling"))
            .unwrap_or_default();
        assert!(
            output.contains("all called"),
            "{last}\n{}",
            output.lines().rev().take(20).collect::<Vec<_>>().join("\n")
        );
        assert!(!output.contains("no string"), "{output}");
    });
}

/// Calls each function with values of every kind at every place, with a few sound values around them.
const CALL_WRONGLY: &str = r"
sim = require 'sim'
local write = print
print = function() end
local deep = {}
for i = 1, 50 do deep = {deep} end
local long = {}
for i = 1, 1000 do long[i] = i * 0.5 end
local dummy = sim.createDummy and sim.createDummy(0.1) or 0
local values = {
    false, true, 0, 1, -1, -4, 1.5, 0/0, 1/0, -1/0, 1e300, math.maxinteger, math.mininteger, 2^31, '', 'text', '\0\255', 'sysCall_init',
    {}, {1, 2, 3}, {0/0, 1/0, -1/0}, {'a', {}, false}, {x = 1}, deep, long, {0, 0, 0, 0, 0, 0, 1}, print, coroutine.create(print), dummy,
}
local function check(name, ok, message)
    if not ok and type(message) ~= 'string' then write('no string', name, type(message)) end
end
for _, entry in ipairs{FUNCTIONS} do
    local name, count = entry[1], entry[2]
    write('calling ' .. name)
    local f = name:match('^sim%.') and sim[name:sub(5)] or _G[name]
    check(name, pcall(f))
    check(name, pcall(f, table.unpack({}, 1, 12)))
    for place = 1, math.min(count, 6) do
        for _, filler in ipairs{false, dummy, 'text', {1, 2, 3}} do
            for _, value in ipairs(values) do
                local arguments = {}
                for i = 1, count do arguments[i] = filler end
                arguments[place] = value
                check(name, pcall(f, table.unpack(arguments, 1, count)))
            end
        end
    end
end
write('all called')
";
