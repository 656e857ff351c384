//! Global functions: hooks, yield levels, the log.

use std::rc::Rc;

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use c_interface::Variable;
use scene::Data;
use script::log::verbosity;
use script::{Hook, LevelChange, Rest, Results, ScriptFunction, SysCall, changed_level};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    register_script_func_hook,
    set_auto_yield,
    get_auto_yield,
    set_yield_allowed,
    get_yield_allowed,
    add_log,
    add_statusbar_message,
    aux_func,
    quit_simulator,
    print_line,
    used_module,
    load_plugin,
    call_plugin,
    program_functions,
    unload_plugin,
    get_plugin_name,
    register_code_editor_infos,
];

/// Runs a function before or after a callback of this script, whether or not the script defines the callback. Registering the
/// same pair again removes it. An empty function name removes all hooks of the callback, an empty callback name all hooks.
///
/// @param systemCallback name of the callback, e.g. `sysCall_actuation`
/// @param userFunction a function, or the dotted name of a global one
/// @param execBefore before (in reverse order of registration) or after the callback
/// @return result 1 when registered, 0 when removed
#[api("registerScriptFuncHook")]
fn register_script_func_hook(
    cx: &mut Cx,
    system_callback: String,
    user_function: ScriptFunction,
    exec_before: bool,
) -> Result<i64> {
    let mut hooks = cx.env().hooks.borrow_mut();
    let list = if exec_before {
        &mut hooks.before
    } else {
        &mut hooks.after
    };
    if system_callback.is_empty() {
        std::mem::take(list)
            .into_values()
            .for_each(|entries| release(cx, &entries));
        return Ok(0);
    }
    let Some(call) = SysCall::from_name(&system_callback) else {
        // Any name is taken; the functions of others have no hooks.
        return Ok(1);
    };
    cx.note_callback(call);
    cx.env().note_hook(call);
    let entries = Rc::make_mut(list.entry(call).or_default());
    match user_function {
        ScriptFunction::Name(name) if name.is_empty() => release(cx, &std::mem::take(entries)),
        ScriptFunction::Name(name) => return Ok(toggle(entries, name)),
        ScriptFunction::Value(function) => {
            entries.push(Hook {
                name: String::new(),
                function: Some(function),
            });
            return Ok(1);
        }
    }
    Ok(0)
}

/// Adds the hook of that name, or removes it when it is there already; 1 or 0.
fn toggle(entries: &mut Vec<Hook>, name: String) -> i64 {
    match entries
        .iter()
        .position(|hook| hook.function.is_none() && hook.name == name)
    {
        Some(at) => {
            entries.remove(at);
            0
        }
        None => {
            entries.push(Hook {
                name,
                function: None,
            });
            1
        }
    }
}

/// Lets go of the functions of hooks that are gone.
fn release(cx: &Cx, entries: &[Hook]) {
    entries
        .iter()
        .filter_map(|hook| hook.function)
        .for_each(|function| cx.release_function(function));
}

/// Allows or forbids that the running coroutine is pre-empted.
///
/// @param allow false raises the level, true lowers it, a number sets it; pre-emption happens at level 0
/// @return level the previous level
#[api("setAutoYield")]
fn set_auto_yield(cx: &mut Cx, allow: LevelChange) -> Result<i64> {
    let level = cx.auto_level()?;
    cx.set_auto_level(changed_level(level, allow))?;
    Ok(level)
}

/// Whether the running coroutine may be pre-empted.
///
/// @return allowed, level
#[api("getAutoYield")]
fn get_auto_yield(cx: &Cx) -> Result<(bool, i64)> {
    let level = cx.auto_level()?;
    Ok((level == 0, level))
}

/// Allows or forbids yielding altogether, in this script.
///
/// @param allow false raises the level, true lowers it, a number sets it; yielding is possible at level 0
/// @return level the previous level
#[api("setYieldAllowed")]
fn set_yield_allowed(cx: &mut Cx, allow: LevelChange) -> Result<i64> {
    let overall = &cx.env().yields.overall;
    Ok(overall.replace(changed_level(overall.get(), allow)))
}

/// Whether this script may yield now.
///
/// @return allowed
#[api("getYieldAllowed")]
fn get_yield_allowed(cx: &Cx) -> Result<bool> {
    Ok(cx.env().yields.overall.get() == 0)
}

/// Writes a line to the log in the name of this script.
///
/// @param verbosityLevel sim.verbosity_*
/// @param logMessage the line; nil clears a graphical log and does nothing here
#[api("addLog")]
fn add_log(cx: &Cx, verbosity_level: i64, log_message: Option<String>) -> Result<()> {
    if let Some(text) = log_message {
        cx.env().log(verbosity_level, &text);
    }
    Ok(())
}

/// Writes a line to the log in the name of this script, as an information.
///
/// @param message the line; nil: none is written
/// @return result 1
#[api("sim.addStatusbarMessage")]
fn add_statusbar_message(cx: &Cx, #[default(None)] message: Option<String>) -> Result<i64> {
    if let Some(message) = message {
        cx.env().log(verbosity::SCRIPT_INFOS, &message);
    }
    Ok(1)
}

