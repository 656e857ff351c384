//! The interface between running scripts and a debugger.
//!
//! The interpreters of a simulator with a [`Debugger`] report to it what they load, and when code reaches a place where it has a trap. While it
//! answers, everything stands still: it is called on the thread of the simulator, in the middle of the code. It looks at the scripts by
//! [`Debuggee`].
//!
//! A debugger lives outside of the simulator's memory, which may be brought back to an earlier moment: it is called outside, asks inside by
//! [`Sim::copied_out`], and keeps nothing that lies inside.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::rc::Rc;

use super::{Script, Sim};
use crate::coverage::FunctionLines;
use scene::Data;

/// Decides where code stops, and for how long.
pub trait Debugger {
    /// A script has loaded a text, which does not run yet. Its traps are not armed.
    fn text_loaded(&self, sim: &Rc<Sim>, script: &Rc<Script>, text: &Rc<LoadedText>);

    /// Code is about to run a line with an armed trap.
    fn line_reached(&self, sim: &Rc<Sim>, place: &Place<'_>);

    /// Code has raised an error that it does not catch, or that `is_caught`. The calls are those where it was raised.
    fn error_raised(&self, sim: &Rc<Sim>, script: &Rc<Script>, message: &str, is_caught: bool);

    /// A call of a script has perhaps changed the scene; without one, an iteration of the application's loop.
    fn scene_changed(&self, sim: &Rc<Sim>, script: Option<&Rc<Script>>);

    /// Nothing runs, or code runs that does not end, also code that the debugger has asked for; `script` is the one that does. Returns whether
    /// the code is to end with an error.
    fn answer_requests(&self, sim: &Rc<Sim>, script: Option<&Rc<Script>>) -> bool;
}

/// A text whose lines can have traps.
#[derive(Debug, Clone)]
pub struct LoadedText {
    /// Its name in the interpreter.
    pub chunk_name: Vec<u8>,
    /// The text, with bytes as it was loaded.
    pub text: Vec<u8>,
    /// The file it is from; None for a text of the scene.
    pub file: Option<PathBuf>,
    /// What people call it: the file, or the path of the script.
    pub title: String,
    /// The script whose own text it is; None for what scripts load.
    pub script: Option<i64>,
    /// The lines with code.
    pub lines: BTreeSet<u32>,
    /// The functions of the text.
    pub functions: Vec<FunctionLines>,
}

/// Where code is about to run a line.
pub struct Place<'a> {
    /// The script.
    pub script: &'a Rc<Script>,
    /// The text.
    pub text: &'a Rc<LoadedText>,
    /// The line, from 1.
    pub line: u32,
    /// The first line of the function; 0 for the main function of a text.
    pub function: u32,
    /// Whether the function took the place of its caller.
    pub is_tail_call: bool,
    /// Counts the functions below.
    pub(crate) level: &'a dyn Fn() -> Level,
}

impl Place<'_> {
    /// The coroutine, and how many functions run below this one in it: counted when it is asked for, since there may be many.
    pub fn level(&self) -> Level {
        (self.level)()
    }
}

/// A coroutine, and a number of functions that run in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Level {
    /// Identifies the coroutine of a script as long as it is alive.
    pub coroutine: usize,
    /// Functions that run below.
    pub below: i32,
}

/// Which traps of a text are armed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Armed {
    /// Those of all lines.
    All,
    /// Those of these lines.
    Lines(BTreeSet<u32>),
}

/// A running function: a coroutine of the script by its place among those that have resumed each other, and the functions below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameId {
    /// 0 is the main coroutine.
    pub coroutine: usize,
    /// Functions that run below it in its coroutine.
    pub below: i32,
}

/// A running function, as people see it.
#[derive(Debug, Clone)]
pub struct Frame {
    /// For questions about it.
    pub id: FrameId,
    /// Its name, as far as it is known.
    pub name: String,
    /// Its text; None where that is not one with traps.
    pub text: Option<Rc<LoadedText>>,
    /// The name of its text.
    pub chunk_name: Vec<u8>,
    /// The line it is at.
    pub line: u32,
}

/// Something with variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Container {
    /// Local variables of a function.
    Locals(FrameId),
    /// Variables of functions around a function.
    Upvalues(FrameId),
    /// Global variables.
    Globals,
    /// A value that was shown before.
    Value(u32),
}

/// Which variables of a container.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Page {
    /// Only items of a list, or only the others.
    pub kind: Option<PageKind>,
    /// So many are left out.
    pub start: usize,
    /// At most so many; 0 for all.
    pub count: usize,
}

/// The halves of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PageKind {
    /// Items of a list.
    Indexed,
    /// Everything else.
    Named,
}

/// A variable, as people see it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Variable {
    /// Its name, or the key in brackets.
    pub name: String,
    /// Its value.
    pub value: String,
    /// The type of the value.
    pub kind: &'static str,
    /// The number of the value where it has variables.
    pub contents: Option<u32>,
    /// The number of its items.
    pub indexed: usize,
    /// The number of its other variables.
    pub named: usize,
}

