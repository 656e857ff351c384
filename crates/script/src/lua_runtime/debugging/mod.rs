//! Debugging of one Lua state: texts with traps, and what can be seen and changed while code stands still.
//!
//! When a text is loaded, traps are added to its bytecode (`lua::bytecode::traps`). Armed ones call the debugger of the simulator.

mod evaluate;
mod frames;
mod values;

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::ffi::{CStr, c_int};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::LuaInterpreter;
use super::coverage::executable;
use super::startup::load_module;
use crate::coverage::read_text;
use crate::host::{
    Armed, CodeLevel, Container, Debuggee, Env, Frame, FrameId, LoadedText, Page, Place, Sim,
    Variable,
};
use crate::lua::{
    self, Catcher, Listener, LiveCode, LuaError, Outcome, Stack, Type, push_callback, push_plain,
};
use scene::Data;
use scene::object::script_object::ScriptType;

/// Most functions with traps that a state loads: Lua code can load as many as it likes.
const MAX_TEXTS: usize = 1000;
/// The error of code that runs while a debugger goes to another moment.
const ABANDONED: &str = "the debugger goes to another moment.";
/// Registry key of the table whose change calls the debugger.
const TRAPS: &CStr = c"swanilda.debugger";
/// Registry key of the coroutine that steps begin in.
const REMEMBERED: &CStr = c"swanilda.debugger.coroutine";

/// What a debugger knows of a state; application data of that state.
#[derive(Default)]
struct Debugged {
    texts: RefCell<Vec<(Rc<LoadedText>, LiveCode)>>,
    /// The name and the text of the file that is loaded next, where files are read from a tape.
    next_file: RefCell<Option<(PathBuf, Vec<u8>)>>,
    /// An expression is evaluated, in that function if there is one: nothing stops.
    is_evaluating: Cell<bool>,
    frame: Cell<Option<FrameId>>,
}

impl Debugged {
    fn of(stack: Stack<'_>) -> Option<Rc<Self>> {
        stack
            .lua()
            .app_data_ref::<Rc<Self>>()
            .map(|debugged| Rc::clone(&debugged))
    }

    fn text(&self, chunk_name: &[u8]) -> Option<Rc<LoadedText>> {
        let texts = self.texts.borrow();
        let found = texts
            .iter()
            .rev()
            .find(|(text, _)| text.chunk_name == chunk_name);
        found.map(|(text, _)| Rc::clone(text))
    }
}

/// Adds traps to every text that a state loads from now on.
pub(super) fn install(sim: &Sim, stack: Stack<'_>) -> Result<(), LuaError> {
    lua::listen(Listener {
        on_error: error_raised,
        on_question: asked,
    });
    stack.lua().set_app_data(Rc::<Debugged>::default());
    stack.new_table(0, 0);
    stack.new_table(0, 1);
    push_plain(stack, reached);
    stack.raw_set_field(-2, "__newindex");
    stack.set_metatable(-2);
    stack.set_registry(TRAPS);
    // What steps remember takes no memory of its own then.
    stack.push_bool(false);
    stack.set_registry(REMEMBERED);
    load_module(stack, sim, "loaders")?;
    push_callback(stack, loaded, 0);
    stack.push_bytes(b"(debugger)");
    stack.push_registry(TRAPS);
    stack.protected_call(3, 0)
}

/// Notes the text of a file that is loaded next: there may be no such file in a replay.
pub(super) fn note_file(stack: Stack<'_>, name: &[u8], text: &[u8]) {
    if let Some(debugged) = Debugged::of(stack) {
        let name = PathBuf::from(&*String::from_utf8_lossy(name));
        debugged.next_file.replace(Some((name, text.to_vec())));
    }
}

pub(super) fn is_installed(stack: Stack<'_>) -> bool {
    Debugged::of(stack).is_some()
}

/// Adds traps to the script's own text, whose function is on top of the stack.
pub(super) fn begin(stack: Stack<'_>, text: &[u8]) {
    if let Some(debugged) = Debugged::of(stack) {
        debugged.add(stack, Some(text));
    }
}

/// Adds traps to a function that the script has loaded.
fn loaded(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    stack.set_top(1);
    if let Some(debugged) = Debugged::of(stack) {
        debugged.add(stack, None);
    }
    Ok(1)
}

