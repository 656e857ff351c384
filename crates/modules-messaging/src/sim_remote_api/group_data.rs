//! One kind of data of many objects (spec: legacy-remote-api 5.2).

use super::call::{Call, Failure, Outcome, bytes, floats, integer};
use scene::Data;

/// `sim.appobj_object_type`: all objects.
const ALL_OBJECTS: i64 = 109;

/// The largest number of a type of objects.
const LAST_TYPE: i64 = 19;

/// Added to the mode of a joint in hybrid operation, which 4.10 does not have any more: no joint has it.
const NO_JOINT: [f32; 2] = [0.0; 2];

/// The data of all objects, by kind.
#[derive(Default)]
struct Lists {
    ints: Vec<i64>,
    floats: Vec<f32>,
    texts: Vec<Vec<u8>>,
}

/// Reads one kind of data of all objects, those of a type, or those of a collection.
pub(super) fn read(call: &mut Call<'_>) -> Outcome {
    let (group, kind) = (i64::from(call.key.int()?), call.key.int()?);
    let objects = members(call, group)?;
    let mut lists = Lists::default();
    for &object in &objects {
        lists.add(call, Data::Int(object), kind)?;
    }
    let sizes = [
        objects.len(),
        lists.ints.len(),
        lists.floats.len(),
        lists.texts.len(),
    ];
    sizes.into_iter().for_each(|size| call.out.size(size));
    objects
        .iter()
        .chain(&lists.ints)
        .for_each(|&value| call.write_int(value));
    lists.floats.iter().for_each(|&value| call.out.float(value));
    lists.texts.iter().for_each(|text| call.out.text(text));
    Ok(())
}

fn members(call: &Call<'_>, group: i64) -> Result<Vec<i64>, Failure> {
    let scene = call.host.scene();
    if !(0..=LAST_TYPE).contains(&group) && group != ALL_OBJECTS {
        return Ok(scene
            .collection_objects(group)?
            .into_iter()
            .map(scene::Handle::raw)
            .collect());
    }
    let is_member = |object: &&scene::Object| group == ALL_OBJECTS || object.is_of_type(group);
    Ok(scene
        .objects()
        .filter(is_member)
        .map(|object| object.handle().raw())
        .collect())
}

impl Lists {
    /// Adds the data of one object.
    fn add(&mut self, call: &Call<'_>, object: Data, kind: i32) -> Outcome {
        const WORLD: i64 = -1;
        const PARENT: i64 = -11;
        match kind {
            0 => self.text(call, "sim.getObjectName", &[object])?,
            1 => self
                .ints
                .push(call.integer("sim.getObjectType", &[object])?),
            2 => self
                .ints
                .push(call.integer("sim.getObjectParent", &[object])?),
            3 | 4 => self.numbers(call, "sim.getObjectPosition", &[object, frame(kind == 4)])?,
            5 | 6 => self.numbers(
                call,
                "sim.getObjectOrientation",
                &[object, frame(kind == 6)],
            )?,
            7 | 8 => self.numbers(call, "sim.getObjectQuaternion", &[object, frame(kind == 8)])?,
            9 | 10 => self.pose(call, &object, "sim.getObjectOrientation", kind == 10)?,
            11 | 12 => self.pose(call, &object, "sim.getObjectQuaternion", kind == 12)?,
            13 => self.proximity(call, object),
            14 => self.force(call, object),
            15 => self.joint_state(call, &object),
            16 => self.joint(call, &object),
            17..=19 => self.velocity(call, &object, kind)?,
            20 => self.text(call, "sim.getObjectAlias", &[object])?,
            21 => self.text(call, "sim.getObjectAlias", &[object, Data::Int(2)])?,
            _ => return Err(Failure::Text(format!("there is no data of kind {kind}."))),
        }
        return Ok(());

        fn frame(is_relative: bool) -> Data {
            Data::Int(if is_relative { PARENT } else { WORLD })
        }
    }

    fn text(&mut self, call: &Call<'_>, function: &str, args: &[Data]) -> Outcome {
        self.texts
            .push(bytes(&call.value(function, args)?).to_vec());
        Ok(())
    }

    fn numbers(&mut self, call: &Call<'_>, function: &str, args: &[Data]) -> Outcome {
        self.floats.extend(floats(&call.value(function, args)?));
        Ok(())
    }

    /// The position, and the rotation as a function returns it.
    fn pose(
        &mut self,
        call: &Call<'_>,
        object: &Data,
        rotation: &str,
        is_relative: bool,
    ) -> Outcome {
        let args = [
            object.clone(),
            Data::Int(if is_relative { -11 } else { -1 }),
        ];
        self.numbers(call, "sim.getObjectPosition", &args)?;
        self.numbers(call, rotation, &args)
    }

    /// What a proximity sensor detects: state, object, point and normal.
    fn proximity(&mut self, call: &Call<'_>, object: Data) {
        let results = call
            .api("sim.readProximitySensor", &[object])
            .unwrap_or_default();
        let (ints, numbers) = match &results[..] {
            [state, _distance, point, detected, normal, ..] => (
                [integer(state), integer(detected)],
                [floats(point), floats(normal)].concat(),
            ),
            _ => ([-1; 2], vec![0.0; 6]),
        };
        self.ints.extend(ints);
        self.floats.extend(numbers);
    }

    /// What a force sensor measures: state, force and torque.
    fn force(&mut self, call: &Call<'_>, object: Data) {
        let results = call
            .api("sim.readForceSensor", &[object])
            .unwrap_or_default();
        let (state, numbers) = match &results[..] {
            [state, force, torque, ..] => {
                (integer(state), [floats(force), floats(torque)].concat())
            }
            _ => (-1, vec![0.0; 6]),
        };
        self.ints.push(state);
        self.floats.extend(numbers);
    }

    /// Position and force of a joint.
    fn joint_state(&mut self, call: &Call<'_>, object: &Data) {
        let object = std::slice::from_ref(object);
        let position = call.value("sim.getJointPosition", object);
        let force = call.value("sim.getJointForce", object);
        match (position, force) {
            (Ok(position), Ok(force)) => self
                .floats
                .extend(floats(&position).into_iter().chain(floats(&force))),
            _ => self.floats.extend(NO_JOINT),
        }
    }

    /// Type and mode of a joint, the lower limit and the range.
    fn joint(&mut self, call: &Call<'_>, object: &Data) {
        let object = std::slice::from_ref(object);
        let kind = call.integer("sim.getJointType", object).unwrap_or(-1);
        let mode = call.integer("sim.getJointMode", object).unwrap_or(-1);
        let interval = call.api("sim.getJointInterval", object).unwrap_or_default();
        self.ints.extend([kind, mode]);
        match &interval[..] {
            [Data::Bool(cyclic), limits, ..] => {
                let limits = floats(limits);
                self.floats
                    .extend(if *cyclic { vec![0.0, -1.0] } else { limits });
            }
            _ => self.floats.extend(NO_JOINT),
        }
    }

    fn velocity(&mut self, call: &Call<'_>, object: &Data, kind: i32) -> Outcome {
        let results = call.api("sim.getObjectVelocity", std::slice::from_ref(object))?;
        let parts = match kind {
            17 => 0..1,
            18 => 1..2,
            _ => 0..2,
        };
        self.floats.extend(
            results
                .get(parts)
                .unwrap_or_default()
                .iter()
                .flat_map(floats),
        );
        Ok(())
    }
}