/// A script that can be looked into while everything stands still.
pub trait Debuggee {
    /// Arms and disarms traps.
    fn arm(&self, wanted: &dyn Fn(&LoadedText) -> Armed);

    /// The functions that run in the script, innermost first, up to `count`; those of its thread where it waits.
    fn frames(&self, count: usize) -> Vec<Frame>;

    /// Remembers the running coroutine, for [`remembered`](Self::remembered).
    fn remember(&self);

    /// The remembered coroutine and the number of functions that run in it, less one: -1 when it has ended.
    fn remembered(&self) -> Option<Level>;

    /// The variables of a container.
    fn variables(&self, of: Container, page: Page) -> Vec<Variable>;

    /// The value of an expression, or what statements return, where variables are those of the function. Without one they are global.
    ///
    /// # Errors
    /// The text of the error.
    fn evaluate(&self, frame: Option<FrameId>, code: &str) -> Result<Variable, String>;

    /// The same as plain data.
    ///
    /// # Errors
    /// The text of the error.
    fn evaluate_data(&self, frame: Option<FrameId>, code: &str) -> Result<Data, String>;

    /// Sets the variable of a container to the value of an expression, and returns it.
    ///
    /// # Errors
    /// When there is no such variable, or the text of the error.
    fn assign(
        &self,
        of: Container,
        name: &str,
        frame: Option<FrameId>,
        code: &str,
    ) -> Result<Variable, String>;

    /// Forgets the numbers of values.
    fn forget_values(&self);
}

impl Sim {
    /// Calls `notify` with the debugger, if there is one, in the memory of the program.
    pub(crate) fn notify_debugger(self: &Rc<Self>, notify: impl FnOnce(&Rc<dyn Debugger>)) {
        if let Some(debugger) = self.scripts.debugger.get() {
            heap::outside(|| notify(debugger));
        }
    }

    /// Whether code has traps: there is a debugger, or the run is captured, and one may come to its replays.
    pub(crate) fn has_traps(&self) -> bool {
        self.scripts.debugger.get().is_some() || self.options.permissions.tape().is_on()
    }

    /// What `work` computes in the memory of the simulator, copied out of it: for debuggers.
    pub fn copied_out<T: Clone>(self: &Rc<Self>, work: impl FnOnce(&Rc<Self>) -> T) -> T {
        heap::outside(|| heap::enter_and_copy(heap::Handle::of(&**self), || work(self)))
    }

    /// Does something in the midst of code, and undoes it: the memory of the simulator is what it was before. The tape gives nothing meanwhile.
    /// `work` keeps nothing of that memory.
    pub fn without_trace<T>(self: &Rc<Self>, work: impl FnOnce() -> T) -> T {
        let tape = self.options.permissions.tape();
        tape.suspend(true);
        let result = self.undone(work);
        tape.suspend(false);
        result
    }

    /// The same, with the tape as ever: what `work` reads from outside is a part of the run.
    pub fn undone<T>(self: &Rc<Self>, work: impl FnOnce() -> T) -> T {
        let moment = self.moment();
        let result = heap::outside(work);
        bring_back(moment.as_ref());
        result
    }

    /// The same again and again, each time from this moment, as long as `goes_on` says of the result; returns the last one.
    pub fn undone_while<T>(
        self: &Rc<Self>,
        mut work: impl FnMut() -> T,
        mut goes_on: impl FnMut(&T) -> bool,
    ) -> T {
        let moment = self.moment();
        loop {
            let result = heap::outside(&mut work);
            bring_back(moment.as_ref());
            if !heap::outside(|| goes_on(&result)) {
                return result;
            }
        }
    }

    fn moment(self: &Rc<Self>) -> Option<heap::Moment> {
        heap::Handle::of(&**self).map(heap::Handle::moment)
    }

    /// What is open that is no memory, by names for users.
    pub fn open_resources(&self) -> Vec<String> {
        let heap = heap::Handle::of(self);
        heap.map(heap::Handle::open_resources).unwrap_or_default()
    }

    /// Ends the code that runs, with errors, so that another moment can be brought back. What comes until then does not count.
    pub fn abandon(&self) {
        self.scripts.is_abandoned.set(true);
    }

    /// Whether what happens does not count any more.
    pub fn is_abandoned(&self) -> bool {
        self.scripts.is_abandoned.get()
    }

    /// All scripts that have been looked up, with names as in the log: objects first, then those that are none.
    pub fn named_scripts(&self) -> Vec<(Rc<Script>, String)> {
        let Ok(scene) = self.scene.try_borrow() else {
            return Vec::new();
        };
        let named = |script: Rc<Script>| {
            let name = script.log_name(&scene);
            (script, name)
        };
        self.scripts.all().into_iter().map(named).collect()
    }
}

/// The memory is what it was, if there is a heap: what was called since is over, and keeps nothing of it.
#[expect(unsafe_code, reason = "memory is brought back")]
fn bring_back(moment: Option<&heap::Moment>) {
    if let Some(moment) = moment {
        // SAFETY: the code inside has stood still on the stack below, and what was called is over; what it returned lies outside.
        unsafe { moment.bring_back() };
    }
}
