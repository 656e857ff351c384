//! `sim.*`: the stream of events (spec: events).

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::Data;
use script::{Bytes, EventFilters, Table};

pub(crate) const FUNCTIONS: &[ApiFn] =
    functions![set_event_filters, get_genesis_events, push_user_event];

/// Selects the events delivered to `sysCall_event` of this script. The filter ends with the script's Lua state.
///
/// @param filters from handles (of objects, `sim.handle_app`, `sim.handle_scene`, `sim.handle_sceneobject` for all other objects, ...) to lists of property names; an empty list means all of them. An empty table removes all filters
#[api("sim.setEventFilters")]
fn set_event_filters(cx: &mut Cx, #[default(Data::Array(Vec::new()))] filters: Data) -> Result<()> {
    let filters = match filters {
        Data::Array(_) | Data::Map(_) => EventFilters::from_table(&filters),
        _ => return Err(ApiError::Other("invalid argument.".into())),
    };
    cx.set_event_filters(filters);
    Ok(())
}

/// A snapshot of everything as events, in CBOR. The numbers of its events end where those of the next dispatched batch begin.
///
/// @return events
#[api("sim.getGenesisEvents")]
fn get_genesis_events(cx: &mut Cx) -> Result<Bytes> {
    Ok(Bytes(cx.genesis_events()))
}

/// Adds an event of one's own to the stream.
///
/// @param event its name
/// @param handle what it is about, or -1
/// @param uid the identifier of what it is about, or -1
/// @param eventData its data
/// @param options bit 0: a later event with the same name and uid in the same batch replaces it
#[api("sim.pushUserEvent")]
fn push_user_event(
    cx: &mut Cx,
    event: String,
    handle: i64,
    uid: i64,
    event_data: Table,
    #[default(0)] options: i64,
) -> Result<()> {
    cx.push_user_event(event, (handle, uid), &event_data.0, options);
    Ok(())
}
