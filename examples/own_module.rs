//! A Lua module of your own, written in Rust: scripts `require` it as any other.
//!
//! `cargo run --example own_module`

use swanilda::mlua::{self, Lua, Table, UserData, UserDataMethods};
use swanilda::{Console, Error, LogLine, ScriptKind, Simulator};

/// A low-pass filter of first order.
struct LowPass {
    /// Share of the new value, 0 to 1.
    share: f64,
    value: Option<f64>,
}

impl UserData for LowPass {
    fn add_methods<M: UserDataMethods<Self>>(methods: &mut M) {
        methods.add_method_mut("update", |_, filter, sample: f64| {
            if !sample.is_finite() {
                return Err(mlua::Error::runtime(format!("{sample} is no sample")));
            }
            let value = filter
                .value
                .map_or(sample, |value| value + filter.share * (sample - value));
            filter.value = Some(value);
            Ok(value)
        });
    }
}

/// The module `filters`.
fn filters(lua: &Lua) -> mlua::Result<Table> {
    let module = lua.create_table()?;
    module.set(
        "low_pass",
        lua.create_function(|_, share: f64| Ok(LowPass { share, value: None }))?,
    )?;
    let mean = |_: &Lua, samples: Vec<f64>| Ok(samples.iter().sum::<f64>() / samples.len() as f64);
    module.set("mean", lua.create_function(mean)?)?;
    Ok(module)
}

const SCRIPT: &str = "
local sim = require 'sim'
local filters = require 'filters'

function sysCall_init()
    filter = filters.low_pass(0.5)
    print(filters.mean{1, 2, 6})
end

function sysCall_sensing()
    print(filter:update(sim.getSimulationTime()))
    local ok, message = pcall(function() filter:update(0 / 0) end)
    print(message)
end
";

struct Terminal;

impl Console for Terminal {
    fn print(&mut self, line: &[u8], time: f64) {
        println!("{time:.2} s: {}", String::from_utf8_lossy(line));
    }

    fn log(&mut self, line: &LogLine<'_>) {
        eprintln!("{}", line.text);
    }
}

/// Runs two steps of a scene whose script uses the module.
pub fn simulate(console: Box<dyn Console>) -> Result<(), Error> {
    let mut simulator = Simulator::builder()
        .console(console)
        .lua_module("filters", filters)
        .build();
    simulator.add_script(ScriptKind::Simulation, "filtering", SCRIPT.as_bytes())?;
    simulator.step(2);
    simulator.stop();
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Scripts may recurse deeply: give them the stack they expect.
    let thread = std::thread::Builder::new().stack_size(Simulator::STACK_SIZE);
    thread
        .spawn(|| simulate(Box::new(Terminal)))?
        .join()
        .expect("a simulator does not panic")?;
    Ok(())
}
