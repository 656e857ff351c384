//! What injected tendons, sites, actuators, joints and contacts become: dummies, and parameters of objects that there are, which are set back afterwards.

use format::robot_file::{Told, initial_target, motor_of, resolved_tendon, surface_values};
use robot_description::mjcf::{self, Adhesion};
use scene::joint::{ACTUATOR, Actuators, Control};
use scene::object::dummy::Dummy;
use scene::object::tendon::TENDON_TARGETS;
use scene::shape::{ContactPair, SURFACE};
use scene::{Data, Edit, Field, Handle, InertValues, Kind, Namespace, Pose, ValueType};

use super::describe::{JointChange, Pair, Site};
use super::injections::Made;
use super::make::{DUMMY, add};
use super::{Cx, Result, names};

/// Something as it was before.
#[derive(Debug, Clone)]
pub(super) enum Undo {
    /// Custom data of an object.
    Custom(Handle, &'static str, Option<(ValueType, Data)>),
    /// MuJoCo's parameters of a joint or a shape.
    Values(Handle, InertValues),
    /// The control of a joint.
    Control(Handle, Control),
    /// How a shape touches others.
    Pairs(Handle, Vec<ContactPair>),
}

/// What was made; Err: what has no counterpart, in words.
type Outcome = Result<std::result::Result<Made, String>>;

fn made(undo: Vec<Undo>) -> Outcome {
    Ok(Ok(Made {
        undo,
        ..Made::default()
    }))
}

fn missing(kind: &str, name: &str) -> Outcome {
    Ok(Err(format!("there is no {kind} '{name}'")))
}

pub(super) fn add_site(cx: &mut Cx, site: &Site, holder: Option<Handle>) -> Outcome {
    let frame = match holder {
        Some(holder) => cx.scene().world_pose(holder)?,
        None => Pose::identity(),
    };
    let kind = Kind::Dummy(Dummy::new(DUMMY));
    let dummy = add(cx, &site.name, kind, frame * site.pose, holder)?;
    Ok(Ok(Made {
        objects: vec![dummy],
        ..Made::default()
    }))
}

pub(super) fn add_tendon(cx: &mut Cx, tendon: &mjcf::Tendon) -> Outcome {
    let resolved = {
        let scene = cx.scene();
        let joint = |name: &str| joint_of(&scene, name);
        let site = |name: &str| names::body(&scene, name);
        resolved_tendon(tendon, joint, site)
    };
    let Some(resolved) = resolved else {
        return Ok(Err("it is over what is not there".to_owned()));
    };
    let kind = Kind::Dummy(Dummy::new(DUMMY));
    let dummy = add(cx, &tendon.name, kind, Pose::identity(), None)?;
    cx.scene_mut().set_tendon(dummy, &resolved)?;
    Ok(Ok(Made {
        objects: vec![dummy],
        ..Made::default()
    }))
}

/// The joint of a name.
fn joint_of(scene: &scene::Scene, name: &str) -> Option<Handle> {
    let found = names::body(scene, name)?;
    let is_joint = scene.object(found).ok()?.joint().is_ok();
    is_joint.then_some(found)
}

fn shape_of(scene: &scene::Scene, name: &str) -> Option<Handle> {
    let found = names::body(scene, name)?;
    let is_shape = scene.object(found).ok()?.shape().is_ok();
    is_shape.then_some(found)
}

pub(super) fn change_joint(cx: &mut Cx, change: &JointChange) -> Outcome {
    let found = joint_of(&cx.scene(), &change.name);
    let Some(joint) = found else {
        return missing("joint", &change.name);
    };
    let mut undo = vec![Undo::Values(joint, values_of(cx, joint)?)];
    undo.extend(count_with_any_engine(cx, joint)?);
    cx.scene_mut().modify_joint(joint, |joint| {
        let mut passive = joint.passive();
        for (name, value) in &change.values {
            let field = match *name {
                "armature" => &mut passive.armature,
                "damping" => &mut passive.damping,
                "frictionloss" => &mut passive.friction,
                "stiffness" => &mut passive.stiffness,
                _ => &mut passive.rest,
            };
            *field = *value;
        }
        joint.set_passive(&passive);
    })?;
    made(undo)
}

/// Lets MuJoCo's parameters of a joint count whatever the engine is.
fn count_with_any_engine(cx: &mut Cx, joint: Handle) -> Result<Option<Undo>> {
    let is_said = custom(cx, joint, ACTUATOR)?.is_some();
    let none = Data::text(&Actuators::default().to_string());
    Ok(match is_said {
        true => None,
        false => Some(set_custom(cx, joint, ACTUATOR, (ValueType::String, none))?),
    })
}

pub(super) fn add_actuator(
    cx: &mut Cx,
    actuator: &mjcf::Actuator,
    [kind, name]: &[String; 2],
) -> Outcome {
    let found = match kind.as_str() {
        "tendon" => names::body(&cx.scene(), name),
        _ => joint_of(&cx.scene(), name),
    };
    let Some(moved) = found else {
        return missing(kind, name);
    };
    let mut actuators = Actuators::default();
    let before = custom(cx, moved, ACTUATOR)?;
    if let Some((_, Data::Text(text) | Data::Buffer(text))) = &before {
        let known = Actuators::parse(&String::from_utf8_lossy(text));
        actuators = known.unwrap_or_default();
    }
    actuators.add(motor_of(actuator));
    let text = Data::text(&actuators.to_string());
    let mut undo = vec![set_custom(cx, moved, ACTUATOR, (ValueType::String, text))?];
    let (told, target) = initial_target(actuator);
    if kind == "tendon" {
        let target = (ValueType::Float, Data::Float(target));
        undo.push(set_custom(
            cx,
            moved,
            TENDON_TARGETS[told as usize],
            target,
        )?);
        cx.scene_mut().modify(moved, Field::Other, |_| ())?;
        return made(undo);
    }
    let control = actuators.iter().next().map(|first| first.kind.control());
    let before = cx.scene().object(moved)?.joint()?.control;
    undo.push(Undo::Control(moved, before));
    cx.scene_mut().modify_joint(moved, |joint| {
        joint.control = control.unwrap_or(before);
        match told {
            Told::Force => joint.set_target_force(0.0, true),
            Told::Position => joint.target_position = target,
            Told::Velocity => joint.target_velocity = target,
        }
    })?;
    made(undo)
}

pub(super) fn add_adhesion(cx: &mut Cx, adhesion: &Adhesion, body: &str) -> Outcome {
    let found = shape_of(&cx.scene(), body);
    let Some(shape) = found else {
        return missing("body", body);
    };
    let mut undo = vec![Undo::Values(shape, values_of(cx, shape)?)];
    if custom(cx, shape, SURFACE)?.is_none() {
        let text = (ValueType::String, Data::text(""));
        undo.push(set_custom(cx, shape, SURFACE, text)?);
    }
    cx.scene_mut()
        .try_modify(shape, Field::Dynamics, |object| {
            let material = &mut object.shape_mut()?.material;
            for (name, value) in surface_values(Some(adhesion), None) {
                material.engine_values.set(name, value);
            }
            Ok(())
        })?;
    made(undo)
}

pub(super) fn add_pair(cx: &mut Cx, pair: &Pair) -> Outcome {
    let found = pair
        .names
        .each_ref()
        .map(|name| shape_of(&cx.scene(), name));
    let [Some(shape), Some(other)] = found else {
        let lost = usize::from(found[0].is_some());
        return missing("body", &pair.names[lost]);
    };
    let before = cx.scene().object(shape)?.contact_pairs();
    let mut pairs = before.clone();
    pairs.retain(|known| known.other != other);
    pairs.push(ContactPair {
        other,
        touches: pair.touches,
        friction: pair.friction,
    });
    cx.scene_mut().set_contact_pairs(shape, &pairs)?;
    made(vec![Undo::Pairs(shape, before)])
}

/// Sets things back to what they were, the last first. Objects that are gone have nothing to be set back.
pub(super) fn undo(cx: &mut Cx, undos: Vec<Undo>) -> Result<()> {
    for one in undos.into_iter().rev() {
        let (Undo::Custom(object, ..)
        | Undo::Values(object, _)
        | Undo::Control(object, _)
        | Undo::Pairs(object, _)) = one;
        if cx.scene().object(object).is_err() {
            continue;
        }
        let mut scene = cx.scene_mut();
        match one {
            Undo::Custom(_, name, value) => {
                let edit = Edit::Name(name, value);
                scene.edit_named_values(Some(object), Namespace::CustomData, edit)?;
                scene.modify(object, Field::Dynamics, |_| ())?;
            }
            Undo::Values(_, values) => scene.try_modify(object, Field::Dynamics, |object| {
                match &mut object.kind {
                    Kind::Joint(joint) => joint.engine_values = values,
                    Kind::Shape(shape) => shape.material.engine_values = values,
                    _ => {}
                }
                Ok(())
            })?,
            Undo::Control(_, control) => {
                scene.modify_joint(object, |joint| joint.control = control)?;
            }
            Undo::Pairs(_, pairs) => scene.set_contact_pairs(object, &pairs)?,
        }
    }
    Ok(())
}

fn values_of(cx: &Cx, object: Handle) -> Result<InertValues> {
    let scene = cx.scene();
    Ok(match &scene.object(object)?.kind {
        Kind::Joint(joint) => joint.engine_values.clone(),
        Kind::Shape(shape) => shape.material.engine_values.clone(),
        _ => InertValues::default(),
    })
}

fn custom(cx: &Cx, object: Handle, name: &str) -> Result<Option<(ValueType, Data)>> {
    let scene = cx.scene();
    let known = scene.object(object)?.custom_data.typed(name);
    Ok(known.map(|(kind, value)| (kind, value.clone())))
}

/// Sets custom data; gives back what they were.
fn set_custom(
    cx: &mut Cx,
    object: Handle,
    name: &'static str,
    value: (ValueType, Data),
) -> Result<Undo> {
    let before = custom(cx, object, name)?;
    let edit = Edit::Name(name, Some(value));
    let mut scene = cx.scene_mut();
    scene.edit_named_values(Some(object), Namespace::CustomData, edit)?;
    Ok(Undo::Custom(object, name, before))
}
