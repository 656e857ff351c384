//! Calls whose results are dropped.

use super::chunk::{Prototype, is_short_string};

mod op {
    pub const GETFIELD: u32 = 14;
    pub const CALL: u32 = 68;
}

impl Prototype<'_> {
    /// Whether calls of a field of that name, on a line, are statements: nothing reads their results. False where the line has no such call,
    /// as for functions that were put into variables before.
    pub(crate) fn drops_results_of(&self, field: &str, line: u32) -> bool {
        let calls = self.code.iter().zip(&self.lines).enumerate();
        let mut wanted = calls
            .filter(|(_, (instruction, at))| **at == line && *instruction & 0x7f == op::CALL)
            .filter(|(place, (instruction, _))| self.calls_field(*place, **instruction, field))
            .map(|(_, (instruction, _))| instruction >> 24)
            .peekable();
        // The third operand is the number of results and one more; 0 for all there are.
        wanted.peek().is_some() && wanted.all(|results| results == 1)
    }

    /// Whether what the call at `place` calls was last read from a field of that name.
    fn calls_field(&self, place: usize, call: u32, field: &str) -> bool {
        let register = call >> 7 & 0xff;
        let read = self.code[..place]
            .iter()
            .rev()
            .find(|&&earlier| earlier & 0x7f == op::GETFIELD && earlier >> 7 & 0xff == register);
        read.and_then(|read| self.constants.get((read >> 24) as usize))
            .is_some_and(|constant| is_short_string(constant, field))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Bytecode;

    fn drops(code: &str) -> bool {
        let bytecode = Bytecode::compile(code.as_bytes(), "=test").unwrap();
        let function = bytecode.main_function().unwrap();
        function.drops_results_of("resume", 1)
    }

    #[test]
    fn statements_drop_results() {
        assert!(drops("coroutine.resume(co, 1, 2)"));
        assert!(drops("if f(x) then coroutine.resume(co) end print(1)"));
        assert!(drops("for i = 1, 3 do coroutine.resume(all[i]) end"));
    }

    #[test]
    fn other_uses_read_results() {
        for code in [
            "local ok = coroutine.resume(co) print(ok)",
            "if coroutine.resume(co) then f() end",
            "print(coroutine.resume(co))",
            "local all = {coroutine.resume(co)}",
            "return coroutine.resume(co)",
            "x = coroutine.resume(co) coroutine.resume(other)",
            "coroutine.wrap(f)",
            "coroutine.resume2(co)",
            "\ncoroutine.resume(co)",
        ] {
            assert!(!drops(code), "{code}");
        }
    }
}
