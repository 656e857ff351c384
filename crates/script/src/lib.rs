//! The script host: lifecycle, order of calls, threads, values between scripts, the step loop; and scripts in Lua.
//!
//! The functions for scripts are in `crate::api`; this module binds them and does not know which exist.

mod binding;
mod calls;
pub mod coverage;
mod error;
mod event_loop;
mod events;
pub(crate) mod files;
mod lifecycle;
pub mod log;
#[expect(unsafe_code, reason = "an edge to C")]
mod lua;
mod lua_runtime;
mod person;
mod plugins;
mod present;
mod property;
mod python_runtime;
mod ros_options;
mod runtime;
mod sim;
pub mod step;
pub mod test_bench;
pub(crate) mod video;

pub use binding::ApiFn;
pub use binding::args::{
    Absence, Args, Bytes, FromScript, Handles, LuaNumber, LuaString, Number, ObjectRef, Rest,
    ScriptFunction, Table,
};
pub use binding::cx::Cx;
pub use binding::hooks::{Hooks, Host, ModuleHook};
pub use binding::module::Module;
pub use binding::param::{DefaultValue, Param};
pub use binding::returns::{IntoScript, Nil, Results};
#[doc(hidden)]
pub use binding::sink::Sink;
pub use binding::source::{Source, Values};
pub use calls::callback::SysCall;
pub use error::{ApiError, ApiResult};
pub use lifecycle::instance::Script;
pub use lifecycle::yields::LevelChange;
pub use log::console::{Console, LogLine, OutputStream, Silent};
pub use lua_runtime::coverage::executable;
pub use property::{
    Color, IntPair, Long, PoseArray, PropertyName, PropertyValue, Quaternion, Text, Vector2,
    Vector3,
};
pub use python_runtime::{EmbeddedScript, PythonHost, ScriptCalls};
pub use ros_options::RosOptions;
pub use runtime::FunctionRef;
pub use sim::{Limits, Options};
pub use step::clock::SimulationState;
pub use test_bench::TestBench;
pub use video::{VideoFailure, VideoOptions, VideoView};

pub use binding::by_handle::ByHandle;
pub use binding::data::{push_buffer, read_buffer};
pub use binding::module::pairs;
pub use binding::needs_lua;
pub use binding::registry::{Member, Registry, member_by_rule};
pub use binding::states::States;
pub use calls::handler::{Handler, HeldFunction, ScriptCallback};
pub use events::EventFilters;
pub use files::app_storage::StorageSection;
pub use files::scene_save::readable_bytes;
pub use files::scene_switch::SceneSource;
pub use lifecycle::env::Env;
pub use lifecycle::env::Hook;
pub use lifecycle::instance::Detached;
pub use lifecycle::order::ScriptGroup;
pub use lifecycle::yields::changed_level;
pub use log::auxiliary_consoles::AuxiliaryConsole;
pub use lua::{
    LuaObject, Stack, Type as LuaType, calls_begun, interrupt_running_code, place_of_interruption,
};
pub use lua_runtime::LuaLanguage;
pub use lua_runtime::reference_modules::ReferenceModule;
pub use lua_runtime::user_modules::UserModule;
pub use person::Ask;
pub use present::{Present, Situation, Watcher};
pub use property::{PropertyTarget, table as property_table};
pub use python_runtime::{PythonLanguage, is_short, python_interpreter, python_parts};
pub use runtime::Languages;
pub use runtime::{
    CallError, CallbackResult, Callee, Interpreter, Language, Runtime, ScriptError, SourceText,
};
pub use sim::Sim;
