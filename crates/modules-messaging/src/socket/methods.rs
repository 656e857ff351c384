//! Methods shared by streams and datagrams.

use api_macro::api;

use super::results::{Outcome, done};
use super::{AnySocket, Sockets, access, descriptor};
use crate::{ApiFn, Cx, Result, functions};
use io::socket::{Failure, Family, Socket, SocketAddress, Timeout};
use scene::Data;
use scene::numbers;
use script::{ApiError, LuaNumber, LuaString, Results};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    collect,
    class_name,
    close,
    getfd,
    setfd,
    dirty,
    settimeout,
    gettimeout,
    getfamily,
    getsockname,
    getpeername
];

/// Drops an object that is no longer referenced; its socket is closed.
#[api("socket.core.collect")]
fn collect(cx: &Cx, object: AnySocket) -> Result<()> {
    let sockets = cx.script_state::<Sockets>();
    match object {
        AnySocket::Stream(object, stream) => {
            stream.borrow_mut().close();
            sockets.streams.borrow_mut().remove(object.id);
        }
        AnySocket::Datagram(object, _) => drop(sockets.datagrams.borrow_mut().remove(object.id)),
    }
    Ok(())
}

/// Class of the object, for `tostring`.
#[api("socket.core.class_name")]
fn class_name(_cx: &Cx, object: AnySocket) -> Result<String> {
    Ok(object.class_name())
}

/// Closes the socket; closing twice does no harm.
#[api("socket.core.any:close")]
fn close(_cx: &Cx, object: AnySocket) -> Result<f64> {
    match object {
        AnySocket::Stream(_, stream) => stream.borrow_mut().close(),
        AnySocket::Datagram(_, datagram) => datagram.borrow_mut().close(),
    }
    Ok(1.0)
}

/// The system's number of the socket; -1 for none.
#[api("socket.core.any:getfd")]
fn getfd(_cx: &Cx, object: AnySocket) -> Result<f64> {
    Ok(object
        .socket()
        .map_or(-1.0, |socket| descriptor(&socket) as f64))
}

/// Assigns another socket of this script to the object, by its number; -1 detaches the socket without closing it.
#[api("socket.core.any:setfd")]
fn setfd(cx: &Cx, object: AnySocket, number: LuaNumber) -> Result<()> {
    let sockets = cx.script_state::<Sockets>();
    let number = numbers::truncated(number.0);
    let socket = match number {
        -1 => None,
        _ => Some(
            sockets
                .by_descriptor()
                .remove(&number)
                .ok_or_else(|| not_ours(number))?,
        ),
    };
    let before = match object {
        AnySocket::Stream(_, stream) => stream.borrow_mut().replace_socket(socket),
        AnySocket::Datagram(_, datagram) => datagram.borrow_mut().replace_socket(socket),
    };
    let mut detached = sockets.detached.borrow_mut();
    detached.remove(&number);
    // A socket that another object holds stays open anyway.
    let left = before.filter(|socket| Socket::strong_count(socket) == 1);
    detached.extend(left.map(|socket| (descriptor(&socket), socket)));
    Ok(())
}

fn not_ours(number: i64) -> ApiError {
    ApiError::NotImplemented(format!(
        "setfd with {number}, which is no socket of this script"
    ))
}

/// Whether unread data have arrived.
#[api("socket.core.any:dirty")]
fn dirty(_cx: &Cx, object: AnySocket) -> Result<bool> {
    Ok(match object {
        AnySocket::Stream(_, stream) => stream.borrow().is_dirty(),
        AnySocket::Datagram(..) => false,
    })
}

/// Limits each wait (mode b) or whole operations (mode t); nil and negative numbers remove the limit.
#[api("socket.core.any:settimeout")]
fn settimeout(
    _cx: &Cx,
    object: AnySocket,
    seconds: Option<LuaNumber>,
    mode: Option<LuaString>,
) -> Result<f64> {
    let seconds = seconds.map_or(-1.0, |seconds| seconds.0);
    let mut timeout = timeout_of(&object);
    match mode.as_ref().map_or(&b"b"[..], |mode| &mode.0) {
        [b'b', ..] => timeout.block = seconds,
        [b'r' | b't', ..] => timeout.total = seconds,
        _ => {
            return Err(ApiError::BadArgument {
                position: 3,
                reason: "invalid timeout mode".into(),
            });
        }
    }
    match object {
        AnySocket::Stream(_, stream) => stream.borrow_mut().timeout = timeout,
        AnySocket::Datagram(_, datagram) => datagram.borrow_mut().timeout = timeout,
    }
    Ok(1.0)
}

