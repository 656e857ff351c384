//! Traps in bytecode: lines where code can be made to call the debugger, and that cost nothing as long as it is not.
//!
//! Behind the instructions of each function stand pieces that nothing jumps to, one for each place where a line begins. A piece writes to a
//! table whose `__newindex` calls the debugger, does what the first instruction of the line does, and goes back. A trap is armed by replacing
//! that first instruction, in memory, with a jump to its piece (`live`). So the code that runs has as many instructions as without a debugger.

use std::collections::BTreeSet;

use super::chunk::{Chunk, Prototype};
use super::probes::{
    accepts_probe_before, aimed, c, code, entered_from_other_lines, is_recorded_before, op, target,
};

/// The table as debuggers see it.
const NAME: &str = "(debugger)";

/// The traps of a function, and of the functions inside it.
#[derive(Debug)]
pub(crate) struct FunctionTraps {
    /// Its first line; 0 for the main function.
    pub line: usize,
    /// All its instructions, as they are loaded.
    pub code: Vec<u32>,
    pub traps: Vec<Trap>,
    pub inner: Vec<FunctionTraps>,
}

/// A place where a line begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Trap {
    pub line: u32,
    /// The number of the instruction.
    pub place: usize,
    /// The instruction without the trap, and with it.
    pub original: u32,
    pub armed: u32,
}

/// The bytecode with traps on these lines, the index of the upvalue for the table, and the traps; None if there is no room.
pub(super) fn with_traps(
    bytecode: &[u8],
    lines: &BTreeSet<u32>,
) -> Option<(Vec<u8>, u8, FunctionTraps)> {
    let mut chunk = Chunk::read(bytecode)?;
    let (upvalue, traps) = add_to(&mut chunk.main, 0, lines)?;
    Some((chunk.write(), upvalue, traps))
}

/// Adds traps to a function and the functions inside it. Returns the index of its new upvalue too.
fn add_to(
    function: &mut Prototype<'_>,
    outer: u8,
    lines: &BTreeSet<u32>,
) -> Option<(u8, FunctionTraps)> {
    let upvalue = function.add_upvalue(NAME, outer)?;
    let traps = add_pieces(function, upvalue, lines);
    let inner = function
        .inner
        .iter_mut()
        .map(|inner| Some(add_to(inner, upvalue, lines)?.1))
        .collect::<Option<_>>()?;
    let traps = FunctionTraps {
        line: function.line,
        code: function.code.clone(),
        traps,
        inner,
    };
    Some((upvalue, traps))
}

/// Adds the pieces of a function. There are none where it uses all registers.
fn add_pieces(function: &mut Prototype<'_>, upvalue: u8, lines: &BTreeSet<u32>) -> Vec<Trap> {
    let Some(registers) = function.registers.checked_add(1) else {
        return Vec::new();
    };
    let (places, scratch) = (places(function, lines), u32::from(function.registers));
    let call = [
        op::GETUPVAL | scratch << 7 | u32::from(upvalue) << 16,
        op::SETI | scratch << 7 | 1 << 16 | scratch << 24,
    ];
    let mut traps = Vec::new();
    for place in places {
        let start = function.code.len();
        let moved = moved(function, place, start + call.len());
        let (Some(moved), Some(armed)) = (moved, jump(place, start)) else {
            continue;
        };
        let (line, original) = (function.lines[place], function.code[place]);
        function.code.extend(call);
        function.code.extend(moved);
        function.lines.resize(function.code.len(), line);
        function.repeat_locals(place, &(start..function.code.len()));
        traps.push(Trap {
            line,
            place,
            original,
            armed,
        });
    }
    if !traps.is_empty() {
        function.registers = registers;
    }
    traps
}

/// The instructions that begin a line: the first ones in the text of the function, and those that other lines jump to.
fn places(function: &Prototype<'_>, lines: &BTreeSet<u32>) -> Vec<usize> {
    let line_of = &function.lines;
    let entered = entered_from_other_lines(function);
    // The first instruction of a function with `...` only arranges its arguments; the last one is the return that no text has.
    let first = usize::from(function.is_vararg);
    let mut seen = BTreeSet::new();
    (first..function.code.len())
        .filter(|&i| lines.contains(&line_of[i]))
        .filter(|&i| i == first || line_of[i] != line_of[i - 1] || entered[i])
        .filter(|&i| !is_recorded_before(function, i) && accepts_probe_before(function, i))
        .filter(|&i| seen.insert(line_of[i]) || entered[i])
        .collect()
}

