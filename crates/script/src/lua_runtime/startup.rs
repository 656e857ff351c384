//! Initialisation of a fresh Lua state: library, `sim`, package path (spec: scripts 9).

use std::ffi::c_int;
use std::path::Path;
use std::rc::Rc;

use mlua::{Function, Lua, Table};

use super::functions::push_function;
use super::members::{SIM, install_globals, install_sim, push_missing};
use super::reference_modules::ReferenceModule;
use super::user_modules::UserModule;
use super::{
    buffers, coverage, debugging, implicit, library_globals, shared_process, stand_ins, taped,
    test_file, threads, user_modules,
};
use crate::binding::registry::{Member, Namespace};
use crate::host::{Script, Sim};
use crate::log::verbosity;
use crate::lua::{self, LuaError, Stack, State, Type, push_callback, push_plain, seeded};

/// Makes a state ready for a script's text.
pub(super) fn fill(
    sim: &Rc<Sim>,
    state: &State,
    user_modules: &[UserModule],
) -> Result<(), LuaError> {
    let stack = state.stack();
    threads::install(stack);
    lua::install_coroutine_hooks(stack, threads::on_count);
    lua::report_dropped_errors(stack, |stack, error| {
        let warning = format!(
            "an error ended a coroutine, and the script does not look at what coroutine.resume returns: {error}"
        );
        stack.env().log(verbosity::SCRIPT_WARNINGS, &warning);
    });
    lua::restrict_debug(stack);
    if sim.has_traps() {
        // Before the library puts a function of its own in front of it.
        lua::report_caught_errors(stack);
    }
    lua::report_closed_pipes(stack, |stack| {
        if let Some(sim) = stack.env().simulator() {
            sim.log.pipe_closed();
        }
    });
    let is_restricted = !sim.options.permissions.is_all();
    let is_taped = stack.tape().is_on();
    if is_taped {
        taped::prepare(stack);
    }
    if is_restricted {
        lua::restrict_libraries(stack);
    } else if is_taped {
        lua::search_by_permissions(stack);
    }
    library_globals::install(stack);
    user_modules::install(user_modules, sim, stack)?;
    install_package(sim, stack);
    install_globals(sim, stack);
    install_sim(stack);
    seed_random(state.lua(), sim.scripts.seed.get())?;
    stack.push_int(stack.env().script.id);
    stack.set_global("sim_script_handle");
    stack.push_int(name_suffix(sim, &stack.env().script));
    stack.set_global("sim_script_name_index");
    run_base(sim, stack)?;
    if is_taped {
        load_module(stack, sim, "captured")?;
        taped::push_functions(stack);
        stack.protected_call(1, 0)?;
    }
    if is_restricted || is_taped {
        load_module(stack, sim, "restricted")?;
        stack.push_bool(sim.options.permissions.can_load_native());
        stack.protected_call(1, 0)?;
    }
    if sim.options.count_lines {
        coverage::install(sim, stack)?;
    }
    if sim.has_traps() {
        debugging::install(sim, stack)?;
    }
    if sim.options.limits.is_some() {
        shared_process::install(sim, stack)?;
    }
    library_globals::take(sim, stack);
    Ok(())
}

/// Defines what scripts find beside Lua's own functions.
fn run_base(sim: &Sim, stack: Stack<'_>) -> Result<(), LuaError> {
    load_module(stack, sim, "base")?;
    buffers::install(stack);
    implicit::install(stack);
    push_plain(stack, stand_ins::begin_thread);
    push_plain(stack, implicit::remove_proxies);
    implicit::push_proxies(stack);
    stack.protected_call(3, 1)?;
    stand_ins::set_caller(stack);
    stand_ins::install(stack);
    Ok(())
}

/// The number in the old name of a script's object; -1 without one.
fn name_suffix(sim: &Sim, script: &Script) -> i64 {
    let scene = sim.scene.borrow();
    let object = script
        .owner()
        .or(script.object)
        .and_then(|handle| scene.object(handle).ok());
    object.map_or(-1, |object| scene::name_suffix(object.old_name()).0)
}

