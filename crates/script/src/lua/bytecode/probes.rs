//! Inserts probes into bytecode: instructions that record in a table that a line runs.
//!
//! A hook that Lua calls for every line makes scripts twenty times slower. A probe is one instruction, `notes.LINE = true`, at the beginning
//! of each line's instructions and wherever a jump from another line enters them. The table is an upvalue that every function of the
//! text gets. Functions with too many constants for that have probes of three instructions.

use std::collections::{BTreeMap, BTreeSet};

use super::chunk::{Chunk, Prototype};

/// The table as debuggers see it.
const NAME: &str = "(coverage)";

pub(super) mod op {
    pub const LOADI: u32 = 1;
    pub const LFALSESKIP: u32 = 6;
    pub const GETUPVAL: u32 = 9;
    pub const SETTABUP: u32 = 15;
    pub const SETTABLE: u32 = 16;
    pub const SETI: u32 = 17;
    pub const ADDI: u32 = 21;
    pub const MMBIN: u32 = 46;
    pub const MMBINK: u32 = 48;
    pub const JMP: u32 = 56;
    pub const EQ: u32 = 57;
    pub const TESTSET: u32 = 67;
    pub const CALL: u32 = 68;
    pub const TAILCALL: u32 = 69;
    pub const FORLOOP: u32 = 73;
    pub const FORPREP: u32 = 74;
    pub const TFORPREP: u32 = 75;
    pub const TFORCALL: u32 = 76;
    pub const TFORLOOP: u32 = 77;
    pub const VARARG: u32 = 80;
    pub const EXTRAARG: u32 = 82;
}

/// Largest number in eight, and in seventeen bits of an instruction.
const MAX_8: usize = 0xff;
const MAX_17: i64 = 0x1_ffff;
/// Stands for zero where numbers have a sign.
const ZERO_17: i64 = MAX_17 >> 1;
const MAX_25: i64 = 0x1ff_ffff;
const ZERO_25: i64 = MAX_25 >> 1;

/// The bytecode with probes on these lines, and the index of the upvalue for the table; None if there is no room.
pub(super) fn with_probes(bytecode: &[u8], lines: &BTreeSet<u32>) -> Option<(Vec<u8>, u8)> {
    let mut chunk = Chunk::read(bytecode)?;
    let upvalue = add_to(&mut chunk.main, 0, lines)?;
    Some((chunk.write(), upvalue))
}

/// Adds probes to a function and the functions inside it. Returns the index of its new upvalue.
fn add_to(function: &mut Prototype<'_>, outer: u8, lines: &BTreeSet<u32>) -> Option<u8> {
    let upvalue = function.add_upvalue(NAME, outer)?;
    let probes = Probes::new(function, upvalue, lines)?;
    probes.insert(function)?;
    function
        .inner
        .iter_mut()
        .try_for_each(|inner| add_to(inner, upvalue, lines).map(drop))?;
    Some(upvalue)
}

pub(super) fn code(instruction: u32) -> u32 {
    instruction & 0x7f
}

/// The last field of eight bits.
pub(super) fn c(instruction: u32) -> u32 {
    instruction >> 24
}

/// The field of seventeen bits.
pub(super) fn bx(instruction: u32) -> i64 {
    i64::from(instruction >> 15)
}

/// The instruction that may run next, other than the one after it.
pub(super) fn target(place: usize, instruction: u32) -> Option<usize> {
    let next = numbers::count(place) + 1;
    let target = match code(instruction) {
        op::JMP => next + i64::from(instruction >> 7) - ZERO_25,
        op::FORLOOP | op::TFORLOOP => next - bx(instruction),
        op::FORPREP => next + bx(instruction) + 1,
        op::TFORPREP => next + bx(instruction),
        op::LFALSESKIP | op::EQ..=op::TESTSET => next + 1,
        // Arithmetic skips the call of a metamethod when it needs none.
        op::ADDI..op::MMBIN => next + 1,
        _ => return None,
    };
    usize::try_from(target).ok()
}

/// The instruction with another jump target; instructions without one are unchanged.
pub(super) fn aimed(instruction: u32, place: usize, target: usize) -> Option<u32> {
    let (next, target) = (numbers::count(place) + 1, numbers::count(target));
    let in_17 = |distance: i64| {
        let distance = (0..=MAX_17)
            .contains(&distance)
            .then_some(numbers::low_u32(distance))?;
        Some(instruction & 0x7fff | distance << 15)
    };
    match code(instruction) {
        op::JMP => {
            let distance = target - next + ZERO_25;
            (0..=MAX_25)
                .contains(&distance)
                .then_some(instruction & 0x7f | numbers::low_u32(distance) << 7)
        }
        op::FORLOOP | op::TFORLOOP => in_17(next - target),
        op::FORPREP => in_17(target - next - 1),
        op::TFORPREP => in_17(target - next),
        _ => Some(instruction),
    }
}

/// The probes of a function.
struct Probes {
    /// For each of its instructions, the lines to note before it.
    lines: Vec<Vec<u32>>,
    /// The probe of each line.
    instructions: BTreeMap<u32, Vec<u32>>,
}

