//! Lua modules that an embedding program writes in Rust: what they return, raise and hold.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use swanilda::mlua::{
    self, Function, Lua, Table, UserData, UserDataFields, UserDataMethods, Value, Variadic,
};
use swanilda::{Limits, Options, ScriptKind, Simulator};

use crate::lines::Lines;

#[allow(dead_code, reason = "its `main` is for people")]
#[path = "../../examples/own_module.rs"]
mod example;

/// Says when it goes.
struct Counter {
    count: i64,
    alive: Rc<Cell<i64>>,
}

impl Drop for Counter {
    fn drop(&mut self) {
        self.alive.set(self.alive.get() - 1);
    }
}

impl UserData for Counter {
    fn add_fields<F: UserDataFields<Self>>(fields: &mut F) {
        fields.add_field_method_get("count", |_, counter| Ok(counter.count));
        fields.add_field_method_set("count", |_, counter, count: i64| {
            counter.count = count;
            Ok(())
        });
    }

    fn add_methods<M: UserDataMethods<Self>>(methods: &mut M) {
        methods.add_method_mut("add", |_, counter, n: i64| {
            counter.count = counter
                .count
                .checked_add(n)
                .ok_or_else(|| mlua::Error::runtime("too many"))?;
            Ok(counter.count)
        });
        methods.add_method("explode", |_, _, ()| -> mlua::Result<()> {
            panic!("out of order")
        });
        methods.add_method("call", |_, _, function: Function| {
            function.call::<Variadic<Value>>(())
        });
    }
}

fn mine(lua: &Lua, alive: &Rc<Cell<i64>>) -> mlua::Result<Table> {
    let module = lua.create_table()?;
    let alive = Rc::clone(alive);
    let counter = move |_: &Lua, ()| {
        alive.set(alive.get() + 1);
        Ok(Counter {
            count: 0,
            alive: Rc::clone(&alive),
        })
    };
    module.set("counter", lua.create_function(counter)?)?;
    let fail = |_: &Lua, text: String| -> mlua::Result<()> { Err(mlua::Error::runtime(text)) };
    module.set("fail", lua.create_function(fail)?)?;
    module.set(
        "explode",
        lua.create_function(|_, ()| -> mlua::Result<()> { panic!("out of order") })?,
    )?;
    module.set(
        "call",
        lua.create_function(|_, function: Function| function.call::<Value>(()))?,
    )?;
    module.set(
        "fill",
        lua.create_function(|lua, n: i64| lua.create_sequence_from(0..n))?,
    )?;
    Ok(module)
}

/// Runs a script that may require `mine`; what it prints and logs.
fn run_with(options: Options, code: &str) -> Vec<String> {
    let (lines, alive) = (Lines::default(), Rc::new(Cell::new(0)));
    let held = Rc::clone(&alive);
    let mut simulator = Simulator::builder()
        .options(options)
        .console(Box::new(lines.clone()))
        .lua_module("mine", move |lua| mine(lua, &held))
        .build();
    let code = format!("sim = require 'sim' mine = require 'mine'\n{code}");
    simulator
        .add_script(ScriptKind::Customization, "", code.as_bytes())
        .expect("there is room for a script");
    drop(simulator);
    assert_eq!(alive.get(), 0, "all values are dropped with the state");
    lines.0.take()
}

fn run(code: &str) -> Vec<String> {
    run_with(Options::default(), code)
}

#[test]
fn the_example_runs() {
    let lines = Lines::default();
    example::simulate(Box::new(lines.clone())).expect("the example is right");
    let prints: Vec<String> = lines
        .0
        .take()
        .into_iter()
        .filter(|line| !line.starts_with("Simulation"))
        .collect();
    assert_eq!(
        prints[..4],
        ["3.", "0.", "12: in update: NaN is no sample", "0.025"],
        "{prints:?}"
    );
}

