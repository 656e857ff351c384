//! The script host: Lua states, lifecycle, order of calls, threads, values between states, the step loop.
//!
//! What scripts can call stands in `crate::api`; this module knows how functions are bound, not which there are.

mod app_storage;
mod args;
mod attached;
mod auxiliary_consoles;
mod binding;
mod by_handle;
mod callback;
mod calls;
pub(crate) mod cbor;
mod clock;
mod console;
pub mod coverage;
mod cx;
mod data;
mod data_changes;
mod dispatch;
mod dynamics_step;
mod embedded;
mod env;
mod error;
mod events;
pub(crate) mod file_lock;
mod handler;
mod instance;
mod joint_motion;
mod lifecycle;
mod lookup;
mod lua;
mod old_calls;
mod order;
mod property;
mod random;
mod removal;
mod returns;
mod scene_save;
mod scene_switch;
mod shared_process;
mod sim;
mod startup;
mod step;
mod system_semaphore;
pub mod test_bench;
mod threads;
mod tubes;
pub mod verbosity;
mod waiting;
pub(crate) mod wall_clock;
mod web_socket_log;
pub(crate) mod web_sockets;

pub use args::{
    Args, Bytes, FromScript, Handles, KeptFunction, LuaNumber, LuaString, Number, ObjectRef, Rest, ScriptFunction,
    Table,
};
pub use binding::{ApiFn, Param};
pub use callback::SysCall;
pub use clock::SimulationState;
pub use console::{Console, LogLine, Silent, Stream};
pub use cx::Cx;
pub use error::{ApiError, ApiResult};
pub use instance::Script;
pub use property::{Color, IntPair, Long, PoseArray, PropertyName, PropertyValue, Quaternion, Text, Vector2, Vector3};
pub use returns::{IntoScript, Nil, Results};
pub use sim::{Limits, Options};
pub use test_bench::TestBench;
pub use threads::LevelChange;

pub(crate) use app_storage::Section;
pub(crate) use auxiliary_consoles::AuxiliaryConsole;
pub(crate) use binding::{Bound, Member, Registry};
pub(crate) use by_handle::ByHandle;
pub(crate) use embedded::{Embedded, FILES};
pub(crate) use env::Hook;
pub(crate) use events::Filters;
pub(crate) use handler::Handler;
pub(crate) use instance::Detached;
pub(crate) use lua::{Object, Stack};
pub(crate) use order::Group;
pub(crate) use property::{Target, table as property_table};
pub(crate) use scene_save::write_named;
pub(crate) use scene_switch::SceneSource;
pub(crate) use sim::Sim;
pub(crate) use threads::{auto_level, changed_level, set_auto_level, use_up_slice};

/// Compiles Lua text to bytecode.
pub(crate) fn compile(code: &[u8], chunk_name: &str) -> Result<Vec<u8>, String> {
    let state = lua::State::new(std::ptr::null(), std::rc::Rc::default());
    let stack = state.stack();
    stack.load(code, chunk_name, false).map_err(|error| error.text)?;
    Ok(stack.dump())
}