impl Probes {
    fn new(function: &mut Prototype<'_>, upvalue: u8, counted: &BTreeSet<u32>) -> Option<Self> {
        let lines = places(function, counted);
        let scratch = function.registers;
        let distinct: BTreeSet<u32> = lines.iter().flatten().copied().collect();
        let instructions = distinct
            .into_iter()
            .map(|line| Some((line, probe(function, scratch, upvalue, line)?)));
        Some(Self {
            lines,
            instructions: instructions.collect::<Option<_>>()?,
        })
    }

    fn insert(&self, function: &mut Prototype<'_>) -> Option<()> {
        let size = |line: &u32| self.instructions[line].len();
        // The new positions of each instruction's probes, and of the instruction itself.
        let (mut starts, mut places, mut end) = (Vec::new(), Vec::new(), 0);
        for lines in &self.lines {
            starts.push(end);
            end += lines.iter().map(size).sum::<usize>();
            places.push(end);
            end += 1;
        }
        starts.push(end);
        let (mut instructions, mut lines) = (Vec::with_capacity(end), Vec::with_capacity(end));
        for (i, &instruction) in function.code.iter().enumerate() {
            self.lines[i]
                .iter()
                .for_each(|line| instructions.extend(&self.instructions[line]));
            let moved = match target(i, instruction) {
                Some(target) => aimed(instruction, places[i], *starts.get(target)?)?,
                None => instruction,
            };
            instructions.push(moved);
            lines.resize(instructions.len(), function.lines[i]);
        }
        (function.code, function.lines) = (instructions, lines);
        function.move_locals(|place| starts.get(place).copied().unwrap_or(end));
        Some(())
    }
}

/// The lines to record before each instruction.
fn places(function: &Prototype<'_>, counted: &BTreeSet<u32>) -> Vec<Vec<u32>> {
    let (code_of, line_of) = (&function.code, &function.lines);
    let entered = entered_from_other_lines(function);
    let mut places = vec![Vec::new(); code_of.len()];
    // The first instruction of a function with `...` only arranges its arguments.
    let first = usize::from(function.is_vararg);
    for i in first..code_of.len() {
        let begins = i == first || line_of[i] != line_of[i - 1] || entered[i];
        if begins
            && !is_recorded_before(function, i)
            && accepts_probe_before(function, i)
            && counted.contains(&line_of[i])
        {
            places[i].push(line_of[i]);
        }
        // No probe can be inserted between these two instructions.
        if let (op::TFORPREP, Some(call)) = (code(code_of[i]), target(i, code_of[i]))
            && line_of
                .get(call)
                .is_some_and(|line| *line != line_of[i] && counted.contains(line))
        {
            places[i].push(line_of[call]);
        }
    }
    places
}

pub(super) fn entered_from_other_lines(function: &Prototype<'_>) -> Vec<bool> {
    let mut entered = vec![false; function.code.len()];
    for (i, &instruction) in function.code.iter().enumerate() {
        if let Some(target) = target(i, instruction)
            && function
                .lines
                .get(target)
                .is_some_and(|line| *line != function.lines[i])
        {
            entered[target] = true;
        }
    }
    entered
}

/// The end of a numeric loop on the same line as its beginning, which has run before.
pub(super) fn is_recorded_before(function: &Prototype<'_>, i: usize) -> bool {
    let begin = target(i, function.code[i]).and_then(|body| body.checked_sub(1));
    code(function.code[i]) == op::FORLOOP
        && begin.is_some_and(|begin| {
            code(function.code[begin]) == op::FORPREP && function.lines[begin] == function.lines[i]
        })
}

/// Whether a probe can be inserted before an instruction: not if the previous instruction requires it to be next, or leaves a variable
/// number of values for it.
pub(super) fn accepts_probe_before(function: &Prototype<'_>, i: usize) -> bool {
    let belongs = matches!(
        code(function.code[i]),
        op::MMBIN..=op::MMBINK | op::EXTRAARG | op::TFORCALL | op::TFORLOOP
    );
    let Some(before) = i.checked_sub(1).map(|before| function.code[before]) else {
        return !belongs;
    };
    let has_next = match code(before) {
        op::LFALSESKIP | op::EQ..=op::TESTSET | op::TAILCALL => true,
        op::CALL | op::VARARG => c(before) == 0,
        _ => false,
    };
    !belongs && !has_next
}

/// `notes.LINE = true`, or in a function with too many constants `notes[LINE] = LINE`, which uses registers from `scratch`.
fn probe(function: &mut Prototype<'_>, scratch: u8, upvalue: u8, line: u32) -> Option<Vec<u32>> {
    let upvalue = u32::from(upvalue);
    if function.constant_count() < MAX_8 {
        let (key, truth) = (
            function.constant_text(&line.to_string()),
            function.constant_true(),
        );
        return Some(vec![
            op::SETTABUP
                | upvalue << 7
                | 1 << 15
                | numbers::count_u32(key) << 16
                | numbers::count_u32(truth) << 24,
        ]);
    }
    function.registers = scratch.checked_add(2)?;
    let (table, number) = (u32::from(scratch), u32::from(scratch) + 1);
    let value = i64::from(line) + ZERO_17;
    let value = u32::try_from(value).ok().filter(|_| value <= MAX_17)?;
    Some(vec![
        op::GETUPVAL | table << 7 | upvalue << 16,
        op::LOADI | number << 7 | value << 15,
        op::SETTABLE | table << 7 | number << 16 | number << 24,
    ])
}
