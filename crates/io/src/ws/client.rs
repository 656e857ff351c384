//! Client side of the WebSocket handshake.

use tokio::net::TcpStream;
use tokio::time::timeout;
use tokio_tungstenite::tungstenite::client::{IntoClientRequest, uri_mode};
use tokio_tungstenite::tungstenite::handshake::client::Request as Handshake;
use tokio_tungstenite::tungstenite::http::header::USER_AGENT;
use tokio_tungstenite::tungstenite::stream::Mode;
use tokio_tungstenite::{WebSocketStream, client_async_with_config};

use super::{Connection, HANDSHAKE_TIMEOUT, Reports, WsEvent, config, connection};

/// The address to connect to, and the request.
pub struct Request {
    handshake: Handshake,
    host: String,
    port: u16,
    /// The connection to be.
    pub(crate) connection: Connection,
}

impl Request {
    /// A request for `ws://host:port/path`.
    ///
    /// # Errors
    /// When the address or the user agent is invalid.
    pub fn new(uri: &str, user_agent: &str, connection: Connection) -> Result<Self, String> {
        let mut handshake = uri
            .into_client_request()
            .map_err(|error| error.to_string())?;
        let agent = user_agent
            .parse()
            .map_err(|_| format!("invalid user agent: {user_agent}"))?;
        handshake.headers_mut().insert(USER_AGENT, agent);
        if !matches!(uri_mode(handshake.uri()), Ok(Mode::Plain)) {
            return Err(format!("only ws:// is supported: {uri}"));
        }
        let host = handshake
            .uri()
            .host()
            .filter(|host| !host.is_empty())
            .ok_or_else(|| format!("no host: {uri}"))?;
        let host = host
            .trim_start_matches('[')
            .trim_end_matches(']')
            .to_owned();
        let port = match handshake.uri().port_u16() {
            Some(port) => port,
            None if handshake
                .uri()
                .authority()
                .is_some_and(|a| a.as_str().ends_with(a.host())) =>
            {
                80
            }
            None => return Err(format!("invalid port: {uri}")),
        };
        Ok(Self {
            handshake,
            host,
            port,
            connection,
        })
    }

    /// Host and port.
    pub fn place(&self) -> (&str, u16) {
        (&self.host, self.port)
    }
}

/// Connects, and converses until the connection ends.
pub(super) async fn connect(request: Request, reports: Reports) {
    let connection = request.connection;
    let event = match timeout(HANDSHAKE_TIMEOUT, open(request)).await {
        Ok(Ok(socket)) => return connection::converse(socket, connection, &reports).await,
        Ok(Err(event)) => event,
        Err(_) => WsEvent::Fail(connection, "no answer in time".to_owned()),
    };
    reports.report(event).await;
}

async fn open(request: Request) -> Result<WebSocketStream<TcpStream>, WsEvent> {
    let unreachable = |error| WsEvent::Unreachable(request.connection, error);
    let stream = TcpStream::connect((request.host.as_str(), request.port))
        .await
        .map_err(unreachable)?;
    let _ = stream.set_nodelay(true);
    let answer = client_async_with_config(request.handshake, stream, Some(config())).await;
    let (socket, _response) =
        answer.map_err(|error| WsEvent::Fail(request.connection, error.to_string()))?;
    Ok(socket)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses() {
        let place = |uri| Request::new(uri, "agent", 1).map(|request| (request.host, request.port));
        assert_eq!(place("ws://127.0.0.1:1"), Ok(("127.0.0.1".to_owned(), 1)));
        assert_eq!(place("ws://host/a?b=c"), Ok(("host".to_owned(), 80)));
        assert_eq!(place("ws://[::1]:2/"), Ok(("::1".to_owned(), 2)));
        for bad in [
            "",
            "::",
            "host",
            "http://host",
            "wss://localhost:9",
            "ws://",
            "ws://host:99999",
            "ws://a b",
            "ws:///x",
        ] {
            assert!(place(bad).is_err(), "{bad}");
        }
        assert!(Request::new("ws://host", "a\nb", 1).is_err());
    }
}
