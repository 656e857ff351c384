//! The native part of LuaSocket's modules: what a script's sockets are, and the functions that belong to none.
//!
//! Scripts hold userdata that name a socket by its number; the sockets are kept for the script's state and go with it. The Lua files
//! `lua/network/socket/*.lua` make classes of these functions.

mod access;
mod datagram;
mod dns;
mod methods;
mod option;
mod results;
mod stream;
mod tls;

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::ffi::c_int;
use std::rc::Rc;
use std::sync::atomic::AtomicBool;

use api_macro::api;

use super::{ApiFn, Args, Cx, FromScript, Module, Result, functions};
use io::socket::{self, Datagram, Failure, Family, Role, Socket, Stream, descriptor};
use scene::Data;
use scene::numbers;
use script::Source;
use script::wall_clock;
use script::{ApiError, ByHandle, LuaNumber, LuaObject, Outside, Results};

use results::{Created, Outcome};

/// Objects are the state's, in a replay too; when one is collected is none of the run's doing.
const OUTSIDE: Outside = Outside::AllBut(&["socket.core.collect", "socket.core.define"]);

/// The core of LuaSocket: `lua/network/socket/core.lua` makes classes of these functions.
pub static CORE: Module = Module {
    inner: &[
        FUNCTIONS,
        OBJECTS,
        methods::FUNCTIONS,
        stream::FUNCTIONS,
        datagram::FUNCTIONS,
        option::FUNCTIONS,
        dns::FUNCTIONS,
    ],
    outside: OUTSIDE,
    ..Module::new("socket.core")
};
/// The module `socket.unix`.
pub static UNIX: Module = Module {
    inner: &[FUNCTIONS],
    outside: OUTSIDE,
    ..Module::new("socket.unix")
};
/// The module `ssl`.
pub static SSL: Module = Module {
    inner: &[
        tls::FUNCTIONS,
        OBJECTS,
        methods::FUNCTIONS,
        stream::FUNCTIONS,
    ],
    outside: OUTSIDE,
    ..Module::new("ssl")
};

const FUNCTIONS: &[ApiFn] = functions![
    tcp,
    tcp4,
    tcp6,
    udp,
    udp4,
    udp6,
    unix_stream,
    unix_dgram,
    poll,
    gettime,
    sleep
];
/// Functions that look at the stack themselves.
const OBJECTS: &[ApiFn] = &[ApiFn {
    name: "socket.core.define",
    doc: "Makes a table the metatable of a class of objects.",
    params: &[],
    returns: &[],
    mutates: false,
    call: define,
    call_data: script::needs_lua,
}];

/// Classes of objects; the Lua files know them by these numbers.
mod class {
    pub const TCP: i64 = 1;
    pub const UNIX_STREAM: i64 = 2;
    pub const TLS: i64 = 3;
    pub const UDP: i64 = 4;
    pub const UNIX_DATAGRAM: i64 = 5;
}

type Shared<T> = Rc<RefCell<T>>;

/// The sockets of a script's state.
#[derive(Default)]
struct Sockets {
    streams: RefCell<ByHandle<Shared<Stream>>>,
    datagrams: RefCell<ByHandle<Shared<Datagram>>>,
    /// Sockets whose objects were told to hold none (`setfd(-1)`), by number.
    detached: RefCell<BTreeMap<i64, Socket>>,
    /// Memory for what is being received.
    space: Cell<Vec<u8>>,
}

impl Sockets {
    fn add_stream(&self, class: i64, stream: Stream) -> Created {
        let id = self.streams.borrow_mut().add(Rc::new(RefCell::new(stream)));
        Created(LuaObject { class, id })
    }

    fn add_datagram(&self, class: i64, datagram: Datagram) -> Created {
        let id = self
            .datagrams
            .borrow_mut()
            .add(Rc::new(RefCell::new(datagram)));
        Created(LuaObject { class, id })
    }

    fn any(&self, object: LuaObject) -> Option<AnySocket> {
        match object.class {
            class::TCP | class::UNIX_STREAM | class::TLS => {
                let stream = self.streams.borrow_mut().get_mut(object.id).cloned();
                stream.map(|stream| AnySocket::Stream(object, stream))
            }
            _ => {
                let datagram = self.datagrams.borrow_mut().get_mut(object.id).cloned();
                datagram.map(|datagram| AnySocket::Datagram(object, datagram))
            }
        }
    }

    /// Every open socket by its number.
    fn by_descriptor(&self) -> BTreeMap<i64, Socket> {
        let mut all = self.detached.borrow().clone();
        let streams = self.streams.borrow();
        let datagrams = self.datagrams.borrow();
        let streams = streams
            .values()
            .filter_map(|stream| stream.borrow().socket().cloned());
        let datagrams = datagrams
            .values()
            .filter_map(|datagram| datagram.borrow().socket().cloned());
        all.extend(
            streams
                .chain(datagrams)
                .map(|socket| (descriptor(&socket), socket)),
        );
        all
    }
}

/// An object given as an argument.
enum AnySocket {
    Stream(LuaObject, Shared<Stream>),
    Datagram(LuaObject, Shared<Datagram>),
}

impl AnySocket {
    /// `tcp{master}` and so on.
    fn class_name(&self) -> String {
        match self {
            Self::Stream(object, _) if object.class == class::TLS => "SSL connection".into(),
            Self::Stream(object, stream) => format!(
                "{}{{{}}}",
                prefix(object.class),
                role_name(stream.borrow().role)
            ),
            Self::Datagram(object, datagram) => {
                let role = if datagram.borrow().connected {
                    "connected"
                } else {
                    "unconnected"
                };
                format!("{}{{{role}}}", prefix(object.class))
            }
        }
    }

