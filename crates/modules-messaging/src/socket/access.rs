//! Permissions of sockets.

use crate::{Cx, Result};
use io::socket::{Family, TlsSettings, port};
use permissions::c_path;

/// A host and a service, to listen at or to connect to.
pub(super) fn check_place(cx: &Cx, family: Family, host: &str, service: &str) -> Result<()> {
    let host = match (host, family) {
        ("*", Family::Inet6) => "::",
        ("*", _) => "0.0.0.0",
        _ => host,
    };
    match port(service) {
        Ok(Some(port)) => Ok(cx.permissions().check_net(host, Some(port))?),
        // Only the system's resolver knows the port of a service.
        _ => Ok(cx
            .permissions()
            .check_net_everywhere(&format!("the service '{service}' of '{host}'"))?),
    }
}

/// A path of this machine, or a name that is none.
pub(super) fn check_local(cx: &Cx, path: &[u8]) -> Result<()> {
    // The system reads a path up to a NUL; what begins with one, or is empty, is the name of a socket without a file.
    match c_path(path) {
        name if name.as_os_str().is_empty() => Ok(cx
            .permissions()
            .check_net_everywhere("a local socket without a file")?),
        path => Ok(cx.permissions().check_device(&path)?),
    }
}

/// A host whose name or address is asked for.
pub(super) fn check_lookup(cx: &Cx, host: &str) -> Result<()> {
    Ok(cx.permissions().check_net(host, None)?)
}

/// The files of certificates and keys.
pub(super) fn check_files(cx: &Cx, settings: &TlsSettings) -> Result<()> {
    let files = [&settings.ca_file, &settings.certificate, &settings.key];
    files
        .into_iter()
        .flatten()
        .try_for_each(|file| Ok(cx.permissions().check_read(file.as_ref())?))
}
