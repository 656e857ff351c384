//! Notifying scripts of changed data of their object (`sysCall_data`).

use std::rc::Rc;

use crate::host::{Script, Sim};
use crate::sys_call::SysCall;
use scene::journal::ChangedNames;
use scene::object::script_object::ScriptType;
use scene::{Data, Handle, Key, Namespace};

impl Sim {
    /// Notifies scripts of custom data and signals that were written or removed since the last loop iteration: one call per object and
    /// namespace.
    pub(crate) fn notify_changed_data(self: &Rc<Self>) {
        let changed = self.scene.borrow_mut().journal_mut().take_changed_data();
        if !self.scripts.may_respond(SysCall::Data) {
            return;
        }
        for ((object, namespace), names) in changed {
            let args = [written_or_removed(names), Data::text(name_of(namespace))];
            for script in self.scripts_of(object) {
                self.deliver(&script, SysCall::Data, &args);
            }
        }
    }

    /// The script an object is, or those attached to it: simulation scripts first.
    fn scripts_of(&self, object: Handle) -> Vec<Rc<Script>> {
        if let Some(script) = self.script(object.raw()) {
            return vec![script];
        }
        // A removed object has no scripts.
        let mut scripts = self.scripts_of_object(object);
        scripts.sort_by_key(|script| {
            (
                script.owner().is_none(),
                script.script_type != ScriptType::Simulation,
            )
        });
        scripts
    }
}

fn written_or_removed(names: ChangedNames) -> Data {
    Data::Map(
        names
            .into_iter()
            .map(|(name, written)| (Key::Text(name.into_bytes()), Data::Bool(written)))
            .collect(),
    )
}

fn name_of(namespace: Namespace) -> &'static str {
    match namespace {
        Namespace::CustomData => "customData",
        Namespace::Signal => "signal",
    }
}
