//! `sim.tube*`: tubes between two scripts, as V-REP had them.

use std::cell::RefCell;
use std::rc::Rc;

use api_macro::api;
use scene::numbers;

use crate::{ApiFn, Cx, Result, functions};
use script::{Bytes, Number, Text};

use super::tubes::Tubes;

pub(crate) const FUNCTIONS: &[ApiFn] =
    functions![tube_open, tube_write, tube_read, tube_status, tube_close];

/// No such tube.
const FAILED: i64 = -1;

/// All tubes of a simulator.
#[derive(Default)]
struct SharedTubes(RefCell<Tubes>);

/// The tubes that a script opened: they close with its Lua state.
#[derive(Default)]
struct OwnTubes(RefCell<Option<(Rc<SharedTubes>, i64)>>);

impl Drop for OwnTubes {
    fn drop(&mut self) {
        if let Some((tubes, script)) = self.0.take() {
            tubes.0.borrow_mut().close_those_of(script);
        }
    }
}

/// Opens one end of a tube; the other one is opened with the same header and name.
///
/// @param dataHeader a number of your own
/// @param dataName a name of your own
/// @param readBufferSize packets that wait at most, the oldest one makes room; 0: any number
/// @return tubeHandle
#[api("sim.tubeOpen")]
fn tube_open(
    cx: &mut Cx,
    data_header: Number,
    data_name: Bytes,
    read_buffer_size: Number,
) -> Result<i64> {
    let capacity = usize::try_from(read_buffer_size.0).unwrap_or(0);
    let (tubes, script) = (cx.module_state::<SharedTubes>(), cx.script().id);
    cx.script_state::<OwnTubes>()
        .0
        .replace(Some((tubes.clone(), script)));
    let handle = tubes
        .0
        .borrow_mut()
        .open(data_header.0, data_name.0, capacity, script);
    Ok(handle)
}

/// Writes a packet into a tube.
///
/// @param tubeHandle from sim.tubeOpen
/// @param data the packet
/// @return result 1, 0 if the other end is not open (the packet is lost), -1 if there is no such tube
#[api("sim.tubeWrite")]
fn tube_write(cx: &mut Cx, tube_handle: Number, data: Bytes) -> Result<i64> {
    Ok(cx
        .module_state::<SharedTubes>()
        .0
        .borrow_mut()
        .write(tube_handle.0, data.0)
        .map_or(FAILED, i64::from))
}

/// Reads and removes the oldest packet of a tube.
///
/// @param tubeHandle from sim.tubeOpen
/// @return data nothing if no packet waits
#[api("sim.tubeRead")]
fn tube_read(cx: &mut Cx, tube_handle: Number) -> Result<Option<Text>> {
    Ok(cx
        .module_state::<SharedTubes>()
        .0
        .borrow_mut()
        .read(tube_handle.0)
        .map(Text))
}

/// The state of a tube.
///
/// @param tubeHandle from sim.tubeOpen
/// @return result 1 if both ends are open, 0 if only this one is, -1 if there is no such tube
/// @return readPacketsCount packets that wait here
/// @return writePacketsCount packets that wait at the other end
#[api("sim.tubeStatus")]
fn tube_status(cx: &Cx, tube_handle: Number) -> Result<(i64, i64, i64)> {
    let status = cx
        .module_state::<SharedTubes>()
        .0
        .borrow()
        .status(tube_handle.0);
    Ok(status.map_or((FAILED, 0, 0), |s| {
        (
            i64::from(s.connected),
            numbers::count(s.to_read),
            numbers::count(s.written),
        )
    }))
}

/// Closes one end of a tube.
///
/// @param tubeHandle from sim.tubeOpen
/// @return result 1, or -1 if there is no such tube
#[api("sim.tubeClose")]
fn tube_close(cx: &mut Cx, tube_handle: Number) -> Result<i64> {
    Ok(
        if cx
            .module_state::<SharedTubes>()
            .0
            .borrow_mut()
            .close(tube_handle.0)
        {
            1
        } else {
            FAILED
        },
    )
}
