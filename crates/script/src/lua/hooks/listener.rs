//! What a debugger is notified of: errors where they are raised, and that it may act in the middle of code that does not end.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use super::interrupt::only_ask;
use crate::lua::calls::entry::{Exit, push_function};
use crate::lua::calls::guard::{Next, guarded, install_with};
use crate::lua::{Stack, Type};

/// Who is notified, the same in every state of the process.
#[derive(Clone, Copy)]
pub(crate) struct Listener {
    /// An error was raised, whose text is on top.
    pub on_error: fn(Stack<'_>, Catcher),
    /// Code runs, and somebody has asked; whether the code is to end with an error.
    pub on_question: fn(Stack<'_>) -> bool,
}

/// Who catches an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Catcher {
    /// The host, which has called the code.
    Host,
    /// `pcall`.
    Protected,
    /// `coroutine.resume`: the code of the coroutine can still be looked at.
    Resume,
}

static LISTENER: OnceLock<Listener> = OnceLock::new();
/// The debugger has a request for the code that runs.
static IS_ASKED: AtomicBool = AtomicBool::new(false);

/// From now on that listener is notified, by all states of the process.
pub(crate) fn listen(listener: Listener) {
    LISTENER.get_or_init(|| listener);
}

/// Makes `pcall` of this state report errors before it catches them.
pub(crate) fn report_caught_errors(stack: Stack<'_>) {
    stack.push_globals();
    install_with::<{ guarded::PCALL }, _>(stack, "pcall", "xpcall", |stack| {
        if stack.top() == 0 {
            return Next::Refuse(c"value expected");
        }
        push_function(stack, None, |stack| {
            of_error(stack, Catcher::Protected);
            Exit::Results(1)
        });
        stack.insert(2);
        Next::Original
    });
    stack.pop(1);
}

/// The next hook notifies the listener; who calls this sends the signal that lets one come, if code runs.
pub fn ask_running_code() {
    IS_ASKED.store(true, Ordering::Release);
    only_ask();
}

/// An error was raised, and is on top.
pub(in crate::lua) fn of_error(stack: Stack<'_>, catcher: Catcher) {
    if let Some(listener) = LISTENER.get()
        && stack.kind(-1) != Type::None
    {
        (listener.on_error)(stack, catcher);
    }
}

/// A hook has come; whether the code is to end with an error.
pub(super) fn of_question(stack: Stack<'_>) -> bool {
    match LISTENER.get() {
        Some(listener) if IS_ASKED.swap(false, Ordering::Acquire) => (listener.on_question)(stack),
        _ => false,
    }
}
