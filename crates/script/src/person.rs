//! Users who watch the simulation through the viewer's pages and answer dialogs of scripts.

use std::rc::Rc;
use std::sync::atomic::Ordering;

use super::sim::Sim;
use scene::Data;
use ui::Question;

/// Shows a dialog and waits for the user's answer. The second argument tells whether the simulator is to end, which ends the wait. None without
/// an answer.
pub type Ask = dyn Fn(&Question, &dyn Fn() -> bool) -> Option<Data>;

impl Sim {
    /// Sets the function that shows dialogs to users.
    pub fn set_person(&self, ask: Rc<Ask>) {
        self.app.borrow_mut().person = Some(ask);
    }

    /// The answer of a user; None without one. The calling script waits meanwhile.
    pub(crate) fn ask_person(&self, question: &Question) -> Option<Data> {
        let ask = self.app.borrow().person.clone()?;
        ask(question, &|| self.options.stop.load(Ordering::Relaxed))
    }
}