#[test]
fn values_and_methods() {
    let lines = run("local c = mine.counter()
        print(c:add(2), c:add(3), c.count, type(c), type(mine.counter().add))
        c.count = 7
        print(c.count, mine.call(function() return c:add(1) end), #mine.fill(1000), package.loaded.mine == mine)
        print(c:call(function() return 1, 2, 3 end))");
    assert_eq!(
        lines,
        ["2, 5, 5, userdata, function", "7, 8, 1000, true", "1, 2, 3"]
    );
}

#[test]
fn errors_are_strings_with_the_line_of_the_call() {
    let lines = run(
        "print(pcall(mine.fail, 'broken'))
        print(pcall(function()
            mine.fail('inside')
        end))
        local c = mine.counter()
        print(pcall(function() c:add(math.maxinteger) c:add(1) end))
        print(pcall(function() c:add('x') end))
        print(pcall(function() return #mine.fail .. '' end))
        print(select(2, pcall(mine.fail, 'text')) .. '!', select(2, pcall(mine.fail, 'text')):find('text'))
        print(xpcall(function() mine.fail('handled') end, function(e) return e:upper() end))
        print(xpcall(mine.fail, print, 'printed'))
        local co = coroutine.create(function() coroutine.yield(1) mine.fail('in a coroutine') end)
        print(coroutine.resume(co))
        print(coroutine.resume(co))
        print(pcall(coroutine.wrap(function() mine.fail('wrapped') end)))
        print((pcall(pcall)))
        print(pcall(error, {code = 5}))
        print(select('#', pcall(error)), pcall(error, nil))
        print(pcall(mine.call, function() mine.fail('deep') end))
        print(pcall(mine.call, function() error('of Lua') end))
        print(coroutine.wrap(function() return pcall(function() return coroutine.yield(5), 6 end) end)())
        local closing = coroutine.create(function() local x <close> = setmetatable({}, {__close = function() mine.fail('late') end}) coroutine.yield() end)
        coroutine.resume(closing)
        print(coroutine.close(closing))",
    );
    let expected = [
        "false, -1: in mine.fail: broken",
        "false, 4: in mine.fail: inside",
        "false, 7: in add: too many",
        "false, 8: in add: bad argument #2 to `Counter.add`: error converting Lua string to i64 (expected number or string \
         coercible to number)",
        "false, [string \"/Script\"]:9: attempt to get length of a function value (field 'fail')",
        "-1: in mine.fail: text!, 19, 22",
        "false, 11: IN MINE.FAIL: HANDLED",
        "-1: in mine.fail: printed",
        "false, nil",
        "true, 1",
        "false, 13: in mine.fail: in a coroutine",
        "false, 16: in mine.fail: wrapped",
        "false",
        "false, {code = 5, }",
        "1, false",
        "false, -1: in mine.call: deep",
        "false, -1: in mine.call: [string \"/Script\"]:21: of Lua",
        "5",
        "false, 23: in mine.fail: late",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn closed_variables_and_readers_of_chunks_see_strings_too() {
    let lines = run("local function closing() return setmetatable({}, {__close = function(_, problem) print(problem .. '') end}) end
        print(pcall(function()
            local x <close> = closing()
            mine.fail('closed')
        end))
        local co = coroutine.wrap(function()
            return pcall(function()
                local x <close> = closing()
                coroutine.yield(1)
                mine.fail('closed after a yield')
            end)
        end)
        print(co(), co())
        print(pcall(load, function() mine.fail('while reading') end))
        print(coroutine.wrap(function() return load(function() mine.fail('in a coroutine') end) end)())
        print(load('return ...', '=x', 't', {})(7), load('return +'))
        print((pcall(pcall)), (pcall(load)))");
    let expected = [
        "5: in mine.fail: closed",
        "false, 5: in mine.fail: closed",
        "11: in mine.fail: closed after a yield",
        "1, false, 11: in mine.fail: closed after a yield",
        "true, nil, 15: in mine.fail: while reading",
        "nil, 16: in mine.fail: in a coroutine",
        "7, nil, [string \"return +\"]:1: unexpected symbol near '+'",
        "false, false",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn a_panic_is_an_error_of_the_script() {
    let lines = run("print(pcall(mine.explode))
        print(pcall(function() mine.counter():explode() end))
        print(coroutine.resume(coroutine.create(mine.explode)))
        print(mine.counter():add(1))
        mine.explode()");
    let panicked = "a Rust function panicked: out of order";
    assert_eq!(
        lines[..3],
        [(); 3].map(|()| format!("false, {panicked}")),
        "{lines:?}"
    );
    assert_eq!(lines[3], "1");
    assert!(
        lines[4].starts_with(panicked) && lines[4].contains(":6: in main chunk"),
        "{lines:?}"
    );
    assert_eq!(lines.len(), 5);
}

#[test]
fn an_error_nobody_caught_is_logged_with_its_traceback() {
    let lines = run("local function inner()\n    mine.counter():add(1.5)\nend\ninner()");
    let [error] = lines.as_slice() else {
        panic!("{lines:?}")
    };
    assert!(
        error.starts_with("3: in add: bad argument #2 to `Counter.add`"),
        "{error}"
    );
    assert!(
        error.contains("stack traceback:") && error.contains(":5: in main chunk"),
        "{error}"
    );
}

#[test]
fn a_module_that_cannot_be_made_is_an_error() {
    let lines = Lines::default();
    let mut simulator = Simulator::builder()
        .console(Box::new(lines.clone()))
        .lua_module("mine", |_| Err(mlua::Error::runtime("no licence")))
        .build();
    let code = b"print(pcall(require, 'mine'))";
    simulator
        .add_script(ScriptKind::Customization, "", code)
        .expect("there is room for a script");
    assert!(
        lines.0.borrow()[0].ends_with("no licence"),
        "{:?}",
        lines.0.borrow()
    );
}

/// What a program has kept of a state outlives it without harm.
#[test]
fn a_function_that_was_kept_fails_when_its_state_is_gone() {
    let kept: Rc<RefCell<Option<Function>>> = Rc::default();
    let keep = Rc::clone(&kept);
    let mut simulator = Simulator::builder()
        .lua_module("mine", move |lua| {
            keep.replace(Some(lua.create_function(|_, x: i64| Ok(x + 1))?));
            lua.create_table()
        })
        .build();
    simulator
        .add_script(ScriptKind::Customization, "", b"require 'mine'")
        .expect("there is room for a script");
    let function = kept.take().expect("the module was required");
    assert_eq!(function.call::<i64>(1).expect("the script lives"), 2);
    drop(simulator);
    assert!(
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| function.call::<i64>(1)))
            .map_or(true, |r| r.is_err())
    );
}

/// A state that a program holds on to stays, with all it needs.
#[test]
fn a_state_that_was_kept_works_without_its_script() {
    let kept: Rc<RefCell<Option<Lua>>> = Rc::default();
    let keep = Rc::clone(&kept);
    let mut simulator = Simulator::builder()
        .lua_module("mine", move |lua| {
            keep.replace(Some(lua.clone()));
            lua.create_table()
        })
        .build();
    simulator
        .add_script(
            ScriptKind::Customization,
            "",
            b"sim = require 'sim' require 'mine'",
        )
        .expect("there is room");
    drop(simulator);
    let lua = kept.take().expect("the module was required");
    let made: String = lua
        .load("local t = {} for i = 1, 1e4 do t[i] = {i} end return tostring(#t)")
        .eval()
        .expect("runs");
    assert_eq!(made, "10000");
    let error = lua
        .load("sim.getSimulationTime()")
        .exec()
        .expect_err("there is no simulator");
    assert!(
        error.to_string().contains("the simulator is gone"),
        "{error}"
    );
}

#[test]
fn memory_that_is_refused_is_an_error_in_rust_functions_too() {
    let options = Options {
        limits: Some(Limits { memory: 8 << 20 }),
        ..Options::default()
    };
    let lines = run_with(
        options,
        "local ok, text = pcall(mine.fill, 1000000) print(ok, #text > 0)\nprint(#mine.fill(10))",
    );
    assert_eq!(lines, ["false, true", "10"]);
}