impl Debugged {
    /// Adds traps to the function on top, which was just compiled from that text, or from a file by its name, or from the text that is its name.
    fn add(&self, stack: Stack<'_>, own: Option<&[u8]>) {
        let full = self.is_evaluating.get() || self.texts.borrow().len() >= MAX_TEXTS;
        let (Some(chunk_name), Some(sim), false) = (
            stack.chunk_name_of_function(),
            stack.env().sim.upgrade(),
            full,
        ) else {
            return;
        };
        let file = self.next_file.take();
        let Some(text) = read(&sim, stack.env(), chunk_name, own, file) else {
            return;
        };
        if let Some(code) = with_traps(stack, &text.lines) {
            let text = Rc::new(text);
            self.texts.borrow_mut().push((Rc::clone(&text), code));
            let script = &stack.env().script;
            sim.notify_debugger(|debugger| debugger.text_loaded(&sim, script, &text));
        }
    }
}

/// Replaces the function on top by the same with traps.
fn with_traps(stack: Stack<'_>, lines: &BTreeSet<u32>) -> Option<LiveCode> {
    stack.push_value(-1);
    let (instrumented, traps) = stack.dump()?.with_traps(lines)?;
    stack.push_registry(TRAPS);
    stack.replace_function(&instrumented);
    stack.keep_code(traps)
}

/// A text with that name, as people see it; None where it cannot be found.
fn read(
    sim: &Sim,
    env: &Env,
    chunk_name: Vec<u8>,
    own: Option<&[u8]>,
    next_file: Option<(PathBuf, Vec<u8>)>,
) -> Option<LoadedText> {
    let named = chunk_name
        .strip_prefix(b"@")
        .map(|name| PathBuf::from(&*String::from_utf8_lossy(name)));
    let of_script = || {
        let files = sim.log.files.borrow();
        let name = String::from_utf8_lossy(&chunk_name);
        files.file_of(&name).map(PathBuf::from)
    };
    let (text, file) = match own {
        Some(text) => (text.to_vec(), named.or_else(of_script)),
        None => match named {
            Some(file) => match next_file.filter(|(name, _)| *name == file) {
                Some((_, text)) => (text, Some(file)),
                None if sim.options.permissions.tape().is_on() => return None,
                None => (read_text(&file)?, Some(file)),
            },
            // Without a name, the text is the name.
            None => (chunk_name.clone(), None),
        },
    };
    // What the simulator has added itself is nothing to look at.
    let has_object = !matches!(
        env.script.script_type,
        ScriptType::Main | ScriptType::Sandbox | ScriptType::AddOn
    );
    if own.is_some() && file.is_none() && !has_object {
        return None;
    }
    let functions = executable(&text)?;
    let title = match &file {
        Some(file) => file.display().to_string(),
        None if own.is_some() => sim.path_of_script(&env.script).unwrap_or_default(),
        None => "load".into(),
    };
    Some(LoadedText {
        chunk_name,
        lines: functions
            .iter()
            .flat_map(|function| function.lines.iter().copied())
            .collect(),
        text,
        file: file.as_deref().map(absolute),
        title,
        script: own.map(|_| env.script.id),
        functions,
    })
}

fn absolute(file: &Path) -> PathBuf {
    std::path::absolute(file).unwrap_or_else(|_| file.to_owned())
}

/// `__newindex` of the table that armed traps write to.
fn reached(stack: Stack<'_>) -> Outcome {
    if let Some(debugged) = Debugged::of(stack)
        && !debugged.is_evaluating.get()
        && let Some(sim) = stack.env().sim.upgrade()
        && let Some((at, call)) = stack.call_at(1)
        && let Some(text) = debugged.text(&call.chunk)
    {
        let place = Place {
            script: &stack.env().script,
            text: &text,
            line: call.line,
            function: call.defined,
            is_tail_call: call.is_tail_call,
            level: &|| CodeLevel {
                coroutine: stack.address(),
                below: stack.depth() - 1 - at,
            },
        };
        sim.notify_debugger(|debugger| debugger.line_reached(&sim, &place));
        if sim.is_abandoned() {
            return Outcome::Raise(ABANDONED.to_owned());
        }
    }
    Outcome::Results(0)
}

