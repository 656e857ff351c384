//! TLS on a stream: rustls, with the certificates trusted by the system.

use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::net::IpAddr;
use std::sync::Arc;

use rustls::client::danger::{HandshakeSignatureValid, ServerCertVerified, ServerCertVerifier};
use rustls::crypto::{CryptoProvider, ring};
use rustls::pki_types::pem::PemObject;
use rustls::pki_types::{CertificateDer, PrivateKeyDer, ServerName, UnixTime};
use rustls::{
    ClientConfig, ClientConnection, Connection, DigitallySignedStruct, RootCertStore, ServerConfig,
    ServerConnection, SignatureScheme,
};

use super::failure::is_pending;
use super::{Failure, Socket, Stream, TlsSettings, Verify, Wait};

/// The state of a connection.
pub(crate) struct Tls {
    connection: Connection,
    /// Decrypted bytes that were not read.
    waiting: usize,
}

impl Tls {
    /// Whether there are unread decrypted bytes.
    pub(super) fn has_plaintext(&self) -> bool {
        self.waiting > 0
    }

    /// Some bytes, at least one.
    pub(super) fn read(
        &mut self,
        socket: &Socket,
        space: &mut [u8],
        wait: &Wait<'_>,
    ) -> Result<usize, Failure> {
        loop {
            match self.connection.reader().read(space) {
                Ok(0) => return Err(Failure::Closed),
                Ok(count) => {
                    self.waiting = self.waiting.saturating_sub(count);
                    return Ok(count);
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                // Many servers close the connection without a TLS close_notify.
                Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                    return Err(Failure::Closed);
                }
                Err(error) => return Err(error.into()),
            }
            self.flush(socket, wait)?;
            self.take_in(socket, wait)?;
        }
    }

    /// Sends some bytes, at least one.
    pub(super) fn write(
        &mut self,
        socket: &Socket,
        data: &[u8],
        wait: &Wait<'_>,
    ) -> Result<usize, Failure> {
        // Bytes that were encrypted before are sent first; bytes that are encrypted now count as sent.
        self.flush(socket, wait)?;
        let count = self.connection.writer().write(data)?;
        match self.flush(socket, wait) {
            Ok(()) | Err(Failure::Timeout) => Ok(count),
            Err(failure) => Err(failure),
        }
    }

    /// Sends what is encrypted.
    fn flush(&mut self, socket: &Socket, wait: &Wait<'_>) -> Result<(), Failure> {
        while self.connection.wants_write() {
            match self.connection.write_tls(&mut &**socket) {
                Ok(0) => return Err(Failure::Closed),
                Ok(_) => {}
                Err(error) if is_pending(&error) => wait.writable(socket)?,
                Err(error) => return Err(error.into()),
            }
        }
        Ok(())
    }

    /// Takes what has arrived and decrypts it.
    fn take_in(&mut self, socket: &Socket, wait: &Wait<'_>) -> Result<(), Failure> {
        match self.connection.read_tls(&mut &**socket) {
            Ok(0) if self.connection.is_handshaking() => return Err(Failure::Closed),
            Ok(_) => {}
            Err(error) if is_pending(&error) => return wait.readable(socket),
            Err(error) => return Err(error.into()),
        }
        match self.connection.process_new_packets() {
            Ok(state) => {
                self.waiting = state.plaintext_bytes_to_read();
                Ok(())
            }
            Err(error) => {
                // Sends the reason to the peer, if it still reads.
                let _ = self.connection.write_tls(&mut &**socket);
                Err(tls_failure(error))
            }
        }
    }

    fn shake_hands(&mut self, socket: &Socket, wait: &Wait<'_>) -> Result<(), Failure> {
        loop {
            self.flush(socket, wait)?;
            if !self.connection.is_handshaking() {
                return Ok(());
            }
            self.take_in(socket, wait)?;
        }
    }

    /// Notifies the peer of the end of the stream, if that does not block.
    pub(super) fn say_goodbye(&mut self, socket: &Socket) {
        self.connection.send_close_notify();
        while self.connection.wants_write() {
            match self.connection.write_tls(&mut &**socket) {
                Ok(count) if count > 0 => {}
                _ => return,
            }
        }
    }

    /// Version and cipher, once they are agreed upon.
    fn info(&self) -> Option<(String, String)> {
        let version = format!("{:?}", self.connection.protocol_version()?).replace('_', ".");
        let cipher = format!("{:?}", self.connection.negotiated_cipher_suite()?.suite());
        Some((version, cipher))
    }
}

impl Stream {
    /// Switches the connection to TLS; the handshake comes next.
    pub fn wrap(&mut self, settings: &TlsSettings) -> Result<(), Failure> {
        self.tls = Some(Box::new(Tls {
            connection: connection(settings)?,
            waiting: 0,
        }));
        Ok(())
    }

    /// Agrees with the other side on keys.
    pub fn shake_hands(&mut self, wait: &Wait<'_>) -> Result<(), Failure> {
        let socket = self.socket().ok_or(Failure::Closed)?.clone();
        let tls = self
            .tls
            .as_mut()
            .ok_or_else(|| Failure::words("no TLS connection"))?;
        tls.shake_hands(&socket, wait)
    }

    /// Version and cipher of the connection.
    pub fn tls_info(&self) -> Option<(String, String)> {
        self.tls.as_ref().and_then(|tls| tls.info())
    }
}

