//! A console that a test reads.

use std::cell::RefCell;
use std::rc::Rc;

use swanilda::{Console, LogLine};

/// Collects prints and error lines.
#[derive(Clone, Default)]
pub struct Lines(pub Rc<RefCell<Vec<String>>>);

impl Console for Lines {
    fn print(&mut self, line: &[u8], _: f64) {
        self.0
            .borrow_mut()
            .push(String::from_utf8_lossy(line).into_owned());
    }

    fn log(&mut self, line: &LogLine<'_>) {
        self.0.borrow_mut().push(line.text.to_owned());
    }
}
