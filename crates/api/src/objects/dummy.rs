//! `sim.*`: dummies and their links.

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::object::dummy::Dummy;
use scene::{Handle, Kind};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![create_dummy, get_link_dummy, set_link_dummy];

/// A new dummy at the world's origin, the last root.
///
/// @param size diameter, metres
/// @return dummyHandle the dummy
#[api("sim.createDummy")]
fn create_dummy(cx: &mut Cx, size: f64) -> Result<Handle> {
    cx.add_object("dummy", Kind::Dummy(Dummy::new(size)))
}

/// The dummy another is linked to.
///
/// @param dummyHandle the dummy
/// @return linkDummyHandle its partner, -1 if there is none
#[api("sim.getLinkDummy")]
fn get_link_dummy(cx: &Cx, dummy_handle: Handle) -> Result<i64> {
    let link = cx.scene().object(dummy_handle)?.dummy()?.link;
    Ok(link.map_or(-1, Handle::raw))
}

/// Links two dummies; earlier partners of both are released.
///
/// @param dummyHandle the dummy
/// @param linkDummyHandle its new partner, -1 for none
/// @return result 1
#[api("sim.setLinkDummy")]
fn set_link_dummy(cx: &mut Cx, dummy_handle: Handle, link_dummy_handle: f64) -> Result<i64> {
    let partner = if link_dummy_handle < 0.0 {
        None
    } else {
        Handle::from_raw(numbers::truncated(link_dummy_handle))
    };
    cx.scene_mut().link_dummies(dummy_handle, partner)?;
    Ok(1)
}
