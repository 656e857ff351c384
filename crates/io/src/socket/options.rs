//! Options of sockets by LuaSocket's names.

use std::io;
use std::net::{Ipv4Addr, Ipv6Addr};
use std::time::Duration;

use rustix::net::sockopt;
use socket2::Socket;

/// The value of an option.
#[derive(Debug, Clone, PartialEq)]
pub enum OptionValue {
    /// On or off.
    Bool(bool),
    /// A count, a size in bytes, or a time in seconds.
    Number(f64),
    /// An address, or the name of an interface.
    Text(String),
    /// How long closing may wait for unsent data.
    Linger {
        /// Whether it waits.
        on: bool,
        /// Seconds, at most.
        timeout: f64,
    },
    /// A group, by its address, and the interface: an address, or the number of one.
    Membership {
        /// The address of the group.
        group: String,
        /// The interface's address, or its number.
        interface: String,
    },
    /// A pending error, or none.
    Error(Option<String>),
}

use OptionValue::{Bool, Number, Text};

/// Reads an option; None for one of another name.
pub fn option(socket: &Socket, name: &str) -> Option<io::Result<OptionValue>> {
    let count = |value: io::Result<usize>| value.map(|value| Number(value as f64));
    let number = |value: io::Result<u32>| value.map(|value| Number(value.into()));
    let seconds = |value: io::Result<Duration>| value.map(|value| Number(value.as_secs_f64()));
    Some(match name {
        "keepalive" => socket.keepalive().map(Bool),
        "reuseaddr" => socket.reuse_address().map(Bool),
        "reuseport" => reuse_port(socket).map(Bool),
        "broadcast" => socket.broadcast().map(Bool),
        "tcp-nodelay" => socket.tcp_nodelay().map(Bool),
        "tcp-keepidle" => seconds(socket.tcp_keepalive_time()),
        "tcp-keepcnt" => number(socket.tcp_keepalive_retries()),
        "tcp-keepintvl" => seconds(socket.tcp_keepalive_interval()),
        "recv-buffer-size" => count(socket.recv_buffer_size()),
        "send-buffer-size" => count(socket.send_buffer_size()),
        "linger" => socket.linger().map(|linger| OptionValue::Linger {
            on: linger.is_some(),
            timeout: linger.unwrap_or_default().as_secs_f64(),
        }),
        "error" => socket
            .take_error()
            .map(|error| OptionValue::Error(error.map(|e| super::failure::system_words(&e)))),
        "ipv6-v6only" => socket.only_v6().map(Bool),
        "ip-multicast-if" => socket
            .multicast_if_v4()
            .map(|address| Text(address.to_string())),
        "ip-multicast-loop" => socket.multicast_loop_v4().map(Bool),
        "ip-multicast-ttl" => number(socket.multicast_ttl_v4()),
        "ipv6-multicast-loop" => socket.multicast_loop_v6().map(Bool),
        "ipv6-multicast-hops" => number(socket.multicast_hops_v6()),
        "ipv6-unicast-hops" => number(socket.unicast_hops_v6()),
        #[cfg(any(target_os = "android", target_os = "linux"))]
        "bindtodevice" => socket
            .device()
            .map(|name| Text(String::from_utf8_lossy(&name.unwrap_or_default()).into())),
        _ => return None,
    })
}

