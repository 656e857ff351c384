//! `sim.*`: dummies and their links.

use std::rc::Rc;

use api_macro::api;

use super::{ApiFn, Cx, Result, functions};
use crate::scene::dummy::Dummy;
use crate::scene::{Handle, Kind};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![create_dummy];

/// Creates a dummy as the last root, named `dummy`.
///
/// @param size diameter, metres
/// @return objectHandle the dummy
#[api("sim.createDummy")]
fn create_dummy(cx: &mut Cx, size: f64) -> Result<Handle> {
    let handle = cx.scene_mut().add("dummy", Kind::Dummy(Dummy::new(size)))?;
    Rc::clone(cx.sim()).announce_created(&[handle]);
    Ok(handle)
}
