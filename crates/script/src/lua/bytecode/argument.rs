//! Whether a function may keep its argument after it has returned: an escape analysis of one register.
//!
//! It does not where it only reads fields of it, as most callbacks do: then the next call can get the same table. Everything else
//! counts as keeping: copies in other variables, calls with it, functions that capture it, assignments to its fields.

use super::chunk::Prototype;

/// The register of the first parameter.
const ARGUMENT: u32 = 0;

mod op {
    pub const MOVE: u32 = 0;
    pub const GETTABLE: u32 = 12;
    pub const GETI: u32 = 13;
    pub const GETFIELD: u32 = 14;
    pub const SETTABUP: u32 = 15;
    pub const SETTABLE: u32 = 16;
    pub const SETI: u32 = 17;
    pub const SETFIELD: u32 = 18;
    pub const SELF: u32 = 20;
    pub const ADDI: u32 = 21;
    pub const ADDK: u32 = 22;
    pub const SHLI: u32 = 33;
    pub const ADD: u32 = 34;
    pub const SHR: u32 = 45;
    pub const MMBIN: u32 = 46;
    pub const UNM: u32 = 49;
    pub const LEN: u32 = 52;
    pub const JMP: u32 = 56;
    pub const EQ: u32 = 57;
    pub const LE: u32 = 59;
    pub const TESTSET: u32 = 67;
    pub const RETURN0: u32 = 71;
    pub const EXTRAARG: u32 = 82;
}

impl Prototype<'_> {
    /// Whether nothing refers to the argument of a call with one argument once the call has returned. Functions that look into the
    /// registers of others (`debug.getlocal`) are not considered.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a register of Lua has eight bits"
    )]
    pub(crate) fn forgets_its_argument(&self) -> bool {
        if self.is_vararg {
            return false;
        }
        if self.parameters == 0 {
            return true;
        }
        let is_captured = |inner: &Prototype<'_>| inner.captures(ARGUMENT as u8);
        !self.inner.iter().any(is_captured)
            && self
                .code
                .iter()
                .all(|&instruction| only_reads_fields(instruction))
    }
}

impl Prototype<'_> {
    /// Whether the body is empty.
    pub(crate) fn does_nothing(&self) -> bool {
        matches!(self.code[..], [only] if only & 0x7f == op::RETURN0)
    }
}

/// Whether an instruction does no more with the argument than read a field of it.
fn only_reads_fields(instruction: u32) -> bool {
    let [a, b, c] = [7, 16, 24].map(|place| instruction >> place & 0xff == ARGUMENT);
    let c_is_register = instruction >> 15 & 1 == 0;
    !match instruction & 0x7f {
        op::JMP | op::RETURN0 | op::EXTRAARG => false,
        op::GETI | op::GETFIELD => a,
        op::GETTABLE => a || c,
        op::SETTABUP => c && c_is_register,
        op::SETI | op::SETFIELD => a || c && c_is_register,
        op::SETTABLE | op::SELF => a || b || c && c_is_register,
        op::ADD..=op::SHR => a || b || c,
        op::MOVE
        | op::ADDI
        | op::ADDK..=op::SHLI
        | op::MMBIN
        | op::UNM..=op::LEN
        | op::EQ..=op::LE
        | op::TESTSET => a || b,
        // All others have one register at most, or count up from it.
        ..op::EXTRAARG => a,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::super::Bytecode;

    /// Whether the function that a text returns forgets its argument.
    fn forgets(function: &str) -> bool {
        let code =
            Bytecode::compile(format!("local up return {function}").as_bytes(), "=test").unwrap();
        code.main_function().unwrap().inner[0].forgets_its_argument()
    }

    #[test]
    fn only_an_empty_body_does_nothing() {
        let does_nothing = |function: &str| {
            let code = Bytecode::compile(format!("return {function}").as_bytes(), "=test").unwrap();
            code.main_function().unwrap().inner[0].does_nothing()
        };
        assert!(does_nothing("function() end") && does_nothing("function(a, b) -- later\n end"));
        for body in [
            "return 1",
            "return nil",
            "local a",
            "a = 1",
            "f()",
            "return f()",
            "goto x ::x::  f()",
        ] {
            assert!(!does_nothing(&format!("function() {body} end")), "{body}");
        }
        assert!(!does_nothing("function(...) return ... end"));
    }

    #[test]
    fn reading_fields_keeps_nothing() {
        for body in [
            "",
            "local a, b = data.handle1, data['handle2'] return {a, b}",
            "if data.handle1 == box and data.handle2 ~= up then return {ignoreContact = false} end",
            "count = (count or 0) + data.handle1 * 2 print(data.engine, data[1], data[up])",
            "local found = {} for i = 1, 10 do found[i] = data.handle1 .. i end return found[data.handle2]",
            "for name, value in pairs(up) do up[name] = data.handle1 end",
            "local function inner(other) return other.handle1 end return inner(up)",
        ] {
            assert!(forgets(&format!("function(data) {body} end")), "{body}");
        }
        assert!(forgets("function() return up end"));
    }

    #[test]
    fn everything_else_may_keep_it() {
        for body in [
            "up = data",
            "last = data",
            "local other = data other.x = 1",
            "return data",
            "return (print(data))",
            "return {data}",
            "return print, data",
            "up.last = data",
            "up[1] = data",
            "up[data] = true",
            "local t = {} t[up] = data",
            "data.handle1 = 1",
            "data[1] = 1",
            "data[up] = 1",
            "data = up",
            "data:method()",
            "up:method(data)",
            "for k, v in pairs(data) do end",
            "return function() return data end",
            "return function() return function() return data.x end end",
            "local a = up or data return a",
            "local a = data .. up",
            "local a = up .. data",
            "local a = data + 1",
            "local a = up + data",
            "local a = -data",
            "local a = #data",
            "local a = data == up",
            "local a = up < data",
            "local close <close> = data",
            "return up[data]",
        ] {
            assert!(!forgets(&format!("function(data) {body} end")), "{body}");
        }
        assert!(!forgets("function(...) return ... end"));
        assert!(!forgets("function(data, ...) end"));
    }
}