/// Small services of the host: `headless`, `useBuffers`, `frexp`. Other commands return nothing.
///
/// @param cmd the service
/// @return result its result
#[api("auxFunc")]
fn aux_func(cx: &Cx, cmd: String, #[name("...")] arguments: Rest) -> Result<Results> {
    let _ = cx;
    Ok(Results(
        match (cmd.as_str(), arguments.0.first().and_then(Data::as_f64)) {
            ("headless" | "useBuffers", _) => vec![Data::Bool(true)],
            ("frexp", Some(number)) => {
                let (mantissa, exponent) = mantissa_and_exponent(number);
                vec![Data::Float(mantissa), Data::Int(exponent)]
            }
            _ => Vec::new(),
        },
    ))
}

/// `number` = m 2^e, where m is between 0.5 and 1.
fn mantissa_and_exponent(number: f64) -> (f64, i64) {
    if number == 0.0 || !number.is_finite() {
        return (number, 0);
    }
    // The logarithm may be rounded to the next whole number.
    let exponent = libm::log2(number.abs()).floor() as i32 + 1;
    let mantissa = number * 0.5_f64.powi(exponent / 2) * 0.5_f64.powi(exponent - exponent / 2);
    match mantissa.abs() {
        1.0.. => (mantissa / 2.0, i64::from(exponent) + 1),
        ..0.5 => (mantissa * 2.0, i64::from(exponent) - 1),
        _ => (mantissa, exponent.into()),
    }
}

/// Ends the program after the current loop iteration.
#[api("quitSimulator")]
fn quit_simulator(cx: &mut Cx) -> Result<()> {
    cx.request_quit(true);
    Ok(())
}

/// Prints a line as it is: what `print` ends in.
///
/// @param text the line
#[api("_print")]
fn print_line(cx: &Cx, text: script::Bytes) -> Result<()> {
    cx.print(&text.0);
    Ok(())
}

/// Notification that a script has loaded a module.
///
/// @param name the module
/// @param implicit loaded implicitly, which uses up a thread's time slice
#[api("_usedModule")]
fn used_module(cx: &Cx, name: String, #[default(false)] implicit: bool) -> Result<()> {
    let _ = name;
    if implicit {
        cx.end_time_slice();
    }
    Ok(())
}

/// Loads a native plugin: its name, the names of its functions, and its variables as name, value and whether that is an expression.
/// Nothing where it cannot be loaded. `loadPlugin` makes a table of functions of it. Only the name where the plugin is a module here.
///
/// @param name the plugin, with or without a version: simX, simX-2
/// @return plugin a map, or the name; nil where it cannot be loaded, which is logged
#[api("_loadPlugin")]
fn load_plugin(cx: &mut Cx, name: String) -> Result<Option<Data>> {
    if cx.has_module_for_plugin(&name) {
        return Ok(Some(Data::text(&name)));
    }
    let Some(plugin) = cx.load_plugin(&name)? else {
        return Ok(None);
    };
    let functions = plugin
        .functions()
        .iter()
        .map(|name| Data::text(name))
        .collect();
    let variables = plugin.variables().into_iter().map(|(name, variable)| {
        let (value, is_expression) = match variable {
            Variable::Expression(text) => (Data::text(&text), true),
            Variable::Value(value) => (value, false),
        };
        Data::map([
            ("name", Data::text(&name)),
            ("value", value),
            ("isExpression", is_expression.into()),
        ])
    });
    Ok(Some(Data::map([
        ("name", Data::text(&plugin.name)),
        ("functions", Data::Array(functions)),
        ("variables", Data::Array(variables.collect())),
    ])))
}

/// Calls a function of a native plugin.
///
/// @param plugin its name; nil: the program that has loaded the simulator
/// @param place of the function among those of the plugin, from 0
/// @param ... what the function gets
/// @return results what the function has left on its stack
#[api("_callPlugin")]
fn call_plugin(
    cx: &mut Cx,
    plugin: Option<String>,
    place: i64,
    #[name("...")] values: Rest,
) -> Result<Results> {
    // A place that is none is no function of the plugin.
    let place = usize::try_from(place).unwrap_or(usize::MAX);
    cx.call_plugin(plugin.as_deref(), place, values.0)
        .map(Results)
}

/// The functions for scripts of the program that has loaded the simulator as a library.
///
/// @return names in the order of their registration
#[api("_programFunctions")]
fn program_functions(cx: &Cx) -> Result<Vec<String>> {
    Ok(cx.functions_of_program())
}

/// Ends the use of a native plugin by this script. With its last user it is unloaded.
///
/// @param name the plugin
/// @param force unload it although other scripts use it
#[api("_unloadPlugin")]
fn unload_plugin(cx: &mut Cx, name: String, #[default(false)] force: bool) -> Result<()> {
    cx.unload_plugin(&name, force)
}

/// Name of a native plugin that is loaded, by its place.
///
/// @param index from 0
/// @return pluginName nil behind the last one
/// @return version what the plugin says of itself
#[api("sim.getPluginName")]
fn get_plugin_name(cx: &Cx, index: script::Number) -> Result<(Option<String>, Option<i64>)> {
    let place = usize::try_from(index.0).ok();
    let plugin = place.and_then(|place| cx.plugin_by_place(place));
    Ok(plugin.map_or((None, None), |(name, version)| {
        (Some(name), Some(version.into()))
    }))
}

/// Accepted for scripts that describe themselves to the original's editor.
///
/// @param moduleName ignored
/// @param ... ignored
#[api("registerCodeEditorInfos")]
fn register_code_editor_infos(
    cx: &Cx,
    _module_name: String,
    #[name("...")] _infos: Rest,
) -> Result<()> {
    let _ = cx;
    Ok(())
}
