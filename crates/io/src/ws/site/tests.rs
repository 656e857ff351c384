//! What a site answers to requests.

use super::*;
use std::io::{Read, Write};

/// A site that answers everything.
struct Anything;

impl Site for Anything {
    fn get(&self, _: &str, _: Option<&str>) -> SiteReply {
        SiteReply {
            status: 200,
            headers: Vec::new(),
            body: Arc::new(b"here".to_vec()),
        }
    }

    fn open(&self, _: &str) -> Option<Box<dyn Visitor>> {
        None
    }
}

#[test]
fn connections_that_say_nothing_give_way() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port is free");
    let server = SiteServer::start_limited(listener, |_| Anything, 4).expect("it starts");
    let open = || std::net::TcpStream::connect(server.address()).expect("it listens");
    let ask = |stream: &mut std::net::TcpStream, connection: &str| {
        let request =
            format!("GET / HTTP/1.1\r\nHost: localhost\r\nConnection: {connection}\r\n\r\n");
        stream
            .set_read_timeout(Some(PAGE_TIMEOUT / 2))
            .expect("it is no zero");
        stream.write_all(request.as_bytes()).expect("it reads");
    };
    // Half of them have been answered once, and ask for nothing more.
    let mut silent: Vec<_> = (0..20).map(|_| open()).collect();
    for _ in 0..20 {
        let mut stream = open();
        ask(&mut stream, "keep-alive");
        stream.read_exact(&mut [0; 15]).expect("an answer");
        silent.push(stream);
    }
    let mut client = open();
    ask(&mut client, "close");
    let mut answer = String::new();
    client.read_to_string(&mut answer).expect("an answer");
    assert!(answer.ends_with("here"), "{answer}");
}

fn head(text: &str) -> Head {
    Head::parse(text.as_bytes())
        .expect("a good head")
        .expect("a complete head")
        .0
}

fn status(request: &str) -> u16 {
    check(
        &head(&format!("{request}\r\n\r\n")),
        "10.0.0.7".parse().ok(),
    )
    .map_or_else(|status| status.as_u16(), |()| 200)
}

#[test]
fn only_names_of_this_machine_are_answered() {
    for host in [
        "127.0.0.1:80",
        "localhost:9",
        "LOCALHOST",
        "[::1]:7",
        "10.0.0.7:80",
    ] {
        assert_eq!(
            status(&format!("GET / HTTP/1.1\r\nHost: {host}")),
            200,
            "{host}"
        );
    }
    for host in [
        "evil.example",
        "127.0.0.1.evil.example",
        "localhost.evil.example:80",
        "127.0.0.1:1.evil.example",
        "[::1].evil.example",
        "10.0.0.8",
        "",
        "[",
        "[]:1",
    ] {
        assert_eq!(
            status(&format!("GET / HTTP/1.1\r\nHost: {host}")),
            403,
            "{host}"
        );
    }
    assert_eq!(status("GET / HTTP/1.1"), 400);
}

#[test]
fn pages_of_others_are_not_answered() {
    let with = |origin: &str| {
        status(&format!(
            "GET / HTTP/1.1\r\nHost: 127.0.0.1:80\r\nOrigin: {origin}"
        ))
    };
    assert_eq!(with("http://127.0.0.1:80"), 200);
    for origin in [
        "http://127.0.0.1:81",
        "http://evil.example",
        "null",
        "",
        "http://localhost:80",
    ] {
        assert_eq!(with(origin), 403, "{origin}");
    }
}

#[test]
fn only_reading_is_allowed() {
    assert_eq!(status("POST / HTTP/1.1\r\nHost: localhost"), 405);
    assert_eq!(
        status("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3"),
        400
    );
    assert_eq!(
        status("GET / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked"),
        400
    );
    assert_eq!(
        status("HEAD / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0"),
        200
    );
}
