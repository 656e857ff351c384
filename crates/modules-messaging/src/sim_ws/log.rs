//! Log messages of WebSocket endpoints.

use std::io;

use super::endpoints::Endpoint;
use super::event::{Event, EventKind};
use script::Host;
use script::log::verbosity;
use script::wall_clock;

pub(super) fn log_event(host: &Host, endpoint: &Endpoint, event: &Event) {
    match &event.kind {
        EventKind::Refused(origin) => log_refused_page(host, endpoint, origin),
        EventKind::Unreachable(error) => log_unreachable(host, error),
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
    let tape = host.options().permissions.tape();
    for line in unreachable(error) {
        let now = tape.input("the time of a log line", wall_clock::utc_date_and_time);
        let line = format!("[{}] {line}", now.unwrap_or_default());
        host.log(verbosity::SCRIPT_WARNINGS | verbosity::UNDECORATED, &line);
    }
}

/// The access log, for those who ask for it.
fn log_access(host: &Host, endpoint: &Endpoint, event: &Event) {
    let verbose = host
        .named_param("simWS.verbose")
        .is_some_and(|value| value != b"0");
    let what = match &event.kind {
        _ if !verbose => return,
        EventKind::Refused(_) | EventKind::Unreachable(_) | EventKind::Message(_) => return,
        EventKind::Open => "is open".to_owned(),
        EventKind::Fail(reason) => format!("has failed: {reason}"),
        EventKind::Close => "is closed".to_owned(),
        EventKind::Http { resource, .. } => format!("asks for {resource}"),
    };
    let connection = event.connection;
    host.log(
        verbosity::SCRIPT_INFOS,
        &format!("{}: connection {connection:x} {what}", endpoint.handle()),
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
