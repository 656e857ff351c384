//! The modules beside `sim`: one folder or file for each.
//!
//! Here stand their native functions. What is better said in Lua stands in `lua/`, in a file of the module's name.

mod cbor;
mod lfs;
mod mime;
mod remote;
mod sim_convex;
mod sim_subprocess;
mod sim_ws;
mod sim_zmq;
mod socket;
mod swanilda_test;

use std::collections::HashMap;
use std::sync::LazyLock;

use crate::api;
use crate::script::{Bound, Embedded, FILES, Registry};

use crate::script::{ApiError, ApiFn, ApiResult as Result, Args, Cx, FromScript, functions};

/// Native functions of Lua modules: `module.function` each. A Lua file of the module's name gets them as its second argument.
pub(crate) const LIBRARIES: &[(&str, &[ApiFn])] = &[
    ("org.conman.cbor", cbor::TREES),
    ("org.conman.cbor_c", cbor::HEADS),
    ("simCBOR", cbor::TREES),
    ("lfs", lfs::FUNCTIONS),
    ("lfs", lfs::LOCK),
    ("lfsx", lfs::FUNCTIONS),
    ("remote.ws", sim_ws::REMOTE),
    ("remote.ws", remote::NAMES),
    ("simConvex", sim_convex::FUNCTIONS),
    ("simSubprocess", sim_subprocess::FUNCTIONS),
    ("remote.zmq", remote::FUNCTIONS),
    ("socket.core", socket::FUNCTIONS),
    ("socket.core", socket::OBJECTS),
    ("socket.core", socket::METHODS),
    ("socket.core", socket::STREAM),
    ("socket.core", socket::DATAGRAM),
    ("socket.core", socket::OPTION),
    ("socket.core", socket::DNS),
    ("socket.unix", socket::FUNCTIONS),
    ("ssl", socket::TLS),
    ("ssl", socket::OBJECTS),
    ("ssl", socket::METHODS),
    ("ssl", socket::STREAM),
    ("mime.core", mime::FUNCTIONS),
    ("simWS", sim_ws::FUNCTIONS),
    ("swanilda.test", swanilda_test::FUNCTIONS),
    ("swanilda.test", swanilda_test::RUN),
];

/// Everything scripts can reach, by name. One per process.
pub(crate) fn registry() -> &'static Registry {
    static REGISTRY: LazyLock<Registry> = LazyLock::new(build);
    &REGISTRY
}

fn build() -> Registry {
    let mut registry = Registry { modules: embedded_modules(), libraries: libraries(), ..Registry::default() };
    api::add_to(&mut registry);
    registry
}

fn embedded_modules() -> HashMap<&'static str, Embedded> {
    FILES.iter().map(|&(name, source)| (name, Embedded::new(source))).collect()
}

fn libraries() -> HashMap<&'static str, Vec<Bound>> {
    let bound = |function: &'static ApiFn| Bound { name: function.name, function, deprecation: None };
    let mut libraries = HashMap::<_, Vec<_>>::new();
    let zmq = sim_zmq::TABLES.iter().map(|&functions| ("simZMQ", functions));
    for (module, functions) in LIBRARIES.iter().copied().chain(zmq) {
        libraries.entry(module).or_default().extend(functions.iter().map(bound));
    }
    libraries
}
