//! Requests of HTTP/1.1, read with bounds.

use std::io::{BufRead, Read, Result};

/// Bytes of the request line and the headers together.
const MAX_HEAD: usize = 32 << 10;
const MAX_HEADERS: usize = 64;
/// Bytes of a body.
pub(super) const MAX_BODY: usize = 16 << 20;

/// A request with its body.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Request {
    pub method: String,
    /// Without a query.
    pub path: String,
    /// Names in lower case.
    headers: Vec<(String, String)>,
    pub body: Vec<u8>,
}

/// What was read.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Received {
    Request(Request),
    /// The client has closed the connection.
    Closed,
    /// The status that says why it is no request.
    Bad(u16),
}

impl Request {
    /// The value of a header; the name is in lower case.
    pub(super) fn header(&self, name: &str) -> Option<&str> {
        let found = self.headers.iter().find(|(other, _)| other == name);
        found.map(|(_, value)| value.as_str())
    }

    #[cfg(test)]
    pub(super) fn with_headers(headers: &[(&str, &str)]) -> Self {
        let owned = |(name, value): &(&str, &str)| ((*name).to_owned(), (*value).to_owned());
        Self {
            headers: headers.iter().map(owned).collect(),
            ..Self::default()
        }
    }

    /// Bytes of the body; or the status that refuses it.
    fn length(&self) -> std::result::Result<usize, u16> {
        if self.header("transfer-encoding").is_some() {
            return Err(411);
        }
        let Some(text) = self.header("content-length") else {
            return Ok(0);
        };
        let length = text.parse::<usize>().map_err(|_| 400_u16)?;
        if length > MAX_BODY {
            Err(413)
        } else {
            Ok(length)
        }
    }
}

/// Reads a request. What it costs is bounded, whatever the client sends.
///
/// # Errors
/// When the connection fails, or says nothing for too long.
pub(super) fn receive(input: &mut impl BufRead) -> Result<Received> {
    let Some(head) = read_head(input)? else {
        return Ok(Received::Closed);
    };
    let Some(mut request) = parse_head(&head) else {
        let is_long = head.len() > MAX_HEAD;
        return Ok(Received::Bad(if is_long { 431 } else { 400 }));
    };
    let length = match request.length() {
        Ok(length) => length,
        Err(status) => return Ok(Received::Bad(status)),
    };
    input.take(length as u64).read_to_end(&mut request.body)?;
    if request.body.len() < length {
        return Ok(Received::Closed);
    }
    Ok(Received::Request(request))
}

/// Lines up to an empty one, or too many bytes; None at the end of the input.
fn read_head(input: &mut impl BufRead) -> Result<Option<Vec<u8>>> {
    let mut head = Vec::new();
    loop {
        let begun = head.len();
        let left = (MAX_HEAD + 1).saturating_sub(begun) as u64;
        let count = input.by_ref().take(left).read_until(b'\n', &mut head)?;
        if count == 0 && begun == 0 {
            return Ok(None);
        }
        let is_empty_line = head[begun..].trim_ascii().is_empty();
        if count == 0 || head.len() > MAX_HEAD || is_empty_line && begun > 0 {
            return Ok(Some(head));
        }
    }
}

fn parse_head(head: &[u8]) -> Option<Request> {
    let mut headers = [httparse::EMPTY_HEADER; MAX_HEADERS];
    let mut parsed = httparse::Request::new(&mut headers);
    if !parsed.parse(head).ok()?.is_complete() {
        return None;
    }
    let header = |header: &httparse::Header<'_>| {
        let value = std::str::from_utf8(header.value).ok()?;
        Some((header.name.to_ascii_lowercase(), value.trim().to_owned()))
    };
    Some(Request {
        method: parsed.method?.to_owned(),
        path: parsed.path?.split('?').next()?.to_owned(),
        headers: parsed.headers.iter().map(header).collect::<Option<_>>()?,
        body: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn received(text: &str) -> Received {
        receive(&mut text.as_bytes()).expect("nothing fails")
    }

    #[test]
    fn requests_follow_each_other() {
        let text = "POST /mcp?x=1 HTTP/1.1\r\nContent-Length: 2\r\nX-A:  b \r\n\r\n{}GET / HTTP/1.1\r\n\r\n";
        let mut input = text.as_bytes();
        let Ok(Received::Request(first)) = receive(&mut input) else {
            panic!("a request")
        };
        assert_eq!(
            (first.method.as_str(), first.path.as_str()),
            ("POST", "/mcp")
        );
        assert_eq!(
            (first.header("x-a"), first.body.as_slice()),
            (Some("b"), &b"{}"[..])
        );
        let Ok(Received::Request(second)) = receive(&mut input) else {
            panic!("another one")
        };
        assert_eq!(second.method, "GET");
        assert_eq!(receive(&mut input).expect("the end"), Received::Closed);
    }

    #[test]
    fn what_is_no_request_has_its_status() {
        let long = format!("GET / HTTP/1.1\r\nA: {}\r\n\r\n", "a".repeat(MAX_HEAD));
        let many = format!("GET / HTTP/1.1\r\n{}\r\n", "A: b\r\n".repeat(100));
        for (text, status) in [
            ("hello\r\n\r\n", 400),
            ("GET / HTTP/1.1\r\nContent-Length: -1\r\n\r\n", 400),
            ("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n", 411),
            (
                "POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n",
                413,
            ),
            ("GET / HTTP/1.1\r\nA: b", 400),
            (&long, 431),
            (&many, 400),
        ] {
            assert_eq!(received(text), Received::Bad(status), "{text:.40}");
        }
        assert_eq!(
            received("POST / HTTP/1.1\r\nContent-Length: 9\r\n\r\nab"),
            Received::Closed
        );
        assert_eq!(received(""), Received::Closed);
    }
}