/// Both limits in seconds; -1 for none.
#[api("socket.core.any:gettimeout")]
fn gettimeout(_cx: &Cx, object: AnySocket) -> Result<(f64, f64)> {
    let timeout = timeout_of(&object);
    Ok((timeout.block, timeout.total))
}

fn timeout_of(object: &AnySocket) -> Timeout {
    match object {
        AnySocket::Stream(_, stream) => stream.borrow().timeout,
        AnySocket::Datagram(_, datagram) => datagram.borrow().timeout,
    }
}

/// `inet4` or `inet6`.
#[api("socket.core.any:getfamily")]
fn getfamily(_cx: &Cx, object: AnySocket) -> Result<&'static str> {
    let family = match object {
        AnySocket::Stream(_, stream) => stream.borrow().family,
        AnySocket::Datagram(_, datagram) => datagram.borrow().family,
    };
    Ok(if family == Family::Inet6 {
        "inet6"
    } else {
        "inet4"
    })
}

/// Address, port (as a string) and family of this end; or the path.
#[api("socket.core.any:getsockname")]
fn getsockname(_cx: &Cx, object: AnySocket) -> Result<Outcome<Results>> {
    let place = match object {
        AnySocket::Stream(_, stream) => stream.borrow().local(),
        AnySocket::Datagram(_, datagram) => datagram.borrow().local(),
    };
    Ok(described(place, |port| Data::text(&port.to_string())))
}

/// Address, port and family of the other end; or the path.
#[api("socket.core.any:getpeername")]
fn getpeername(_cx: &Cx, object: AnySocket) -> Result<Outcome<Results>> {
    let place = match object {
        AnySocket::Stream(_, stream) => stream.borrow().peer(),
        AnySocket::Datagram(_, datagram) => datagram.borrow().peer(),
    };
    Ok(described(place, |port| Data::Int(port.into())))
}

fn described(
    place: std::result::Result<SocketAddress, Failure>,
    port: impl Fn(u16) -> Data,
) -> Outcome<Results> {
    Outcome(place.map(|place| match place {
        SocketAddress::Net(address) => {
            let family = if address.is_ipv6() { "inet6" } else { "inet" };
            Results(vec![
                Data::text(&address.ip().to_string()),
                port(address.port()),
                Data::text(family),
            ])
        }
        SocketAddress::Path(path) => Results(vec![Data::Text(path)]),
    }))
}

/// The addresses of a host and a service, or of a path.
pub(super) fn places(
    cx: &Cx,
    family: Family,
    datagrams: bool,
    host: &LuaString,
    service: Option<&LuaString>,
) -> Result<std::result::Result<Vec<SocketAddress>, Failure>> {
    if family == Family::Unix {
        access::check_local(cx, &host.0)?;
        return Ok(Ok(vec![SocketAddress::Path(host.0.clone())]));
    }
    let missing = || ApiError::BadArgument {
        position: 3,
        reason: "string expected, got no value".into(),
    };
    let service = service.ok_or_else(missing)?;
    access::check_place(cx, family, &host.text(), &service.text())?;
    let lookup = ::io::socket::Lookup {
        family,
        datagrams,
        stop: super::stop(cx),
    };
    let found = lookup.resolve(&host.text(), &service.text());
    Ok(found.map(|found| found.into_iter().map(SocketAddress::Net).collect()))
}

/// For methods whose only result is that all is well.
pub(super) type Done = Outcome<f64>;

/// Runs `action` with the places, if there are any.
pub(super) fn with_places(
    places: std::result::Result<Vec<SocketAddress>, Failure>,
    action: impl FnOnce(&[SocketAddress]) -> std::result::Result<(), Failure>,
) -> Done {
    done(places.and_then(|places| action(&places)))
}
