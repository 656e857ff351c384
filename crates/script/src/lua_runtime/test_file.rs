//! Files of tests: compiled once, and loaded into the simulator of each test without the bodies of the other tests.

use std::ffi::c_int;
use std::rc::Rc;
use std::sync::Arc;

use crate::lua::{Bytecode, PassedFunction, Stack, Type, push_callback};
use crate::test_bench::TestBench;

/// The module that loads test files.
pub(super) const MODULE: &str = "busted";
/// Its functions that get a test: a name and a function.
const TESTS: [&str; 3] = ["it", "spec", "test"];

/// A compiled file of tests.
struct CompiledTests {
    bytecode: Bytecode,
    /// Functions that are tests and nothing else.
    bodies: Vec<PassedFunction>,
    /// The first and the last line of each test's function; of what is no function of Lua, 0.
    lines: Vec<(usize, usize)>,
}

impl CompiledTests {
    /// What is to be loaded for that test, numbered from 1.
    fn of_test(&self, number: usize) -> Option<Bytecode> {
        let lines = self.lines.get(number.checked_sub(1)?)?;
        Some(
            self.bytecode
                .with_stubs(self.bodies.iter().filter(|body| body.lines != *lines)),
        )
    }
}

/// Adds the functions for the module to the table on top.
pub(super) fn add_functions(stack: Stack<'_>) {
    push_callback(stack, keep, 0);
    stack.raw_set_field(-2, "keep");
    push_callback(stack, load, 0);
    stack.raw_set_field(-2, "load");
}

fn bench(stack: Stack<'_>) -> Option<Rc<TestBench>> {
    // Where lines are counted, the functions of all texts count.
    let sim = stack
        .env()
        .sim
        .upgrade()
        .filter(|sim| !sim.options.count_lines)?;
    sim.test_bench.get().cloned()
}

/// `keep(chunk, lines)`: leaves a file with the runner. `lines` has two numbers for each test; it is nil when the file uses the names of
/// tests for something else.
fn keep(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let Some(bench) = bench(stack) else {
        return Ok(0);
    };
    let mut lines = Vec::new();
    if stack.kind(2) == Type::Table {
        let number = |i: usize| {
            stack
                .integer_at(2, numbers::count(i))
                .and_then(|line| usize::try_from(line).ok())
                .unwrap_or(0)
        };
        lines = (1..=stack.raw_len(2))
            .step_by(2)
            .map(|i| (number(i), number(i + 1)))
            .collect();
    }
    stack.push_value(1);
    if let Some(bytecode) = stack.dump() {
        let bodies = if lines.is_empty() {
            Vec::new()
        } else {
            bytecode.passed_functions(&TESTS)
        };
        bench.compiled.replace(Some(Arc::new(CompiledTests {
            bytecode,
            bodies,
            lines,
        })));
    }
    Ok(0)
}

/// `load(environment, number)`: the chunk of the file that was left with the runner, for all tests or for one; nothing when there is none.
fn load(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let Some(compiled) = bench(stack).and_then(|bench| bench.compiled.borrow().clone()) else {
        return Ok(0);
    };
    let Some(tests) = compiled.downcast_ref::<CompiledTests>() else {
        return Ok(0);
    };
    let number = stack
        .integer(2)
        .and_then(|number| usize::try_from(number).ok());
    let of_test = number.and_then(|number| tests.of_test(number));
    stack
        .load_bytecode(of_test.as_ref().unwrap_or(&tests.bytecode), "=")
        .map_err(|error| error.text)?;
    stack.push_value(1);
    stack.set_environment();
    Ok(1)
}
