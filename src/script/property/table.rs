//! The table of static properties: `static.tsv` says which there are, the files beside it how they are read and written.
//!
//! A property in the table without code exists and can be asked about; reading or writing it says that it is not built.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::access::Accessor;
use super::{app, dummy, joint, object, scene, script, shape};
use crate::scene::{Kind, ValueType};

/// `part<TAB>name<TAB>type<TAB>flags`, in the order of enumeration within a part.
const STATIC: &str = include_str!("static.tsv");

/// Bits of the flags of a property.
pub(crate) mod flags {
    pub const NOT_WRITABLE: i64 = 1;
    pub const NOT_READABLE: i64 = 2;
    pub const REMOVABLE: i64 = 4;
    pub const MODEL_HASH_EXCLUDE: i64 = 8;
    pub const DEPRECATED: i64 = 0x10;
}

/// One static property.
#[derive(Clone, Copy)]
pub(crate) struct Row {
    pub name: &'static str,
    pub ty: ValueType,
    pub flags: i64,
    pub accessor: Option<&'static Accessor>,
}

/// Properties that come together, e.g. those of all dummies.
#[derive(Default)]
pub(crate) struct Part {
    rows: Vec<Row>,
    by_name: HashMap<&'static str, usize>,
}

impl Part {
    pub(crate) fn find(&self, name: &str) -> Option<&Row> {
        self.by_name.get(name).map(|&at| &self.rows[at])
    }

    /// All but the deprecated ones.
    pub(crate) fn listed(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.flags & flags::DEPRECATED == 0)
    }
}

/// The part with that name.
pub(crate) fn part(name: &str) -> &'static Part {
    static PARTS: LazyLock<HashMap<&'static str, Part>> = LazyLock::new(build);
    PARTS.get(name).expect("part names in the code stand in static.tsv")
}

fn build() -> HashMap<&'static str, Part> {
    let accessors = accessors();
    let mut parts: HashMap<&'static str, Part> = HashMap::new();
    for line in STATIC.lines() {
        let fields: Vec<&'static str> = line.split('\t').collect();
        let [part, name, ty, flags] = fields[..] else { panic!("a line of static.tsv has four fields: {line}") };
        let ty = ValueType::from_word(ty).expect("static.tsv holds known types");
        let flags = flags.parse().expect("static.tsv holds flags as integers");
        let entry = parts.entry(part).or_default();
        entry.by_name.insert(name, entry.rows.len());
        entry.rows.push(Row { name, ty, flags, accessor: accessors.get(&(part, name)).copied() });
    }
    parts
}

type Accessors = HashMap<(&'static str, &'static str), &'static Accessor>;

fn accessors() -> Accessors {
    let files: &[(&'static str, &'static [Accessor])] = &[
        ("app", app::APP),
        ("simulation", scene::SIMULATION),
        ("simulation", scene::SIMULATION_SETTINGS),
        ("environment", scene::ENVIRONMENT),
        ("container", scene::CONTAINER),
        ("dynamics", scene::DYNAMICS),
        ("dynamics", scene::PHYSICS_STEP),
        ("object", object::OWN),
        ("object", object::PLACED),
        ("object", object::FLAGS),
        ("object", object::FLAG_SETS),
        ("script", script::SCRIPT),
        ("scriptObject", script::SCRIPT_OBJECT),
        ("dummy", dummy::DUMMY),
        ("colour", dummy::COLOUR),
        ("shape", shape::SHAPE),
        ("object", shape::BOX),
        ("mass", shape::MASS),
        ("joint", joint::JOINT),
        ("joint", joint::CONTROL),
        ("joint", joint::STATE),
    ];
    files.iter().flat_map(|&(part, rows)| rows.iter().map(move |row| ((part, row.name), row))).collect()
}

/// The parts an object of that kind has beside the common one, and the word for its class.
pub(crate) fn parts_of(kind: &Kind) -> (&'static str, &'static [&'static str]) {
    match kind {
        Kind::Shape(_) => ("shape", &["mass", "material", "shape"]),
        Kind::Joint(_) => ("joint", &["colour", "joint"]),
        Kind::Graph(_) => ("graph", &["colour", "graph"]),
        Kind::Camera(_) => ("camera", &["colour", "viewable", "camera"]),
        Kind::Dummy(_) => ("dummy", &["colour", "dummy"]),
        Kind::ProximitySensor(_) => ("proximitySensor", &["colour", "rayColour", "volume", "proximitySensor"]),
        Kind::VisionSensor(_) => ("visionSensor", &["colour", "viewable", "visionSensor"]),
        Kind::ForceSensor(_) => ("forceSensor", &["colour", "forceSensor"]),
        Kind::Light(_) => ("light", &["colour", "lightColour", "light"]),
        Kind::OcTree(_) => ("ocTree", &["colour", "ocTree"]),
        Kind::PointCloud(_) => ("pointCloud", &["colour", "pointCloud"]),
        Kind::Script(_) => ("script", &["colour", "script", "scriptObject"]),
    }
}

#[cfg(test)]
mod tests {
    use super::{STATIC, accessors, part};

    #[test]
    fn every_accessor_has_its_row() {
        for (part_name, name) in accessors().keys() {
            assert!(part(part_name).find(name).is_some(), "{part_name}: {name}");
        }
    }

    #[test]
    fn rows_are_found_by_name() {
        assert!(STATIC.lines().count() > 600);
        assert!(part("object").find("layer").is_some_and(|row| row.flags == 0 && row.accessor.is_some()));
    }
}
