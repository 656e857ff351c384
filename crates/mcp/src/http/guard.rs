//! Who may speak to the server.

use ring::rand::{SecureRandom, SystemRandom};

use super::request::Request;

/// What a client has to know.
#[derive(Clone)]
pub struct Secret(String);

impl Secret {
    /// 128 random bits.
    ///
    /// # Errors
    /// When the system has no random numbers.
    pub fn random() -> std::io::Result<Self> {
        let mut bytes = [0; 16];
        let filled = SystemRandom::new().fill(&mut bytes);
        filled.map_err(|_| std::io::Error::other("the system has no random numbers"))?;
        Ok(Self(format!("{:032x}", u128::from_be_bytes(bytes))))
    }

    /// A secret of the user's own; None if it is too short to be one, or cannot stand in a header.
    pub fn given(text: &str) -> Option<Self> {
        let is_long = text.len() >= 16;
        let is_plain = text.bytes().all(|byte| byte.is_ascii_graphic());
        (is_long && is_plain).then(|| Self(text.to_owned()))
    }

    /// As it stands in the header.
    pub fn text(&self) -> &str {
        &self.0
    }

    /// All bytes are compared, so that time says nothing about how many of them are right.
    fn is(&self, text: &str) -> bool {
        let pairs = text.bytes().zip(self.0.bytes());
        let differences = pairs.fold(0, |all, (a, b)| all | (a ^ b));
        differences == 0 && text.len() == self.0.len()
    }
}

/// Checks requests before anything is done.
pub(super) struct Guard {
    secret: Secret,
}

/// Why a request is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Refusal {
    /// A page of another machine sent it.
    Origin,
    /// The secret is missing or wrong.
    Secret,
}

impl Guard {
    pub(super) fn new(secret: Secret) -> Self {
        Self { secret }
    }

    pub(super) fn check(&self, request: &Request) -> Result<(), Refusal> {
        let is_foreign = |name| request.header(name).is_some_and(|value| !is_local(value));
        if is_foreign("origin") || is_foreign("host") {
            return Err(Refusal::Origin);
        }
        let token = request.header("authorization").and_then(bearer);
        if token.is_some_and(|token| self.secret.is(token)) {
            Ok(())
        } else {
            Err(Refusal::Secret)
        }
    }
}

fn bearer(header: &str) -> Option<&str> {
    let (scheme, token) = header.split_once(' ')?;
    scheme.eq_ignore_ascii_case("bearer").then(|| token.trim())
}

/// Whether an origin or a host is this machine.
fn is_local(value: &str) -> bool {
    let host = value
        .strip_prefix("http://")
        .or_else(|| value.strip_prefix("https://"))
        .unwrap_or(value);
    let name = match host.strip_prefix('[') {
        Some(rest) => rest.split(']').next(),
        None => host.split(':').next(),
    };
    matches!(name, Some("localhost" | "127.0.0.1" | "::1"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(headers: &[(&str, &str)]) -> Request {
        Request::with_headers(headers)
    }

    fn guard() -> Guard {
        Guard::new(Secret::given("0123456789abcdef").expect("long enough"))
    }

    #[test]
    fn the_secret_is_needed() {
        let check = |value| guard().check(&request(&[("authorization", value)]));
        assert_eq!(check("Bearer 0123456789abcdef"), Ok(()));
        assert_eq!(check("bearer 0123456789abcdef"), Ok(()));
        for wrong in [
            "Bearer 0123456789abcdeF",
            "Bearer 0123456789abcde",
            "Bearer 0123456789abcdef0",
            "Basic 0123456789abcdef",
            "0123456789abcdef",
            "",
        ] {
            assert_eq!(check(wrong), Err(Refusal::Secret), "{wrong}");
        }
        assert_eq!(guard().check(&request(&[])), Err(Refusal::Secret));
    }

    #[test]
    fn pages_and_names_of_other_machines_are_refused_even_with_the_secret() {
        let check = |name, value| {
            guard().check(&request(&[
                (name, value),
                ("authorization", "Bearer 0123456789abcdef"),
            ]))
        };
        for local in [
            "http://localhost:3000",
            "http://127.0.0.1",
            "https://[::1]:80",
        ] {
            assert_eq!(check("origin", local), Ok(()), "{local}");
        }
        for foreign in [
            "https://example.com",
            "http://localhost.example.com",
            "null",
            "http://127.0.0.1.example.com",
        ] {
            assert_eq!(check("origin", foreign), Err(Refusal::Origin), "{foreign}");
        }
        assert_eq!(
            check("host", "rebound.example.com:80"),
            Err(Refusal::Origin)
        );
        assert_eq!(check("host", "127.0.0.1:80"), Ok(()));
    }

    #[test]
    fn short_secrets_are_none() {
        assert!(Secret::given("0123456789abcde").is_none());
        assert!(Secret::given("0123456789abcdef\r\nx").is_none());
    }
}
