//! How fast scripts call the simulator: one benchmark per row of calls in docs/BENCHMARKS.md.
//!
//! A function has two ways into Lua: as a row of the simulator (`getSimulationTime` returns a number, `getObjectPosition` a table of three), and
//! from an embedding program by mlua's `create_function` (`ownNumber`, `ownTable`).

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use swanilda::mlua::{self, Lua, Table};
use swanilda::scene::Data;
use swanilda::{ScriptKind, Simulator};

/// As in the command: each simulator has memory of its own.
#[global_allocator]
static ALLOCATOR: swanilda::Allocator = swanilda::Allocator;

/// Calls in a tight loop.
const CALLS: u64 = 100_000;

const SCRIPT: &str = "
sim = require 'sim'
own = require 'own'
function ownNumber(n) local f = own.number for _ = 1, n do f() end end
function ownTable(n) local f = own.table for _ = 1, n do f() end end
function sysCall_init() h = sim.createDummy(0.1) p = {0, 0, 0} q = {0, 0, 1} end
function getSimulationTime(n) local f = sim.getSimulationTime for _ = 1, n do f() end end
function getObjectPosition(n) local f, h = sim.getObjectPosition, h for _ = 1, n do f(h, -1) end end
function setObjectPosition(n) local f, h, p = sim.setObjectPosition, h, p for _ = 1, n do f(h, p) end end
function setObjectPositionChanging(n)
    local f, h, p, q = sim.setObjectPosition, h, p, q
    for _ = 1, n / 2 do f(h, p) f(h, q) end
end
function getIntProperty(n) local f, h = sim.getIntProperty, h for _ = 1, n do f(h, 'layer') end end
function setIntProperty(n) local f, h = sim.setIntProperty, h for i = 1, n do f(h, 'layer', i & 1) end end
function setFloatPropertyCustom(n) local f, h = sim.setFloatProperty, h for i = 1, n do f(h, 'customData.x', i) end end
function getFloatPropertyCustom(n) local f, h = sim.getFloatProperty, h for _ = 1, n do f(h, 'customData.x') end end
function getVector3Property(n) local f, s = sim.getVector3Property, sim.handle_scene for _ = 1, n do f(s, 'gravity') end end
";

const FUNCTIONS: [&str; 11] = [
    "getSimulationTime",
    "ownNumber",
    "getObjectPosition",
    "ownTable",
    "setObjectPosition",
    "setObjectPositionChanging",
    "getIntProperty",
    "setIntProperty",
    "setFloatPropertyCustom",
    "getFloatPropertyCustom",
    "getVector3Property",
];

/// The module `own`, as an embedding program writes it.
fn own(lua: &Lua) -> mlua::Result<Table> {
    let module = lua.create_table()?;
    module.set("number", lua.create_function(|_, ()| Ok(0.5))?)?;
    module.set("table", lua.create_function(|_, ()| Ok([0.0, 0.0, 0.5]))?)?;
    Ok(module)
}

fn calls(criterion: &mut Criterion) {
    let mut sim = Simulator::builder().lua_module("own", own).build();
    let script = sim
        .add_script(ScriptKind::Customization, "bench", SCRIPT.as_bytes())
        .expect("the script loads");
    let mut group = criterion.benchmark_group("calls");
    group.throughput(Throughput::Elements(CALLS));
    for function in FUNCTIONS {
        group.bench_function(function, |bencher| {
            bencher.iter(|| {
                sim.call(&script, function, &[Data::Int(CALLS as i64)])
                    .expect("the function works")
            });
        });
    }
    group.finish();
}

criterion_group!(benches, calls);
criterion_main!(benches);
