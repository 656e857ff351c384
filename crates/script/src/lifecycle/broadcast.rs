//! Broadcasts: one callback to many scripts.

use std::rc::Rc;

use super::Reply;
use crate::host::{Script, ScriptGroup, Sim, state};
use crate::sys_call::SysCall;
use scene::Data;

impl Sim {
    /// Delivers a callback to the scripts of a group; returns how many ran it.
    pub(crate) fn deliver_to(
        self: &Rc<Self>,
        group: ScriptGroup,
        call: SysCall,
        args: &[Data],
    ) -> i64 {
        let scripts = self.scripts_in(group);
        numbers::count(
            scripts
                .iter()
                .filter(|script| self.deliver(script, call, args).ran)
                .count(),
        )
    }

    /// Simulation scripts, then customization scripts: those there are before the simulation scripts run. One that comes meanwhile is
    /// called from the next time on.
    pub(crate) fn deliver_to_embedded(self: &Rc<Self>, call: SysCall, args: &[Data]) -> i64 {
        let customization = self.scripts_in(ScriptGroup::Customization);
        let count = self.deliver_to(ScriptGroup::Simulation, call, args);
        let others = customization
            .iter()
            .filter(|script| self.deliver(script, call, args).ran);
        count + numbers::count(others.count())
    }

    /// Notes that a script has these callbacks; a script with `sysCall_event` receives events from now on.
    pub(crate) fn note_callbacks(self: &Rc<Self>, bits: u64) {
        self.scripts.note_callbacks(bits);
        if bits & SysCall::Event.bit() != 0 {
            self.add_event_listener();
        }
    }

    /// Everyone, in regular order.
    pub(crate) fn broadcast(self: &Rc<Self>, call: SysCall, args: &[Data]) {
        if !self.scripts.may_respond(call) {
            return;
        }
        for script in self.active_scripts().iter() {
            self.deliver(script, call, args);
        }
    }

    /// Calls scripts in turn until one returns a value.
    pub(crate) fn first_answer(
        self: &Rc<Self>,
        scripts: &[Rc<Script>],
        call: SysCall,
        args: &[Data],
    ) -> Option<Data> {
        scripts
            .iter()
            .find_map(|script| self.deliver(script, call, args).value)
    }

    /// A message to all initialised scripts but the sender.
    pub(crate) fn broadcast_message(self: &Rc<Self>, sender: i64, args: &[Data]) {
        self.app
            .borrow()
            .broadcasts
            .note(args.first().and_then(|message| message.field("id")));
        if !self.scripts.may_respond(SysCall::Msg) {
            return;
        }
        for script in self.active_scripts().iter() {
            if script.id != sender && script.base_state() == state::INITIALIZED {
                self.deliver(script, SysCall::Msg, args);
            }
        }
    }

    /// Notifies all others that a script has run one of the callbacks that concern them.
    pub(crate) fn broadcast_system_call(self: &Rc<Self>, script: &Script, call: SysCall) {
        if !self.scripts.may_respond(SysCall::Msg) {
            return;
        }
        let data = Data::map([
            ("callType", Data::Int(call as i64)),
            ("script", Data::Int(script.id)),
        ]);
        let message = Data::map([("id", Data::text("systemCall")), ("data", data)]);
        self.broadcast_message(script.id, &[message]);
    }

    /// Calls every script before a simulation step; true when one forbids it.
    pub(crate) fn main_script_is_vetoed(self: &Rc<Self>) -> bool {
        if !self.scripts.may_respond(SysCall::BeforeMainScript) {
            return false;
        }
        let mut vetoed = false;
        for script in self.active_scripts().iter() {
            let is_main = script.script_type == scene::object::script_object::ScriptType::Main;
            if !is_main && script.base_state() == state::INITIALIZED {
                let Reply { value, .. } = self.deliver(script, SysCall::BeforeMainScript, &[]);
                vetoed |= value
                    .as_ref()
                    .and_then(|v| v.field("doNotRunMainScript"))
                    .is_some_and(Data::truthy);
            }
        }
        vetoed && !self.clock.stop_is_requested()
    }
}
