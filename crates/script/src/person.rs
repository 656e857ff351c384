//! Users who watch the simulation through the viewer's pages and answer dialogs of scripts.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::atomic::Ordering;

use heap::{Outer, brought_in};

use crate::host::Sim;
use crate::tape::Taped;
use scene::Data;
use ui::Question;

/// Shows a dialog and waits for the user's answer. The second argument tells whether the simulator is to end, which ends the wait. None without
/// an answer.
pub type Ask = dyn Fn(&Question, &dyn Fn() -> bool) -> Option<Data>;

/// Who answers dialogs, if anybody does.
#[derive(Default)]
struct Person(RefCell<Option<Rc<Outer<Rc<Ask>>>>>);

impl Sim {
    /// Sets the function that shows dialogs to users.
    pub fn set_person(&self, ask: Rc<Ask>) {
        self.modules
            .states
            .get::<Person>()
            .0
            .replace(Some(Rc::new(Outer::new(ask))));
    }

    /// The answer of a user; None without one. The calling script waits meanwhile.
    pub(crate) fn ask_person(&self, question: &Question) -> Option<Data> {
        let ask = || {
            let person = self.modules.states.existing::<Person>()?;
            let ask = person.0.borrow().clone()?;
            let should_end = || self.options.stop.load(Ordering::Relaxed);
            brought_in(|| ask.with(|ask| ask(question, &should_end))).map(Taped)
        };
        let tape = self.options.permissions.tape();
        let answer = tape.input("the answer to a dialog", ask).ok().flatten();
        answer.map(|answer| answer.0)
    }
}