fn connection(settings: &TlsSettings) -> Result<Connection, Failure> {
    let provider = Arc::new(ring::default_provider());
    if settings.is_server {
        let config = server_config(settings, provider)?;
        return Ok(ServerConnection::new(Arc::new(config))
            .map_err(tls_failure)?
            .into());
    }
    let config = client_config(settings, provider)?;
    Ok(
        ClientConnection::new(Arc::new(config), server_name(settings)?)
            .map_err(tls_failure)?
            .into(),
    )
}

/// Without a name there is nothing a certificate could be compared with.
fn server_name(settings: &TlsSettings) -> Result<ServerName<'static>, Failure> {
    match (settings.host.as_str(), settings.verify) {
        ("", Verify::Nobody) => Ok(ServerName::IpAddress(IpAddr::from([0, 0, 0, 0]).into())),
        ("", Verify::Peer) => Err(Failure::words(
            "the name of the server is needed: sni(name) before dohandshake()",
        )),
        (host, _) => {
            ServerName::try_from(host.to_owned()).map_err(|_| Failure::words("invalid server name"))
        }
    }
}

fn client_config(
    settings: &TlsSettings,
    provider: Arc<CryptoProvider>,
) -> Result<ClientConfig, Failure> {
    let builder = ClientConfig::builder_with_provider(Arc::clone(&provider));
    let builder = builder
        .with_safe_default_protocol_versions()
        .map_err(tls_failure)?;
    let builder = match settings.verify {
        Verify::Peer => builder.with_root_certificates(trusted(settings.ca_file.as_deref())?),
        Verify::Nobody => builder
            .dangerous()
            .with_custom_certificate_verifier(Arc::new(AcceptAnyCertificate(provider))),
    };
    match own_certificate(settings)? {
        Some((chain, key)) => builder
            .with_client_auth_cert(chain, key)
            .map_err(tls_failure),
        None => Ok(builder.with_no_client_auth()),
    }
}

fn server_config(
    settings: &TlsSettings,
    provider: Arc<CryptoProvider>,
) -> Result<ServerConfig, Failure> {
    let (chain, key) = own_certificate(settings)?
        .ok_or_else(|| Failure::words("a server needs a certificate and a key"))?;
    let builder = ServerConfig::builder_with_provider(provider);
    let builder = builder
        .with_safe_default_protocol_versions()
        .map_err(tls_failure)?;
    builder
        .with_no_client_auth()
        .with_single_cert(chain, key)
        .map_err(tls_failure)
}

type OwnCertificate = (Vec<CertificateDer<'static>>, PrivateKeyDer<'static>);

fn own_certificate(settings: &TlsSettings) -> Result<Option<OwnCertificate>, Failure> {
    let (Some(certificate), Some(key)) = (&settings.certificate, &settings.key) else {
        return Ok(None);
    };
    let key = PrivateKeyDer::from_pem_file(key)
        .map_err(|_| Failure::Words(format!("error loading private key ({key})")))?;
    Ok(Some((certificates(certificate)?, key)))
}

fn certificates(file: &str) -> Result<Vec<CertificateDer<'static>>, Failure> {
    let failure = || Failure::Words(format!("error loading certificate ({file})"));
    let reader = BufReader::new(File::open(file).map_err(|_| failure())?);
    let certificates: Result<Vec<_>, _> = CertificateDer::pem_reader_iter(reader).collect();
    certificates
        .ok()
        .filter(|list| !list.is_empty())
        .ok_or_else(failure)
}

/// The certificates of `file`, or those of the system.
fn trusted(file: Option<&str>) -> Result<RootCertStore, Failure> {
    let mut store = RootCertStore::empty();
    let certificates = match file {
        Some(file) => certificates(file)?,
        None => rustls_native_certs::load_native_certs().certs,
    };
    store.add_parsable_certificates(certificates);
    if store.is_empty() {
        return Err(Failure::words(
            "this system has no certificates to trust: name a file with 'cafile'",
        ));
    }
    Ok(store)
}

fn tls_failure(error: rustls::Error) -> Failure {
    Failure::Words(error.to_string())
}

/// Accepts every certificate, for scripts with `verify = 'none'`. Signatures of the handshake are still checked.
#[derive(Debug)]
struct AcceptAnyCertificate(Arc<CryptoProvider>);

impl ServerCertVerifier for AcceptAnyCertificate {
    fn verify_server_cert(
        &self,
        _: &CertificateDer<'_>,
        _: &[CertificateDer<'_>],
        _: &ServerName<'_>,
        _: &[u8],
        _: UnixTime,
    ) -> Result<ServerCertVerified, rustls::Error> {
        Ok(ServerCertVerified::assertion())
    }

    fn verify_tls12_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signed: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, rustls::Error> {
        let algorithms = &self.0.signature_verification_algorithms;
        rustls::crypto::verify_tls12_signature(message, certificate, signed, algorithms)
    }

    fn verify_tls13_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signed: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, rustls::Error> {
        let algorithms = &self.0.signature_verification_algorithms;
        rustls::crypto::verify_tls13_signature(message, certificate, signed, algorithms)
    }

    fn supported_verify_schemes(&self) -> Vec<SignatureScheme> {
        self.0.signature_verification_algorithms.supported_schemes()
    }
}
