//! Typed properties: named, typed values of the application, the scene, objects and scripts (spec: data 3, data 4, data 5, properties 1).
//!
//! Static properties are in one table; custom data, signals and named parameters are created by scripts. Collections are no
//! targets.

mod access;
mod inert;
mod model_hash;
mod stored;
pub mod table;
mod types;
mod value;

use std::rc::Rc;

use super::error::{ApiError, ApiResult};
use crate::host::{Script, Sim};
use ::scene::object::script_object::ScriptType;
use ::scene::{Data, FIRST_MESH_UID, Handle, Namespace, Uid, ValueType, special};
use access::{Accessor, Subject};
use table::ValueSource;
use types::{
    app, colour, display, dummy, engine, force_sensor, joint, mesh, object, proximity_sensor,
    scene, script, shape, view,
};

pub use stored::OLD_SIGNALS;
pub use table::{
    Class, Row, app_class, flags, mesh_class, object_class, scene_class, script_class,
};
pub use value::{
    Color, IntPair, Long, PoseArray, PropertyName, PropertyValue, Quaternion, Text, Vector2,
    Vector3,
};

/// An entity with properties.
#[derive(Clone)]
pub enum PropertyTarget {
    /// The application.
    App,
    /// The scene.
    Scene,
    /// An object of the scene.
    Object(Handle),
    /// A mesh of a shape.
    Mesh(Uid),
    /// A script that is no object.
    Script(Rc<Script>),
}

impl PropertyTarget {
    fn object(&self) -> Option<Handle> {
        if let Self::Object(handle) = self {
            Some(*handle)
        } else {
            None
        }
    }
}

