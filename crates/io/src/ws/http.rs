//! Plain HTTP for web pages: request heads and responses.

use tokio::sync::oneshot;
use tokio_tungstenite::tungstenite::http::header::{CONTENT_LENGTH, TRANSFER_ENCODING, UPGRADE};
use tokio_tungstenite::tungstenite::http::{
    HeaderMap, HeaderName, HeaderValue, Request, StatusCode,
};

use super::MAX_MESSAGE;

/// The largest head of a request.
pub(super) const MAX_HEAD: usize = 1 << 16;
const MAX_HEADERS: usize = 100;

/// The answer to an HTTP request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reply {
    /// The status code.
    pub status: u16,
    /// The body.
    pub data: Vec<u8>,
}

impl Reply {
    /// An answer without content.
    pub fn status(status: u16) -> Self {
        Self {
            status,
            data: Vec::new(),
        }
    }
}

/// The client that waits for the response.
pub struct Requester(pub(super) oneshot::Sender<Reply>);

impl Requester {
    /// Sends the answer.
    pub fn answer(self, reply: Reply) {
        // A client that is gone needs no response.
        let _ = self.0.send(reply);
    }
}

/// Method, target and header of a request.
#[derive(Debug)]
pub(super) struct Head {
    pub(super) method: String,
    /// As sent, with its query.
    pub(super) target: String,
    /// HTTP/1.1, not 1.0.
    pub(super) is_current: bool,
    pub(super) headers: HeaderMap,
}

impl Head {
    /// The head at the beginning of `bytes` and its length; nothing when more is to come.
    ///
    /// # Errors
    /// The status to answer with.
    pub(super) fn parse(bytes: &[u8]) -> Result<Option<(Self, usize)>, StatusCode> {
        let mut headers = [httparse::EMPTY_HEADER; MAX_HEADERS];
        let mut request = httparse::Request::new(&mut headers);
        match request.parse(bytes) {
            Ok(httparse::Status::Complete(length)) => Ok(Some((Self::new(&request)?, length))),
            Ok(httparse::Status::Partial) if bytes.len() < MAX_HEAD => Ok(None),
            Ok(httparse::Status::Partial) | Err(httparse::Error::TooManyHeaders) => {
                Err(StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE)
            }
            Err(_) => Err(StatusCode::BAD_REQUEST),
        }
    }

    fn new(request: &httparse::Request<'_, '_>) -> Result<Self, StatusCode> {
        let mut headers = HeaderMap::new();
        for header in request.headers.iter() {
            let name = HeaderName::from_bytes(header.name.as_bytes())
                .map_err(|_| StatusCode::BAD_REQUEST)?;
            let value =
                HeaderValue::from_bytes(header.value).map_err(|_| StatusCode::BAD_REQUEST)?;
            headers.append(name, value);
        }
        Ok(Self {
            method: request.method.unwrap_or_default().to_owned(),
            target: request.path.unwrap_or_default().to_owned(),
            is_current: request.version == Some(1),
            headers,
        })
    }

    /// Whether this is the beginning of a WebSocket connection.
    pub(super) fn is_upgrade(&self) -> bool {
        self.header(UPGRADE)
            .is_some_and(|value| value.eq_ignore_ascii_case("websocket"))
    }

    pub(super) fn header(&self, name: HeaderName) -> Option<&str> {
        self.headers.get(name)?.to_str().ok()
    }

    /// The same for the WebSocket library, which looks at method, version and header.
    ///
    /// # Errors
    /// When the method is none.
    pub(super) fn handshake(&self) -> Result<Request<()>, StatusCode> {
        if !self.is_current {
            return Err(StatusCode::BAD_REQUEST);
        }
        let request = Request::builder().method(self.method.as_str()).body(());
        let mut request = request.map_err(|_| StatusCode::BAD_REQUEST)?;
        *request.headers_mut() = self.headers.clone();
        Ok(request)
    }

    /// Whether the body is chunked.
    ///
    /// # Errors
    /// The status of the error: other encodings are not supported, and an additional length contradicts the encoding.
    pub(super) fn is_chunked(&self) -> Result<bool, StatusCode> {
        let mut encodings = self.headers.get_all(TRANSFER_ENCODING).iter();
        match (encodings.next(), encodings.next()) {
            (None, _) => Ok(false),
            (Some(_), _) if self.headers.contains_key(CONTENT_LENGTH) => {
                Err(StatusCode::BAD_REQUEST)
            }
            (Some(encoding), None) if encoding.as_bytes().eq_ignore_ascii_case(b"chunked") => {
                Ok(true)
            }
            _ => Err(StatusCode::NOT_IMPLEMENTED),
        }
    }

    /// Length of a body that is not chunked.
    ///
    /// # Errors
    /// The status to answer with.
    pub(super) fn body_length(&self) -> Result<usize, StatusCode> {
        let Some(value) = self.headers.get(CONTENT_LENGTH) else {
            return Ok(0);
        };
        let digits = value
            .to_str()
            .ok()
            .filter(|text| text.bytes().all(|byte| byte.is_ascii_digit()) && !text.is_empty());
        match digits.ok_or(StatusCode::BAD_REQUEST)?.parse() {
            Ok(length) if length <= MAX_MESSAGE => Ok(length),
            _ => Err(StatusCode::PAYLOAD_TOO_LARGE),
        }
    }
}

/// The bytes of an answer to a request for `target`.
pub(super) fn response(reply: &Reply, target: &str, with_body: bool) -> Vec<u8> {
    let reason = StatusCode::from_u16(reply.status)
        .ok()
        .and_then(|status| status.canonical_reason())
        .unwrap_or_default();
    let head = format!(
        "HTTP/1.1 {} {reason}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
        reply.status,
        content_type(target),
        reply.data.len(),
    );
    let body = if with_body {
        reply.data.as_slice()
    } else {
        &[]
    };
    [head.as_bytes(), body].concat()
}

