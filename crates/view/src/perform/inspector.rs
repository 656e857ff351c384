//! Rows of the inspector: properties with values, groups and units.

use serde_json::{Value, json};

use super::values::to_json;
use crate::sample::WORLD_POSE;
use geometry::pose::pose_to_array;
use scene::Handle;
use scene::joint::JointType;
use simulator::PropertyRow;
use simulator::Simulator;

/// Units of properties that have one: name, unit.
const UNITS: &str = include_str!("units.tsv");

/// Names of the properties of an object, and their rows.
///
/// # Errors
/// When there is nothing with that handle.
pub(crate) fn rows(sim: &Simulator, handle: i64) -> Result<Vec<(String, Value)>, String> {
    let rows = sim
        .property_rows(handle)
        .map_err(|error| error.to_string())?;
    let motion = motion(sim, handle);
    let described = rows
        .into_iter()
        .map(|row| (row.name.clone(), describe(&row, motion)));
    Ok(world_pose(sim, handle)
        .into_iter()
        .chain(described)
        .collect())
}

/// How a joint moves; other objects have no units that depend on it.
#[derive(Clone, Copy, PartialEq)]
enum Motion {
    Turns,
    Slides,
}

fn motion(sim: &Simulator, handle: i64) -> Motion {
    let scene = sim.scene();
    let object = Handle::from_raw(handle).and_then(|handle| scene.object(handle).ok());
    let slides = object
        .and_then(|object| object.joint().ok())
        .is_some_and(|joint| joint.joint_type == JointType::Prismatic);
    if slides {
        Motion::Slides
    } else {
        Motion::Turns
    }
}

/// Where an object is in the world: no property, but what people want to know first.
fn world_pose(sim: &Simulator, handle: i64) -> Option<(String, Value)> {
    let pose = sim.scene().world_pose(Handle::from_raw(handle)?).ok()?;
    let row = json!({
        "name": WORLD_POSE, "type": "pose", "value": pose_to_array(&pose), "writable": false,
        "group": "pose", "unit": "m, quaternion", "label": label(WORLD_POSE),
    });
    Some((WORLD_POSE.to_owned(), row))
}

fn describe(row: &PropertyRow, motion: Motion) -> Value {
    let mut described = json!({
        "name": row.name,
        "type": row.ty.word(),
        "value": to_json(&row.value),
        "writable": row.is_writable,
        "group": group(row),
        "unit": unit(&row.name, motion),
        "label": label(&row.name),
    });
    if !row.description.is_empty() {
        described["about"] = row.description.into();
    }
    if !row.has_effect {
        described["inert"] = true.into();
    }
    described
}

/// The headings of the reference: pose and place, appearance, physics, and the type's own.
fn group(row: &PropertyRow) -> &'static str {
    let name = row.name.as_str();
    let begins = |words: &[&str]| words.iter().any(|word| name.starts_with(word));
    // Classes are paths, such as `app.scene.object.joint`.
    match row.class.rsplit('.').next().unwrap_or_default() {
        "data" => "data",
        "object" if begins(&["mov"]) => "mouse",
        "object" if begins(&["pose", "bb", "calc"]) => "pose",
        "object" if begins(&["model"]) => "model",
        _ if begins(&["color", "applyColor", "rayColor", "lightColor"]) => "color",
        _ if begins(&[
            "bullet",
            "ode",
            "vortex",
            "newton",
            "mujoco",
            "rapier",
            "engineProperties",
        ]) =>
        {
            "engine"
        }
        _ if begins(&[
            "dyn",
            "respondable",
            "mass",
            "inertia",
            "centerOfMass",
            "init",
            "principal",
            "kinematic",
        ]) =>
        {
            "dynamics"
        }
        class => class,
    }
}

/// The unit; where a table has one for angles and one for lengths, that of the joint.
fn unit(name: &str, motion: Motion) -> Option<&'static str> {
    let known = |line: &'static str| line.split_once('\t').filter(|(known, _)| *known == name);
    let (_, unit) = UNITS.lines().find_map(known)?;
    Some(match unit.split_once(" or ") {
        None => unit,
        Some((of_angles, _)) if motion == Motion::Turns => of_angles,
        Some((_, of_lengths)) => of_lengths,
    })
}

/// The name in words: `jointPosition` is a joint position.
fn label(name: &str) -> String {
    let mut words = String::with_capacity(name.len() + 8);
    for letter in name.chars() {
        match letter {
            '.' | '_' => words.push(' '),
            letter
                if letter.is_ascii_uppercase()
                    && words.ends_with(|last: char| last.is_ascii_lowercase()) =>
            {
                words.push(' ');
                words.push(letter.to_ascii_lowercase());
            }
            letter => words.push(letter),
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_those_of_the_joint() {
        for (name, turning, sliding) in [
            ("jointPosition", "rad", "m"),
            ("targetVel", "rad/s", "m/s"),
            ("targetForce", "N m", "N"),
            ("springDamperParams", "N m/rad, N m s/rad", "N/m, N s/m"),
        ] {
            assert_eq!(unit(name, Motion::Turns), Some(turning));
            assert_eq!(unit(name, Motion::Slides), Some(sliding));
        }
    }

    #[test]
    fn rows_say_where_an_object_is_and_what_has_no_effect() {
        let mut sim = Simulator::new(simulator::Options::default());
        sim.scene_mut().add_default_objects().unwrap();
        let scene = sim.scene();
        let shape = scene.objects().find(|object| object.shape().is_ok());
        let handle = shape.unwrap().handle().raw();
        drop(scene);
        let rows: std::collections::BTreeMap<_, _> =
            rows(&sim, handle).unwrap().into_iter().collect();
        let world = rows[WORLD_POSE]["value"].as_array().unwrap();
        assert_eq!(
            (world.len(), &rows[WORLD_POSE]["writable"]),
            (7, &false.into())
        );
        let inert = |name: &str| rows[name]["inert"] == true;
        assert!(inert("bullet.stickyContact") && inert("modelAcknowledgment"));
        assert!(!inert("bullet.friction") && !inert("mass"));
    }

    #[test]
    fn labels_are_words() {
        assert_eq!(label("jointPosition"), "joint position");
        assert_eq!(label("color.diffuse"), "color diffuse");
        assert_eq!(label("bbHSize"), "bb h size");
        let unit = |name| super::unit(name, Motion::Turns);
        assert_eq!((unit("mass"), unit("alias")), (Some("kg"), None));
    }
}
