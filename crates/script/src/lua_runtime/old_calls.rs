//! Scripts from before callbacks existed. `lua/library/old_calls.lua` runs them.

use super::startup;
use crate::host::Sim;
use crate::lua::{LuaError, Stack};
use crate::sys_call::SysCall;

/// Names that identify such a text: the call it runs for, and the first of the calls. They are searched in the text as in the original, so that a
/// comment is enough.
const SIGNS: [&[u8]; 2] = [b"sim_call_type", b"sim.syscb_init"];

/// The calls there were.
const CALLS: &[SysCall] = &[
    SysCall::Cleanup,
    SysCall::NonSimulation,
    SysCall::BeforeSimulation,
    SysCall::AfterSimulation,
    SysCall::Actuation,
    SysCall::Sensing,
    SysCall::Suspended,
    SysCall::Suspend,
    SysCall::Resume,
    SysCall::BeforeInstanceSwitch,
    SysCall::AfterInstanceSwitch,
    SysCall::BeforeCopy,
    SysCall::AfterCopy,
];

/// Whether a text is of that kind.
pub(super) fn are_expected_by(code: &[u8]) -> bool {
    SIGNS.iter().all(|sign| contains(code, sign))
        && !contains(code, SysCall::Init.name().as_bytes())
}

fn contains(code: &[u8], part: &[u8]) -> bool {
    code.windows(part.len()).any(|window| window == part)
}

/// Runs the loaded text on top of the stack, which it takes, as its initialization, and defines its callbacks.
pub(super) fn begin(stack: Stack<'_>, sim: &Sim) -> Result<(), LuaError> {
    startup::load_module(stack, sim, "old_calls")?;
    stack.insert(-2);
    stack.push_int(SysCall::Init as i64);
    stack.new_table(0, CALLS.len());
    for call in CALLS {
        stack.push_int(*call as i64);
        stack.raw_set_field(-2, call.name());
    }
    stack.protected_call(3, 0)
}

#[cfg(test)]
mod tests {
    use super::are_expected_by;

    #[test]
    fn texts_that_ask_for_the_call() {
        assert!(are_expected_by(
            b"if (sim_call_type==sim.syscb_init) then end"
        ));
        assert!(!are_expected_by(
            b"if (sim_call_type==sim.syscb_actuation) then end"
        ));
        assert!(!are_expected_by(
            b"if sim_call_type==sim.syscb_init then end function sysCall_init() end"
        ));
        assert!(!are_expected_by(
            b"function sysCall_msg(m) print(m.data.callType == sim.syscb_init) end"
        ));
    }
}
