//! Groups of inverse kinematics of old scenes, whose tips are saved.

use super::Context;
use crate::scene_file::load::EXPLICIT_IK_GROUP;
use crate::ttt::chunks::{IkElement as ElementChunk, IkGroup as GroupChunk};
use scene::tree::ik_groups::{IkElement, IkGroup};

pub(super) fn groups(context: &Context<'_>) -> Vec<GroupChunk> {
    let is_saved = |group: &IkGroup| {
        group
            .elements
            .iter()
            .all(|element| context.saved.contains(&element.tip))
    };
    let groups = context
        .scene
        .ik_groups()
        .iter()
        .filter(|(_, group)| is_saved(group));
    groups
        .map(|(handle, saved)| group(context, handle, saved))
        .collect()
}

fn group(context: &Context<'_>, handle: i64, group: &IkGroup) -> GroupChunk {
    GroupChunk {
        handle: Some(numbers::low_i32(handle)),
        name: Some(group.name.as_str().into()),
        max_iter: Some(group.max_iterations),
        damping: Some(group.damping),
        method: Some(group.method),
        do_on: Some(group.performed_after),
        flags: Some(group.flags | if group.explicit { EXPLICIT_IK_GROUP } else { 0 }),
        persistent_id: Some(group.persistent_uid.as_str().into()),
        elements: (0..)
            .zip(&group.elements)
            .map(|(at, saved)| element(context, at, saved))
            .collect(),
        ..GroupChunk::default()
    }
}

fn element(context: &Context<'_>, at: i32, element: &IkElement) -> ElementChunk {
    ElementChunk {
        handle: Some(at),
        tip_and_base: Some(
            [Some(element.tip), element.base].map(|object| context.file_handle(object)),
        ),
        alt_base: Some(context.file_handle(element.constraint_base)),
        precisions: Some(element.precisions),
        constraints: Some(element.constraints),
        weights: Some(element.weights),
        flags: Some(element.flags),
        ..ElementChunk::default()
    }
}
