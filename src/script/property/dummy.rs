//! Properties of dummies, and colours.

use super::Color;
use super::access::{Accessor, object_properties};
use crate::scene::Handle;

pub(super) const DUMMY: &[Accessor] = object_properties! {
    "dummySize": f64, |o| o.dummy()?.size, Appearance |o, size| o.dummy_mut()?.size = size;
    "linkedDummyHandle": i64, |o| o.dummy()?.link.map_or(-1, Handle::raw);
    "dummyType": i64, |o| o.dummy()?.link_type as i64;
};

pub(super) const COLOUR: &[Accessor] = object_properties! {
    "color.diffuse": Color, |o| Color::from_f32(o.dummy()?.colour),
        Appearance |o, colour| o.dummy_mut()?.colour = colour.to_f32();
};
