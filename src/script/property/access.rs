//! How a static property is read and written: one row per property, made by the macros below.

use std::rc::Rc;

use super::Target;
use crate::scene::{Data, Handle, SceneError, SceneResult};
use crate::script::error::{ApiError, ApiResult};
use crate::script::lifecycle::instance::Script;
use crate::script::sim::Sim;

/// Whose property it is.
pub(crate) struct Subject<'a> {
    pub sim: &'a Rc<Sim>,
    pub target: &'a Target,
}

/// Code of one static property; what is missing in one direction is not built or not allowed.
pub(crate) struct Accessor {
    pub name: &'static str,
    pub read: Option<fn(&Subject<'_>) -> ApiResult<Data>>,
    pub write: Option<fn(&Subject<'_>, Data) -> ApiResult<()>>,
}

/// What a change of a property says that cannot be made.
pub(super) fn refused() -> SceneError {
    SceneError::Refused(ApiError::PropertyNotWritable.to_string())
}

/// A number as it is; infinite ones and NaN are refused.
pub(super) fn finite(value: f64) -> SceneResult<f64> {
    if value.is_finite() { Ok(value) } else { Err(refused()) }
}

/// A length, at least 10 micrometres; infinite ones and NaN are refused.
pub(super) fn length(value: f64) -> SceneResult<f64> {
    Ok(finite(value)?.max(1e-5))
}

/// The first two numbers; fewer, infinite ones and NaN are refused.
pub(super) fn pair(values: &[f64]) -> SceneResult<[f64; 2]> {
    let &[first, second] = values.first_chunk().ok_or_else(refused)?;
    Ok([finite(first)?, finite(second)?])
}

impl Subject<'_> {
    /// The object the properties belong to.
    pub(super) fn object(&self) -> ApiResult<Handle> {
        match self.target {
            Target::Object(handle) => Ok(*handle),
            _ => Err(SceneError::NoSuchObject.into()),
        }
    }

    /// The script the properties belong to.
    pub(super) fn script(&self) -> ApiResult<Rc<Script>> {
        match self.target {
            Target::Script(script) => Ok(Rc::clone(script)),
            Target::Object(handle) => self.sim.script(handle.raw()).ok_or(ApiError::NoSuchScript),
            Target::App | Target::Scene | Target::Mesh(_) => Err(ApiError::NoSuchScript),
        }
    }
}

/// Rows of properties that are read and written through `&Subject`.
macro_rules! subject_properties {
    ($($name:literal: $ty:ty, |$s:ident| $get:expr $(, |$w:ident, $v:ident| $set:expr)?;)*) => { &[ $(
        $crate::script::property::access::Accessor {
            name: $name,
            read: Some(|$s| Ok(<$ty as $crate::script::property::PropertyValue>::into_data($get))),
            write: subject_properties!(@write $ty $(, |$w, $v| $set)?),
        },
    )* ] };
    (@write $ty:ty) => { None };
    (@write $ty:ty, |$w:ident, $v:ident| $set:expr) => {
        Some(|$w, data| {
            let $v = <$ty as $crate::script::property::PropertyValue>::from_data(data)
                .ok_or($crate::script::error::ApiError::PropertyType)?;
            $set;
            Ok(())
        })
    };
}

/// Rows of properties that an object holds itself: read from `&Object`, written to `&mut Object` as a change of a `Field`.
macro_rules! object_properties {
    ($($name:literal: $ty:ty, |$o:ident| $get:expr $(, $field:ident |$w:ident, $v:ident| $set:expr)?;)*) => { &[ $(
        $crate::script::property::access::Accessor {
            name: $name,
            read: Some(|subject| {
                let scene = subject.sim.scene.borrow();
                let $o = scene.object(subject.object()?)?;
                Ok(<$ty as $crate::script::property::PropertyValue>::into_data($get))
            }),
            write: object_properties!(@write $ty $(, $field |$w, $v| $set)?),
        },
    )* ] };
    (@write $ty:ty) => { None };
    (@write $ty:ty, $field:ident |$w:ident, $v:ident| $set:expr) => {
        Some(|subject, data| {
            let $v = <$ty as $crate::script::property::PropertyValue>::from_data(data)
                .ok_or($crate::script::error::ApiError::PropertyType)?;
            let handle = subject.object()?;
            subject.sim.scene.borrow_mut().try_modify(handle, $crate::scene::Field::$field, |$w| {
                $set;
                Ok(())
            })?;
            Ok(())
        })
    };
}

/// Rows of properties of an object that concern more than itself: read from `&Scene` and its handle, written to `&mut Scene`.
macro_rules! placed_properties {
    ($($name:literal: $ty:ty, |$s:ident, $h:ident| $get:expr $(, |$w:ident, $wh:ident, $v:ident| $set:expr)?;)*) => { &[ $(
        $crate::script::property::access::Accessor {
            name: $name,
            read: Some(|subject| {
                let ($s, $h) = (subject.sim.scene.borrow(), subject.object()?);
                Ok(<$ty as $crate::script::property::PropertyValue>::into_data($get))
            }),
            write: placed_properties!(@write $ty $(, |$w, $wh, $v| $set)?),
        },
    )* ] };
    (@write $ty:ty) => { None };
    (@write $ty:ty, |$w:ident, $h:ident, $v:ident| $set:expr) => {
        Some(|subject, data| {
            let $v = <$ty as $crate::script::property::PropertyValue>::from_data(data)
                .ok_or($crate::script::error::ApiError::PropertyType)?;
            let (mut $w, $h) = (subject.sim.scene.borrow_mut(), subject.object()?);
            $set;
            Ok(())
        })
    };
}

pub(super) use {object_properties, placed_properties, subject_properties};
