//! Methods of UDP objects and local datagrams.

use api_macro::api;

use super::methods::{Done, places, with_places};
use super::results::{Outcome, done};
use super::{AnySocket, Shared, access, class, prefix, stop};
use crate::{ApiFn, Args, Cx, FromScript, Result, functions};
use io::socket::{Datagram, Failure, Family, SocketAddress, Wait, numeric};
use scene::Data;
use scene::numbers;
use script::Source;
use script::{ApiError, LuaNumber, LuaString, Results, Text};

pub(crate) const FUNCTIONS: &[ApiFn] =
    functions![bind, connect, receive, receivefrom, send, sendto];

/// Default length limit of `receive`.
const SIZE: f64 = 8192.0;

/// A datagram object: 0 any, 1 unconnected, 2 connected.
pub(super) struct DatagramArg<const STATE: u8>(Shared<Datagram>);

type Any = DatagramArg<0>;
type Unconnected = DatagramArg<1>;
type Connected = DatagramArg<2>;

impl<const STATE: u8> FromScript for DatagramArg<STATE> {
    const TYPE: &'static str = "any";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        let refused = |class| {
            let wanted = ["any", "unconnected", "connected"][usize::from(STATE)];
            args.refused(&format!("{}{{{wanted}}} expected", prefix(class)))
        };
        match AnySocket::from_script(args) {
            Ok(AnySocket::Datagram(object, datagram)) => {
                let fits = STATE == 0 || datagram.borrow().connected == (STATE == 2);
                if fits {
                    Ok(Self(datagram))
                } else {
                    Err(refused(object.class))
                }
            }
            _ => Err(refused(class::UDP)),
        }
    }
}

/// Binds to an address and a port (`*` and 0 for any), or to a path.
#[api("socket.core.datagram:bind")]
fn bind(cx: &Cx, object: Unconnected, host: LuaString, port: Option<LuaString>) -> Result<Done> {
    let mut datagram = object.0.borrow_mut();
    let places = places(cx, datagram.family, true, &host, port.as_ref())?;
    Ok(with_places(places, |places| datagram.bind(places)))
}

/// Speaks to one peer from now on; with `*` to everybody.
#[api("socket.core.datagram:connect")]
fn connect(cx: &Cx, object: Any, host: LuaString, port: Option<LuaString>) -> Result<Done> {
    let mut datagram = object.0.borrow_mut();
    if datagram.family != Family::Unix && host.0 == b"*" {
        return Ok(done(datagram.disconnect()));
    }
    let places = places(cx, datagram.family, true, &host, port.as_ref())?;
    Ok(with_places(places, |places| datagram.connect(places)))
}

/// The next datagram; what is longer than `size` bytes is cut.
#[api("socket.core.datagram:receive")]
fn receive(cx: &Cx, object: Any, size: Option<LuaNumber>) -> Result<Outcome<Text>> {
    Ok(Outcome(
        received(cx, &object.0, size).map(|(data, _)| Text(data)),
    ))
}

/// The next datagram, with the address and the port it came from.
#[api("socket.core.datagram:receivefrom")]
fn receivefrom(cx: &Cx, object: Unconnected, size: Option<LuaNumber>) -> Result<Outcome<Results>> {
    Ok(Outcome(received(cx, &object.0, size).map(
        |(data, from)| {
            let data = Data::Text(data);
            Results(match from {
                SocketAddress::Net(from) => vec![
                    data,
                    Data::text(&from.ip().to_string()),
                    Data::Int(from.port().into()),
                ],
                SocketAddress::Path(path) => vec![data, Data::Text(path)],
            })
        },
    )))
}

type Arrived = std::result::Result<(Vec<u8>, SocketAddress), Failure>;

fn received(cx: &Cx, datagram: &Shared<Datagram>, size: Option<LuaNumber>) -> Arrived {
    let size = numbers::index(size.map_or(SIZE, |size| size.0));
    let datagram = datagram.borrow();
    datagram.receive(size, &Wait::begin(datagram.timeout, stop(cx)))
}

/// Sends a datagram to the peer.
#[api("socket.core.datagram:send")]
fn send(cx: &Cx, object: Connected, data: LuaString) -> Result<Outcome<f64>> {
    let mut datagram = object.0.borrow_mut();
    let wait = Wait::begin(datagram.timeout, stop(cx));
    Ok(sent(datagram.send(&data.0, None, &wait)))
}

/// Sends a datagram to an address (no name) and a port, or to a path.
#[api("socket.core.datagram:sendto")]
fn sendto(
    cx: &Cx,
    object: Unconnected,
    data: LuaString,
    host: LuaString,
    port: Option<LuaString>,
) -> Result<Outcome<f64>> {
    let mut datagram = object.0.borrow_mut();
    let place = if datagram.family == Family::Unix {
        access::check_local(cx, &host.0)?;
        SocketAddress::Path(host.0)
    } else {
        let missing = || ApiError::BadArgument {
            position: 4,
            reason: "string expected, got no value".into(),
        };
        let port = port.ok_or_else(missing)?;
        access::check_place(cx, datagram.family, &host.text(), &port.text())?;
        match numeric(&host.text(), &port.text(), datagram.family) {
            Ok(address) => SocketAddress::Net(address),
            Err(failure) => return Ok(Outcome(Err(failure))),
        }
    };
    let wait = Wait::begin(datagram.timeout, stop(cx));
    Ok(sent(datagram.send(&data.0, Some(&place), &wait)))
}

fn sent(result: std::result::Result<usize, Failure>) -> Outcome<f64> {
    Outcome(result.map(|count| count as f64))
}
