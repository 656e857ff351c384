//! Methods of TCP objects and local streams.

use std::net::Shutdown;
use std::rc::Rc;

use api_macro::api;

use super::methods::{Done, places, with_places};
use super::results::{Created, Outcome, Received, Sent, done};
use super::{AnySocket, Shared, Sockets, access, class, prefix, role_name, stop};
use crate::{ApiFn, Args, Cx, FromScript, Result, functions};
use io::socket::{Pattern, Role, Stream, Wait};
use scene::Data;
use scene::numbers;
use script::Source;
use script::{ApiError, LuaNumber, LuaString};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    bind, connect, listen, accept, receive, send, shutdown, getstats, setstats
];

/// LuaSocket's length of the queue of pending connections.
const BACKLOG: f64 = 32.0;

/// A stream in a role: the numbers of [`Role`], or any.
pub(super) struct StreamArg<const ROLE: u8> {
    class: i64,
    pub stream: Shared<Stream>,
}

const ANY: u8 = 0;
const MASTER: u8 = 1;
const CLIENT: u8 = 2;
const SERVER: u8 = 3;

type Any = StreamArg<ANY>;
type Master = StreamArg<MASTER>;
pub(super) type Client = StreamArg<CLIENT>;
type Server = StreamArg<SERVER>;

fn role(number: u8) -> Option<Role> {
    match number {
        MASTER => Some(Role::Master),
        CLIENT => Some(Role::Client),
        SERVER => Some(Role::Server),
        _ => None,
    }
}

impl<const ROLE: u8> FromScript for StreamArg<ROLE> {
    const TYPE: &'static str = "any";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        let wanted = role(ROLE);
        let refused = |class| {
            let wanted = wanted.map_or("any", role_name);
            args.refused(&format!("{}{{{wanted}}} expected", prefix(class)))
        };
        match AnySocket::from_script(args) {
            Ok(AnySocket::Stream(object, stream)) => {
                let fits = wanted.is_none_or(|wanted| stream.borrow().role == wanted);
                if fits {
                    Ok(Self {
                        class: object.class,
                        stream,
                    })
                } else {
                    Err(refused(object.class))
                }
            }
            _ => Err(refused(class::TCP)),
        }
    }
}

/// Binds to an address and a port (`*` and 0 for any), or to a path.
#[api("socket.core.stream:bind")]
fn bind(cx: &Cx, object: Master, host: LuaString, port: Option<LuaString>) -> Result<Done> {
    let mut stream = object.stream.borrow_mut();
    let places = places(cx, stream.family, false, &host, port.as_ref())?;
    Ok(with_places(places, |places| stream.bind(places)))
}

/// Connects to a host and a port, or to a path.
#[api("socket.core.stream:connect")]
fn connect(cx: &Cx, object: Any, host: LuaString, port: Option<LuaString>) -> Result<Done> {
    let mut stream = object.stream.borrow_mut();
    let places = places(cx, stream.family, false, &host, port.as_ref())?;
    let wait = Wait::begin(stream.timeout, stop(cx));
    Ok(with_places(places, |places| stream.connect(places, &wait)))
}

/// Becomes a server.
#[api("socket.core.stream:listen")]
fn listen(cx: &Cx, object: Master, backlog: Option<LuaNumber>) -> Result<Done> {
    let family = object.stream.borrow().family;
    if object.stream.borrow().is_unbound() {
        access::check_place(cx, family, "*", "0")?;
    }
    let backlog = backlog.map_or(BACKLOG, |backlog| backlog.0).max(0.0);
    let backlog = numbers::truncated_i32(backlog);
    Ok(done(object.stream.borrow_mut().listen(backlog)))
}

/// Waits for a connection and returns its object.
#[api("socket.core.stream:accept")]
fn accept(cx: &Cx, object: Server) -> Result<Outcome<Created>> {
    let accepted = {
        let stream = object.stream.borrow();
        stream.accept(&Wait::begin(stream.timeout, stop(cx)))
    };
    Ok(Outcome(accepted.map(|client| {
        cx.script_state::<Sockets>()
            .add_stream(object.class, client)
    })))
}

/// The argument that says how much to receive.
struct Amount(Pattern);

impl Amount {
    const LINE: Self = Self(Pattern::Line);

    fn named(name: &[u8]) -> Option<Self> {
        match name {
            [b'*', b'l', ..] => Some(Self(Pattern::Line)),
            [b'*', b'a', ..] => Some(Self(Pattern::All)),
            _ => None,
        }
    }
}

impl From<Amount> for Data {
    fn from(Amount(pattern): Amount) -> Self {
        match pattern {
            Pattern::Line => Self::text("*l"),
            Pattern::All => Self::text("*a"),
            Pattern::Count(count) => Self::Int(numbers::count(count)),
        }
    }
}

