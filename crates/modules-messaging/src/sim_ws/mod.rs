//! The native part of the Lua module `simWS`: WebSocket servers and clients.

mod endpoints;
mod event;
mod log;

use std::net::TcpListener;
use std::rc::Rc;

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Module, Result, functions, remote};
use endpoints::{Endpoint, HandlerKind, Role, WebSockets, handle_number};
use io::{IdCounter, SendError, WsEndpoint, WsPages, WsRequest};
use script::{Bytes, Handler, Hooks, Outside, ScriptFunction};

/// The module `simWS`.
pub static MODULE: Module = Module {
    about: "WebSocket servers and clients.",
    functions: &[("WebSocket", FUNCTIONS)],
    constants: "opcode.continuation\t0\nopcode.text\t1\nopcode.binary\t2\n",
    hooks: Hooks {
        start_of_iteration: Some(endpoints::start_of_iteration),
        ..Hooks::NONE
    },
    outside: Outside::Only(&["simWS.send", "simWS.getPort"]),
    ..Module::new("simWS")
};

const FUNCTIONS: &[ApiFn] = functions![
    start,
    get_port,
    stop,
    connect,
    disconnect,
    send,
    set_open_handler,
    set_fail_handler,
    set_close_handler,
    set_message_handler,
    set_http_handler,
];

/// The server of the remote API, which brings its own port along.
pub(super) const REMOTE: &[ApiFn] = functions![start_remote];
/// And for the visualization stream.
pub(super) const STREAM: &[ApiFn] = functions![start_stream];

/// Starts a server.
///
/// @param listenPort 0 for any free one
/// @return serverHandle
#[api("simWS.start")]
fn start(cx: &mut Cx, listen_port: i64) -> Result<String> {
    let port = u16::try_from(listen_port)
        .map_err(|_| ApiError::Other(format!("invalid port: {listen_port}")))?;
    let address = cx.options().listen_address;
    cx.permissions()
        .check_net(&address.to_string(), Some(port))?;
    let listen = |_: &Cx| {
        TcpListener::bind((address, port))
            .map_err(|error| unusable(&format!("{address}:{port}"), &error))
    };
    serve(cx, &format!("{address}:{port}"), listen, WsPages::All)
}

/// The port of a server. Not in CoppeliaSim.
///
/// @param serverHandle
/// @return port
#[api("simWS.getPort")]
fn get_port(cx: &Cx, server_handle: String) -> Result<i64> {
    endpoint(cx, &server_handle)?
        .port()
        .map(i64::from)
        .ok_or_else(invalid_handle)
}

/// Starts a server at the port of the remote API.
///
/// @return serverHandle
#[api("remote.ws.start")]
fn start_remote(cx: &mut Cx) -> Result<String> {
    let place = "the remote API's port";
    let listen = |cx: &Cx| {
        let listener = remote::listener(cx).ok_or("there is no port for the remote API.")?;
        listener.map_err(|error| unusable(place, &error))
    };
    let pages = WsPages::Own(cx.options().web_origins.clone());
    serve(cx, place, listen, pages)
}

/// Starts a server at the port of the visualization stream.
///
/// @return serverHandle
#[api("remote.visualization.start")]
fn start_stream(cx: &mut Cx) -> Result<String> {
    let place = "the port of the visualization stream";
    let listen = |cx: &Cx| {
        let listener = remote::visualization_listener(cx)
            .ok_or("there is no port for the visualization stream.")?;
        listener.map_err(|error| unusable(place, &error))
    };
    let pages = WsPages::Own(cx.options().web_origins.clone());
    serve(cx, place, listen, pages)
}

/// A server at `place`, where `listen` opens a port.
fn serve(
    cx: &mut Cx,
    place: &str,
    listen: impl FnOnce(&Cx) -> std::result::Result<TcpListener, String>,
    pages: WsPages,
) -> Result<String> {
    let mut socket = None;
    let opened = cx.permissions().tape().input("a WebSocket server", || {
        let listener = listen(cx)?;
        let served = cx
            .event_loop()
            .and_then(|event_loop| WsEndpoint::listen(event_loop, listener, pages, numbers(cx)));
        socket = Some(served.map_err(|error| unusable(place, &error))?);
        Ok(())
    });
    opened?.map_err(ApiError::Other)?;
    Ok(endpoints::add(cx, Role::Server, socket).handle())
}

fn unusable(address: &str, error: &std::io::Error) -> String {
    format!("Underlying Transport Error: cannot listen at {address}: {error}")
}

/// Stops a server; its connections end at once.
///
/// @param serverHandle
#[api("simWS.stop")]
fn stop(cx: &mut Cx, server_handle: String) -> Result<()> {
    let number = handle_number(&server_handle, "Server")
        .filter(|&number| cx.module_state::<WebSockets>().get(number).is_some());
    cx.module_state::<WebSockets>()
        .stop(number.ok_or_else(invalid_handle)?);
    Ok(())
}

/// Connects to a server; one of the handlers for open and fail will be called.
///
/// @param uri ws://host:port/path
/// @return clientHandle
#[api("simWS.connect")]
fn connect(cx: &mut Cx, uri: String) -> Result<String> {
    let agent = cx
        .app()
        .named_params
        .get("simWS.userAgent")
        .cloned()
        .unwrap_or_default();
    let mut socket = None;
    let opened = cx.permissions().tape().input("a WebSocket client", || {
        let client = connected(cx, &uri, &String::from_utf8_lossy(&agent));
        socket = Some(client.map_err(|error| error.to_string())?);
        Ok(())
    });
    opened?.map_err(ApiError::Other)?;
    Ok(endpoints::add(cx, Role::Client, socket).handle())
}