/// What instruction `place` does, at another place of the same function, and then goes on behind the first one. None for instructions that
/// cannot be moved.
fn moved(function: &Prototype<'_>, place: usize, at: usize) -> Option<Vec<u32>> {
    let instruction = function.code[place];
    let next = function.code.get(place + 1).copied();
    let to = target(place, instruction);
    Some(match code(instruction) {
        op::JMP => vec![jump(at, to?)?],
        // Without or with the next one, which is a jump, or sets the other boolean.
        op::LFALSESKIP => vec![
            instruction,
            jump(at + 1, place + 1)?,
            jump(at + 2, place + 2)?,
        ],
        op::EQ..=op::TESTSET => {
            let jumped = target(place + 1, next?)?;
            vec![instruction, jump(at + 1, jumped)?, jump(at + 2, place + 2)?]
        }
        op::ADDI..op::MMBIN => vec![instruction, next?, jump(at + 2, place + 2)?],
        // These jump forwards only, and the loop is behind.
        op::FORPREP => vec![
            instruction & 0x7fff,
            jump(at + 1, place + 1)?,
            jump(at + 2, to?)?,
        ],
        op::TFORPREP => {
            let (call, end) = (to?, to? + 1);
            let repeat = *function.code.get(end)?;
            let repeat = aimed(repeat, at + 2, target(end, repeat)?)?;
            vec![
                instruction & 0x7fff,
                function.code[call],
                repeat,
                jump(at + 3, end + 1)?,
            ]
        }
        op::FORLOOP => vec![aimed(instruction, at, to?)?, jump(at + 1, place + 1)?],
        op::MMBIN..=op::MMBINK | op::EXTRAARG | op::TFORCALL | op::TFORLOOP => return None,
        op::CALL | op::VARARG if c(instruction) == 0 => return None,
        _ if next.is_some_and(|next| code(next) == op::EXTRAARG) => {
            vec![instruction, next?, jump(at + 2, place + 2)?]
        }
        _ => vec![instruction, jump(at + 1, place + 1)?],
    })
}

/// The instruction at a place that jumps to another one.
fn jump(place: usize, to: usize) -> Option<u32> {
    aimed(op::JMP, place, to)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{Chunk, with_traps};
    use crate::lua::Bytecode;

    const TEXT: &str = "local x = 1
for i = 1, 2 do
    x = x + i
end
while x > 0 do
    x = x - 1
end
for k, v in pairs({}) do local a = k == v end
return function(...)
    if x and ... then return x end
    return {...}
end
";

    #[test]
    fn code_stays_in_its_place_and_lines_have_traps_where_they_begin() {
        let plain = Bytecode::compile(TEXT.as_bytes(), "=text").expect("it compiles");
        let all: BTreeSet<u32> = (1..=12).collect();
        let (_, _, traps) = with_traps(&plain.0, &all).expect("there is room");
        let main = Chunk::read(&plain.0).expect("bytecode").main;
        for (traps, before) in [(&traps, &main.code), (&traps.inner[0], &main.inner[0].code)] {
            assert_eq!(traps.code[..before.len()], before[..]);
            let are_original = |trap: &super::Trap| before[trap.place] == trap.original;
            assert!(traps.traps.iter().all(are_original));
        }
        let lines = |traps: &super::FunctionTraps| -> Vec<u32> {
            traps.traps.iter().map(|trap| trap.line).collect()
        };
        assert_eq!(lines(&traps), [1, 2, 3, 5, 6, 8, 12]);
        assert_eq!(lines(&traps.inner[0]), [10, 11, 12]);
    }

    #[test]
    fn without_lines_there_are_no_traps() {
        let plain = Bytecode::compile(TEXT.as_bytes(), "=text").expect("it compiles");
        let (_, _, traps) = with_traps(&plain.0, &BTreeSet::new()).expect("there is room");
        let main = Chunk::read(&plain.0).expect("bytecode").main;
        assert!(traps.traps.is_empty() && traps.code == main.code);
    }
}