/// Changes an option; None for one of another name, or of another type of value.
pub fn set_option(socket: &Socket, name: &str, value: &OptionValue) -> Option<io::Result<()>> {
    Some(match (name, value) {
        ("keepalive", Bool(on)) => socket.set_keepalive(*on),
        ("reuseaddr", Bool(on)) => socket.set_reuse_address(*on),
        ("reuseport", Bool(on)) => set_reuse_port(socket, *on),
        ("broadcast", Bool(on)) => socket.set_broadcast(*on),
        ("tcp-nodelay", Bool(on)) => socket.set_tcp_nodelay(*on),
        ("ipv6-v6only", Bool(on)) => socket.set_only_v6(*on),
        ("ip-multicast-loop", Bool(on)) => socket.set_multicast_loop_v4(*on),
        ("ipv6-multicast-loop", Bool(on)) => socket.set_multicast_loop_v6(*on),
        ("ip-multicast-if", Text(address)) => {
            address_of(address).and_then(|a| socket.set_multicast_if_v4(&a))
        }
        #[cfg(any(target_os = "android", target_os = "linux"))]
        ("bindtodevice", Text(name)) => {
            socket.bind_device((!name.is_empty() && name != "*").then_some(name.as_bytes()))
        }
        ("linger", OptionValue::Linger { on, timeout }) => {
            socket.set_linger(on.then_some(Duration::from_secs(whole(*timeout).into())))
        }
        (_, Number(number)) => return set_number(socket, name, whole(*number)),
        (_, OptionValue::Membership { group, interface }) => {
            return change_membership(socket, name, group, interface);
        }
        _ => return None,
    })
}

fn set_number(socket: &Socket, name: &str, number: u32) -> Option<io::Result<()>> {
    let seconds = Duration::from_secs(number.into());
    Some(match name {
        "recv-buffer-size" => socket.set_recv_buffer_size(number as usize),
        "send-buffer-size" => socket.set_send_buffer_size(number as usize),
        "tcp-keepidle" => sockopt::set_tcp_keepidle(socket, seconds).map_err(io::Error::from),
        "tcp-keepintvl" => sockopt::set_tcp_keepintvl(socket, seconds).map_err(io::Error::from),
        "tcp-keepcnt" => sockopt::set_tcp_keepcnt(socket, number).map_err(io::Error::from),
        "ip-multicast-ttl" => socket.set_multicast_ttl_v4(number),
        "ipv6-multicast-hops" => socket.set_multicast_hops_v6(number),
        "ipv6-unicast-hops" => socket.set_unicast_hops_v6(number),
        _ => return None,
    })
}

fn change_membership(
    socket: &Socket,
    name: &str,
    group: &str,
    interface: &str,
) -> Option<io::Result<()>> {
    let v4 = || Ok::<_, io::Error>((address_of(group)?, address_of(interface)?));
    let v6 = || {
        let group = group.parse::<Ipv6Addr>().map_err(|_| invalid())?;
        Ok::<_, io::Error>((group, interface.parse::<f64>().map_or(0, whole)))
    };
    Some(match name {
        "ip-add-membership" => v4().and_then(|(group, at)| socket.join_multicast_v4(&group, &at)),
        "ip-drop-membership" => v4().and_then(|(group, at)| socket.leave_multicast_v4(&group, &at)),
        "ipv6-add-membership" => v6().and_then(|(group, at)| socket.join_multicast_v6(&group, at)),
        "ipv6-drop-membership" => {
            v6().and_then(|(group, at)| socket.leave_multicast_v6(&group, at))
        }
        _ => return None,
    })
}

/// A number of a script in the system's form.
fn whole(number: f64) -> u32 {
    number.clamp(0.0, i32::MAX.into()) as u32
}

fn address_of(text: &str) -> io::Result<Ipv4Addr> {
    if text == "*" {
        Ok(Ipv4Addr::UNSPECIFIED)
    } else {
        text.parse().map_err(|_| invalid())
    }
}

fn invalid() -> io::Error {
    io::ErrorKind::InvalidInput.into()
}

#[cfg(unix)]
fn reuse_port(socket: &Socket) -> io::Result<bool> {
    socket.reuse_port()
}

#[cfg(unix)]
fn set_reuse_port(socket: &Socket, on: bool) -> io::Result<()> {
    socket.set_reuse_port(on)
}

#[cfg(not(unix))]
fn reuse_port(_: &Socket) -> io::Result<bool> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(not(unix))]
fn set_reuse_port(_: &Socket, _: bool) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