/// An error is on top.
fn error_raised(stack: Stack<'_>, catcher: Catcher) {
    let watched = Debugged::of(stack).filter(|debugged| !debugged.is_evaluating.get());
    let (Some(debugged), Some(sim)) = (watched, stack.env().sim.upgrade()) else {
        return;
    };
    let is_caught = match catcher {
        Catcher::Host => false,
        // What the library catches is its own affair.
        Catcher::Protected if !is_called_by_script(&debugged, stack) => return,
        Catcher::Protected => true,
        // The library resumes the thread of a script, and passes its errors on.
        Catcher::Resume => is_called_by_script(&debugged, stack),
    };
    let message = match stack.text(-1) {
        Some(text) => String::from_utf8_lossy(&text).into_owned(),
        None => "an error that is no text".into(),
    };
    let script = &stack.env().script;
    sim.notify_debugger(|debugger| debugger.error_raised(&sim, script, &message, is_caught));
}

/// Whether the innermost code is that of a text with traps.
fn is_called_by_script(debugged: &Debugged, stack: Stack<'_>) -> bool {
    stack
        .call_at(0)
        .is_some_and(|(_, call)| debugged.text(&call.chunk).is_some())
}

/// Somebody wants to look at the code that runs; whether it is to end with an error.
fn asked(stack: Stack<'_>) -> bool {
    let debugger = |sim: Rc<Sim>| {
        let debugger = sim.scripts.debugger.get()?;
        let script = &stack.env().script;
        let is_to_end = heap::outside(|| debugger.answer_requests(&sim, Some(script)));
        Some(is_to_end || sim.is_abandoned())
    };
    let is_to_end = stack.env().sim.upgrade().and_then(debugger);
    is_to_end.unwrap_or(false)
}

impl Debuggee for LuaInterpreter {
    fn arm(&self, wanted: &dyn Fn(&LoadedText) -> Armed) {
        let Some(debugged) = Debugged::of(self.stack()) else {
            return;
        };
        for (text, code) in debugged.texts.borrow().iter() {
            match wanted(text) {
                Armed::All => code.arm(&|_| true),
                Armed::Lines(lines) => code.arm(&|line| lines.contains(&line)),
            }
        }
    }

    fn frames(&self, count: usize) -> Vec<Frame> {
        frames::all(self.stack(), count)
    }

    fn remember(&self) {
        let running = frames::innermost(self.stack());
        running.push_running_coroutine();
        running.set_registry(REMEMBERED);
    }

    fn remembered(&self) -> Option<CodeLevel> {
        self.on_stack(|stack| {
            stack.push_registry(REMEMBERED);
            let coroutine = stack.coroutine_at(-1).filter(|found| !found.has_failed())?;
            Some(CodeLevel {
                coroutine: coroutine.address(),
                below: coroutine.depth() - 1,
            })
        })
    }

    fn variables(&self, of: Container, page: Page) -> Vec<Variable> {
        let stack = frames::innermost(self.stack());
        let top = stack.top();
        let found = values::variables(stack, self.stack(), of, page);
        stack.set_top(top);
        found
    }

    fn evaluate(&self, frame: Option<FrameId>, code: &str) -> Result<Variable, String> {
        evaluate::with_value(self.stack(), frame, code, |stack| {
            Ok(values::describe(stack, -1, String::new()))
        })
    }

    fn evaluate_data(&self, frame: Option<FrameId>, code: &str) -> Result<Data, String> {
        evaluate::with_value(self.stack(), frame, code, |stack| {
            super::data::read_data(stack, -1).map_err(|error| error.to_string())
        })
    }

    fn assign(
        &self,
        of: Container,
        name: &str,
        frame: Option<FrameId>,
        code: &str,
    ) -> Result<Variable, String> {
        let main = self.stack();
        evaluate::with_value(main, frame, code, |stack| {
            let shown = values::describe(stack, -1, name.to_owned());
            values::assign(stack, main, of, name)?;
            Ok(shown)
        })
    }

    fn forget_values(&self) {
        values::forget(self.stack());
    }
}

/// The kind of what is at an index, as people see it.
fn kind_name(kind: Type) -> &'static str {
    match kind {
        Type::None | Type::Nil => "nil",
        Type::Boolean => "boolean",
        Type::Number => "number",
        Type::String => "string",
        Type::Table => "table",
        Type::Function => "function",
        Type::UserData | Type::LightUserData => "userdata",
        Type::Thread => "thread",
    }
}
