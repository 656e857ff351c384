//! Calls of one script about many contacts: what is the same for all of them is done once.

use std::rc::Rc;

use super::{CONTACT, CONTACT_BITS};
use crate::host::{CallbackResult, Integers, Level, MAX_DEPTH, Runtime, Script, ScriptError, Sim};
use crate::sys_call::SysCall;
use scene::Data;

/// The only script that is to be asked about contacts.
pub(crate) struct SoleResponder {
    script: Rc<Script>,
    runtime: Rc<Runtime>,
    call: SysCall,
}

impl Sim {
    /// The only script that has functions for contacts, if it has one, no hooks, and no call of it is in progress.
    pub(crate) fn sole_responder(&self) -> Option<SoleResponder> {
        let scripts = self.active_scripts_reversed();
        let script = scripts
            .iter()
            .find(|script| !script.ignores(CONTACT_BITS))?;
        let runtime = script.current_runtime()?;
        let call = CONTACT
            .into_iter()
            .find(|call| runtime.env.may_respond() & CONTACT_BITS == call.bit())?;
        let responder = SoleResponder {
            script: Rc::clone(script),
            runtime,
            call,
        };
        let may_call = responder.runtime.env.depth.get() == 0 && self.scripts.depth() < MAX_DEPTH;
        (may_call && self.is_sole(&responder)).then_some(responder)
    }

    /// Whether nothing has changed that matters for the calls of scripts about contacts.
    fn is_sole(&self, responder: &SoleResponder) -> bool {
        let SoleResponder {
            script,
            runtime,
            call,
        } = responder;
        let is_same = |other: &Rc<Script>| Rc::ptr_eq(other, script);
        let env = &runtime.env;
        script.is_running()
            && script
                .runtime
                .borrow()
                .as_ref()
                .is_some_and(|current| Rc::ptr_eq(current, runtime))
            && env.defined.get() & CONTACT_BITS == call.bit()
            && env.hooked.get() & CONTACT_BITS == 0
            && !script.removed.get()
            && !self.is_disabled(script)
            && self.all_active_reversed(|other| is_same(other) || other.ignores(CONTACT_BITS))
    }

    /// Calls the function of the script for one table after the other, as long as it returns nothing. Returns how often it was called, and
    /// what the last call returned. `next` makes the tables from their number.
    pub(crate) fn ask_in_turn(
        self: &Rc<Self>,
        responder: &SoleResponder,
        names: &'static [&'static str; 3],
        mut next: impl FnMut(usize) -> Option<[i64; 3]>,
    ) -> (usize, Option<Data>) {
        let SoleResponder { runtime, call, .. } = responder;
        let (mut count, mut host_calls) = (0, runtime.interpreter.host_calls());
        let mut only_lua_ran = || {
            let before = std::mem::replace(&mut host_calls, runtime.interpreter.host_calls());
            before.is_some() && before == host_calls
        };
        let level = Level::enter(&self.scripts, &runtime.env);
        let result = loop {
            let Some(values) = next(count) else {
                break Ok(None);
            };
            count += 1;
            level.begin_slice();
            match runtime.interpreter.call_with_integers(
                *call,
                Integers {
                    names,
                    values: &values,
                },
            ) {
                Ok(CallbackResult::Returned(Some(value))) => break Ok(Some(value)),
                Err(error) => break Err(error),
                Ok(_) if only_lua_ran() || self.is_sole(responder) => {}
                Ok(_) => break Ok(None),
            }
        };
        drop(level);
        (count, self.complete_answer(responder, result))
    }

    fn complete_answer(
        self: &Rc<Self>,
        SoleResponder {
            script,
            runtime,
            call,
        }: &SoleResponder,
        result: Result<Option<Data>, ScriptError>,
    ) -> Option<Data> {
        let value = result.unwrap_or_else(|error| {
            self.fail(script, &error);
            None
        });
        if runtime.env.depth.get() == 0 {
            self.complete_call(script, *call, value.as_ref());
        }
        value
    }
}
