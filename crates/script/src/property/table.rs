//! The table of static properties: `static.tsv` lists them and their effect; the files in `types` read and write those that have
//! one.

mod accessors;
mod descriptions;
mod lines;
#[cfg(test)]
mod tests;

use heap::Lazy;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use super::access::Accessor;
pub use crate::event_stream::protocol::{LaterName, later_names};
use crate::event_stream::protocol::{Meaning, renamed};
use ::scene::parameters::engine::{EngineParam, engine_params};
use ::scene::{Data, Kind, ValueType};
use accessors::accessors;
use descriptions::description;
use lines::{ENGINE_PARTS, lines};
pub use lines::{Line, described};

/// Bits of the flags of a property.
pub mod flags {
    /// `sim.propertyinfo_notwritable`: scripts cannot set it.
    pub const NOT_WRITABLE: i64 = 1;
    /// `sim.propertyinfo_notreadable`: scripts cannot read it.
    pub const NOT_READABLE: i64 = 2;
    /// `sim.propertyinfo_removable`: scripts can remove it.
    pub const REMOVABLE: i64 = 4;
    /// `sim.propertyinfo_modelhashexclude`: the hash of a model does not depend on it.
    pub const MODEL_HASH_EXCLUDE: i64 = 8;
    /// `sim.propertyinfo_deprecated`: another property replaces it.
    pub const DEPRECATED: i64 = 0x10;
    /// `sim.propertyinfo_largedata`: its value may be large.
    pub const LARGE_DATA: i64 = 0x100;
}

/// One static property of one class.
#[derive(Clone)]
pub struct Row {
    /// Its name, without the class.
    pub name: &'static str,
    /// The type of its value.
    pub ty: ValueType,
    /// Bits of [`flags`].
    pub flags: i64,
    /// Where its value comes from.
    pub source: ValueSource,
    /// The class as returned by `sim.getPropertyName`.
    pub class: &'static str,
    /// What it is, in a sentence.
    pub description: &'static str,
}

/// The source of the value of a property.
#[derive(Clone)]
pub enum ValueSource {
    /// It is read and written by code.
    Works(&'static Accessor),
    /// Stored as scripts set it, without effect; the default until then.
    Inert(Data),
    /// Always this value.
    Constant(Data),
    /// A parameter of a physics engine.
    Engine(&'static EngineParam),
    /// True where another property is false.
    Opposite(Box<Row>),
}

/// Targets that have the same static properties.
pub struct Class {
    /// The class name, which may prefix a property name.
    pub word: &'static str,
    /// Words that may precede it.
    outer: &'static [&'static str],
    /// In the order of enumeration.
    rows: Vec<Row>,
    /// Properties of the version after 4.10 that are the opposite of a row. They are in no list.
    opposites: Vec<Row>,
    /// How many rows come before custom data and signals.
    common: usize,
    by_name: ByName,
}

impl Class {
    /// The row with that name, or with that name in the version after 4.10; without class in front.
    pub(crate) fn find(&self, name: &str) -> Option<&Row> {
        match self.by_name.get(name) {
            Some(&at) => Some(&self.rows[at]),
            None => self.opposites.iter().find(|row| row.name == name),
        }
    }

    /// The rows that come before custom data and signals, and those that come after.
    pub(crate) fn rows(&self) -> (&[Row], &[Row]) {
        self.rows.split_at(self.common)
    }

    /// The name without a prefix for the class.
    pub(crate) fn without_words<'a>(&self, name: &'a str) -> &'a str {
        if !name.contains('.') {
            return name;
        }
        let strip = |name: &'a str, word: &str| name.strip_prefix(word)?.strip_prefix('.');
        let words = self.outer.iter().copied().chain([self.word]);
        words.fold(name, |name, word| strip(name, word).unwrap_or(name))
    }
}

/// The index of the rows by name.
type ByName = HashMap<&'static str, usize, BuildHasherDefault<NameHasher>>;

/// FNV-1a: the names are short and known, so that nothing dearer is needed.
struct NameHasher(u64);

impl Default for NameHasher {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Hasher for NameHasher {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
    }
}

/// Definition of a class: its word, its path, the words that may precede it, its parts before and after the named values.
type ClassSpec = (
    &'static str,
    &'static str,
    &'static [&'static str],
    &'static [&'static str],
    &'static [&'static str],
);

/// The classes, in the order of [`CLASSES`].
#[derive(Clone, Copy)]
enum ClassId {
    App,
    Scene,
    /// Scripts that are no objects.
    Script,
    Shape,
    Joint,
    Graph,
    Camera,
    Dummy,
    ProximitySensor,
    Path,
    VisionSensor,
    ForceSensor,
    Light,
    OcTree,
    PointCloud,
    ScriptObject,
    Mesh,
}

/// The path of the part all objects have.
const OBJECT_PATH: &str = "app.scene.object";
const OBJECT: &[&str] = &["scene", "object"];

