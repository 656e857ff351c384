//! Delivery of user input in windows of scripts, and of the notifications that scripts asked for (spec: simui 4).

use std::rc::Rc;

use super::handler::Handler;
use crate::host::Sim;
use crate::log::verbosity;
use scene::Data;
use scene::object::script_object::ScriptType;
use ui::Event;

impl Sim {
    /// Closes the consoles that last as long as the simulation.
    pub(crate) fn close_consoles(&self) {
        let windows = self.app.borrow_mut().consoles.end_simulation();
        let ui = self.app.borrow().ui.clone();
        for window in windows {
            // Nothing else destroys them.
            let _ = ui.borrow_mut().destroy(&window);
        }
    }

    /// Calls the handlers of the events that wait, in their order. What they raise waits for the next time.
    pub(crate) fn deliver_ui_events(self: &Rc<Self>) {
        let ui = self.app.borrow().ui.clone();
        let count = ui.borrow().waiting();
        for _ in 0..count {
            let next = ui.borrow_mut().next_event();
            match next {
                Some(Ok(event)) => self.deliver_ui_event(event),
                Some(Err(warning)) => self.log(verbosity::WARNINGS, &warning),
                None => break,
            }
        }
    }

    fn deliver_ui_event(self: &Rc<Self>, event: Event) {
        if event.evaluates {
            return self.evaluate_entry(&event);
        }
        if let Some(script) = self.script(event.script) {
            self.call_handler(&script, &Handler::Name(event.handler), &event.args);
        }
    }

    /// Replaces what was entered by its value as a Lua expression in the sandbox; one that fails changes nothing.
    fn evaluate_entry(self: &Rc<Self>, event: &Event) {
        let (Some(Data::Text(entry)), Some(window), Some(widget)) =
            (event.args.last(), event.window, event.widget)
        else {
            return;
        };
        let Some(sandbox) = self.scripts.detached(ScriptType::Sandbox) else {
            return;
        };
        let code = [b"tostring(", entry.as_slice(), b")"].concat();
        if let Ok(results) = self.execute_string(&sandbox, &code)
            && let Some(Data::Text(result)) = results.first()
        {
            let ui = self.app.borrow().ui.clone();
            ui.borrow_mut().replace_by_result(
                window,
                widget,
                String::from_utf8_lossy(result).into_owned(),
            );
        }
    }
}
