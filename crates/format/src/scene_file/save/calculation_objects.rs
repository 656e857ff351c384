//! Collision and distance objects of old scenes, whose entities are saved.

use super::{Context, colour};
use crate::ttt::chunks::{Collision, Distance};
use scene::Handle;
use scene::appearance::colour::Colour;
use scene::tree::calculation_objects::CalculationObject;

/// Of the lines that show them, pixels.
const WIDTH: i32 = 1;

pub(super) fn collisions(context: &Context<'_>) -> Vec<Collision> {
    let saved = context
        .scene
        .collision_objects()
        .iter()
        .filter_map(|(handle, object)| {
            Some(Collision {
                contour_width: Some(WIDTH),
                colour: Some(colour::colour(&Colour::new([0.0; 3]))),
                entities_and_handle: Some(entities_and_handle(context, object, handle)?),
                name: Some(object.name.as_str().into()),
                persistent_id: Some(object.persistent_uid.as_str().into()),
                flags: Some(object.switches),
            })
        });
    saved.collect()
}

pub(super) fn distances(context: &Context<'_>) -> Vec<Distance> {
    let saved = context
        .scene
        .distance_objects()
        .iter()
        .filter_map(|(handle, object)| {
            Some(Distance {
                entities_and_handle: Some(entities_and_handle(context, object, handle)?),
                threshold: Some(object.threshold),
                width: Some(WIDTH),
                colour: Some(colour::colour(&Colour::new([0.0; 3]))),
                flags: Some(object.switches),
                name: Some(object.name.as_str().into()),
                persistent_id: Some(object.persistent_uid.as_str().into()),
            })
        });
    saved.collect()
}

/// None where the first entity is not saved.
fn entities_and_handle<R>(
    context: &Context<'_>,
    object: &CalculationObject<R>,
    handle: i64,
) -> Option<[i32; 3]> {
    let [first, second] =
        object
            .entities
            .map(|entity| match context.scene.collections().get(entity) {
                Ok(_) => numbers::low_i32(entity),
                Err(_) => context.file_handle(Handle::from_raw(entity)),
            });
    (first >= 0).then_some([first, second, numbers::low_i32(handle)])
}