/// A property name, taken apart.
enum Name<'a> {
    Static(&'a str),
    Stored(Namespace, &'a str),
    /// A named parameter of the application.
    Param(&'a str),
}

/// Size in bytes from which a value counts as large; the original's limit is unknown.
const LARGE: usize = 1000;

/// Type and flags, as returned by `sim.getPropertyInfo`.
pub(crate) type Info = (ValueType, i64);

impl Sim {
    /// The target a script means by `raw`.
    pub fn property_target(&self, raw: i64, caller: &Rc<Script>) -> ApiResult<PropertyTarget> {
        let script = match raw {
            special::APP => return Ok(PropertyTarget::App),
            special::SCENE => return Ok(PropertyTarget::Scene),
            special::SELF => Some(Rc::clone(caller)),
            special::MAIN_SCRIPT => self.scripts.detached(ScriptType::Main),
            special::SANDBOX => self.scripts.detached(ScriptType::Sandbox),
            _ => match Handle::from_raw(raw).filter(|&handle| self.scene.borrow().exists(handle)) {
                Some(handle) if raw < FIRST_MESH_UID => return Ok(PropertyTarget::Object(handle)),
                _ if self.scene.borrow().mesh(raw).is_some() => {
                    return Ok(PropertyTarget::Mesh(raw));
                }
                _ => self.script(raw),
            },
        };
        let script = script.ok_or(ApiError::NoSuchTarget)?;
        Ok(script
            .object
            .map_or_else(|| PropertyTarget::Script(script), PropertyTarget::Object))
    }

    /// Value of a property of type `ty`.
    pub fn read_property(
        self: &Rc<Self>,
        target: &PropertyTarget,
        name: &str,
        ty: ValueType,
    ) -> ApiResult<Data> {
        let class = self.class_of(target)?;
        match parse_name(class, target, name) {
            Name::Stored(namespace, name) => self.read_stored(target, namespace, name, ty),
            Name::Param(name) => self.read_param(name, ty),
            Name::Static(name) => self.read_row(target, row_of(class, name, ty)?),
        }
    }

    /// Value of a static property.
    pub fn read_row(self: &Rc<Self>, target: &PropertyTarget, row: &Row) -> ApiResult<Data> {
        if row.flags & flags::NOT_READABLE != 0 {
            return Err(ApiError::PropertyNotReadable);
        }
        match &row.source {
            ValueSource::Works(accessor) => {
                let read = accessor.read.ok_or(ApiError::PropertyNotReadable)?;
                read(&Subject { sim: self, target })
                    .map_err(|error| refusal(error, ApiError::PropertyNotReadable))
            }
            ValueSource::Inert(default) => Ok(self
                .read_inert(target, row.name)?
                .unwrap_or_else(|| default.clone())),
            ValueSource::Constant(value) => Ok(value.clone()),
            ValueSource::Engine(param) => {
                Ok(self.scene.borrow().engine_value(param, target.object())?)
            }
            ValueSource::Opposite(of) => Ok((!self.read_row(target, of)?.truthy()).into()),
        }
    }

    /// Sets a property of type `ty`; `writer` becomes the owner of a signal.
    pub(crate) fn write_property(
        self: &Rc<Self>,
        target: &PropertyTarget,
        name: &str,
        (ty, value): (ValueType, Data),
        writer: &Script,
    ) -> ApiResult<()> {
        let class = self.class_of(target)?;
        match parse_name(class, target, name) {
            Name::Stored(namespace, name) => {
                self.write_stored(target, namespace, name, (ty, value), writer)
            }
            Name::Param(name) => self.write_param(name, ty, value),
            Name::Static(name) => self.write_row(target, row_of(class, name, ty)?, value),
        }
    }

    fn write_row(
        self: &Rc<Self>,
        target: &PropertyTarget,
        row: &Row,
        value: Data,
    ) -> ApiResult<()> {
        if row.flags & flags::NOT_WRITABLE != 0 || has_nan(&value) {
            return Err(ApiError::PropertyNotWritable);
        }
        match &row.source {
            ValueSource::Works(accessor) => self.write_through(accessor, target, row, value),
            ValueSource::Inert(default) => {
                let value = row
                    .ty
                    .accept(default, value)
                    .ok_or(ApiError::PropertyNotWritable)?;
                self.write_inert(target, row.name, value)
            }
            ValueSource::Constant(_) => Err(ApiError::PropertyNotWritable),
            ValueSource::Engine(param) => {
                let set = self
                    .scene
                    .borrow_mut()
                    .set_engine_value(param, target.object(), value);
                set.map_err(|_| ApiError::PropertyNotWritable)
            }
            ValueSource::Opposite(of) => self.write_row(target, of, (!value.truthy()).into()),
        }
    }

    /// Writing the current value is no change, so everything that was read can be written back.
    fn write_through(
        self: &Rc<Self>,
        accessor: &Accessor,
        target: &PropertyTarget,
        row: &Row,
        value: Data,
    ) -> ApiResult<()> {
        let write = accessor.write.ok_or(ApiError::PropertyNotWritable)?;
        let written = write(&Subject { sim: self, target }, value.clone());
        written.or_else(|error| match self.read_row(target, row) {
            Ok(current) if current == value => Ok(()),
            _ => Err(refusal(error, ApiError::PropertyNotWritable)),
        })
    }

    /// Removes custom data, a signal or a named parameter.
    pub(crate) fn remove_property(&self, target: &PropertyTarget, name: &str) -> ApiResult<()> {
        let class = self.class_of(target)?;
        let existed = match parse_name(class, target, name) {
            Name::Stored(namespace, name) => self.remove_stored(target, namespace, name)?,
            Name::Param(name) => self.app.borrow_mut().named_params.remove(name).is_some(),
            Name::Static(name) if class.find(name).is_some() => {
                return Err(ApiError::PropertyNotRemovable);
            }
            Name::Static(_) => false,
        };
        if existed {
            Ok(())
        } else {
            Err(ApiError::UnknownProperty)
        }
    }

    /// Type and flags of a property; None if unknown. The flag for large values depends on the present value.
    pub fn property_info(self: &Rc<Self>, target: &PropertyTarget, name: &str) -> Option<Info> {
        let class = self.class_of(target).ok()?;
        let (ty, flags) = match parse_name(class, target, name) {
            Name::Stored(namespace, name) => self.stored_info(target, namespace, name)?,
            Name::Param(name) => {
                let known = self.app.borrow().named_params.contains_key(name);
                known.then_some((
                    ValueType::String,
                    flags::REMOVABLE | flags::MODEL_HASH_EXCLUDE,
                ))?
            }
            Name::Static(name) => class.find(name).map(|row| (row.ty, row.flags))?,
        };
        let large = ty.may_be_large()
            && self
                .read_property(target, name, ty)
                .is_ok_and(|value| value.size() > LARGE);
        Some((
            ty,
            if large {
                flags | flags::LARGE_DATA
            } else {
                flags
            },
        ))
    }

    /// What a static property is, in a sentence; empty for others.
    pub(crate) fn property_description(&self, target: &PropertyTarget, name: &str) -> &'static str {
        let Ok(class) = self.class_of(target) else {
            return "";
        };
        match parse_name(class, target, name) {
            Name::Static(name) => class.find(name).map_or("", |row| row.description),
            Name::Stored(..) | Name::Param(_) => "",
        }
    }

    /// The property at `index` in the order of enumeration, with its class; None past the end. Static ones count only if they begin
    /// with `prefix`; custom data and signals in any case, as in CoppeliaSim.
    pub(crate) fn property_name(
        &self,
        target: &PropertyTarget,
        index: usize,
        prefix: &str,
    ) -> Option<(String, &'static str)> {
        let (before, after) = self.rows_of(target).ok()?;
        let listed = |rows: &'static [Row]| {
            rows.iter()
                .filter(|row| row.flags & flags::DEPRECATED == 0 && row.name.starts_with(prefix))
        };
        let listing = |row: &'static Row| (row.name.to_owned(), row.class);
        if let Some(row) = listed(before).nth(index) {
            return Some(listing(row));
        }
        let index = index - listed(before).count();
        match self.stored_name_at(target, index) {
            Ok(name) => Some((name, before.last()?.class)),
            Err(count) => listed(after).nth(index - count).map(listing),
        }
    }

    /// The static properties of a target in the order of enumeration: those before and those after custom data and signals.
    ///
    /// # Errors
    /// When the target is gone.
    pub fn rows_of(&self, target: &PropertyTarget) -> ApiResult<(&'static [Row], &'static [Row])> {
        Ok(self.class_of(target)?.rows())
    }

    fn class_of(&self, target: &PropertyTarget) -> ApiResult<&'static Class> {
        Ok(match target {
            PropertyTarget::App => app_class(),
            PropertyTarget::Scene => scene_class(),
            PropertyTarget::Script(_) => script_class(),
            PropertyTarget::Mesh(_) => mesh_class(),
            PropertyTarget::Object(handle) => {
                object_class(&self.scene.borrow().object(*handle)?.kind)
            }
        })
    }
}

