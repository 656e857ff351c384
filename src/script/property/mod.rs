//! Typed properties: named, typed values of the application, the scene, objects and scripts (SPEC-5 5.3 to 5.6).
//!
//! Static properties stand in one table; custom data, signals and named parameters are created by scripts. Meshes and collections
//! are no targets yet.

mod access;
mod app;
mod dummy;
mod joint;
mod object;
mod scene;
mod script;
mod shape;
mod stored;
mod table;
mod value;

use std::rc::Rc;

use super::error::{ApiError, ApiResult};
use super::instance::Script;
use super::sim::Sim;
use crate::scene::script_object::ScriptType;
use crate::scene::{Data, Handle, Namespace, ValueType, special};
use access::Subject;
use table::{Row, flags, part, parts_of};

pub(crate) use app::AppData;
pub(crate) use stored::SignalOwners;
pub use value::{Color, IntPair, Long, PoseArray, PropertyValue, Quaternion, Text, Vector2, Vector3};

/// What has properties.
pub(crate) enum Target {
    App,
    Scene,
    Object(Handle),
    /// A script that is no object.
    Script(Rc<Script>),
}

/// A property name, taken apart.
enum Name<'a> {
    Static(&'a str),
    Stored(Namespace, &'a str),
    /// A named parameter of the application.
    Param(&'a str),
}

/// A part of the table, with its class as `sim.getPropertyName` tells it.
type Part = (&'static str, String);

/// Type and flags, as `sim.getPropertyInfo` tells them.
pub(crate) type Info = (ValueType, i64);

impl Sim {
    /// The target a script means by `raw`.
    pub(crate) fn property_target(&self, raw: i64, caller: &Rc<Script>) -> ApiResult<Target> {
        let script = match raw {
            special::APP => return Ok(Target::App),
            special::SCENE => return Ok(Target::Scene),
            special::SELF => Some(Rc::clone(caller)),
            special::MAIN_SCRIPT => self.detached(ScriptType::Main),
            special::SANDBOX => self.detached(ScriptType::Sandbox),
            _ => match Handle::from_raw(raw).filter(|&handle| self.scene.borrow().exists(handle)) {
                Some(handle) => return Ok(Target::Object(handle)),
                None => self.script(raw),
            },
        };
        let script = script.ok_or(ApiError::NoSuchTarget)?;
        Ok(script.object.map_or_else(|| Target::Script(script), Target::Object))
    }

    /// Value of a property of type `ty`.
    pub(crate) fn read_property(self: &Rc<Self>, target: &Target, name: &str, ty: ValueType) -> ApiResult<Data> {
        match self.parse_name(target, name) {
            Name::Stored(namespace, name) => self.read_stored(target, namespace, name, ty),
            Name::Param(name) => self.read_param(name, ty),
            Name::Static(name) => {
                let row = self.static_row(target, name, ty)?;
                if row.flags & flags::NOT_READABLE != 0 {
                    return Err(ApiError::PropertyNotReadable);
                }
                let read = row.accessor.and_then(|accessor| accessor.read).ok_or_else(|| not_built(name))?;
                read(&Subject { sim: self, target })
            }
        }
    }

    /// Sets a property of type `ty`; `writer` becomes the owner of a signal.
    pub(crate) fn write_property(
        self: &Rc<Self>,
        target: &Target,
        name: &str,
        (ty, value): (ValueType, Data),
        writer: &Script,
    ) -> ApiResult<()> {
        match self.parse_name(target, name) {
            Name::Stored(namespace, name) => self.write_stored(target, namespace, name, (ty, value), writer),
            Name::Param(name) => self.write_param(name, ty, value),
            Name::Static(name) => {
                let row = self.static_row(target, name, ty)?;
                if row.flags & flags::NOT_WRITABLE != 0 {
                    return Err(ApiError::PropertyNotWritable);
                }
                let write = row.accessor.and_then(|accessor| accessor.write).ok_or_else(|| not_built(name))?;
                write(&Subject { sim: self, target }, value)
            }
        }
    }

    /// Removes custom data, a signal or a named parameter.
    pub(crate) fn remove_property(&self, target: &Target, name: &str) -> ApiResult<()> {
        let existed = match self.parse_name(target, name) {
            Name::Stored(namespace, name) => self.remove_stored(target, namespace, name)?,
            Name::Param(name) => self.app.borrow_mut().named_params.remove(name).is_some(),
            Name::Static(name) if self.find_row(target, name).is_some() => return Err(ApiError::PropertyNotRemovable),
            Name::Static(_) => false,
        };
        if existed { Ok(()) } else { Err(ApiError::UnknownProperty) }
    }

    /// Type and flags of a property; None when there is none of that name.
    pub(crate) fn property_info(&self, target: &Target, name: &str) -> Option<Info> {
        match self.parse_name(target, name) {
            Name::Stored(namespace, name) => self.stored_info(target, namespace, name),
            Name::Param(name) => {
                let known = self.app.borrow().named_params.contains_key(name);
                known.then_some((ValueType::String, flags::REMOVABLE | flags::MODEL_HASH_EXCLUDE))
            }
            Name::Static(name) => self.find_row(target, name).map(|row| (row.ty, row.flags)),
        }
    }

    /// All properties in the order of enumeration: name and class. Static ones only if they begin with `prefix`; custom data and
    /// signals in any case, as in CoppeliaSim.
    pub(crate) fn property_names(&self, target: &Target, prefix: &str) -> Vec<(String, String)> {
        let (before, after) = self.parts(target);
        let listed = |parts: &[Part]| -> Vec<(String, String)> {
            let rows = parts.iter().flat_map(|(name, class)| part(name).listed().map(move |row| (row, class)));
            let rows = rows.filter(|(row, _)| row.name.starts_with(prefix));
            rows.map(|(row, class)| (row.name.to_owned(), class.clone())).collect()
        };
        let mut names = listed(&before);
        let class = before.last().map_or_else(|| "app".to_owned(), |(_, class)| class.clone());
        names.extend(self.stored_names(target).into_iter().map(|name| (name, class.clone())));
        names.extend(listed(&after));
        names
    }

    /// The parts of the table a target has, each with its class: those before and those after the named values.
    fn parts(&self, target: &Target) -> (Vec<Part>, Vec<Part>) {
        let with = |names: &[&'static str], class: &str| names.iter().map(|&n| (n, class.to_owned())).collect();
        match target {
            Target::App => (with(&["app"], "app"), Vec::new()),
            Target::Scene => (with(&["dynamics", "simulation", "environment", "container"], "app.scene"), Vec::new()),
            Target::Script(_) => (with(&["script"], "app.script"), Vec::new()),
            Target::Object(handle) => {
                let scene = self.scene.borrow();
                let Ok(object) = scene.object(*handle) else { return Default::default() };
                let (class, names) = parts_of(&object.kind);
                (with(&["object"], "app.scene.object"), with(names, &format!("app.scene.object.{class}")))
            }
        }
    }

    fn find_row(&self, target: &Target, name: &str) -> Option<&'static Row> {
        let (before, after) = self.parts(target);
        before.iter().chain(&after).find_map(|(part_name, _)| part(part_name).find(name))
    }

    /// The row of a static property that has the type it is asked for.
    fn static_row(&self, target: &Target, name: &str, ty: ValueType) -> ApiResult<&'static Row> {
        let row = self.find_row(target, name).ok_or(ApiError::UnknownProperty)?;
        if row.ty == ty { Ok(row) } else { Err(ApiError::PropertyType) }
    }

    /// Takes a name apart; the class of the target may stand in front of it.
    fn parse_name<'a>(&self, target: &Target, name: &'a str) -> Name<'a> {
        let name = self.without_class(target, name);
        let stored = !matches!(target, Target::Script(_));
        if let (true, Some(rest)) = (stored, name.strip_prefix("customData.")) {
            return Name::Stored(Namespace::CustomData, rest);
        }
        if let (true, Some(rest)) = (stored, name.strip_prefix("signal.")) {
            return Name::Stored(Namespace::Signal, rest);
        }
        match (target, name.strip_prefix("namedParam.")) {
            (Target::App, Some(rest)) => Name::Param(rest),
            _ => Name::Static(name),
        }
    }

    fn without_class<'a>(&self, target: &Target, name: &'a str) -> &'a str {
        let strip = |name: &'a str, class: &str| -> &'a str {
            name.strip_prefix(class).and_then(|rest| rest.strip_prefix('.')).unwrap_or(name)
        };
        match target {
            Target::App => strip(name, "app"),
            Target::Scene => strip(strip(name, "app"), "scene"),
            Target::Script(_) => strip(strip(name, "scene"), "script"),
            Target::Object(handle) => {
                let scene = self.scene.borrow();
                let class = scene.object(*handle).map_or("object", |object| parts_of(&object.kind).0);
                strip(strip(strip(name, "scene"), "object"), class)
            }
        }
    }
}

fn not_built(name: &str) -> ApiError {
    ApiError::NotImplemented(format!("property {name}"))
}
