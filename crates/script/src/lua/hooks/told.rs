//! What a debugger is told of: errors where they are raised, and that it may look in the middle of code that does not end.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use super::interrupt::only_ask;
use crate::lua::Stack;

/// Who is told, the same in every state of the process.
#[derive(Clone, Copy)]
pub(crate) struct Listener {
    /// An error was raised, whose text is on top; code of the script does not catch it.
    pub on_error: fn(Stack<'_>),
    /// Code runs, and somebody has asked.
    pub on_question: fn(Stack<'_>),
}

static LISTENER: OnceLock<Listener> = OnceLock::new();
/// Somebody wants to look at the code that runs.
static IS_ASKED: AtomicBool = AtomicBool::new(false);

/// From now on that listener is told, of all states of the process.
pub(crate) fn listen(on_error: fn(Stack<'_>), on_question: fn(Stack<'_>)) {
    LISTENER.get_or_init(|| Listener {
        on_error,
        on_question,
    });
}

/// The next hook tells the listener; who calls this sends the signal that lets one come, if code runs.
pub fn ask_running_code() {
    IS_ASKED.store(true, Ordering::Release);
    only_ask();
}

/// An error was raised, and is on top.
pub(in crate::lua) fn of_error(stack: Stack<'_>) {
    if let Some(listener) = LISTENER.get() {
        (listener.on_error)(stack);
    }
}

/// A hook has come.
pub(super) fn of_question(stack: Stack<'_>) {
    if let Some(listener) = LISTENER.get()
        && IS_ASKED.swap(false, Ordering::Acquire)
    {
        (listener.on_question)(stack);
    }
}
