//! A person who looks on through pages and answers dialogs of scripts.

use std::rc::Rc;
use std::sync::atomic::Ordering;

use super::sim::Sim;
use scene::Data;
use ui::Question;

/// Asks a question and waits for the answer, as long as the second argument does not say that the simulator is to end. None when nobody answers.
pub type Ask = dyn Fn(&Question, &dyn Fn() -> bool) -> Option<Data>;

impl Sim {
    /// Questions go there from now on.
    pub fn set_person(&self, ask: Rc<Ask>) {
        self.app.borrow_mut().person = Some(ask);
    }

    /// The answer of a person; None without one. The calling script waits meanwhile.
    pub(crate) fn ask_person(&self, question: &Question) -> Option<Data> {
        let ask = self.app.borrow().person.clone()?;
        ask(question, &|| self.options.stop.load(Ordering::Relaxed))
    }
}
