//! `swanilda batch --ray`: the Python package spreads the runs over a cluster.

use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use testing::batch::Batch;

/// Has the runs made by a cluster, and returns the exit code: 0, or 1 when some failed.
///
/// # Errors
/// When Python, its packages or the cluster are not there; they have said why.
pub(super) fn run(
    batch: &Batch,
    address: &str,
    out: &Path,
    timeout: f64,
    force: bool,
) -> Result<u8, String> {
    let cluster = if address == "local" {
        Value::Null
    } else {
        address.into()
    };
    let arguments = json!({
        "scene": batch.scene, "params": batch.sweeps, "seeds": batch.seeds, "fixed": batch.fixed, "time": batch.time,
        "timeout": timeout, "cluster": cluster, "out": out, "force": force,
    });
    let mut python = Command::new("python3");
    python
        .args(["-m", "swanilda.ray", &arguments.to_string()])
        .stdin(Stdio::null());
    let status = python
        .status()
        .map_err(|error| format!("--ray needs python3 with the package swanilda: {error}"))?;
    match status.code() {
        Some(code @ (0 | 3)) => Ok(u8::from(code == 3)),
        _ => Err(format!(
            "the runs on Ray ended with {status}. They need `pip install '.[ray]'` in Swanilda's repository."
        )),
    }
}
