//! How a connection of TLS is to be.
#![cfg_attr(
    not(feature = "tls"),
    allow(
        dead_code,
        reason = "scripts set them, and learn later that there is no TLS"
    )
)]

/// Whether the other side must prove who it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verify {
    /// The certificate of the other side must be valid.
    Peer,
    /// Any certificate will do.
    Nobody,
}

/// The parameters of a connection.
#[derive(Debug, Clone)]
pub struct TlsSettings {
    /// Whether this side is the server of the handshake.
    pub is_server: bool,
    /// Whether the certificate of the other side is checked.
    pub verify: Verify,
    /// The name the certificate of a server must have.
    pub host: String,
    /// A file with the certificates to trust, instead of the system's.
    pub ca_file: Option<String>,
    /// Files with the own certificate and its key.
    pub certificate: Option<String>,
    /// The file of the key that belongs to `certificate`.
    pub key: Option<String>,
}
