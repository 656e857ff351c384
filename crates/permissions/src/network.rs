//! Hosts and ports.

use std::net::IpAddr;
use std::str::FromStr;

/// A host, by name or address, at one port or at all.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HostRule {
    host: String,
    port: Option<u16>,
}

impl HostRule {
    /// A host at a port; without one, at all.
    pub fn new(host: &str, port: Option<u16>) -> Self {
        Self {
            host: canonical(host),
            port,
        }
    }

    /// Without a port, whether the host may be asked for. Names are compared as they stand: what a name leads to is the resolver's business.
    pub(super) fn admits(&self, host: &str, port: Option<u16>) -> bool {
        self.host == canonical(host) && (self.port.is_none() || port.is_none() || self.port == port)
    }
}

impl FromStr for HostRule {
    type Err = String;

    /// `HOST`, `HOST:PORT`, `[::1]:PORT`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("HOST or HOST:PORT is needed, not '{text}'");
        if text.parse::<IpAddr>().is_ok() {
            return Ok(Self::new(text, None));
        }
        let (host, port) = match text.rsplit_once(':') {
            Some((host, port)) if !host.ends_with(':') => {
                (host, Some(port.parse().map_err(|_| wrong())?))
            }
            _ => (text, None),
        };
        let bare = host
            .strip_prefix('[')
            .and_then(|host| host.strip_suffix(']'))
            .unwrap_or(host);
        if bare.is_empty() || (bare.contains(':') && bare == host) {
            Err(wrong())
        } else {
            Ok(Self::new(bare, port))
        }
    }
}

/// Addresses in one form, names in small letters.
fn canonical(host: &str) -> String {
    match host.parse::<IpAddr>() {
        Ok(address) => address.to_string(),
        Err(_) => host.trim_end_matches('.').to_ascii_lowercase(),
    }
}

/// As the option takes it.
pub(super) fn place(host: &str, port: Option<u16>) -> String {
    let host = if host.contains(':') {
        format!("[{host}]")
    } else {
        host.to_owned()
    };
    port.map_or_else(|| host.clone(), |port| format!("{host}:{port}"))
}