/// The error when the scene rejects a value: CoppeliaSim's has no reason.
fn refusal(error: ApiError, words: ApiError) -> ApiError {
    if matches!(error, ApiError::Scene(_)) {
        words
    } else {
        error
    }
}

/// No static property can be what is no number.
fn has_nan(value: &Data) -> bool {
    match value {
        Data::Float(number) => number.is_nan(),
        Data::Array(items) => items.iter().any(has_nan),
        _ => false,
    }
}

/// The row of a static property, if it has the requested type.
fn row_of(class: &'static Class, name: &str, ty: ValueType) -> ApiResult<&'static Row> {
    let row = class.find(name).ok_or(ApiError::UnknownProperty)?;
    if row.ty == ty {
        Ok(row)
    } else {
        Err(ApiError::PropertyType)
    }
}

/// Splits a name; it may be prefixed by the class of the target.
fn parse_name<'a>(class: &Class, target: &PropertyTarget, name: &'a str) -> Name<'a> {
    // Names of the version after 4.10 may begin as a class does: `joint.position`.
    let name = match class.find(name) {
        Some(_) => name,
        None => class.without_words(name),
    };
    let stored = !matches!(target, PropertyTarget::Script(_) | PropertyTarget::Mesh(_));
    if let (true, Some(rest)) = (stored, name.strip_prefix("customData.")) {
        return Name::Stored(Namespace::CustomData, rest);
    }
    if let (true, Some(rest)) = (stored, name.strip_prefix("signal.")) {
        return Name::Stored(Namespace::Signal, rest);
    }
    match (target, name.strip_prefix("namedParam.")) {
        (PropertyTarget::App, Some(rest)) => Name::Param(rest),
        _ => Name::Static(name),
    }
}