/// Content types by extension, the longer before the shorter.
const CONTENT_TYPES: &[(&str, &str)] = &[
    (".js.map", "application/json; charset=UTF-8"),
    (".html", "text/html; charset=UTF-8"),
    (".htm", "text/html; charset=UTF-8"),
    (".js", "application/javascript; charset=UTF-8"),
    (".json", "application/json; charset=UTF-8"),
    (".css", "text/css; charset=UTF-8"),
    (".txt", "text/plain; charset=UTF-8"),
    (".svg", "image/svg+xml; charset=UTF-8"),
    (".png", "image/png"),
    (".jpg", "image/jpeg"),
    (".jpeg", "image/jpeg"),
    (".gif", "image/gif"),
    (".ico", "image/x-icon"),
    (".wasm", "application/wasm"),
];

/// The content type of a resource, by its name.
fn content_type(target: &str) -> &'static str {
    let path = target.split('?').next().unwrap_or_default();
    if path.is_empty() || path.ends_with('/') {
        return "text/html; charset=UTF-8";
    }
    let known = CONTENT_TYPES
        .iter()
        .find(|(extension, _)| path.ends_with(extension));
    known.map_or("application/octet-stream", |&(_, content_type)| {
        content_type
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head(text: &str) -> Head {
        let (head, length) = Head::parse(text.as_bytes())
            .expect("a good head")
            .expect("a complete head");
        assert_eq!(length, text.len());
        head
    }

    #[test]
    fn heads_of_requests() {
        let page = head("GET /a.js?x=1 HTTP/1.1\r\nHost: h\r\n\r\n");
        assert_eq!(
            (page.target.as_str(), page.is_upgrade(), page.body_length()),
            ("/a.js?x=1", false, Ok(0))
        );
        assert!(head("GET / HTTP/1.1\r\nUpgrade: WebSocket\r\n\r\n").is_upgrade());
        assert_eq!(
            head("POST / HTTP/1.0\r\ncontent-length: 3\r\n\r\n").body_length(),
            Ok(3)
        );
        assert!(
            Head::parse(b"GET / HT")
                .expect("so far it is good")
                .is_none()
        );
        assert_eq!(
            Head::parse(b"\x16\x03\x01\x02\x00").err(),
            Some(StatusCode::BAD_REQUEST)
        );
        let endless = vec![b'a'; MAX_HEAD];
        assert_eq!(
            Head::parse(&endless).err(),
            Some(StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE)
        );
    }

    #[test]
    fn any_bytes_are_a_head_or_none() {
        let good = b"POST /a?b HTTP/1.1\r\nContent-Length: 12\r\nUpgrade: websocket\r\n\r\n";
        for at in 0..good.len() {
            assert!(matches!(Head::parse(&good[..at]), Ok(None)), "{at} bytes");
            for byte in 0..=255 {
                let mut bytes = good.to_vec();
                bytes[at] = byte;
                if let Ok(Some((head, length))) = Head::parse(&bytes) {
                    assert!(length <= bytes.len());
                    let _ = (head.body_length(), head.handshake(), head.is_upgrade());
                }
            }
        }
    }

    #[test]
    fn lengths_that_cannot_be() {
        for (value, status) in [
            ("-1", 400),
            ("", 400),
            ("1, 1", 400),
            ("99999999999999999999", 413),
            ("32000001", 413),
        ] {
            let request = format!("POST / HTTP/1.1\r\nContent-Length: {value}\r\n\r\n");
            assert_eq!(
                head(&request)
                    .body_length()
                    .map_err(|status| status.as_u16()),
                Err(status),
                "{value:?}"
            );
        }
    }

    #[test]
    fn encodings_of_the_body() {
        for (headers, expected) in [
            ("", Ok(false)),
            ("Transfer-Encoding: Chunked\r\n", Ok(true)),
            (
                "Transfer-Encoding: gzip, chunked\r\n",
                Err(StatusCode::NOT_IMPLEMENTED),
            ),
            (
                "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n",
                Err(StatusCode::NOT_IMPLEMENTED),
            ),
            (
                "Transfer-Encoding: chunked\r\nContent-Length: 1\r\n",
                Err(StatusCode::BAD_REQUEST),
            ),
        ] {
            assert_eq!(
                head(&format!("POST / HTTP/1.1\r\n{headers}\r\n")).is_chunked(),
                expected,
                "{headers}"
            );
        }
    }

    #[test]
    fn content_types() {
        for (target, expected) in [
            ("/", "text/html; charset=UTF-8"),
            ("?a=/x.png", "text/html; charset=UTF-8"),
            ("/a.js?x=1", "application/javascript; charset=UTF-8"),
            ("/a.js.map", "application/json; charset=UTF-8"),
            ("/a/b.wasm", "application/wasm"),
            ("/a.tar", "application/octet-stream"),
        ] {
            assert_eq!(content_type(target), expected, "{target}");
        }
    }

    #[test]
    fn answers() {
        let reply = Reply {
            status: 200,
            data: b"1".to_vec(),
        };
        let text = String::from_utf8(response(&reply, "/a.txt", true)).expect("it is text");
        assert!(
            text.starts_with("HTTP/1.1 200 OK\r\n")
                && text.ends_with("Content-Length: 1\r\nConnection: close\r\n\r\n1")
        );
        assert!(response(&reply, "/a.txt", false).ends_with(b"\r\n\r\n"));
    }
}
