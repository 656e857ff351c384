//! Origin check of web pages. A browser lets any page connect to this machine, and sends the origin of the page.

use std::net::IpAddr;

/// The pages a server admits, by their origin.
#[derive(Debug, Clone)]
pub enum Pages {
    /// Pages of any origin.
    All,
    /// Those of this machine, and these.
    Own(Vec<String>),
}

impl Pages {
    /// Whether a connection is welcome; only browsers name an origin.
    pub(super) fn admit(&self, origin: Option<&str>) -> bool {
        match (self, origin) {
            (Self::All, _) | (_, None) => true,
            (Self::Own(others), Some(origin)) => {
                is_local(origin) || others.iter().any(|other| other == origin || other == "*")
            }
        }
    }
}

/// A page of a server on this machine. `null` is a page opened from the disk, but also a frame of any page.
fn is_local(origin: &str) -> bool {
    let Some((_, authority)) = origin.split_once("://") else {
        return false;
    };
    host_of(authority).is_some_and(|host| {
        host == "localhost"
            || host
                .parse::<IpAddr>()
                .is_ok_and(|address| address.is_loopback())
    })
}

/// The host of `host`, `host:port` or `[address]:port`; nothing when more than a port comes after it.
pub(super) fn host_of(authority: &str) -> Option<&str> {
    let (host, rest) = match authority.strip_prefix('[') {
        Some(rest) => rest.split_once(']')?,
        None => authority.split_at(authority.find(':').unwrap_or(authority.len())),
    };
    let is_port = |port: &str| port.bytes().all(|byte| byte.is_ascii_digit());
    (rest.is_empty() || rest.strip_prefix(':').is_some_and(is_port)).then_some(host)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_of_this_machine_are_welcome() {
        let own = Pages::Own(vec!["https://lab.example".to_owned()]);
        for origin in [
            "http://localhost:8000",
            "http://127.0.0.1",
            "https://[::1]:1",
            "https://lab.example",
        ] {
            assert!(own.admit(Some(origin)), "{origin}");
        }
        assert!(own.admit(None));
    }

    #[test]
    fn other_pages_are_not() {
        let own = Pages::Own(Vec::new());
        let others = [
            "null",
            "",
            "file://",
            "http://",
            "http://example.org",
            "http://localhost.example.org",
            "http://127.0.0.1.example.org",
            "http://127.0.0.1:1.evil.com",
            "http://localhost:80@evil.com",
            "http://[::1].evil.com",
            "http://[::1",
        ];
        for origin in others {
            assert!(!own.admit(Some(origin)), "{origin}");
            assert!(
                Pages::All.admit(Some(origin))
                    && Pages::Own(vec!["*".to_owned()]).admit(Some(origin)),
                "{origin}"
            );
        }
    }
}
