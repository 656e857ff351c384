//! The common part of objects.

use super::{Context, custom_data};
use crate::ttt::chunks::{Common, UserParams};
use crate::ttt::{Counted, OriginalReference, Text};
use scene::object::viewers::Viewers;
use scene::{Data, ForbiddenMovements, Handle, Object, SceneResult, alternative_name};

/// Current programs mark every property with it.
const WRITTEN_SINCE_2_5: i32 = 0x4;
/// Kinds of references.
const SCENE_OBJECT: i32 = 109;
const COLLECTION: i32 = 115;

pub(super) fn common(context: &Context<'_>, object: &Object) -> SceneResult<Common> {
    let order = namesake_order(context, object)?;
    let movement = &object.movement;
    let model = u8::from(object.is_model());
    let mut common = Common {
        signature: Some([57, 58, 59]),
        pose: Some(object.pose().into()),
        handles: Some([
            object.handle().0.cast_signed(),
            context.file_handle(object.parent()),
        ]),
        alias: Some(object.alias().into()),
        name: Some(object.old_name().into()),
        alt_name: Some(alternative_name(object.old_name()).as_str().into()),
        authorized_viewable: Some(viewers(context, object)),
        hierarchy_colour: Some(numbers::low_i32(object.hierarchy_colour)),
        self_collision_indicator: Some(numbers::low_i32(object.self_collision_indicator)),
        object_property: Some(numbers::low_i32(object.object_property.bits()) | WRITTEN_SINCE_2_5),
        switches_2: Some(model | old_switches(movement.forbidden)),
        switches: Some(model | switches(movement.forbidden) | u8::from(object.assembly.moves) << 7),
        assembly_pose: Some(object.assembly.pose.into()),
        assembly: Some((
            words(&object.assembly.child_words),
            words(&object.assembly.parent_words),
        )),
        extension_string: Some(object.extension_string.as_str().into()),
        locks: u8::try_from(movement.forbidden.bits() >> 4 & 3).ok(),
        special_property: Some(numbers::low_i32(object.special_property.bits())),
        model_property: Some(numbers::low_i32(object.model_property.bits())),
        layer: Some(object.layer.bits()),
        script_exec_priority: Some(object.priority as i32),
        child_order: Some(order),
        translation: Some((
            numbers::low_i32(movement.preferred_axes.bits()),
            numbers::low_i32(movement.relativity[0].0),
            movement.step[0],
        )),
        rotation: Some((numbers::low_i32(movement.relativity[1].0), movement.step[1])),
        size_factor: Some(object.size_factor),
        size_values: Some(object.size_values),
        custom_data: custom_data::chunk(&object.custom_data),
        user_params: user_params(object),
        acknowledgment: Some(acknowledgment(object)),
        dna: Some(Text(object.dna.clone())),
        persistent_id: Some(object.persistent_uid.as_str().into()),
        ..Common::default()
    };
    references(context, object, &mut common);
    originals(context, object, &mut common);
    Ok(common)
}

/// Which cameras and sensors see it: -1 for all, -2 for none, a saved object, or a collection.
fn viewers(context: &Context<'_>, object: &Object) -> i32 {
    match object.viewers {
        Viewers::All => -1,
        Viewers::None => -2,
        Viewers::One(viewer) => context.file_handle(Some(viewer)),
        Viewers::Collection(collection) => numbers::low_i32(collection),
    }
}

/// The place among the siblings of the same alias; -1 for an alias of one's own.
fn namesake_order(context: &Context<'_>, object: &Object) -> SceneResult<i32> {
    Ok(context
        .scene
        .child_order(object.handle())?
        .map_or(-1, numbers::count_i32))
}

/// Bits of what a hand may not do, moving and turning apart.
fn switches(forbidden: ForbiddenMovements) -> u8 {
    bits(
        forbidden,
        &[
            (ForbiddenMovements::TRANSLATION_RUNNING, 0x2),
            (ForbiddenMovements::TRANSLATION_STOPPED, 0x4),
            (ForbiddenMovements::ROTATION_RUNNING, 0x10),
            (ForbiddenMovements::ROTATION_STOPPED, 0x20),
        ],
    )
}

fn old_switches(forbidden: ForbiddenMovements) -> u8 {
    bits(
        forbidden,
        &[
            (ForbiddenMovements::TRANSLATION_RUNNING, 0x2),
            (ForbiddenMovements::TRANSLATION_STOPPED, 0x4),
        ],
    )
}

fn bits(forbidden: ForbiddenMovements, table: &[(ForbiddenMovements, u8)]) -> u8 {
    table
        .iter()
        .filter(|(flag, _)| forbidden.contains(*flag))
        .fold(0, |bits, (_, bit)| bits | bit)
}

fn words(words: &[String]) -> Counted<Text> {
    Counted(words.iter().map(|word| word.as_str().into()).collect())
}

fn user_params(object: &Object) -> Option<UserParams> {
    let params = object
        .user_params
        .iter()
        .map(|(name, value)| (name.as_str().into(), "".into(), value.as_str().into(), 0));
    let params: Vec<_> = params.collect();
    (!params.is_empty()).then_some(UserParams {
        params: Some(Counted(params)),
    })
}

fn acknowledgment(object: &Object) -> Text {
    match object.inert.get("modelAcknowledgment") {
        Some(Data::Text(text)) => Text(text.clone()),
        _ => Text::default(),
    }
}

fn references(context: &Context<'_>, object: &Object, common: &mut Common) {
    for (tag, list) in &object.references {
        let handles = list.iter().map(|raw| reference(context, *raw));
        if tag.is_empty() {
            let kind = |handle: i32| {
                if handle >= 2_000_000 {
                    COLLECTION
                } else {
                    SCENE_OBJECT
                }
            };
            common.references = Some(Counted(
                handles.map(|handle| [kind(handle), handle, 0]).collect(),
            ));
        } else {
            common
                .tagged_references
                .push((tag.as_str().into(), Counted(handles.collect())));
        }
    }
}

/// A saved object, or a collection.
fn reference(context: &Context<'_>, raw: i64) -> i32 {
    match context.scene.collections().get(raw) {
        Ok(_) => numbers::low_i32(raw),
        Err(_) => context.file_handle(Handle::from_raw(raw)),
    }
}

/// Originals are known by their identity, wherever they are.
fn originals(context: &Context<'_>, object: &Object, common: &mut Common) {
    let known = |raw: i64| {
        Some(
            context
                .scene
                .object(Handle::from_raw(raw)?)
                .ok()?
                .persistent_uid
                .as_str(),
        )
    };
    let pair = |raw: &i64| {
        known(*raw).map_or((-1, Text::default()), |id| {
            (numbers::low_i32(*raw), id.into())
        })
    };
    for (tag, list) in &object.original_references {
        let pairs = list.iter().map(pair);
        if tag.is_empty() {
            let of = |(handle, id): (i32, Text)| OriginalReference {
                kind: SCENE_OBJECT,
                handle,
                persistent_id: (handle >= 0).then_some(id),
            };
            common.original_references = Some(Counted(pairs.map(of).collect()));
        } else {
            common
                .tagged_original_references
                .push((tag.as_str().into(), Counted(pairs.collect())));
        }
    }
}
