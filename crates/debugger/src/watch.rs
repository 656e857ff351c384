//! Watching a replay: who changes a property, or makes an expression true.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use script::{Debugger, LoadedText, Place, Script, Sim};
use serde_json::json;

use crate::data::DataBreakpoints;
use crate::objects::sandbox;
use crate::session::asked;

/// Frames to look through for one with a text.
const MAX_FRAMES: usize = 50;

/// The line of a script that did something.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cause {
    /// The file, or the path of the script.
    pub title: String,
    /// The line, from 1.
    pub line: u32,
    /// The code of the line.
    pub code: String,
}

/// A debugger that stops nothing: it notes a change and what did it.
pub struct Watch {
    property: RefCell<DataBreakpoints>,
    is_of_property: bool,
    expression: Option<String>,
    /// The expression is asked after each call of a script.
    asks_often: Cell<bool>,
    change: RefCell<Option<(String, Option<Cause>)>>,
    error: RefCell<Option<String>>,
}

impl Watch {
    fn new(property: Option<&str>, expression: Option<&str>) -> Self {
        let mut watched = DataBreakpoints::default();
        if let Some(property) = property {
            watched.set(None, &[json!({"dataId": property})]);
        }
        Self {
            property: RefCell::new(watched),
            is_of_property: property.is_some(),
            expression: expression.map(str::to_owned),
            asks_often: Cell::new(false),
            change: RefCell::default(),
            error: RefCell::default(),
        }
    }

    /// Nothing is watched.
    pub fn of_nothing() -> Self {
        Self::new(None, None)
    }

    /// Watches a property, such as `/arm/joint:targetPosition`.
    pub fn of_property(name: &str) -> Self {
        Self::new(Some(name), None)
    }

    /// Watches a Lua expression with the global variables of the sandbox.
    pub fn of_expression(expression: &str) -> Self {
        Self::new(None, Some(expression))
    }

    /// Whether the object and its property were there.
    pub fn is_known(&self) -> bool {
        self.property.borrow().has_values()
    }

    /// Why the expression had no value the last time, if it never had one.
    pub fn error(&self) -> Option<String> {
        self.error.borrow().clone()
    }

    /// The last change since the last time that this was asked: a sentence, and what did it; nothing did what the simulation does itself.
    pub fn take_change(&self) -> Option<(String, Option<Cause>)> {
        self.change.take()
    }

    /// From now on the expression is asked after each call of a script, until it is true.
    pub fn ask_at_each_call(&self) {
        self.asks_often.set(true);
    }

    /// Whether the expression is true now.
    pub fn is_true(&self, sim: &Rc<Sim>) -> bool {
        let Some(expression) = &self.expression else {
            return false;
        };
        let value = sim.without_trace(|| {
            let sandbox = sandbox(sim);
            asked(sim, sandbox, |sandbox| sandbox.evaluate(None, expression))
        });
        match value {
            Ok(value) => {
                self.error.replace(None);
                value.value != "nil" && value.value != "false"
            }
            Err(reason) => {
                self.error.replace(Some(reason));
                false
            }
        }
    }
}

impl Debugger for Watch {
    fn text_loaded(&self, _: &Rc<Sim>, _: &Rc<Script>, _: &Rc<LoadedText>) {}

    fn line_reached(&self, _: &Rc<Sim>, _: &Place<'_>) {}

    fn error_raised(&self, _: &Rc<Sim>, _: &Rc<Script>, _: &str, _: bool) {}

    fn scene_changed(&self, sim: &Rc<Sim>, script: Option<&Rc<Script>>) {
        if self.is_of_property {
            let changes = self.property.borrow_mut().changes(sim, false);
            if let Some(change) = changes.into_iter().next_back() {
                self.change.replace(Some((change.text, cause(sim, script))));
            }
        } else if self.asks_often.get() && self.is_true(sim) {
            self.asks_often.set(false);
            self.change
                .replace(Some((String::new(), cause(sim, script))));
        }
    }

    fn answer_requests(&self, _: &Rc<Sim>, _: Option<&Rc<Script>>) -> bool {
        false
    }
}

/// The line of the script that runs.
fn cause(sim: &Rc<Sim>, script: Option<&Rc<Script>>) -> Option<Cause> {
    let frames = asked(sim, script?.id, |debuggee| Ok(debuggee.frames(MAX_FRAMES))).ok()?;
    let frame = frames.iter().find(|frame| frame.text.is_some())?;
    let text = frame.text.as_ref()?;
    let code = String::from_utf8_lossy(&text.text);
    let place = usize::try_from(frame.line).ok()?.checked_sub(1)?;
    Some(Cause {
        title: text.title.clone(),
        line: frame.line,
        code: code
            .lines()
            .nth(place)
            .unwrap_or_default()
            .trim()
            .to_owned(),
    })
}
