//! Properties of dummies.

use super::Text;
use super::access::{Accessor, length, object_properties, placed_properties};
use scene::object::dummy::LinkType;
use scene::{Handle, SceneError};

pub(in crate::property) const DUMMY: &[Accessor] = object_properties! {
    "dummySize": f64, |o| o.dummy()?.size, Appearance |o, size| o.dummy_mut()?.size = length(size)?;
    "assemblyTag": Text, |o| Text(o.dummy()?.assembly_tag.clone().into_bytes()),
        Other |o, tag| o.dummy_mut()?.assembly_tag = String::from_utf8_lossy(&tag.0).into_owned();
};

pub(in crate::property) const LINK: &[Accessor] = placed_properties! {
    "linkedDummyHandle": i64, |s, h| s.object(h)?.dummy()?.link.map_or(-1, Handle::raw),
        |s, h, partner| s.link_dummies(h, Handle::from_raw(partner))?;
    "dummyType": i64, |s, h| s.object(h)?.dummy()?.link_type as i64, |s, h, code| {
        let link_type = LinkType::from_code(code).ok_or(SceneError::InvalidData)?;
        s.set_link_type(h, link_type)?;
    };
};
