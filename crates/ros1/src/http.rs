//! HTTP, as much as XML-RPC needs: POST of a text, and a text as the answer.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::Duration;

use crate::clock::Deadline;
use crate::network::{NodeNetwork, Place, timed_out};
use crate::{Error, Result, limits};

/// The longest head of a request or an answer.
const HEAD: usize = 16 << 10;

/// Most lines of a head.
const HEADERS: usize = 64;

/// Sends a text and reads the answer, all within a time limit.
pub(crate) fn post(
    network: NodeNetwork,
    place: &Place,
    body: &str,
    timeout: Duration,
) -> Result<Vec<u8>> {
    let deadline = Deadline::after(timeout);
    let mut stream = network.connect(place, deadline)?;
    stream.set_write_timeout(Some(deadline.left().ok_or_else(timed_out)?))?;
    let head = format!(
        "POST / HTTP/1.1\r\nHost: {}:{}\r\nContent-Type: text/xml\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
        place.host,
        place.port,
        body.len()
    );
    stream.write_all((head + body).as_bytes())?;
    let mut reader = Reader {
        stream: &mut stream,
        buffer: Vec::new(),
        timeout: ReadTimeout::Until(deadline),
    };
    let (length, status) = reader
        .head(answer_head)?
        .ok_or_else(|| Error::protocol("no answer"))?;
    let body = reader.body(length)?;
    if status == 200 {
        Ok(body)
    } else {
        Err(Error::protocol(format!("HTTP status {status}")))
    }
}

/// Answers requests until the other side closes the connection.
///
/// # Errors
/// When it says something else, or nothing for too long.
pub(crate) fn serve(stream: &mut TcpStream, answer: impl Fn(&[u8]) -> String) -> Result<()> {
    stream.set_write_timeout(Some(limits::SILENCE_TIMEOUT))?;
    let mut left_over = Vec::new();
    loop {
        let mut reader = Reader {
            stream,
            buffer: left_over,
            timeout: ReadTimeout::Each(limits::SILENCE_TIMEOUT),
        };
        let Some((length, ())) = reader.head(request_head)? else {
            return Ok(());
        };
        let length = length.ok_or_else(|| Error::protocol("a request without Content-Length"))?;
        let body = reader.body(Some(length))?;
        left_over = reader.buffer;
        let text = answer(&body);
        let head = format!(
            "HTTP/1.1 200 OK\r\nContent-Type: text/xml\r\nContent-Length: {}\r\n\r\n",
            text.len()
        );
        stream.write_all((head + &text).as_bytes())?;
    }
}

/// What the head of a message says: the length of its body, if it is stated, and something else.
type Head<T> = (Option<usize>, T);

fn answer_head(bytes: &[u8]) -> Result<Option<(usize, Head<u16>)>> {
    let mut headers = [httparse::EMPTY_HEADER; HEADERS];
    let mut answer = httparse::Response::new(&mut headers);
    match answer
        .parse(bytes)
        .map_err(|error| Error::protocol(format!("HTTP: {error}")))?
    {
        httparse::Status::Partial => Ok(None),
        httparse::Status::Complete(end) => {
            let status = answer.code.unwrap_or_default();
            Ok(Some((end, (content_length(answer.headers)?, status))))
        }
    }
}

fn request_head(bytes: &[u8]) -> Result<Option<(usize, Head<()>)>> {
    let mut headers = [httparse::EMPTY_HEADER; HEADERS];
    let mut request = httparse::Request::new(&mut headers);
    match request
        .parse(bytes)
        .map_err(|error| Error::protocol(format!("HTTP: {error}")))?
    {
        httparse::Status::Partial => Ok(None),
        httparse::Status::Complete(_) if request.method != Some("POST") => {
            Err(Error::protocol("no POST"))
        }
        httparse::Status::Complete(end) => Ok(Some((end, (content_length(request.headers)?, ())))),
    }
}

fn content_length(headers: &[httparse::Header]) -> Result<Option<usize>> {
    if headers
        .iter()
        .any(|header| header.name.eq_ignore_ascii_case("transfer-encoding"))
    {
        return Err(Error::protocol("transfer encodings"));
    }
    let Some(header) = headers
        .iter()
        .find(|header| header.name.eq_ignore_ascii_case("content-length"))
    else {
        return Ok(None);
    };
    let length = std::str::from_utf8(header.value)
        .ok()
        .and_then(|text| text.trim().parse().ok());
    match length {
        Some(length) if length <= limits::XML => Ok(Some(length)),
        _ => Err(Error::protocol("Content-Length")),
    }
}

/// How long to wait for bytes.
#[derive(Clone, Copy)]
enum ReadTimeout {
    Until(Deadline),
    Each(Duration),
}

struct Reader<'a> {
    stream: &'a mut TcpStream,
    /// What was read and not used.
    buffer: Vec<u8>,
    timeout: ReadTimeout,
}

impl Reader<'_> {
    /// None if the other side has closed the connection before it said anything.
    fn head<T>(
        &mut self,
        parse: impl Fn(&[u8]) -> Result<Option<(usize, T)>>,
    ) -> Result<Option<T>> {
        loop {
            if !self.buffer.is_empty()
                && let Some((end, head)) = parse(&self.buffer)?
            {
                self.buffer.drain(..end);
                return Ok(Some(head));
            }
            if self.buffer.len() > HEAD {
                return Err(Error::protocol("a long head"));
            }
            if !self.more()? {
                return if self.buffer.is_empty() {
                    Ok(None)
                } else {
                    Err(Error::protocol("half a head"))
                };
            }
        }
    }

    /// That many bytes, or all until the end.
    fn body(&mut self, length: Option<usize>) -> Result<Vec<u8>> {
        while length.is_none_or(|length| self.buffer.len() < length) {
            if self.buffer.len() > limits::XML {
                return Err(Error::protocol("a long body"));
            }
            if !self.more()? {
                match length {
                    Some(_) => return Err(Error::protocol("half a body")),
                    None => return Ok(std::mem::take(&mut self.buffer)),
                }
            }
        }
        let rest = self.buffer.split_off(length.unwrap_or_default());
        Ok(std::mem::replace(&mut self.buffer, rest))
    }

    /// False at the end.
    fn more(&mut self) -> Result<bool> {
        let timeout = match self.timeout {
            ReadTimeout::Until(deadline) => deadline.left().ok_or_else(timed_out)?,
            ReadTimeout::Each(timeout) => timeout,
        };
        self.stream.set_read_timeout(Some(timeout))?;
        let mut chunk = [0; 8 << 10];
        let count = self
            .stream
            .read(&mut chunk)
            .map_err(|error| match error.kind() {
                std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut => timed_out(),
                _ => error.into(),
            })?;
        self.buffer.extend_from_slice(&chunk[..count]);
        Ok(count > 0)
    }
}
