//! Properties of a target in the event stream, and which of them a change can affect (spec: events 8).

use heap::{Lazy, outside};
use std::collections::BTreeMap;
use std::sync::Mutex;

use crate::event_stream::protocol::{Meaning, Protocol, renamed};
use crate::property::{Class, Row, flags};
use scene::Field;

/// Readable properties without events: derived ones, those read on purpose, and those that differ at each reading.
const SILENT: &[&str] = &[
    "objectUid",
    "mov.optionsFlags",
    "mov.preferredAxesFlags",
    "visible",
    "modelHash",
    "meshes",
    "executionDepth",
    "jointForce",
    "color.transparency",
    "imageBuffer",
    "depthBuffer",
    "povray.castShadows",
    "povray.focalBlur",
    "povray.blurSamples",
    "povray.blurDistance",
    "povray.aperture",
    "closeThreshold",
    "objectCreationCounter",
    "objectDestructionCounter",
    "hierarchyChangeCounter",
    "processId",
    "processCnt",
    "randomFloat",
    "randomQuaternion",
    "randomString",
    // Sent whenever objects are added, removed or selected, see `Sim::push_list`.
    "objectHandles",
    "orphanHandles",
    "selectionHandles",
];

/// Too large to store the last value: sent when this changes, and with the geometry.
const LARGE: &[(Field, &[&str])] = &[
    (Field::Geometry, &["vertices", "indices", "normals"]),
    (Field::Texture, &["textureCoordinates", "rawTexture"]),
];

/// Properties that share an event.
const PAIRS: &[[&str; 2]] = &[["bbPose", "bbHSize"], ["parentUid", "parentHandle"]];

/// Fields that change in nearly every step, and their properties. A change of any other field can concern all properties. A new alias
/// is told before the order among namesakes that results from it.
const FREQUENT: &[(Field, &[&str])] = &[
    (Field::Alias, &["alias", "scriptName"]),
    (Field::Pose, &["pose"]),
    (
        Field::Measured,
        &[
            "calcLinearVelocity",
            "calcRotationAxis",
            "calcRotationVelocity",
            "dynamicFlag",
            "dynLinearVelocity",
            "dynAngularVelocity",
            "sensorForce",
            "sensorTorque",
            "filterSensorForce",
            "filterSensorTorque",
            "detectedObjectHandle",
            "detectedPoint",
            "detectedNormal",
        ],
    ),
    (
        Field::JointPosition,
        &[
            "jointPosition",
            "quaternion",
            "intrinsicPose",
            "intrinsicError",
            "calcVelocity",
            "averageJointForce",
        ],
    ),
    (
        Field::JointControl,
        &[
            "targetPos",
            "targetVel",
            "targetForce",
            "dynCtrlMode",
            "dynVelMode",
            "dynPosMode",
            "maxVelAccelJerk",
            "springDamperParams",
        ],
    ),
];

/// One property of the stream.
pub(super) struct StreamProperty {
    pub row: &'static Row,
    /// Index of the property in the same event.
    pub partner: Option<usize>,
    /// Not stored; sent when this or the geometry changes.
    pub large: Option<Field>,
    /// Name and meaning in protocol 4.
    pub renamed: (&'static str, Meaning),
}

impl StreamProperty {
    /// The name listeners know it by.
    pub(super) fn key(&self, protocol: Protocol) -> &'static str {
        if protocol == Protocol::V4 {
            self.renamed.0
        } else {
            self.row.name
        }
    }
}

/// The properties of a class of targets, in their order.
pub(super) struct Keys {
    pub properties: Vec<StreamProperty>,
    frequent: Vec<(Field, Vec<usize>)>,
    all: Vec<usize>,
}

impl Keys {
    fn of_class(class: &'static Class) -> Self {
        let (before, after) = class.rows();
        let rows: Vec<&'static Row> = before
            .iter()
            .chain(after)
            .filter(|row| is_sent(row))
            .collect();
        let index = |name: &str| rows.iter().position(|row| row.name == name);
        let partner = |name: &str| {
            let pair = PAIRS.iter().find(|pair| pair.contains(&name))?;
            index(pair.iter().find(|other| **other != name)?)
        };
        let properties = rows.iter().map(|row| StreamProperty {
            row,
            partner: partner(row.name),
            large: LARGE
                .iter()
                .find(|(_, names)| names.contains(&row.name))
                .map(|(field, _)| *field),
            renamed: renamed(row.class, row.name),
        });
        let properties = properties.collect();
        let indices = |names: &[&str]| names.iter().filter_map(|name| index(name)).collect();
        let frequent = FREQUENT
            .iter()
            .map(|(field, names)| (*field, indices(names)))
            .collect();
        Self {
            properties,
            frequent,
            all: (0..rows.len()).collect(),
        }
    }

    /// Indices of the properties a change of `field` can concern.
    pub(super) fn concerned(&self, field: Field) -> &[usize] {
        self.frequent
            .iter()
            .find(|(frequent, _)| *frequent == field)
            .map_or(&self.all, |(_, indices)| indices)
    }

    pub(super) fn all(&self) -> &[usize] {
        &self.all
    }

    pub(super) fn index_of(&self, name: &str) -> Option<usize> {
        self.properties
            .iter()
            .position(|property| property.row.name == name)
    }
}

fn is_sent(row: &Row) -> bool {
    let hidden = flags::NOT_READABLE | flags::DEPRECATED;
    row.flags & hidden == 0 && !SILENT.contains(&row.name) && !row.name.starts_with("volume_")
}

/// The properties sent for targets of that class: computed once per process.
pub fn keys(class: &'static Class) -> &'static Keys {
    static KNOWN: Lazy<Mutex<BTreeMap<usize, &'static Keys>>> = Lazy::new(Mutex::default);
    let mut known = KNOWN
        .lock()
        .expect("nothing panics while it holds the lock");
    let address = std::ptr::from_ref(class) as usize;
    outside(|| {
        known
            .entry(address)
            .or_insert_with(|| Box::leak(Box::new(Keys::of_class(class))))
    })
}