impl FromScript for Amount {
    const TYPE: &'static str = "string";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        match args.with_bytes(Self::named).flatten() {
            Some(amount) => Ok(amount),
            None => match args.lua_number() {
                Some(count) if count >= 0.0 => Ok(Self(Pattern::Count(numbers::index(count)))),
                _ => Err(args.refused("invalid receive pattern")),
            },
        }
    }
}

/// Receives a line (`*l`), everything (`*a`), or a number of bytes; a prefix goes in front and counts.
#[api("socket.core.stream:receive")]
fn receive(
    cx: &Cx,
    object: Client,
    #[default(Amount::LINE)] pattern: Amount,
    prefix: Option<LuaString>,
) -> Result<Received> {
    let sockets = cx.script_state::<Sockets>();
    let mut data = sockets.space.take();
    data.clear();
    data.extend(prefix.iter().flat_map(|prefix| &prefix.0));
    let Amount(pattern) = pattern;
    let is_enough =
        matches!(pattern, Pattern::Count(count) if !data.is_empty() && count <= data.len());
    let result = if is_enough {
        Ok(())
    } else {
        let mut stream = object.stream.borrow_mut();
        let wait = Wait::begin(stream.timeout, stop(cx));
        stream.receive(pattern, &mut data, &wait)
    };
    Ok(Received {
        sockets: Rc::clone(&sockets),
        data,
        result,
    })
}

/// Sends bytes `i` to `j` of the data.
#[api("socket.core.stream:send")]
fn send(
    cx: &Cx,
    object: Client,
    data: LuaString,
    i: Option<LuaNumber>,
    j: Option<LuaNumber>,
) -> Result<Sent> {
    let (start, end) = range(
        data.0.len(),
        i.map_or(1.0, |i| i.0),
        j.map_or(-1.0, |j| j.0),
    );
    let mut stream = object.stream.borrow_mut();
    let wait = Wait::begin(stream.timeout, stop(cx));
    let (count, result) = stream.send(data.0.get(start..end).unwrap_or_default(), &wait);
    Ok(Sent {
        last: (start + count) as f64,
        result,
    })
}

/// The bytes `i` to `j` as `string.sub` counts them: from where (0: the first) and up to which.
fn range(length: usize, i: f64, j: f64) -> (usize, usize) {
    let from_end = |index: f64| {
        if index < 0.0 {
            length as f64 + index + 1.0
        } else {
            index
        }
    };
    let start = numbers::index(from_end(i).max(1.0)) - 1;
    let end = numbers::index(from_end(j)).min(length);
    (start, end.max(start))
}

/// Ends one direction of the connection, or both.
#[api("socket.core.stream:shutdown")]
fn shutdown(_cx: &Cx, object: Client, how: Option<LuaString>) -> Result<f64> {
    let how = match how.as_ref().map_or(&b"both"[..], |how| &how.0) {
        b"receive" => Shutdown::Read,
        b"send" => Shutdown::Write,
        b"both" => Shutdown::Both,
        other => {
            let reason = format!("invalid option '{}'", String::from_utf8_lossy(other));
            return Err(ApiError::BadArgument {
                position: 2,
                reason,
            });
        }
    };
    object.stream.borrow().shutdown(how);
    Ok(1.0)
}

/// Bytes received, bytes sent, and the age in seconds.
#[api("socket.core.stream:getstats")]
fn getstats(_cx: &Cx, object: Client) -> Result<(f64, f64, f64)> {
    Ok(object.stream.borrow().stats())
}

/// Sets the values of `getstats`.
#[api("socket.core.stream:setstats")]
fn setstats(
    _cx: &Cx,
    object: Client,
    received: Option<LuaNumber>,
    sent: Option<LuaNumber>,
    age: Option<LuaNumber>,
) -> Result<f64> {
    let mut stream = object.stream.borrow_mut();
    let (old_received, old_sent, old_age) = stream.stats();
    let or = |value: Option<LuaNumber>, old| value.map_or(old, |value| value.0);
    stream.set_stats(
        or(received, old_received),
        or(sent, old_sent),
        or(age, old_age),
    );
    Ok(1.0)
}

#[cfg(test)]
mod tests {
    use super::range;

    #[test]
    fn ranges_count_as_string_sub_does() {
        assert_eq!(range(5, 1.0, -1.0), (0, 5));
        assert_eq!(range(5, 2.0, 3.0), (1, 3));
        assert_eq!(range(5, -2.0, -1.0), (3, 5));
        assert_eq!(range(5, -9.0, 99.0), (0, 5));
        assert_eq!(range(5, 4.0, 2.0), (3, 3));
        assert_eq!(range(0, 1.0, -1.0), (0, 0));
        assert_eq!(range(5, 9.0, -1.0), (8, 8));
        assert_eq!(range(5, f64::NAN, f64::INFINITY), (0, 5));
    }
}
