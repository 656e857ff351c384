//! Replaces functions that will not be called by stubs: loading a chunk takes as long as its functions are.
//!
//! A function can be replaced if the chunk makes it as the last argument of a call and has no other reference to it, as in
//! `it('name', function() ... end)`. What a global of that name does with it, only the caller of this module knows.

use std::ops::Range;

use super::chunk::{Chunk, Prototype, is_short_string, write_size};

mod op {
    pub const GETTABUP: u32 = 11;
    pub const CALL: u32 = 68;
    pub const RETURN0: u32 = 71;
    pub const CLOSURE: u32 = 79;
}

/// The arguments of the calls: a name and a function. As in the instruction, which counts the called function as well.
const NAME_AND_FUNCTION: u32 = 3;
/// A call whose results are dropped, as the instruction has it.
const NO_RESULTS: u32 = 1;

/// A function that a chunk makes for a call only.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct PassedFunction {
    /// Its first and its last line.
    pub lines: (usize, usize),
    /// Its place in the bytecode.
    place: Range<usize>,
}

/// The functions that are passed to one of these global functions, behind a name; in the order of the bytecode.
pub(super) fn passed_functions(bytecode: &[u8], callees: &[&str]) -> Vec<PassedFunction> {
    let mut found = Vec::new();
    // Without variables of the name `_ENV`, globals are those of the chunk.
    if let Some(chunk) = Chunk::read(bytecode).filter(|chunk| !chunk.main.has_local(b"_ENV")) {
        collect(&chunk.main, bytecode.as_ptr().addr(), callees, &mut found);
    }
    found
}

fn collect(
    function: &Prototype<'_>,
    start: usize,
    callees: &[&str],
    found: &mut Vec<PassedFunction>,
) {
    let is_passed = passed(function, callees);
    for (inner, is_passed) in function.inner.iter().zip(is_passed) {
        if is_passed {
            let begin = inner.raw.as_ptr().addr() - start;
            let lines = (inner.line, inner.last_line);
            found.push(PassedFunction {
                lines,
                place: begin..begin + inner.raw.len(),
            });
        } else {
            collect(inner, start, callees, found);
        }
    }
}

/// For each inner function, whether it is passed to one of these.
fn passed(function: &Prototype<'_>, callees: &[&str]) -> Vec<bool> {
    let mut passed = vec![false; function.inner.len()];
    for (place, pair) in function.code.windows(2).enumerate() {
        let (closure, call) = (Instruction(pair[0]), Instruction(pair[1]));
        let is_argument = closure.code() == op::CLOSURE
            && call.code() == op::CALL
            && (call.b(), call.c()) == (NAME_AND_FUNCTION, NO_RESULTS)
            && closure.a() == call.a() + NAME_AND_FUNCTION - 1;
        if is_argument
            && is_global(function, place, call.a(), callees)
            && let Some(passed) = passed.get_mut(closure.bx())
        {
            *passed = true;
        }
    }
    passed
}

/// Whether a register has got one of these globals by an instruction before `place`.
fn is_global(function: &Prototype<'_>, place: usize, register: u32, names: &[&str]) -> bool {
    let mut before = function.code[..place]
        .iter()
        .rev()
        .map(|&instruction| Instruction(instruction));
    let Some(get) = before.find(|instruction| instruction.a() == register) else {
        return false;
    };
    let constant = function.constants.get(get.c() as usize);
    get.code() == op::GETTABUP
        && function.upvalue_name(get.b() as usize) == Some(b"_ENV")
        && constant.is_some_and(|constant| names.iter().any(|name| is_short_string(constant, name)))
}

/// The bytecode with stubs in place of these functions, which are in its order.
pub(super) fn with_stubs<'a>(
    bytecode: &[u8],
    functions: impl Iterator<Item = &'a PassedFunction>,
) -> Vec<u8> {
    let mut out = Vec::with_capacity(bytecode.len());
    let mut end = 0;
    for function in functions {
        out.extend(&bytecode[end..function.place.start]);
        write_stub(&mut out, function.lines);
        end = function.place.end;
    }
    out.extend(&bytecode[end..]);
    out
}