/// A client on its way to a server.
fn connected(cx: &Cx, uri: &str, agent: &str) -> Result<WsEndpoint> {
    let numbers = numbers(cx);
    let refused =
        |reason: String| ApiError::Other(format!("Could not create connection: {reason}"));
    let request = WsRequest::new(uri, agent, numbers.next()).map_err(refused)?;
    let (host, port) = request.place();
    cx.permissions().check_net(host, Some(port))?;
    let event_loop = cx
        .event_loop()
        .map_err(|error| refused(error.to_string()))?;
    Ok(WsEndpoint::connect(event_loop, request, numbers))
}

/// Ends a client at once.
///
/// @param clientHandle
#[api("simWS.disconnect")]
fn disconnect(cx: &mut Cx, client_handle: String) -> Result<()> {
    let number = handle_number(&client_handle, "Client")
        .filter(|&number| cx.module_state::<WebSockets>().get(number).is_some());
    cx.module_state::<WebSockets>()
        .stop(number.ok_or_else(invalid_handle)?);
    Ok(())
}

/// Sends a message.
///
/// @param serverOrClientHandle
/// @param connectionHandle as handlers get it
/// @param data text must be valid UTF-8
/// @param opcode simWS.opcode.*
#[api("simWS.send")]
fn send(
    cx: &mut Cx,
    server_or_client_handle: String,
    connection_handle: String,
    data: Bytes,
    #[default(1, "simWS.opcode.text")] opcode: i64,
) -> Result<()> {
    let endpoint = endpoint(cx, &server_or_client_handle)?;
    let connection = handle_number(&connection_handle, "Connection").ok_or_else(invalid_handle)?;
    match endpoint.send(connection, data.0, opcode) {
        Err(SendError::Expired) if !numbers(cx).was_issued(connection) => Err(invalid_handle()),
        Err(error) => Err(ApiError::Other(error.to_string())),
        Ok(()) => Ok(()),
    }
}

/// Sets what is called with endpoint and connection when a connection is open.
///
/// @param serverOrClientHandle
/// @param callbackFn a function, or the name of a global one of the script that called start or connect
#[api("simWS.setOpenHandler")]
fn set_open_handler(
    cx: &mut Cx,
    server_or_client_handle: String,
    callback_fn: ScriptFunction,
) -> Result<()> {
    set_handler(cx, &server_or_client_handle, HandlerKind::Open, callback_fn)
}

/// Sets what is called with endpoint and connection when there will be no connection.
///
/// @param serverOrClientHandle
/// @param callbackFn a function, or the name of a global one of the script that called start or connect
#[api("simWS.setFailHandler")]
fn set_fail_handler(
    cx: &mut Cx,
    server_or_client_handle: String,
    callback_fn: ScriptFunction,
) -> Result<()> {
    set_handler(cx, &server_or_client_handle, HandlerKind::Fail, callback_fn)
}

/// Sets what is called with endpoint and connection when a connection has ended.
///
/// @param serverOrClientHandle
/// @param callbackFn a function, or the name of a global one of the script that called start or connect
#[api("simWS.setCloseHandler")]
fn set_close_handler(
    cx: &mut Cx,
    server_or_client_handle: String,
    callback_fn: ScriptFunction,
) -> Result<()> {
    set_handler(
        cx,
        &server_or_client_handle,
        HandlerKind::Close,
        callback_fn,
    )
}

/// Sets what is called with endpoint, connection and data when a message has come.
///
/// @param serverOrClientHandle
/// @param callbackFn a function, or the name of a global one of the script that called start or connect
#[api("simWS.setMessageHandler")]
fn set_message_handler(
    cx: &mut Cx,
    server_or_client_handle: String,
    callback_fn: ScriptFunction,
) -> Result<()> {
    set_handler(
        cx,
        &server_or_client_handle,
        HandlerKind::Message,
        callback_fn,
    )
}

/// Sets what is called with server, connection, resource and data when an HTTP request has come; it returns status and data.
///
/// @param serverHandle
/// @param callbackFn a function, or the name of a global one of the script that called start
#[api("simWS.setHTTPHandler")]
fn set_http_handler(cx: &mut Cx, server_handle: String, callback_fn: ScriptFunction) -> Result<()> {
    if handle_number(&server_handle, "Server").is_none() {
        return Err(invalid_handle());
    }
    set_handler(cx, &server_handle, HandlerKind::Http, callback_fn)
}

fn set_handler(cx: &Cx, handle: &str, kind: HandlerKind, function: ScriptFunction) -> Result<()> {
    let handler = Handler::new(cx, function);
    endpoint(cx, handle)?.set_handler(kind, handler);
    Ok(())
}

fn endpoint(cx: &Cx, handle: &str) -> Result<Rc<Endpoint>> {
    let number = handle_number(handle, "Server").or_else(|| handle_number(handle, "Client"));
    let endpoint = number.and_then(|number| cx.module_state::<WebSockets>().get(number));
    endpoint
        .filter(|endpoint| endpoint.handle() == handle)
        .ok_or_else(invalid_handle)
}

/// The numbers of endpoints and connections.
fn numbers(cx: &Cx) -> IdCounter {
    cx.module_state::<WebSockets>().numbers.clone()
}

fn invalid_handle() -> ApiError {
    ApiError::Other("invalid object handle".into())
}
