//! Host names and services.
//!
//! The system's resolver cannot be interrupted: it runs on its own thread, which is abandoned when the wait ends.

use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};

use dns_lookup::{AddrFamily, AddrInfoHints, LookupError, LookupErrorKind, SockType};
use heap::brought_in;

use super::failure::system_words;
use super::wait::SLICE;
use super::{Failure, Family};

/// Name resolution for sockets of one sort.
#[derive(Clone, Copy)]
pub struct Lookup<'a> {
    /// The addresses that are wanted.
    pub family: Family,
    /// Datagrams; otherwise streams.
    pub datagrams: bool,
    /// Set when the result is no longer needed.
    pub stop: &'a AtomicBool,
}

impl Lookup<'_> {
    /// The addresses of a service of a host: a name, an address, or `*` for every address of this machine.
    pub fn resolve(&self, host: &str, service: &str) -> Result<Vec<SocketAddr>, Failure> {
        let port = port(service)?;
        if let Some(ip) = self
            .any_address(host)
            .or_else(|| host.parse::<IpAddr>().ok())
        {
            let port = port.map_or_else(
                || {
                    self.query("localhost", service)
                        .map(|found| found[0].port())
                },
                Ok,
            )?;
            let address = SocketAddr::new(ip, port);
            return if self.family.admits(address) {
                Ok(vec![address])
            } else {
                Err(wrong_family())
            };
        }
        let mut addresses = self.query(host, if port.is_some() { "" } else { service })?;
        if let Some(port) = port {
            addresses
                .iter_mut()
                .for_each(|address| address.set_port(port));
        }
        Ok(addresses)
    }

    fn any_address(&self, host: &str) -> Option<IpAddr> {
        (host == "*").then(|| match self.family {
            Family::Inet6 => Ipv6Addr::UNSPECIFIED.into(),
            _ => Ipv4Addr::UNSPECIFIED.into(),
        })
    }

    /// Queries the system. The answer is never empty.
    fn query(&self, host: &str, service: &str) -> Result<Vec<SocketAddr>, Failure> {
        let hints = self.hints();
        let found = brought_in(|| {
            let (host, service) = (host.to_owned(), service.to_owned());
            on_thread(self.stop, move || -> Result<Vec<_>, Failure> {
                let service = (!service.is_empty()).then_some(service.as_str());
                let found = dns_lookup::getaddrinfo(Some(&host), service, Some(hints))
                    .map_err(lookup_failure)?;
                Ok(found.flatten().map(|entry| entry.sockaddr).collect())
            })?
        })?;
        if found.is_empty() {
            Err(unknown_name())
        } else {
            Ok(found)
        }
    }

    fn hints(&self) -> AddrInfoHints {
        let kind = if self.datagrams {
            SockType::DGram
        } else {
            SockType::Stream
        };
        let address = match self.family {
            Family::Inet => AddrFamily::Inet.into(),
            Family::Inet6 => AddrFamily::Inet6.into(),
            Family::Any | Family::Unix => 0,
        };
        AddrInfoHints {
            socktype: kind.into(),
            address,
            ..AddrInfoHints::default()
        }
    }
}

/// A numeric address: no name is looked up.
pub fn numeric(host: &str, service: &str, family: Family) -> Result<SocketAddr, Failure> {
    let ip = host.parse().map_err(|_| unknown_name())?;
    let address = SocketAddr::new(ip, port(service)?.ok_or_else(unknown_name)?);
    if family.admits(address) {
        Ok(address)
    } else {
        Err(wrong_family())
    }
}

/// The name of an address; its digits when it has none.
pub fn name_of(address: SocketAddr, stop: &AtomicBool) -> Result<(String, String), Failure> {
    brought_in(|| {
        on_thread(stop, move || {
            dns_lookup::getnameinfo(&address, 0).map_err(lookup_failure)
        })?
    })
}

/// The name of this machine.
pub fn host_name() -> Result<String, Failure> {
    Ok(dns_lookup::get_hostname()?)
}

/// Runs `question` on a thread, which may outlive the simulator, and waits for its answer. Called outside of heaps.
fn on_thread<T: Send + 'static>(
    stop: &AtomicBool,
    question: impl FnOnce() -> T + Send + 'static,
) -> Result<T, Failure> {
    let (sender, answer) = mpsc::sync_channel(1);
    // An answer that arrives after the wait has ended is dropped.
    std::thread::Builder::new()
        .name("lookup".into())
        .spawn(move || drop(sender.send(question())))?;
    loop {
        match answer.recv_timeout(SLICE) {
            Ok(answer) => return Ok(answer),
            Err(RecvTimeoutError::Timeout) if stop.load(Ordering::Relaxed) => {
                return Err(Failure::Interrupted);
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Failure::words("the resolver failed"));
            }
        }
    }
}

/// The number of a port; None for the name of a service.
pub fn port(service: &str) -> Result<Option<u16>, Failure> {
    match service.parse::<f64>() {
        Ok(number) if number.fract() == 0.0 && (0.0..=65535.0).contains(&number) => {
            Ok(Some(number as u16))
        }
        Ok(_) => Err(Failure::words("service not supported for socket type")),
        Err(_) if service.is_empty() => Ok(Some(0)),
        Err(_) => Ok(None),
    }
}

fn unknown_name() -> Failure {
    Failure::words("host or service not provided, or not known")
}

fn wrong_family() -> Failure {
    Failure::words("Address family for hostname not supported")
}

fn lookup_failure(error: LookupError) -> Failure {
    Failure::words(match error.kind() {
        LookupErrorKind::Again => "temporary failure in name resolution",
        LookupErrorKind::Badflags => "invalid value for ai_flags",
        LookupErrorKind::NoName => return unknown_name(),
        LookupErrorKind::NoData => "No address associated with hostname",
        LookupErrorKind::Fail => "non-recoverable failure in name resolution",
        LookupErrorKind::Family => "ai_family not supported",
        LookupErrorKind::Memory => "memory allocation failure",
        LookupErrorKind::Service => "service not supported for socket type",
        LookupErrorKind::Socktype => "ai_socktype not supported",
        LookupErrorKind::System | LookupErrorKind::Unknown | LookupErrorKind::IO => {
            return Failure::Words(system_words(&io::Error::from(error)));
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_need_no_resolver() {
        let stop = AtomicBool::new(false);
        let lookup = Lookup {
            family: Family::Inet,
            datagrams: false,
            stop: &stop,
        };
        assert_eq!(
            lookup.resolve("127.0.0.1", "80"),
            Ok(vec![([127, 0, 0, 1], 80).into()])
        );
        assert_eq!(lookup.resolve("*", "0"), Ok(vec![([0, 0, 0, 0], 0).into()]));
        assert_eq!(lookup.resolve("::1", "80"), Err(wrong_family()));
        assert_eq!(numeric("localhost", "80", Family::Any), Err(unknown_name()));
        for odd in ["-1", "65536", "1.5", "inf", "nan"] {
            assert_eq!(
                port(odd),
                Err(Failure::words("service not supported for socket type")),
                "{odd}"
            );
        }
    }
}
