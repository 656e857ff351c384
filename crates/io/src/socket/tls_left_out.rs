//! In place of TLS, in builds without the feature `tls`: no connection can use it.

use super::{Failure, Socket, Stream, TlsSettings, Wait};

/// There is none.
pub(crate) enum Tls {}

impl Tls {
    pub(super) fn has_plaintext(&self) -> bool {
        match *self {}
    }

    pub(super) fn read(
        &mut self,
        _: &Socket,
        _: &mut [u8],
        _: &Wait<'_>,
    ) -> Result<usize, Failure> {
        match *self {}
    }

    pub(super) fn write(&mut self, _: &Socket, _: &[u8], _: &Wait<'_>) -> Result<usize, Failure> {
        match *self {}
    }

    pub(super) fn say_goodbye(&mut self, _: &Socket) {
        match *self {}
    }
}

impl Stream {
    /// Always a failure: this build has no TLS.
    pub fn wrap(&mut self, _: &TlsSettings) -> Result<(), Failure> {
        Err(left_out())
    }

    /// Always a failure: this build has no TLS.
    pub fn shake_hands(&mut self, _: &Wait<'_>) -> Result<(), Failure> {
        Err(left_out())
    }

    /// None: there is no TLS.
    pub fn tls_info(&self) -> Option<(String, String)> {
        None
    }
}

fn left_out() -> Failure {
    Failure::words("this build has no TLS: build Swanilda with the feature `tls`")
}