    fn socket(&self) -> Option<Socket> {
        match self {
            Self::Stream(_, stream) => stream.borrow().socket().cloned(),
            Self::Datagram(_, datagram) => datagram.borrow().socket().cloned(),
        }
    }
}

fn prefix(class: i64) -> &'static str {
    match class {
        class::UNIX_STREAM => "unixstream",
        class::TLS => "ssl",
        class::UDP => "udp",
        class::UNIX_DATAGRAM => "unixdgram",
        _ => "tcp",
    }
}

fn role_name(role: Role) -> &'static str {
    match role {
        Role::Master => "master",
        Role::Client => "client",
        Role::Server => "server",
    }
}

impl FromScript for AnySocket {
    const TYPE: &'static str = "any";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        let sockets = args.context()?.script_state::<Sockets>();
        args.object()
            .and_then(|object| sockets.any(object))
            .ok_or_else(|| args.refused("socket expected"))
    }
}

/// Whether a running script must stop waiting.
fn stop<'a>(cx: &'a Cx<'_>) -> &'a AtomicBool {
    &cx.options().stop
}

fn define(args: &mut Args<'_>) -> Result<c_int> {
    let class = args.take::<i64>()?;
    let stack = args.stack();
    if !args.is_table(2) {
        return Err(ApiError::ArgumentType);
    }
    stack.push_value(2);
    stack.define_class(class);
    Ok(0)
}

fn new_stream(cx: &Cx, class: i64, family: Family) -> Outcome<Created> {
    Outcome(
        Stream::new(family).map(|stream| cx.script_state::<Sockets>().add_stream(class, stream)),
    )
}

fn new_datagram(cx: &Cx, class: i64, family: Family) -> Outcome<Created> {
    Outcome(
        Datagram::new(family)
            .map(|datagram| cx.script_state::<Sockets>().add_datagram(class, datagram)),
    )
}

/// A TCP object; its first address decides on the family.
#[api("socket.core.tcp")]
fn tcp(cx: &Cx) -> Result<Outcome<Created>> {
    Ok(new_stream(cx, class::TCP, Family::Any))
}

/// A TCP object for IPv4.
#[api("socket.core.tcp4")]
fn tcp4(cx: &Cx) -> Result<Outcome<Created>> {
    Ok(new_stream(cx, class::TCP, Family::Inet))
}

/// A TCP object for IPv6.
#[api("socket.core.tcp6")]
fn tcp6(cx: &Cx) -> Result<Outcome<Created>> {
    Ok(new_stream(cx, class::TCP, Family::Inet6))
}

/// A UDP object; its first address decides on the family.
#[api("socket.core.udp")]
fn udp(cx: &Cx) -> Result<Outcome<Created>> {
    Ok(new_datagram(cx, class::UDP, Family::Any))
}

/// A UDP object for IPv4.
#[api("socket.core.udp4")]
fn udp4(cx: &Cx) -> Result<Outcome<Created>> {
    Ok(new_datagram(cx, class::UDP, Family::Inet))
}

/// A UDP object for IPv6.
#[api("socket.core.udp6")]
fn udp6(cx: &Cx) -> Result<Outcome<Created>> {
    Ok(new_datagram(cx, class::UDP, Family::Inet6))
}

/// A stream object for paths of this machine.
#[api("socket.core.unix_stream")]
fn unix_stream(cx: &Cx) -> Result<Outcome<Created>> {
    Ok(new_stream(cx, class::UNIX_STREAM, Family::Unix))
}

/// A datagram object for paths of this machine.
#[api("socket.core.unix_dgram")]
fn unix_dgram(cx: &Cx) -> Result<Outcome<Created>> {
    Ok(new_datagram(cx, class::UNIX_DATAGRAM, Family::Unix))
}

/// Waits for sockets, given by their numbers. Returns for each whether it is ready.
#[api("socket.core.poll")]
fn poll(cx: &Cx, readers: Vec<f64>, writers: Vec<f64>, seconds: f64) -> Result<Results> {
    let known = cx.script_state::<Sockets>().by_descriptor();
    let find = |numbers: &[f64]| {
        numbers
            .iter()
            .map(|&number| find(&known, number))
            .collect::<Result<Vec<_>>>()
    };
    let ready = socket::select(&find(&readers)?, &find(&writers)?, seconds, stop(cx));
    let (readable, writable) = ready.map_err(raised)?;
    let list = |ready: Vec<bool>| Data::Array(ready.into_iter().map(Data::Bool).collect());
    Ok(Results(vec![list(readable), list(writable)]))
}

fn find(known: &BTreeMap<i64, Socket>, number: f64) -> Result<Socket> {
    let unknown = || ApiError::Other(format!("descriptor {number} is no socket of this script."));
    known
        .get(&numbers::truncated(number))
        .cloned()
        .ok_or_else(unknown)
}

/// A failure scripts do not get as a result.
fn raised(failure: Failure) -> ApiError {
    match failure {
        Failure::Interrupted => ApiError::Interrupted,
        _ => ApiError::Other(failure.text().to_owned()),
    }
}

/// Unix time in seconds.
#[api("socket.core.gettime")]
fn gettime(_cx: &Cx) -> Result<f64> {
    Ok(wall_clock::unix_seconds())
}

/// Blocks the script.
#[api("socket.core.sleep")]
fn sleep(cx: &Cx, seconds: LuaNumber) -> Result<()> {
    socket::sleep(seconds.0, stop(cx)).map_err(raised)
}