/// A function of these lines that does nothing.
fn write_stub(out: &mut Vec<u8>, (line, last_line): (usize, usize)) {
    // Its source is that of the function it is in.
    write_size(out, 0);
    write_size(out, line);
    write_size(out, last_line);
    let (parameters, is_vararg, registers) = (0, 0, 2);
    out.extend([parameters, is_vararg, registers]);
    write_size(out, 1);
    out.extend((op::RETURN0 | 1 << 16).to_ne_bytes());
    let (constants, upvalues, inner, lines, absolute_lines, locals, upvalue_names) =
        (0, 0, 0, 0, 0, 0, 0);
    for count in [
        constants,
        upvalues,
        inner,
        lines,
        absolute_lines,
        locals,
        upvalue_names,
    ] {
        write_size(out, count);
    }
}

#[derive(Clone, Copy)]
struct Instruction(u32);

impl Instruction {
    fn code(self) -> u32 {
        self.0 & 0x7f
    }

    fn a(self) -> u32 {
        self.0 >> 7 & 0xff
    }

    fn b(self) -> u32 {
        self.0 >> 16 & 0xff
    }

    fn c(self) -> u32 {
        self.0 >> 24
    }

    fn bx(self) -> usize {
        (self.0 >> 15) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::super::Bytecode;
    use crate::lua::tests::with_state;

    /// The lines of the functions that can be replaced.
    fn lines(text: &str) -> Vec<(usize, usize)> {
        let bytecode = Bytecode::compile(text.as_bytes(), "=text").expect("it compiles");
        bytecode
            .passed_functions(&["it"])
            .into_iter()
            .map(|function| function.lines)
            .collect()
    }

    #[test]
    fn functions_are_found_where_nothing_else_refers_to_them() {
        assert_eq!(
            lines("it('a', function()\nend)\nit('b' .. 1, function() x() end)"),
            [(1, 2), (3, 3)]
        );
        assert_eq!(
            lines("describe('g', function()\n it('a', function() end) end)"),
            [(2, 2)]
        );
        assert_eq!(
            lines("it('a', function() it('b', function() end) end)").len(),
            1
        );
    }

    #[test]
    fn functions_that_may_be_used_elsewhere_stay() {
        for text in [
            "local f = function() end it('a', f)",
            "local it = it it('a', function() end)",
            "local t = {it = it} t.it('a', function() end) local function g() t.it('a', function() end) end",
            "other('a', function() end)",
            "x = it('a', function() end)",
            "return it('a', function() end)",
            "it(function() end)",
            "it('a', function() end, 1)",
            "local _ENV = {it = it} it('a', function() end)",
        ] {
            assert_eq!(lines(text), [], "{text}");
        }
    }

    #[test]
    fn a_chunk_with_stubs_does_the_rest_as_before() {
        let text = "local n = 7\nit('a', function() return n end)\nit('b', function()\nreturn n + 1 end)\nreturn n";
        let bytecode = Bytecode::compile(text.as_bytes(), "=text").expect("it compiles");
        let passed = bytecode.passed_functions(&["it"]);
        let reduced = bytecode.with_stubs(passed.iter().filter(|function| function.lines.0 != 3));
        with_state(|state| {
            let stack = state.stack();
            let define = "function it(name, body) _G[name] = {debug.getinfo(body, 'S').linedefined, body()} end";
            stack
                .load_text(define.as_bytes(), "=define")
                .expect("it compiles");
            stack.protected_call(0, 0).expect("runs");
            stack.load_bytecode(&reduced, "=text").expect("it loads");
            stack.protected_call(0, 1).expect("runs");
            assert_eq!(stack.integer(-1), Some(7));
            let results = state.lua().globals();
            assert_eq!(results.get::<Vec<i64>>("a").expect("a list"), [2]);
            assert_eq!(results.get::<Vec<i64>>("b").expect("a list"), [3, 8]);
        });
        assert_eq!(
            bytecode.with_stubs(passed.iter().filter(|_| false)),
            bytecode
        );
    }
}
