//! The native part of `simQML` (`lua/modules/simQML.lua`): interfaces in QML, each in a process of Python with PySide6.
//!
//! A process draws into memory. Its windows are canvases (`ui::Canvas`), so that pages show its pictures and send what persons do; events of
//! interface and script go both ways. What a process sends is on the tape of a capture, so a replay needs none.

mod engine;
mod engines;
mod items;
mod message;
mod process;

use api_macro::api;

use super::{ApiFn, Cx, Module, Result, functions};
use engines::{Engines, NotLoaded};
pub use items::{act, catch_up, close, find, is_interface, state};
use scene::Data;
use script::{Bytes, Hooks, Results, ScriptCallback, ScriptFunction};

/// The module `simQML`.
pub static MODULE: Module = Module {
    inner: &[INNER],
    hooks: Hooks {
        start_of_iteration: Some(engines::start_of_iteration),
        ..Hooks::NONE
    },
    ..Module::new("simQML")
};

const INNER: &[ApiFn] = functions![start, stop, send, version];

/// Loads an interface: its number; or why interfaces cannot run here; or what is wrong with this one.
#[api("simQML.start")]
fn start(
    cx: &mut Cx,
    handle: String,
    source: Bytes,
    name: String,
    handler: ScriptFunction,
) -> Result<Results> {
    let handler = ScriptCallback::new(cx, handler);
    let what = [Data::Buffer(source.0), Data::text(&name)];
    let loaded = cx.module_state::<Engines>().load(cx, handle, what, handler);
    Ok(Results(match loaded {
        Ok(number) => vec![Data::Int(number)],
        Err(NotLoaded::Lacking(reason)) => vec![Data::Nil, Data::text(&reason)],
        Err(NotLoaded::Wrong(reason)) => vec![Data::Nil, Data::Nil, Data::text(&reason)],
    }))
}

/// Ends an interface.
#[api("simQML.stop")]
fn stop(cx: &mut Cx, number: i64) -> Result<()> {
    cx.module_state::<Engines>().stop(number);
    Ok(())
}

/// Sends an event to an interface.
#[api("simQML.send")]
fn send(cx: &mut Cx, number: i64, name: String, text: Bytes) -> Result<()> {
    if let Some(engine) = cx.module_state::<Engines>().get(number) {
        let text = String::from_utf8_lossy(&text.0);
        engine.send("event", &[Data::text(&name), Data::text(&text)]);
    }
    Ok(())
}

/// The version of Qt, zeros without one.
#[api("simQML.version")]
fn version(cx: &mut Cx) -> Result<Vec<i64>> {
    let version = cx.module_state::<Engines>().version(cx);
    Ok(version.unwrap_or_default().to_vec())
}
