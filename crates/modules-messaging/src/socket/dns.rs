//! `socket.dns`: names and addresses.

use std::net::SocketAddr;

use api_macro::api;

use super::access::check_lookup;
use super::results::Outcome;
use super::stop;
use crate::{ApiFn, Cx, Result, functions};
use io::socket::{Failure, Family, Lookup, host_name, name_of};
use scene::Data;
use script::{LuaString, Results};

pub(crate) const FUNCTIONS: &[ApiFn] =
    functions![toip, tohostname, getaddrinfo, getnameinfo, gethostname];

type Found<T> = std::result::Result<T, Failure>;

fn addresses(cx: &Cx, host: &str, service: &str, family: Family) -> Found<Vec<SocketAddr>> {
    Lookup {
        family,
        datagrams: false,
        stop: stop(cx),
    }
    .resolve(host, service)
}

/// Information about a host: `name`, `alias`, `ip`.
fn resolved(name: &str, ips: &[String]) -> Data {
    let ips = ips.iter().map(|ip| Data::text(ip)).collect();
    Data::map([
        ("name", Data::text(name)),
        ("alias", Data::Array(Vec::new())),
        ("ip", Data::Array(ips)),
    ])
}

/// The words of the older functions.
fn not_found(failure: Failure) -> Failure {
    if failure == Failure::Interrupted {
        failure
    } else {
        Failure::words("host not found")
    }
}

/// The IPv4 address of a host, and what is known of it.
#[api("socket.core.dns:toip")]
fn toip(cx: &Cx, host: LuaString) -> Result<Outcome<Results>> {
    let host = host.text();
    check_lookup(cx, &host)?;
    let found = addresses(cx, &host, "0", Family::Inet).map_err(not_found);
    Ok(Outcome(found.map(|found| {
        let ips: Vec<String> = found
            .iter()
            .map(|address| address.ip().to_string())
            .collect();
        Results(vec![Data::text(&ips[0]), resolved(&host, &ips)])
    })))
}

/// The name of a host, and what is known of it.
#[api("socket.core.dns:tohostname")]
fn tohostname(cx: &Cx, host: LuaString) -> Result<Outcome<Results>> {
    check_lookup(cx, &host.text())?;
    let named = addresses(cx, &host.text(), "0", Family::Inet).and_then(|found| {
        let (name, _) = name_of(found[0], stop(cx))?;
        Ok((name, found[0].ip().to_string()))
    });
    let named = named.map_err(not_found);
    Ok(Outcome(named.map(|(name, ip)| {
        Results(vec![Data::text(&name), resolved(&name, &[ip])])
    })))
}

/// All addresses of a host: a list of tables with `family` and `addr`.
#[api("socket.core.dns:getaddrinfo")]
fn getaddrinfo(cx: &Cx, host: LuaString) -> Result<Outcome<Data>> {
    let entry = |address: SocketAddr| {
        let family = if address.is_ipv6() { "inet6" } else { "inet" };
        Data::map([
            ("family", Data::text(family)),
            ("addr", Data::text(&address.ip().to_string())),
        ])
    };
    check_lookup(cx, &host.text())?;
    let found = addresses(cx, &host.text(), "0", Family::Any);
    Ok(Outcome(found.map(|found| {
        Data::Array(found.into_iter().map(entry).collect())
    })))
}

/// The names of a host's addresses, and the name of a service.
#[api("socket.core.dns:getnameinfo")]
fn getnameinfo(
    cx: &Cx,
    host: Option<LuaString>,
    service: Option<LuaString>,
) -> Result<Outcome<Results>> {
    let text = |given: &Option<LuaString>| given.as_ref().map(|given| given.text().into_owned());
    let (host, service) = (text(&host), text(&service));
    let name = host.as_deref().unwrap_or("127.0.0.1");
    check_lookup(cx, name)?;
    let found = addresses(cx, name, service.as_deref().unwrap_or("0"), Family::Any);
    let named = found.and_then(|found| {
        found
            .into_iter()
            .map(|address| name_of(address, stop(cx)))
            .collect::<Found<Vec<(String, String)>>>()
    });
    Ok(Outcome(named.map(|named| {
        let names = named
            .iter()
            .filter(|_| host.is_some())
            .map(|(name, _)| Data::text(name))
            .collect();
        let service = service
            .and(named.first())
            .map(|(_, service)| Data::text(service));
        Results([Data::Array(names)].into_iter().chain(service).collect())
    })))
}

/// The name of this machine.
#[api("socket.core.dns:gethostname")]
fn gethostname(_cx: &Cx) -> Result<Outcome<String>> {
    Ok(Outcome(host_name()))
}
