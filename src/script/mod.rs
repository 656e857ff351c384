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
pub(crate) mod step;
pub mod test_bench;
pub(in crate::script) mod video;

pub use binding::ApiFn;
pub use binding::args::{
    Absence, Args, Bytes, FromScript, Handles, LuaNumber, LuaString, Number, ObjectRef, Rest, ScriptFunction, Table,
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
pub use log::console::{Console, LogLine, Silent, Stream};
pub use lua_runtime::coverage::executable;
pub use property::{Color, IntPair, Long, PoseArray, PropertyName, PropertyValue, Quaternion, Text, Vector2, Vector3};
pub use python_runtime::{EmbeddedScript, PythonHost, ScriptCalls};
pub use ros_options::RosOptions;
pub use runtime::FunctionRef;
pub use sim::{Limits, Options};
pub use step::clock::SimulationState;
pub use test_bench::TestBench;
pub use video::{VideoFailure, VideoOptions, VideoView};

pub(crate) use binding::by_handle::ByHandle;
pub(crate) use binding::data::{push_buffer, read_buffer};
pub(crate) use binding::module::pairs;
pub(crate) use binding::registry::{Member, Registry, member_by_rule};
pub(crate) use binding::states::States;
pub(crate) use binding::{functions, needs_lua};
#[cfg(test)]
pub(crate) use calls::handler::HeldFunction;
pub(crate) use calls::handler::{Handler, ScriptCallback};
pub(crate) use events::Filters;
pub(crate) use files::app_storage::Section;
pub(crate) use files::scene_save::readable_bytes;
pub(crate) use files::scene_switch::SceneSource;
pub(crate) use lifecycle::env::Env;
pub(crate) use lifecycle::env::Hook;
pub(crate) use lifecycle::instance::Detached;
pub(crate) use lifecycle::order::Group;
pub(crate) use lifecycle::yields::changed_level;
pub(crate) use log::auxiliary_consoles::AuxiliaryConsole;
pub(crate) use lua::{Object, Stack, Type as LuaType, calls_begun, interrupt_running_code, place_of_interruption};
pub(crate) use lua_runtime::LuaLanguage;
pub(crate) use lua_runtime::embedded::FILES;
pub(crate) use lua_runtime::reference_modules::ReferenceModule;
pub(crate) use lua_runtime::user_modules::UserModule;
pub(crate) use person::Ask;
pub(crate) use present::{Present, Situation, Watcher};
pub(crate) use property::{Target, table as property_table};
pub(crate) use python_runtime::{PythonLanguage, is_short, python_interpreter, python_parts};
pub(crate) use runtime::Languages;
pub(crate) use runtime::{CallError, CallbackResult, Callee, Interpreter, Language, Runtime, ScriptError, SourceText};
pub(crate) use sim::Sim;
