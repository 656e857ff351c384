//! Log messages of WebSocket endpoints.

use std::io;

use super::endpoints::Endpoint;
use ::io::WsEvent;
use script::Host;
use script::log::verbosity;
use script::wall_clock;

pub(super) fn log_event(host: &Host, endpoint: &Endpoint, event: &WsEvent) {
    match event {
        WsEvent::Refused(_, origin) => log_refused_page(host, endpoint, origin),
        WsEvent::Unreachable(_, error) => log_unreachable(host, error),
        _ => log_access(host, endpoint, event),
    }
}

fn log_refused_page(host: &Host, endpoint: &Endpoint, origin: &str) {
    let text = format!(
        "{}: a page of {origin} was refused; --allow-origin {origin} lets it in",
        endpoint.handle()
    );
    host.log(verbosity::SCRIPT_WARNINGS | verbosity::ONCE, &text);
}

fn log_unreachable(host: &Host, error: &io::Error) {
    for line in unreachable(error) {
        let line = format!("[{}] {line}", wall_clock::utc_date_and_time());
        host.log(verbosity::SCRIPT_WARNINGS | verbosity::UNDECORATED, &line);
    }
}

/// The access log, for those who ask for it.
fn log_access(host: &Host, endpoint: &Endpoint, event: &WsEvent) {
    let verbose = host
        .named_param("simWS.verbose")
        .is_some_and(|value| value != b"0");
    let text = match event {
        _ if !verbose => return,
        WsEvent::Open(connection) => format!("{connection:x} is open"),
        WsEvent::Refused(..) | WsEvent::Unreachable(..) => return,
        WsEvent::Fail(connection, reason) => format!("{connection:x} has failed: {reason}"),
        WsEvent::Close(connection) => format!("{connection:x} is closed"),
        WsEvent::Message(..) => return,
        WsEvent::Http {
            connection,
            resource,
            ..
        } => format!("{connection:x} asks for {resource}"),
    };
    host.log(
        verbosity::SCRIPT_INFOS,
        &format!("{}: connection {text}", endpoint.handle()),
    );
}

/// A failed connection in the words and the form of websocketpp, the original's library, which existing tools look for. It asks
/// first who the peer is, in vain.
fn unreachable(error: &io::Error) -> Vec<String> {
    let text = error.to_string();
    let reason = text.split(" (os error").next().unwrap_or_default();
    let mut lines = Vec::new();
    if let Some(code) = error.raw_os_error() {
        lines.push(format!(
            "[info] asio async_connect error: asio.system:{code} ({reason})"
        ));
        lines.push(
            "[info] Error getting remote endpoint: asio.system:107 (Transport endpoint is not connected)".to_owned(),
        );
    }
    lines.push(format!("[error] handle_connect error: {reason}"));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failed_connections() {
        let refused = unreachable(&io::Error::from_raw_os_error(111));
        assert_eq!(refused.len(), 3);
        assert_eq!(
            refused[0],
            "[info] asio async_connect error: asio.system:111 (Connection refused)"
        );
        assert_eq!(
            refused[2],
            "[error] handle_connect error: Connection refused"
        );
        assert_eq!(
            unreachable(&io::Error::other("no such host")),
            ["[error] handle_connect error: no such host"]
        );
    }
}
