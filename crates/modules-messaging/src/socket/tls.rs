//! The native part of the module `ssl`.

use api_macro::api;

use super::results::{Created, Outcome};
use super::stream::Client;
use super::{Sockets, access, class, stop};
use crate::{ApiFn, Cx, Result, functions};
use io::socket::{TlsSettings, Verify, Wait};
use scene::Data;
use script::Table;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![wrap, dohandshake, info];

/// Wraps the socket of another object in TLS.
#[api("ssl.wrap")]
fn wrap(cx: &Cx, object: Client) -> Result<Outcome<Created>> {
    let sockets = cx.script_state::<Sockets>();
    let mut old = object.stream.borrow_mut();
    let new = old.handed_over();
    Ok(Outcome(Ok(sockets.add_stream(class::TLS, new))))
}

/// Agrees on keys. The settings are looked at the first time.
#[api("ssl.dohandshake")]
fn dohandshake(cx: &Cx, object: Client, settings: Table) -> Result<Outcome<bool>> {
    let mut stream = object.stream.borrow_mut();
    let wait = Wait::begin(stream.timeout, stop(cx));
    let settings = tls_settings(&settings.0);
    access::check_files(cx, &settings)?;
    let ready = if stream.is_tls() {
        Ok(())
    } else {
        stream.wrap(&settings)
    };
    Ok(Outcome(
        ready
            .and_then(|()| stream.shake_hands(&wait))
            .map(|()| true),
    ))
}

fn tls_settings(settings: &Data) -> TlsSettings {
    let text = |name| match settings.field(name) {
        Some(Data::Text(text)) => Some(String::from_utf8_lossy(text).into_owned()),
        _ => None,
    };
    TlsSettings {
        is_server: text("mode").is_some_and(|mode| mode == "server"),
        verify: if text("verify").is_some_and(|verify| verify == "none") {
            Verify::Nobody
        } else {
            Verify::Peer
        },
        host: text("host").unwrap_or_default(),
        ca_file: text("cafile"),
        certificate: text("certificate"),
        key: text("key"),
    }
}

/// Version and cipher of the connection.
#[api("ssl.info")]
fn info(_cx: &Cx, object: Client) -> Result<Option<(String, String)>> {
    Ok(object.stream.borrow().tls_info())
}
