//! A guard of `coroutine.resume`: it notes which coroutine runs, and reports errors that are dropped, since `coroutine.resume(co)` as a
//! statement drops them.

use super::listener::{self, Catcher};
use super::running::enter_coroutine;
use crate::lua::calls::guard::{Next, guarded, install};
use crate::lua::{Stack, Type};

/// What is reported of such an error: its message.
pub(crate) type OnDropped = fn(Stack<'_>, &str);

/// Who is notified, the same in every state of the process.
static ON_DROPPED: std::sync::OnceLock<OnDropped> = std::sync::OnceLock::new();

/// Makes `coroutine.resume` report errors to statements that drop them.
pub(crate) fn report_dropped_errors(stack: Stack<'_>, on_dropped: OnDropped) {
    ON_DROPPED.get_or_init(|| on_dropped);
    stack.push_global("coroutine");
    install::<{ guarded::COROUTINE_RESUME }, _>(stack, "resume", |stack| {
        match stack.coroutine(stack.slot(1)) {
            Some(coroutine) => {
                enter_coroutine(coroutine);
                Next::OriginalThen(look_at_results)
            }
            // An argument of another type is Lua's error.
            None => Next::Original,
        }
    });
    stack.pop(1);
}

/// Below the top are whether it went well, and the coroutine; nothing else is left of the arguments of a call that failed.
fn look_at_results(stack: Stack<'_>) {
    enter_coroutine(stack);
    let failed = stack.top() >= 2 && stack.kind(-2) == Type::Boolean && !stack.truthy(-2);
    if failed {
        listener::of_error(stack, Catcher::Resume);
    }
    if !failed || !stack.caller_drops_results_of("resume") {
        return;
    }
    let message = match stack.text(-1) {
        Some(text) => String::from_utf8_lossy(&text).into_owned(),
        None => "an error that is no text".to_owned(),
    };
    // Whether the coroutine was dead before is no news.
    let is_refusal = message.starts_with("cannot resume ");
    if let Some(report) = ON_DROPPED.get().filter(|_| !is_refusal) {
        report(stack, &message);
    }
}
