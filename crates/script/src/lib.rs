//! The script host: lifecycle, order of calls, threads, values between scripts, the step loop; and scripts in Lua.
//!
//! The functions for scripts are in `crate::api`; this crate binds them and does not know which exist. Its rooms stand on floors
//! (docs/ARCHITECTURE.md): each uses only those below it.

#![cfg_attr(
    not(test),
    warn(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss
    )
)]

// The ground: what knows no simulator.
mod app_storage;
mod binding;
mod budget;
mod clock;
pub mod coverage;
mod error;
mod event_loop;
mod event_stream;
mod function_ref;
mod json;
pub mod log;
#[expect(unsafe_code, reason = "an edge to C")]
mod lua;
mod options;
mod random;
mod ros_options;
mod sys_call;
mod tape;
pub mod test_bench;
pub mod test_cases;
pub mod wall_clock;

// What a simulator is.
mod host;

// What happens to it.
mod calls;
mod events;
mod files;
mod lifecycle;
mod person;
pub mod phases;
mod plugins;
mod present;
mod property;
mod state_hash;
mod step;
mod video;

// What scripts see of it, and the languages they are written in.
mod cx;
mod lua_runtime;
mod python_runtime;

pub use binding::ApiFn;
pub use binding::args::{
    Absence, Args, Bytes, FromScript, Handles, InTurn, LuaNumber, LuaString, Number, ObjectRef,
    Rest, ScriptFunction, Table,
};
pub use binding::hooks::{Hooks, Host, ModuleHook};
pub use binding::literal::literal;
pub use binding::module::{Module, Outside};
pub use binding::operand::{Operand, arranged};
pub use binding::param::{DefaultValue, Param};
pub use binding::returns::{IntoScript, Nil, Results};
#[doc(hidden)]
pub use binding::sink::Sink;
pub use binding::source::{Source, Values};
pub use clock::SimulationState;
pub use cx::Cx;
pub use error::{ApiError, ApiResult};
pub use function_ref::FunctionRef;
pub use host::LevelChange;
pub use host::Script;
pub use json::data_of_json;
pub use log::console::{Console, LogLine, OutputStream, Silent};
pub use lua_runtime::coverage::executable;
pub use lua_runtime::syntax::{SyntaxError, syntax_error};
pub use options::{CacheFolder, Limits, Options};
pub use property::{
    Color, IntPair, Long, PoseArray, PropertyName, PropertyValue, Quaternion, Text, Vector2,
    Vector3,
};
pub use python_runtime::{EmbeddedScript, LaunchError, PythonHost, ScriptCalls, start_python};
pub use ros_options::RosOptions;
pub use state_hash::ChangedValue;
pub use sys_call::SysCall;
pub use tape::Taped;
pub use test_bench::TestBench;
pub use video::{VideoFailure, VideoOptions, VideoView};

pub use app_storage::StorageSection;
pub use binding::by_handle::ByHandle;
pub use binding::data::{push_buffer, read_buffer};
pub use binding::module::pairs;
pub use binding::needs_lua;
pub use binding::registry::{Member, Registry, member_by_rule};
pub use binding::states::States;
pub use calls::handler::{Handler, HeldFunction, ScriptCallback};
pub use event_stream::EventFilters;
pub use files::scene_save::readable_bytes;
pub use files::scene_switch::SceneSource;
pub use host::{
    Armed, CodeLevel, Container, Debuggee, Debugger, Frame, FrameId, LoadedText, Page, PageKind,
    Place, Variable,
};
pub use host::{
    CallError, CallbackResult, Callee, Interpreter, Language, Languages, Runtime, ScriptError, Sim,
    SourceText,
};
pub use host::{Detached, Env, Hook, ScriptGroup, changed_level};
pub use log::auxiliary_consoles::AuxiliaryConsole;
pub use log::suggestion::nearest;
pub use lua::{
    LuaObject, Stack, Type as LuaType, ask_running_code, calls_begun, interrupt_running_code,
    is_call, only_ask, place_is_exact, place_of_interruption,
};
pub use lua_runtime::reference_modules::ReferenceModule;
pub use lua_runtime::user_modules::UserModule;
pub use lua_runtime::{LuaLanguage, running_callback};
pub use person::Ask;
pub use present::{Present, Situation, Watcher};
pub use property::{OLD_SIGNALS, PropertyTarget, table as property_table};
pub use python_runtime::{
    PythonLanguage, is_short, python_command, python_interpreter, python_parts,
};
