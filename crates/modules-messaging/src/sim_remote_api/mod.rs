//! `simRemoteApi`: servers of the legacy remote API, the API of `simxStart` (spec: legacy-remote-api).
//!
//! `wire::simx` is the protocol, `io::SimxServer` has the sockets, `services` decides when commands are executed, and the
//! other files here are the commands.

mod call;
mod commands;
mod direct;
mod files;
mod group_data;
mod objects;
mod script_call;
mod sensors;
mod service;
mod services;
mod signals;

use std::net::{SocketAddr, TcpListener};
use std::time::Duration;

use api_macro::api;
use capture::Tape;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use io::EventLoop;
use scene::Data;
use scene::numbers;
use scene::object::script_object::ScriptType;
use script::log::verbosity;
use script::{Hooks, Outside, Results, States};
use service::{Lifetime, Service, Settings};
use services::Services;
use wire::simx::VERSION;

/// The module `simRemoteApi`.
pub static MODULE: Module = Module {
    about: "Servers of the legacy remote API, for programs with `simxStart`.",
    functions: &[("Servers", FUNCTIONS)],
    hooks: Hooks {
        start_of_iteration: Some(services::start_of_iteration),
        before_step: Some(services::before_step),
        before_dynamics: None,
        after_step: None,
        end_of_simulation: Some(services::end_of_simulation),
    },
    outside: Outside::Only(&["simRemoteApi.status"]),
    ..Module::new("simRemoteApi")
};

const FUNCTIONS: &[ApiFn] = functions![start, stop, reset, status];

/// Bytes of a packet that servers may use.
const PACKET_SIZES: std::ops::RangeInclusive<i64> = 200..=30_000;

/// Serves a client by the legacy remote API as long as the simulator lives, at a listener that `listen` opens. Returns where it listens.
///
/// # Errors
/// When the listener cannot be used.
pub fn serve(
    states: &States,
    event_loop: &EventLoop,
    tape: &Tape,
    listen: impl FnOnce() -> std::result::Result<TcpListener, String>,
    age: Duration,
) -> std::result::Result<SocketAddr, String> {
    let settings = Settings {
        max_packet: 1300,
        is_monitored: false,
        may_synchronize: true,
    };
    let lifetime = Lifetime::Simulator;
    let service = Service::start(event_loop, tape, listen, settings, lifetime, age)?;
    let address = service.address();
    states.get::<Services>().add(service);
    Ok(address)
}

/// Starts a server of the legacy remote API, for one client at a time. Started by a simulation script or the main script, it ends with the
/// simulation.
///
/// @param port on which it listens, where the simulator's servers do
/// @param maxPacketSize bytes of a packet, 200 to 30000
/// @param debug shows what happens in an auxiliary console
/// @param preEnableTrigger whether clients may switch to the synchronous mode
/// @return result 1, or -1 when the port is not free
#[api("simRemoteApi.start")]
fn start(
    cx: &mut Cx,
    port: i64,
    #[default(1300)] max_packet_size: i64,
    #[default(false)] debug: bool,
    #[default(false)] pre_enable_trigger: bool,
) -> Result<i64> {
    if port < 0 {
        let text = "shared memory (a negative port) is not implemented in Swanilda: choose a port from 1 to 65535.";
        return Err(ApiError::Other(text.into()));
    }
    let number = u16::try_from(port).ok().filter(|&port| port > 0);
    let Some(port) = number.filter(|&port| services(cx).get(port).is_none()) else {
        return Ok(refused(cx, "start", "Invalid port number."));
    };
    let address = cx.options().listen_address;
    cx.permissions()
        .check_net(&address.to_string(), Some(port))?;
    let max_packet = max_packet_size.clamp(*PACKET_SIZES.start(), *PACKET_SIZES.end());
    let max_packet = usize::try_from(max_packet).unwrap_or_default();
    let settings = Settings {
        max_packet,
        is_monitored: debug,
        may_synchronize: pre_enable_trigger,
    };
    let lifetime = match cx.script().script_type {
        ScriptType::Main | ScriptType::Simulation => Lifetime::Simulation,
        _ => Lifetime::Call,
    };
    let age = Duration::from_secs_f64(cx.clock().wall_seconds());
    let listen = || TcpListener::bind((address, port)).map_err(|error| error.to_string());
    let tape = cx.permissions().tape();
    let event_loop = cx.event_loop().map_err(|error| error.to_string());
    let service = event_loop
        .and_then(|event_loop| Service::start(&event_loop, tape, listen, settings, lifetime, age));
    match service {
        Ok(service) => services(cx).add(service),
        Err(error) => {
            return Ok(refused(
                cx,
                "start",
                &format!("cannot listen at {address}:{port}: {error}."),
            ));
        }
    }
    cx.env().log(
        verbosity::INFOS,
        &format!("starting a remote API server on port {port}"),
    );
    Ok(1)
}

