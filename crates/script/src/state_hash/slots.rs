//! What is hashed of each class of targets: values read directly, and all properties that hold a state of their own.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Mutex;

use heap::{Lazy, outside};

use super::bytes::{Bytes, Key64};
use super::readers::{DIRECT, Direct, TREE};
use crate::host::Sim;
use crate::property::{Class, PropertyTarget, Row, flags, object_class, scene_class};
use scene::{Field, Kind, Object, Topic, Topics};

/// Readable properties that are not hashed: those that follow from the state of others, are no state of the simulation, or differ
/// between runs that are the same.
const LEFT_OUT: &[&str] = &[
    // Follow from other objects, from the geometry, or from what is hashed directly.
    "modelInvisible",
    "visible",
    "modelHash",
    "modelBase",
    "selected",
    "bbPose",
    "bbHSize",
    "engineProperties",
    "applyCulling",
    "applyShadingAngle",
    "applyShowEdges",
    "applyColor.diffuse",
    "applyColor.specular",
    "applyColor.emission",
    "applyColor.transparency",
    "frustumCornerNear",
    "frustumCornerFar",
    "volume_edges",
    "volume_closeEdges",
    // Of scripts: hashed apart, since no journal records them.
    "executionDepth",
    "scriptState",
    "scriptName",
    "addOnPath",
    "addOnMenuPath",
    // What a script does counts, not how it is written: a script that was changed can be compared with what it was.
    "code",
    // Of the scene: hashed apart.
    "simulationTime",
    "stepCount",
    "simulationState",
    "objectHandles",
    "orphanHandles",
    "selectionHandles",
    // Of the session, or of the file that the scene came from.
    "objectCreationCounter",
    "objectDestructionCounter",
    "hierarchyChangeCounter",
    "sceneUid",
    "sceneUidString",
    "scenePath",
    "finalSaveRequest",
];

/// Properties that are large: only changes of the geometry concern them.
const LARGE: &[&str] = &["voxels", "points", "colors"];

/// Changes of nearly every step. Any other change of an object can concern all its properties.
const FREQUENT_FIELDS: &[Field] = &[
    Field::Alias,
    Field::Pose,
    Field::Measured,
    Field::JointPosition,
    Field::JointControl,
    Field::Texture,
];

const FREQUENT: Topics = Topics::NONE.with_fields(FREQUENT_FIELDS);

const GEOMETRY: Topics = Topics::NONE.with(Topic::Field(Field::Geometry));

/// One hashed value of a class of targets.
pub(super) struct Slot {
    pub name: &'static str,
    pub key: Key64,
    /// Changes that concern it.
    topics: Topics,
    read: Read,
}

enum Read {
    Direct(&'static Direct),
    Property(&'static Row),
}

/// The hashed values of a class of targets.
pub(super) struct Slots {
    /// Those read directly come first.
    pub slots: Vec<Slot>,
    /// How many they are.
    direct: usize,
    /// The positions of those that each frequent change concerns.
    frequent: Vec<(Topic, Vec<usize>)>,
}

/// Changes that can concern any value.
pub(super) const GENERAL: Topics = Topics::ALL.without(FREQUENT);

impl Slots {
    /// Of objects of that kind: made once per process.
    pub(super) fn of_kind(kind: &Kind) -> &'static Self {
        static KNOWN: Lazy<Mutex<BTreeMap<i64, &'static Slots>>> = Lazy::new(Mutex::default);
        let mut known = KNOWN
            .lock()
            .expect("nothing panics while it holds the lock");
        outside(|| {
            known
                .entry(kind.type_number())
                .or_insert_with(|| Box::leak(Box::new(Self::new_of_kind(kind))))
        })
    }

    fn new_of_kind(kind: &Kind) -> Self {
        let direct: Vec<&'static Direct> = DIRECT.iter().filter(|one| (one.of)(kind)).collect();
        let replaced = |name: &str| {
            direct
                .iter()
                .any(|one| one.name == name || one.also.contains(&name))
        };
        let properties = properties_of(object_class(kind)).filter(|row| !replaced(row.name));
        let slots = direct.iter().map(|one| Slot::direct(one));
        Self::new(
            slots.chain(properties.map(Slot::property)).collect(),
            direct.len(),
        )
    }

    /// Of the scene.
    pub(super) fn of_scene() -> &'static Self {
        static SLOTS: Lazy<Slots> = Lazy::new(|| {
            let slots = properties_of(scene_class()).map(Slot::property).collect();
            Slots::new(slots, 0)
        });
        &SLOTS
    }