#[rustfmt::skip]
const CLASSES: [ClassSpec; 17] = [
    ("app", "app", &[], &["app"], &[]),
    ("scene", "app.scene", &["app"], &["dynamics", "simulation", "environment", "container"], &[]),
    ("script", "app.script", &["scene"], &["script"], &[]),
    ("shape", "app.scene.object.shape", OBJECT, &["object"], &["mass", "material", "shape"]),
    ("joint", "app.scene.object.joint", OBJECT, &["object"], &["colour", "joint"]),
    ("graph", "app.scene.object.graph", OBJECT, &["object"], &["colour", "graph"]),
    ("camera", "app.scene.object.camera", OBJECT, &["object"], &["colour", "viewable", "camera"]),
    ("dummy", "app.scene.object.dummy", OBJECT, &["object"], &["colour", "dummy"]),
    ("proximitySensor", "app.scene.object.proximitySensor", OBJECT, &["object"], &["colour", "rayColour", "volume", "proximitySensor"]),
    ("path", "app.scene.object.path", OBJECT, &["object"], &["colour"]),
    ("visionSensor", "app.scene.object.visionSensor", OBJECT, &["object"], &["colour", "viewable", "visionSensor"]),
    ("forceSensor", "app.scene.object.forceSensor", OBJECT, &["object"], &["colour", "forceSensor"]),
    ("light", "app.scene.object.light", OBJECT, &["object"], &["colour", "lightColour", "light"]),
    ("octree", "app.scene.object.octree", OBJECT, &["object"], &["colour", "ocTree"]),
    ("pointCloud", "app.scene.object.pointCloud", OBJECT, &["object"], &["colour", "pointCloud"]),
    ("script", "app.scene.object.script", OBJECT, &["object"], &["colour", "script", "scriptObject"]),
    ("mesh", "app.scene.mesh", &["scene"], &["colour", "mesh"], &[]),
];

/// The class of the application.
pub fn app_class() -> &'static Class {
    class(ClassId::App)
}

/// The class of the scene.
pub fn scene_class() -> &'static Class {
    class(ClassId::Scene)
}

/// The class of scripts that are no objects.
pub fn script_class() -> &'static Class {
    class(ClassId::Script)
}

/// The class of the meshes of shapes.
pub fn mesh_class() -> &'static Class {
    class(ClassId::Mesh)
}

/// The class of objects of that kind.
pub fn object_class(kind: &Kind) -> &'static Class {
    class(match kind {
        Kind::Shape(_) => ClassId::Shape,
        Kind::Joint(_) => ClassId::Joint,
        Kind::Graph(_) => ClassId::Graph,
        Kind::Camera(_) => ClassId::Camera,
        Kind::Dummy(_) => ClassId::Dummy,
        Kind::ProximitySensor(_) => ClassId::ProximitySensor,
        Kind::Path(_) => ClassId::Path,
        Kind::VisionSensor(_) => ClassId::VisionSensor,
        Kind::ForceSensor(_) => ClassId::ForceSensor,
        Kind::Light(_) => ClassId::Light,
        Kind::OcTree(_) => ClassId::OcTree,
        Kind::PointCloud(_) => ClassId::PointCloud,
        Kind::Script(_) => ClassId::ScriptObject,
    })
}

fn class(id: ClassId) -> &'static Class {
    &classes()[id as usize]
}

fn classes() -> &'static [Class] {
    static ALL: Lazy<Vec<Class>> = Lazy::new(|| {
        let parts = parts();
        CLASSES.iter().map(|spec| build(spec, &parts)).collect()
    });
    &ALL
}

fn build(&(word, path, outer, before, after): &ClassSpec, parts: &Parts) -> Class {
    let rows_of = |names: &[&'static str]| -> Vec<Row> {
        let with_class = |part: &str, row: &Row| Row {
            class: if part == "object" { OBJECT_PATH } else { path },
            ..row.clone()
        };
        names
            .iter()
            .flat_map(|&part| parts[part].iter().map(move |row| with_class(part, row)))
            .collect()
    };
    let (mut rows, own) = (rows_of(before), rows_of(after));
    let common = rows.len();
    rows.extend(own);
    let mut by_name: ByName = rows
        .iter()
        .enumerate()
        .map(|(at, row)| (row.name, at))
        .collect();
    let mut opposites = Vec::new();
    for (at, row) in rows.iter().enumerate() {
        match renamed(row.class, row.name) {
            (later, Meaning::Not) => opposites.push(opposite(later, row)),
            (later, _) if later != row.name => {
                by_name.entry(later).or_insert(at);
            }
            _ => {}
        }
    }
    Class {
        word,
        outer,
        rows,
        opposites,
        common,
        by_name,
    }
}

/// The property that is true where `row` is false.
fn opposite(name: &'static str, row: &Row) -> Row {
    Row {
        name,
        description: "True where its older name is false, and the reverse.",
        source: ValueSource::Opposite(Box::new(row.clone())),
        ..row.clone()
    }
}

type Parts = HashMap<&'static str, Vec<Row>>;

fn parts() -> Parts {
    let accessors = accessors();
    let mut parts = Parts::new();
    for line in lines() {
        let Line {
            part,
            name,
            ty,
            flags,
            state,
            default,
            description,
        } = line;
        let is_other_word = state == "works" && !default.is_empty();
        let value = || {
            ty.parse(default)
                .expect("static.tsv holds defaults of the row's type")
        };
        let source = match (
            accessors.get(&(part, if is_other_word { default } else { name })),
            state,
        ) {
            (Some(accessor), _) => ValueSource::Works(accessor),
            (None, "inert") => ValueSource::Inert(value()),
            (None, "constant") => ValueSource::Constant(value()),
            _ => panic!("a property in static.tsv that works has an accessor: {part} {name}"),
        };
        parts.entry(part).or_default().push(Row {
            name,
            ty,
            flags,
            source,
            class: "",
            description,
        });
    }
    for (part, owner) in ENGINE_PARTS {
        parts.entry(part).or_default().extend(
            engine_params(owner)
                .filter(|param| param.is_property)
                .map(|param| engine_row(part, param)),
        );
    }
    parts
}

fn engine_row(part: &str, param: &'static EngineParam) -> Row {
    Row {
        name: param.name,
        ty: param.ty,
        flags: param.flags,
        source: ValueSource::Engine(param),
        class: "",
        description: description(part, param.name),
    }
}
