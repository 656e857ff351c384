//! The common part of objects (spec: scene-files 6).

use super::{Context, custom_data};
use crate::ttt::chunks::{Common, UserParams};
use crate::ttt::tree::{Class, Object as FileObject};
use crate::ttt::{Counted, Text};
use scene::object::assembly::Assembly;
use scene::object::movement::MovementFrame;
use scene::object::script_object::ExecutionPriority;
use scene::{
    Data, Field, ForbiddenMovements, Handle, Layers, ModelFlags, Movement, Object, ObjectFlags,
    Pose, PreferredAxes, Scene, SceneResult, SpecialFlags, clean_alias,
};

/// Written since 2.5 into every property; where it is missing, the object was hidden.
const NOT_HIDDEN: i64 = 0x4;
/// Before, a pose that is not the identity was used.
const ASSEMBLY_POSE_BIT_SINCE: i32 = 20;

/// The alias, or what older files call the object up to the number of its copy.
pub(super) fn alias(common: &Common) -> String {
    let name = || common.name.as_ref().map(Text::decode).unwrap_or_default();
    let alias = common.alias.as_ref().map_or_else(
        || name().split('#').next().unwrap_or("").to_owned(),
        Text::decode,
    );
    clean_alias(alias.as_bytes())
}

/// The names of the file, with the objects that were made of them.
pub(super) fn names(objects: &[FileObject], handles: &[Handle]) -> Vec<(Handle, String)> {
    let pairs = handles.iter().zip(objects);
    pairs
        .filter_map(|(handle, object)| Some((*handle, object.common.name.as_ref()?.decode())))
        .collect()
}

pub(super) fn fill(
    scene: &mut Scene,
    context: &Context<'_>,
    handle: Handle,
    object: &FileObject,
) -> SceneResult<()> {
    let common = &object.common;
    if let Some(pose) = common.pose.and_then(|pose| pose.pose()) {
        scene.set_local_pose(handle, pose)?;
    }
    if let Some(name) = &common.name {
        scene.set_old_name(handle, &name.decode())?;
    }
    scene.modify(handle, Field::Other, |new| {
        visibility(new, common);
        model(new, common);
        identity(new, common);
        new.movement = movement(common);
        new.size_factor = common
            .size_factor
            .filter(|f| f.is_finite() && *f > 0.0)
            .unwrap_or(1.0);
        new.size_values = common
            .size_values
            .filter(|values| values.iter().all(|v| v.is_finite()))
            .unwrap_or([1.0; 3]);
        new.special_property = common
            .special_property
            .map_or(new.special_property, |bits| {
                SpecialFlags::from_bits_retain(bits.into())
            });
        new.hierarchy_colour = common.hierarchy_colour.unwrap_or(-1).into();
        new.self_collision_indicator = common.self_collision_indicator.unwrap_or(0).into();
        new.priority =
            ExecutionPriority::from_number(common.script_exec_priority.unwrap_or(1).into());
        new.assembly = assembly(common, context.header.serialization);
        new.extension_string = common
            .extension_string
            .as_ref()
            .map(Text::decode)
            .unwrap_or_default();
        new.user_params = user_params(common.user_params.as_ref());
        custom_data::fill(
            &mut new.custom_data,
            common.custom_data.as_ref(),
            common.old_custom_data.as_ref(),
            "_oldObjectCustomData_",
        );
        colour(new, context, &object.class);
    })
}

fn visibility(new: &mut Object, common: &Common) {
    new.layer = common.layer.map_or(new.layer, Layers::from_bits_retain);
    let Some(property) = common.object_property.map(i64::from) else {
        return;
    };
    new.object_property = ObjectFlags::from_bits_retain(property & !NOT_HIDDEN);
    if property & NOT_HIDDEN == 0 && new.layer.bits() < 256 {
        new.layer = new.layer.hidden();
    }
}

fn model(new: &mut Object, common: &Common) {
    let switches = common
        .switches
        .or(common.switches_2)
        .or(common.old_switches)
        .unwrap_or(0);
    let flags = ModelFlags::from_bits_retain(common.model_property.unwrap_or(0).into());
    new.set_model_property(if switches & 1 == 0 {
        ModelFlags::NOT_MODEL
    } else {
        flags
    });
    if let Some(text) = common
        .acknowledgment
        .as_ref()
        .filter(|text| !text.0.is_empty())
    {
        new.inert
            .set("modelAcknowledgment", Data::Text(text.0.clone()));
    }
}

fn identity(new: &mut Object, common: &Common) {
    if let Some(id) = common.persistent_id.as_ref().filter(|id| !id.0.is_empty()) {
        new.persistent_uid = id.decode();
    }
    if let Some(dna) = common.dna.as_ref().filter(|dna| !dna.0.is_empty()) {
        new.dna.clone_from(&dna.0);
    }
}

