//! What a simulator is: its parts, its scripts and their environments, and the interface to languages.
//!
//! These types name each other: a simulator has scripts, a script its runtime, that an environment, and that the simulator. What happens
//! to them over time (callbacks, calls, files, steps) is the matter of the rooms above, whose methods of [`Sim`] stand there.

mod app;
mod broadcasts;
mod debugging;
mod env;
mod hints;
mod line_counts;
mod logging;
mod removals;
mod runtime;
mod scripts;
mod seed;
mod signal_owners;
mod sim;

pub use app::AppData;
pub use debugging::{
    Armed, Container, Debuggee, Debugger, Frame, FrameId, Level as CodeLevel, LoadedText, Page,
    PageKind, Place, Variable,
};
pub(crate) use env::level::Level;
pub use env::yields::{LevelChange, changed_level};
pub use env::{Env, Hook};
pub(crate) use removals::Removals;
pub(crate) use runtime::Integers;
pub use runtime::{
    CallError, CallbackResult, Callee, Interpreter, Language, Languages, Runtime, ScriptError,
    SourceText,
};
pub use scripts::order::ScriptGroup;
pub(crate) use scripts::script::state;
pub use scripts::script::{Detached, Script};
pub(crate) use scripts::set::{MAX_DEPTH, ScriptSet};
pub(crate) use scripts::source::log_suffix;
pub(crate) use signal_owners::SignalOwners;
pub use sim::Sim;