    fn new(slots: Vec<Slot>, direct: usize) -> Self {
        let concerned = |topic: Topic| {
            let places = 0..slots.len();
            let places = places.filter(|at| slots[*at].topics.contains(topic));
            (topic, places.collect())
        };
        let fields = FREQUENT_FIELDS.iter().map(|field| Topic::Field(*field));
        let frequent = fields.map(concerned).collect();
        Self {
            slots,
            direct,
            frequent,
        }
    }

    /// The positions of the values that these changes can concern.
    pub(super) fn concerned(&self, changes: Topics) -> impl Iterator<Item = usize> {
        let is_general = changes.intersects(GENERAL);
        let all = if is_general {
            0..self.slots.len()
        } else {
            0..0
        };
        let all = all.filter(move |at| self.slots[*at].topics.intersects(changes));
        let frequent = if is_general { &[] } else { &self.frequent[..] };
        let frequent = frequent
            .iter()
            .filter(move |(topic, _)| changes.contains(*topic));
        all.chain(frequent.flat_map(|(_, places)| places.iter().copied()))
    }

    /// The positions of where an object is in the tree.
    pub(super) fn about_tree(&self) -> std::ops::Range<usize> {
        0..TREE.min(self.direct)
    }
}

/// The properties of a class that hold a state, without those with other names for the same.
fn properties_of(class: &'static Class) -> impl Iterator<Item = &'static Row> {
    let hidden = flags::NOT_READABLE | flags::DEPRECATED;
    let (before, after) = class.rows();
    before
        .iter()
        .chain(after)
        .filter(move |row| row.flags & hidden == 0 && !LEFT_OUT.contains(&row.name))
}

impl Slot {
    fn direct(direct: &'static Direct) -> Self {
        let topics = if direct.large {
            direct.topics
        } else {
            direct.topics.and(GENERAL)
        };
        Self {
            name: direct.name,
            key: Key64::of_name(direct.name),
            topics,
            read: Read::Direct(direct),
        }
    }

    fn property(row: &'static Row) -> Self {
        let is_large = LARGE.contains(&row.name);
        Self {
            name: row.name,
            key: Key64::of_name(row.name),
            topics: if is_large { GEOMETRY } else { GENERAL },
            read: Read::Property(row),
        }
    }

    /// The hash of the value that an object has.
    pub(super) fn hash_of(&self, sim: &Rc<Sim>, object: &Object, bytes: &mut Bytes) -> u64 {
        let handle = object.handle();
        match self.read {
            Read::Direct(direct) => (direct.read)(object, bytes),
            Read::Property(row) => {
                write_property(sim, &PropertyTarget::Object(handle), row, bytes);
            }
        }
        bytes.take_hash(self.key.on(handle.raw()))
    }

    /// The hash of the value that the scene has.
    pub(super) fn hash_of_scene(&self, sim: &Rc<Sim>, bytes: &mut Bytes) -> u64 {
        if let Read::Property(row) = self.read {
            write_property(sim, &PropertyTarget::Scene, row, bytes);
        }
        bytes.take_hash(self.key.on(scene::special::SCENE))
    }
}

/// A property that cannot be read now has no value.
fn write_property(sim: &Rc<Sim>, target: &PropertyTarget, row: &Row, bytes: &mut Bytes) {
    if let Ok(value) = sim.read_row(target, row) {
        bytes.data(&value);
    }
}
