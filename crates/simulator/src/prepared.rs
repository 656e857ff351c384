//! Calls of functions of the API that are made again and again: looked up once, and made one after the other in one go.

use ::scene::Data;
use ::scene::object::script_object::ScriptType;
use script::Member;

use super::{Error, Simulator};

/// A call of a function of the API, which [`Simulator::prepare_call`] makes.
#[derive(Debug, Clone)]
pub struct PreparedCall {
    member: Option<Member>,
    name: String,
    args: Vec<Data>,
}

impl Simulator {
    /// A call of a function that scripts have, with its arguments; see [`call_api`](Self::call_api).
    pub fn prepare_call(&self, name: &str, args: Vec<Data>) -> PreparedCall {
        PreparedCall {
            member: self.parts.sim.modules.registry.find(name),
            name: name.to_owned(),
            args,
        }
    }

    /// Makes a call, with further arguments.
    ///
    /// # Errors
    /// As [`call_api`](Self::call_api).
    pub fn call_once(&mut self, call: &PreparedCall, more: &[Data]) -> Result<Vec<Data>, Error> {
        let sandbox = self.detached(ScriptType::Sandbox);
        let args = [&call.args, more].concat();
        Ok(self.copied(|sim| sim.call_member(&sandbox, call.member, &call.name, &args))?)
    }

    /// Makes calls one after the other, each with a last argument of its own if it has one, until one fails. `collect` adds the results of each to
    /// what was collected so far.
    ///
    /// # Errors
    /// How many calls were good before, and the error of the one that failed, or of `collect`.
    pub fn call_prepared<'a, T: Clone>(
        &mut self,
        calls: impl Iterator<Item = (&'a PreparedCall, Option<f64>)>,
        collected: &T,
        collect: impl Fn(&mut T, usize, &[Data]) -> Result<(), String>,
    ) -> Result<T, (usize, String)> {
        let sandbox = self.detached(ScriptType::Sandbox);
        self.copied(|sim| {
            let mut collected = collected.clone();
            for (number, (call, last)) in calls.enumerate() {
                let made = match last {
                    None => sim.call_member(&sandbox, call.member, &call.name, &call.args),
                    Some(last) => {
                        let args = [&call.args[..], &[Data::Float(last)]].concat();
                        sim.call_member(&sandbox, call.member, &call.name, &args)
                    }
                };
                let failed = |error: String| (number, error);
                let results = made.map_err(|error| failed(Error::from(error).to_string()))?;
                collect(&mut collected, number, &results).map_err(failed)?;
            }
            Ok(collected)
        })
    }
}