fn movement(common: &Common) -> Movement {
    let mut movement = Movement::default();
    if let Some((axes, relativity, step)) = common.translation {
        movement.preferred_axes = PreferredAxes::from_bits_retain(axes.into());
        (movement.relativity[0], movement.step[0]) = (MovementFrame(relativity.into()), step);
    }
    if let Some((relativity, step)) = common.rotation {
        (movement.relativity[1], movement.step[1]) = (MovementFrame(relativity.into()), step);
    }
    movement.forbidden = forbidden(common);
    movement
}

/// Old files have numbers for words, and say with bits what can be no child or no parent.
fn assembly(common: &Common, serialization: i32) -> Assembly {
    let default = Assembly::default();
    let words = |words: &Counted<Text>| words.0.iter().map(Text::decode).collect::<Vec<_>>();
    let [cannot_be_child, cannot_be_parent] =
        [5, 6].map(|bit| common.old_switches.unwrap_or(0) >> bit & 1 == 1);
    let old = |number: i32, cannot: bool| match number {
        _ if cannot => Vec::new(),
        0 => vec![Assembly::WORD.to_owned()],
        number => vec![number.to_string()],
    };
    let (child_words, parent_words) = match (&common.assembly, common.old_assembly) {
        (Some((child, parent)), _) => (words(child), words(parent)),
        (None, Some([child, parent])) => {
            (old(child, cannot_be_child), old(parent, cannot_be_parent))
        }
        (None, None) => (default.child_words, default.parent_words),
    };
    let pose = common
        .assembly_pose
        .and_then(|pose| pose.pose())
        .unwrap_or_default();
    let moves = match common.switches {
        Some(switches) if serialization >= ASSEMBLY_POSE_BIT_SINCE => switches & 0x80 != 0,
        _ => pose != Pose::identity(),
    };
    Assembly {
        pose,
        moves,
        child_words,
        parent_words,
    }
}

/// Movements by hand that are forbidden. Old files forbid translation and rotation together.
fn forbidden(common: &Common) -> ForbiddenMovements {
    let bits = |switches: u8, bits: &[(u8, ForbiddenMovements)]| {
        bits.iter()
            .filter(|(bit, _)| switches >> bit & 1 == 1)
            .map(|(_, flag)| *flag)
            .collect::<ForbiddenMovements>()
    };
    let stopped = ForbiddenMovements::TRANSLATION_STOPPED;
    let running = ForbiddenMovements::TRANSLATION_RUNNING;
    let (turning_stopped, turning_running) = (
        ForbiddenMovements::ROTATION_STOPPED,
        ForbiddenMovements::ROTATION_RUNNING,
    );
    let moving = match (common.switches, common.switches_2.or(common.old_switches)) {
        (Some(new), _) => bits(
            new,
            &[
                (1, running),
                (2, stopped),
                (4, turning_running),
                (5, turning_stopped),
            ],
        ),
        (None, Some(old)) => bits(
            old,
            &[
                (1, running | turning_running),
                (2, stopped | turning_stopped),
            ],
        ),
        (None, None) => ForbiddenMovements::empty(),
    };
    moving
        | bits(
            common.locks.unwrap_or(0),
            &[
                (0, ForbiddenMovements::OTHER_TRANSLATIONS),
                (1, ForbiddenMovements::OTHER_ROTATIONS),
            ],
        )
}

/// Names and values; units and flags concern a dialog.
pub(super) fn user_params(params: Option<&UserParams>) -> Vec<(String, String)> {
    let Some(Counted(params)) = params.and_then(|params| params.params.as_ref()) else {
        return Vec::new();
    };
    params
        .iter()
        .map(|(name, _, value, _)| (name.decode(), value.decode()))
        .collect()
}

fn colour(new: &mut Object, context: &Context<'_>, class: &Class) {
    use super::sensors::colour;
    let chunk = match class {
        Class::Joint(joint) => &joint.colour,
        Class::Dummy(dummy) => &dummy.colour,
        Class::ForceSensor(sensor) => &sensor.colour,
        Class::ProximitySensor(sensor) => &sensor.colour,
        Class::VisionSensor(sensor) => &sensor.colour,
        Class::Camera(camera) => &camera.colour,
        Class::Light(light) => &light.colour,
        Class::Graph(graph) => &graph.colour,
        Class::OcTree(tree) => &tree.colour,
        Class::PointCloud(cloud) => &cloud.colour,
        Class::Path(path) => path.path.as_ref().map_or(&path.colour, |line| &line.colour),
        Class::ScriptObject(script) => &script.colour,
        _ => &None,
    };
    if let Some(chunk) = chunk {
        let brighter = context.header.serialization < 17 && !matches!(class, Class::Light(_));
        new.colour = colour(chunk, new.colour, brighter);
        new.colour_extension = chunk
            .extension_string
            .as_ref()
            .map(Text::decode)
            .unwrap_or_default();
    }
}
