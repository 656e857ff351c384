//! `sim.*`: serial ports. Opening, closing and reading as scripts know them are in `lua/library/sim/serial.lua`.
//!
//! Ports belong to the simulator, so that scripts may share a handle; they are closed when the simulation ends.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use api_macro::api;
use scene::numbers;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use io::SerialPort;
use script::{ByHandle, Bytes, Host, Number};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    serial_open,
    serial_close,
    serial_send,
    serial_check,
    serial_read,
    serial_rest
];

/// The open ports of a simulator.
#[derive(Default)]
struct Ports(RefCell<ByHandle<SerialPort>>);

/// Closes all ports: they last no longer than a simulation.
pub(crate) fn end_simulation(host: &Host) {
    if let Some(ports) = host.module_state::<Ports>() {
        ports.0.borrow_mut().clear();
    }
}

/// The port is not open, or the device is gone.
const FAILED: i64 = -1;
/// There is nothing to send.
const NOTHING_TO_SEND: i64 = -5;

#[api("sim._serialOpen")]
fn serial_open(cx: &mut Cx, port_string: String, baud_rate: Number) -> Result<i64> {
    cx.permissions()
        .check_device(&SerialPort::file(&port_string))?;
    let ports = cx.module_state::<Ports>();
    let mut ports = ports.0.borrow_mut();
    if ports.values().any(|port| port.path() == port_string) {
        return Ok(FAILED);
    }
    let port = SerialPort::open(&port_string, baud_rate.0)
        .map_err(|reason| ApiError::Other(reason.into()))?;
    Ok(port.map_or(FAILED, |port| ports.add(port)))
}

#[api("sim._serialClose")]
fn serial_close(cx: &mut Cx, port_handle: Number) -> Result<()> {
    cx.module_state::<Ports>()
        .0
        .borrow_mut()
        .remove(port_handle.0)
        .map(drop)
        .ok_or_else(unknown)
}

/// Sends bytes through a serial port.
///
/// @param portHandle from sim.serialOpen
/// @param data the bytes
/// @return charsSent how many the device took; -5 for no data, -1 when the device is gone
#[api("sim.serialSend")]
fn serial_send(cx: &mut Cx, port_handle: Number, data: Bytes) -> Result<i64> {
    let stop = Arc::clone(&cx.options().stop);
    let ports = cx.module_state::<Ports>();
    let mut ports = ports.0.borrow_mut();
    let port = ports.get_mut(port_handle.0).ok_or_else(unknown)?;
    Ok(
        match (
            data.0.len(),
            port.write(&data.0, || stop.load(Ordering::Relaxed)),
        ) {
            (0, _) => NOTHING_TO_SEND,
            (_, 0) => FAILED,
            (_, written) => numbers::count(written),
        },
    )
}

/// Number of bytes available at a serial port.
///
/// @param portHandle from sim.serialOpen
/// @return byteCount -1 when the device is gone
#[api("sim.serialCheck")]
fn serial_check(cx: &mut Cx, port_handle: Number) -> Result<i64> {
    let ports = cx.module_state::<Ports>();
    let mut ports = ports.0.borrow_mut();
    let port = ports.get_mut(port_handle.0).ok_or_else(unknown)?;
    Ok(port.available().map_or(FAILED, numbers::count))
}

/// Bytes that are there, at most `length` of them; nothing when there are none, or no such port.
#[api("sim._serialRead")]
fn serial_read(cx: &mut Cx, port_handle: Number, length: Number) -> Result<Option<Bytes>> {
    let ports = cx.module_state::<Ports>();
    let mut ports = ports.0.borrow_mut();
    let bytes = ports
        .get_mut(port_handle.0)
        .map(|port| port.read(usize::try_from(length.0).unwrap_or(0)));
    Ok(bytes.filter(|bytes| !bytes.is_empty()).map(Bytes))
}

/// Waits a moment where the script cannot yield, so that asking again does not keep the processor busy.
#[api("sim._serialRest")]
fn serial_rest(cx: &Cx) -> Result<()> {
    if cx.can_yield() {
        return Ok(());
    }
    cx.wait_for(Some(std::time::Duration::from_millis(1)), || None::<()>)
        .map(drop)
}

fn unknown() -> ApiError {
    ApiError::Other("invalid port handle.".into())
}
