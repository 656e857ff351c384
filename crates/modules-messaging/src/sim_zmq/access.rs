//! Permissions of ZeroMQ sockets. libzmq reads addresses generously: what is restricted must be written plainly.

use std::path::Path;

use crate::{Cx, Result};

/// The option of a socket with the address of a proxy.
const SOCKS_PROXY: i32 = 68;

/// An address to bind or to connect to.
pub(super) fn check_endpoint(cx: &Cx, endpoint: &str) -> Result<()> {
    match endpoint.split_once("://") {
        // Sockets of this process.
        Some(("inproc", _)) => Ok(()),
        Some(("ipc", path)) => check_local(cx, path),
        Some(("tcp", place)) => check_place(cx, place, endpoint),
        _ => Ok(cx.permissions().check_net_everywhere(endpoint)?),
    }
}

fn check_local(cx: &Cx, path: &str) -> Result<()> {
    match path {
        // A file of libzmq's choice, and names that are no files.
        "*" => Ok(cx
            .permissions()
            .check_device(&std::env::temp_dir().join("*"))?),
        _ if path.starts_with('@') => Ok(cx
            .permissions()
            .check_net_everywhere("a local socket without a file")?),
        _ => Ok(cx.permissions().check_device(Path::new(path))?),
    }
}

fn check_place(cx: &Cx, place: &str, endpoint: &str) -> Result<()> {
    match host_and_port(place) {
        Some((host, port)) => Ok(cx.permissions().check_net(host, Some(port))?),
        None => Ok(cx.permissions().check_net_everywhere(endpoint)?),
    }
}

/// `host:port`, without an address to connect from. The host `*` is every address of this machine, the port `*` any free one.
fn host_and_port(place: &str) -> Option<(&str, u16)> {
    let (host, port) = place.rsplit_once(':').filter(|_| !place.contains(';'))?;
    let port = match port {
        "*" | "!" => 0,
        _ if port.bytes().all(|byte| byte.is_ascii_digit()) => port.parse().ok()?,
        _ => return None,
    };
    let bare = host
        .strip_prefix('[')
        .and_then(|host| host.strip_suffix(']'))
        .unwrap_or(host);
    Some((if bare == "*" { "0.0.0.0" } else { bare }, port))
}

/// A proxy is a host that is connected to.
pub(super) fn check_option(cx: &Cx, option: i32, value: &[u8]) -> Result<()> {
    if option != SOCKS_PROXY || value.is_empty() {
        return Ok(());
    }
    let place = String::from_utf8_lossy(value);
    check_place(cx, place.trim_end_matches('\0'), "a proxy")
}

#[cfg(test)]
mod tests {
    use super::host_and_port;

    #[test]
    fn addresses_that_are_plain() {
        assert_eq!(host_and_port("127.0.0.1:80"), Some(("127.0.0.1", 80)));
        assert_eq!(host_and_port("[::1]:80"), Some(("::1", 80)));
        assert_eq!(host_and_port("*:*"), Some(("0.0.0.0", 0)));
        // libzmq connects to the second one, takes 65616 for 80, and reads digits up to the first letter.
        for odd in [
            "127.0.0.1:1;evil:80",
            "host:65616",
            "host:80x",
            "host",
            "host:",
            "host: 80",
            "host:+80",
        ] {
            assert_eq!(host_and_port(odd), None, "{odd}");
        }
    }
}