/// Ends a server that a script has started.
///
/// @param port of the server
/// @return result 1, or -1 when there is none
#[api("simRemoteApi.stop")]
fn stop(cx: &mut Cx, port: i64) -> Result<i64> {
    let Some(service) = named(cx, port) else {
        return Ok(refused(cx, "stop", "Invalid port number."));
    };
    if service.lifetime() == Lifetime::Simulator {
        return Ok(refused(
            cx,
            "stop",
            "Can't stop a continuous remote API server service.",
        ));
    }
    services(cx).remove(service.port());
    Ok(1)
}

/// Starts a server anew: its client is gone then.
///
/// @param port of the server
/// @return result 1, or -1 when there is none
#[api("simRemoteApi.reset")]
fn reset(cx: &mut Cx, port: i64) -> Result<i64> {
    let Some(service) = named(cx, port) else {
        return Ok(refused(cx, "reset", "Invalid port number."));
    };
    let age = Duration::from_secs_f64(cx.clock().wall_seconds());
    match cx
        .event_loop()
        .and_then(|event_loop| service.reset(&event_loop, age))
    {
        Ok(()) => Ok(1),
        Err(error) => Ok(refused(cx, "reset", &format!("{error}."))),
    }
}

/// What a server does.
///
/// @param port of the server
/// @return status -1 without a server, else 1, or 3 while a client is connected
/// @return info milliseconds of the last request, of the last reply, between the last two requests; commands of the last request, of the last
/// reply
/// @return serverVersion of the protocol
/// @return clientVersion -1 before the first message
/// @return connectedMachine the client's address
#[api("simRemoteApi.status")]
fn status(cx: &Cx, port: i64) -> Result<Results> {
    let version = Data::Int(VERSION.into());
    let Some(service) = named(cx, port) else {
        return Ok(Results(vec![
            Data::Int(-1),
            Data::Nil,
            version,
            Data::Int(-1),
        ]));
    };
    let status = service.with_session(|session| {
        let traffic = session.traffic();
        let [request, reply] =
            [traffic.commands_in_request, traffic.commands_in_reply].map(numbers::count);
        let times = [
            traffic.last_request,
            traffic.last_reply,
            traffic.between_requests,
            request,
            reply,
        ];
        let state = if session.peer().is_some() { 3 } else { 1 };
        let peer = session
            .peer()
            .unwrap_or("NONE (reception line is not open)");
        let client_version = session.client_version().map_or(-1, i64::from);
        vec![
            Data::Int(state),
            times.into(),
            version,
            Data::Int(client_version),
            Data::text(peer),
        ]
    });
    Ok(Results(status.unwrap_or_default()))
}

fn services(cx: &Cx) -> std::rc::Rc<Services> {
    cx.module_state()
}

fn named(cx: &Cx, port: i64) -> Option<std::rc::Rc<Service>> {
    services(cx).get(u16::try_from(port).ok()?)
}

/// Says why a function returns -1, which programs seldom look at.
fn refused(cx: &Cx, function: &str, reason: &str) -> i64 {
    cx.env().log(
        verbosity::SCRIPT_ERRORS,
        &format!("simRemoteApi.{function}: {reason}"),
    );
    -1
}
