//! The functions that run in a script.

use super::Debugged;
use crate::host::{Frame, FrameId};
use crate::lua::{Call, Stack, Type};

/// The global that holds the thread of a script.
const THREAD: &str = "__coroutine__";

/// The coroutine on which code of the script runs now, or would.
pub(super) fn innermost(main: Stack<'_>) -> Stack<'_> {
    let chain = main.resumed_coroutines();
    let mut alive = chain
        .iter()
        .rev()
        .filter(|coroutine| !coroutine.has_failed());
    *alive.next().unwrap_or(&main)
}

/// The coroutine with that place; the one behind the last is the thread of the script, which waits.
pub(super) fn coroutine(main: Stack<'_>, place: usize) -> Option<Stack<'_>> {
    let chain = main.resumed_coroutines();
    match chain.get(place) {
        Some(coroutine) => Some(*coroutine),
        None if place == chain.len() => waiting_thread(chain[chain.len() - 1]),
        None => None,
    }
}

/// The thread of the script, if it waits.
fn waiting_thread(stack: Stack<'_>) -> Option<Stack<'_>> {
    let thread = (stack.push_global(THREAD) == Type::Thread)
        .then(|| stack.coroutine_at(-1))
        .flatten();
    stack.pop(1);
    thread.filter(|thread| thread.is_suspended())
}

/// All functions, innermost first; those of the thread where nothing else runs.
pub(super) fn all(main: Stack<'_>, count: usize) -> Vec<Frame> {
    let Some(debugged) = Debugged::of(main) else {
        return Vec::new();
    };
    let chain = main.resumed_coroutines();
    let is_idle = chain.len() == 1 && main.depth() == 0;
    let chain: Vec<(usize, Stack<'_>)> = if is_idle {
        waiting_thread(main)
            .map(|thread| (1, thread))
            .into_iter()
            .collect()
    } else {
        chain.into_iter().enumerate().rev().collect()
    };
    let mut frames = Vec::new();
    for (place, coroutine) in chain {
        let calls = coroutine.calls(count - frames.len());
        frames.extend(
            calls
                .into_iter()
                .map(|(below, call)| frame(&debugged, place, below, call)),
        );
    }
    frames
}

fn frame(debugged: &Debugged, coroutine: usize, below: i32, call: Call) -> Frame {
    let text = debugged.text(&call.chunk);
    let in_text = text.as_ref().and_then(|text| {
        let functions = text.functions.iter();
        functions
            .filter(|function| function.line == call.defined)
            .find_map(|function| function.name.clone())
    });
    let name = match (call.defined, call.name.or(in_text)) {
        (0, _) => "(main)".into(),
        (_, Some(name)) => name,
        (line, None) => format!("function at line {line}"),
    };
    Frame {
        id: FrameId { coroutine, below },
        name,
        text,
        chunk_name: call.chunk,
        line: call.line,
    }
}
