//! `simMujoco`: what scripts put into MuJoCo's model, on top of the soft shapes and loop closures that are here (spec: simmujoco 1).
//!
//! An injection is read when it is added, so that mistakes are errors of its caller. It becomes objects when the physics is about to move the scene
//! (`Hooks::before_dynamics`), after its callback; they go with it, with its script, and with the simulation.

mod acts;
mod describe;
mod info;
mod injections;
mod make;
mod names;
mod readings;

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use describe::Kind;
use injections::{Injection, Injections};
use script::{Hooks, Host, ScriptCallback, ScriptFunction, Table};

/// The module `simMujoco`.
pub static MODULE: Module = Module {
    functions: &[
        ("Injections", FUNCTIONS),
        ("What was injected", readings::FUNCTIONS),
    ],
    inner: &[INNER],
    hooks: Hooks {
        before_dynamics: Some(before_dynamics),
        end_of_simulation: Some(end_of_simulation),
        ..Hooks::NONE
    },
    ..Module::new("simMujoco")
};

const FUNCTIONS: &[ApiFn] = functions![remove_injection];

const INNER: &[ApiFn] = functions![add_flexcomp, composite, add_injection, make_pending, unmake];

/// Adds a flexcomp.
///
/// @param info where it is, and what it is
/// @param callback called when it becomes objects
/// @return injectionId from 1
#[api("simMujoco.addFlexcomp")]
fn add_flexcomp(cx: &mut Cx, info: Table, callback: Option<ScriptFunction>) -> Result<i64> {
    add(cx, Kind::Flexcomp, info, String::new(), callback)
}

/// Adds a composite.
///
/// @param xml the element
/// @param info where it is, and what it is
/// @param callback called when it becomes objects
/// @return injectionId from 1
#[api("simMujoco.composite")]
fn composite(
    cx: &mut Cx,
    xml: String,
    info: Table,
    callback: Option<ScriptFunction>,
) -> Result<i64> {
    add(cx, Kind::Composite, info, xml, callback)
}

/// Adds elements.
///
/// @param xml the elements
/// @param info where they are
/// @param callback called when they become objects
/// @return injectionId from 1
#[api("simMujoco.addInjection")]
fn add_injection(
    cx: &mut Cx,
    xml: String,
    info: Table,
    callback: Option<ScriptFunction>,
) -> Result<i64> {
    add(cx, Kind::Any, info, xml, callback)
}

fn add(
    cx: &mut Cx,
    kind: Kind,
    info: Table,
    xml: String,
    callback: Option<ScriptFunction>,
) -> Result<i64> {
    let described = describe::describe(cx, kind, &info.0, &xml)?;
    let injections = cx.module_state::<Injections>();
    for (flex, _) in &described.softs {
        if injections.has_soft(&flex.name) {
            let text = format!("'{}' is the name of something injected already.", flex.name);
            return Err(refused(text));
        }
    }
    let callback = callback.map(|function| ScriptCallback::new(cx, function).into());
    let life = std::rc::Rc::downgrade(&cx.script_state());
    let injection = Injection::new(kind, info.0, xml, callback, life);
    Ok(injections.add(injection, &described))
}

/// Takes an injection out of the model again, with what it has become.
///
/// @param injectionId from addFlexcomp, composite or addInjection
#[api("simMujoco.removeInjection")]
fn remove_injection(cx: &mut Cx, injection_id: i64) -> Result<()> {
    let injections = cx.module_state::<Injections>();
    let Some(injection) = injections.take(injection_id) else {
        return Err(unknown(injection_id));
    };
    make::unmake(cx, injection)
}

/// Makes objects of the injections that have none, and takes those of scripts that have ended out.
#[api("simMujoco.make")]
fn make_pending(cx: &mut Cx) -> Result<()> {
    make::make_pending(cx)
}

/// Takes the objects of all injections out; those of scripts that still run are made again.
#[api("simMujoco.unmake")]
fn unmake(cx: &mut Cx) -> Result<()> {
    let injections = cx.module_state::<Injections>();
    for injection in injections.take_made() {
        make::unmake(cx, injection)?;
    }
    Ok(())
}

fn before_dynamics(host: &Host<'_>) {
    let injections = host.module_state::<Injections>();
    if injections.is_some_and(|injections| injections.has_work()) {
        run(host, "simMujoco.make");
    }
}

fn end_of_simulation(host: &Host<'_>) {
    let injections = host.module_state::<Injections>();
    if injections.is_some_and(|injections| !injections.is_empty()) {
        run(host, "simMujoco.unmake");
    }
}

fn run(host: &Host<'_>, function: &str) {
    if let Err(error) = host.call_inner(function, &[]) {
        host.log(
            script::log::verbosity::ERRORS,
            &format!("simMujoco: {error}"),
        );
    }
}

fn unknown(id: i64) -> ApiError {
    refused(format!("there is no injection {id}."))
}

fn refused(text: impl Into<String>) -> ApiError {
    ApiError::Other(text.into())
}