/// `math.random` starts from the simulator's seed: Lua's own start is different in every state. From seeds that follow each other its generator
/// begins with numbers that do as well, so the seed is scrambled first (the finalizer of SplitMix64).
pub(super) fn seed_random(lua: &Lua, seed: u32) -> mlua::Result<()> {
    let math: Table = lua.globals().get("math")?;
    math.get::<Function>("randomseed")?.call(scrambled(seed))
}

/// The state of these random numbers at their beginning.
pub(super) fn random_of(seed: u32) -> [u64; 4] {
    seeded(scrambled(seed))
}

fn scrambled(seed: u32) -> i64 {
    let mut bits = u64::from(seed).wrapping_add(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (bits ^ (bits >> 31)).cast_signed()
}

/// Modules that CoppeliaSim has not, or no longer, and files that are no modules: a script's own file of that name goes first.
const LAST: &[&str] = &[
    "base",
    "captured",
    "cbor",
    "class",
    "deprecate",
    "json",
    "main",
    "no_exit",
    "old_calls",
    "restricted",
    "say",
    "seal",
];

/// Helpers with names that a scene's own modules may have: a file in the scene's folders goes first, one of an installation does not.
const HELPERS: &[&str] = &[
    "Buffer",
    "base16",
    "checkargs",
    "checkmodel",
    "deque",
    "functional",
    "gcode",
    "grid",
    "itertools",
    "lfsx",
    "logger",
    "mathx",
    "matrix",
    "matrix-utils",
    "priorityqueue",
    "stringx",
    "tablex",
    "utils",
    "uuid",
    "var",
];

/// Puts the scene's folders first into `package.path` and `package.cpath`, and the embedded library into `package.searchers`.
fn install_package(sim: &Sim, stack: Stack<'_>) {
    stack.push_global("package");
    install_paths(sim, stack);
    install_searchers(stack);
    stack.pop(1);
}

/// The file extension of native libraries.
const LIBRARY_EXTENSION: &str = if cfg!(windows) { "dll" } else { "so" };

/// Where the modules of an installation of CoppeliaSim are. They go before the scene's own, as there.
fn installed_paths(resources: &Path) -> String {
    let resources = resources.display();
    let folders = [
        "",
        "lua/",
        "lua/models/deprecated/",
        "lua/deprecated/",
        "bwf/",
    ];
    folders
        .map(|folder| format!("{resources}/{folder}?.lua;{resources}/{folder}?/init.lua;"))
        .concat()
}

/// Files in the scene's folders go before those of Lua's own default. The table `package` is on top.
fn install_paths(sim: &Sim, stack: Stack<'_>) {
    let mut path = sim
        .options
        .resources
        .as_deref()
        .map(installed_paths)
        .unwrap_or_default();
    let mut cpath = String::new();
    for dir in &sim.options.package_dirs {
        let dir = dir.display();
        path.push_str(&format!("{dir}/?.lua;{dir}/?/init.lua;"));
        cpath.push_str(&format!("{dir}/?.{LIBRARY_EXTENSION};"));
    }
    for (field, first) in [("path", path), ("cpath", cpath)] {
        stack.raw_get_field(-1, field);
        let default = stack.text(-1).unwrap_or_default();
        stack.pop(1);
        stack.push_bytes(&[first.as_bytes(), &default].concat());
        stack.raw_set_field(-2, field);
    }
}

/// The table `package` is on top. Its first searcher, that of `package.preload`, stays the first.
fn install_searchers(stack: Stack<'_>) {
    stack.raw_get_field(-1, "searchers");
    let last = numbers::count(stack.raw_len(-1));
    for i in (2..=last).rev() {
        stack.raw_get_index(-1, i);
        stack.raw_set_index(-2, i + 1);
    }
    push_callback(stack, search_embedded, 0);
    stack.raw_set_index(-2, 2);
    push_callback(stack, search_last, 0);
    stack.raw_set_index(-2, last + 2);
    stack.pop(1);
}

/// Finds the modules that come with the simulator and go before a script's own files.
fn search_embedded(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let name = String::from_utf8_lossy(&stack.text(1).unwrap_or_default()).into_owned();
    if LAST.contains(&&*name) || HELPERS.contains(&&*name) && is_the_scene_s(stack, &name) {
        return Ok(0);
    }
    if name == "sim" || name == "sim-1" {
        push_callback(stack, return_sim, 0);
        return Ok(1);
    }
    find_module(stack, &name)
}

/// Whether the folders that scripts bring along have a module of that name.
fn is_the_scene_s(stack: Stack<'_>, name: &str) -> bool {
    let Some(sim) = stack.env().sim.upgrade() else {
        return false;
    };
    let has = |folder: &Path| {
        let permissions = &sim.options.permissions;
        permissions.exists(&folder.join(name).with_extension("lua"))
            || permissions.exists(&folder.join(name).join("init.lua"))
    };
    sim.options.package_dirs.iter().any(|folder| has(folder))
}

/// Finds the others. The error for a module of CoppeliaSim that was not found says that it is missing, without the searched places,
/// unless the original text is wanted.
fn search_last(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let name = String::from_utf8_lossy(&stack.text(1).unwrap_or_default()).into_owned();
    if LAST.contains(&&*name) {
        return find_module(stack, &name);
    }
    let wants_original = stack
        .env()
        .sim
        .upgrade()
        .is_some_and(|sim| sim.options.original_errors);
    match ReferenceModule::all().find(|module| module.name == name) {
        Some(module) if !wants_original => Err(module.missing()),
        _ => Ok(0),
    }
}

/// Pushes the loader of a module, and the native functions for its file; or why there is none.
fn find_module(stack: Stack<'_>, name: &str) -> Result<c_int, String> {
    let sim = stack.env().sim.upgrade().ok_or("the simulator is gone.")?;
    let registry = &sim.modules.registry;
    let file = name.replace('.', "/");
    let namespace = registry.module(name);
    match namespace {
        _ if registry.files.contains_key(file.as_str()) && !file.starts_with("sim/") => {
            load_module(stack, &sim, &file).map_err(|error| error.text)?;
        }
        Some(_) => push_callback(stack, return_library, 0),
        None => {
            stack.push_bytes(format!("no module '{name}' in Swanilda's library").as_bytes());
            return Ok(1);
        }
    }
    push_native(stack, namespace);
    if name == test_file::MODULE {
        test_file::add_functions(stack);
    }
    Ok(2)
}

/// Pushes a table of what is native in a module: constants, functions, and what is for its Lua part.
fn push_native(stack: Stack<'_>, namespace: Option<&Namespace>) {
    stack.new_table(0, 0);
    let Some(namespace) = namespace else { return };
    for (name, member) in namespace.listed() {
        match member {
            Member::Constant(value) => {
                set_constant(stack, name, value);
                continue;
            }
            Member::Native(id) => push_function(stack, id),
            Member::Missing(id) => push_missing(stack, id),
            Member::Lua { .. } => continue,
        }
        stack.raw_set_field(-2, name);
    }
    for &(name, id) in &namespace.inner {
        push_function(stack, id);
        stack.raw_set_field(-2, name);
    }
}

/// Sets `name`, or `enumeration.name`, in the table on top.
fn set_constant(stack: Stack<'_>, name: &str, value: i64) {
    let Some((enumeration, name)) = name.split_once('.') else {
        stack.push_int(value);
        return stack.raw_set_field(-2, name);
    };
    if stack.raw_get_field(-1, enumeration) != Type::Table {
        stack.pop(1);
        stack.new_table(0, 0);
        stack.push_value(-1);
        stack.raw_set_field(-3, enumeration);
    }
    stack.push_int(value);
    stack.raw_set_field(-2, name);
    stack.pop(1);
}

/// The loader of a module that is native altogether: what the searcher found comes as its second argument.
fn return_library(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    Ok(stack.top().min(1))
}

fn return_sim(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    stack.push_registry(SIM);
    Ok(1)
}

/// Pushes the chunk of an embedded module.
pub(super) fn load_module(stack: Stack<'_>, sim: &Sim, name: &str) -> Result<(), LuaError> {
    match sim.modules.registry.files.get(name) {
        Some(module) => {
            stack.load_bytecode(module.bytecode(name), name)?;
            library_globals::apply(stack, name);
            Ok(())
        }
        None => Err(LuaError {
            text: format!("no module '{name}' in Swanilda's library"),
        }),
    }
}
