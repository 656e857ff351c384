//! `sim.*`: collisions and distances.

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use perception::entity::Entity;
use scene::numbers;
use scene::{Handle, Scene};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] =
    functions![check_collision, check_collision_ex, check_distance];

/// Entities for the two handles of a script.
fn entities(scene: &Scene, [first, second]: [Number; 2]) -> Result<[Entity; 2]> {
    Ok([
        Entity::named(scene, first.0)?,
        Entity::named_or_all(scene, second.0)?,
    ])
}

fn raw(objects: Option<[Handle; 2]>) -> Vec<i64> {
    objects.map_or(vec![-1; 2], |objects| objects.map(Handle::raw).to_vec())
}

/// Whether the surfaces of two entities intersect. Flags of objects that are named alone do not count.
///
/// @param entity1Handle an object or a collection
/// @param entity2Handle the same, or sim.handle_all for all other collidable objects
/// @return result 1 if they collide, else 0
/// @return collidingObjects the first pair that collides; -1 for none
#[api("sim.checkCollision")]
fn check_collision(
    cx: &Cx,
    entity1_handle: Number,
    entity2_handle: Number,
) -> Result<(i64, Vec<i64>)> {
    let found = cx.query(|perception, scene| {
        let entities = entities(scene, [entity1_handle, entity2_handle])?;
        let is_on = scene.settings().calculations.collision;
        Ok::<_, crate::ApiError>(if is_on {
            perception.collision(scene, entities)
        } else {
            None
        })
    })?;
    Ok((i64::from(found.is_some()), raw(found)))
}

/// The segments in which the surfaces of shapes intersect.
///
/// @param entity1Handle an object or a collection
/// @param entity2Handle the same, or sim.handle_all for all other collidable objects
/// @return segmentCount how many
/// @return segmentData x, y, z of both ends of each, in the world
#[api("sim.checkCollisionEx")]
fn check_collision_ex(
    cx: &Cx,
    entity1_handle: Number,
    entity2_handle: Number,
) -> Result<(i64, Vec<f64>)> {
    let segments = cx.query(|perception, scene| {
        let entities = entities(scene, [entity1_handle, entity2_handle])?;
        let is_on = scene.settings().calculations.collision;
        Ok::<_, crate::ApiError>(if is_on {
            perception.intersections(scene, entities)
        } else {
            Vec::new()
        })
    })?;
    Ok((
        numbers::count(segments.len()),
        segments.as_flattened().as_flattened().to_vec(),
    ))
}

/// The smallest distance between the surfaces of two entities. Flags of objects that are named alone do not count.
///
/// @param entity1Handle an object or a collection
/// @param entity2Handle the same, or sim.handle_all for all other measurable objects
/// @param threshold larger distances do not count, metres; 0 for no limit
/// @return result 1 if there is a distance, else 0
/// @return distanceData x, y, z of the closest point on each entity, and the distance, metres
/// @return objectHandlePair the objects that are closest; -1 for none
#[api("sim.checkDistance")]
fn check_distance(
    cx: &Cx,
    entity1_handle: Number,
    entity2_handle: Number,
    #[default(0.0)] threshold: f64,
) -> Result<(i64, Vec<f64>, Vec<i64>)> {
    let below = if threshold > 0.0 {
        threshold
    } else {
        f64::INFINITY
    };
    let found = cx.query(|perception, scene| {
        let entities = entities(scene, [entity1_handle, entity2_handle])?;
        let is_on = scene.settings().calculations.distance;
        Ok::<_, crate::ApiError>(if is_on {
            perception.distance(scene, entities, below)
        } else {
            None
        })
    })?;
    let data = found.map_or(vec![0.0; 7], |found| {
        found
            .points
            .as_flattened()
            .iter()
            .copied()
            .chain([found.distance])
            .collect()
    });
    Ok((
        i64::from(found.is_some()),
        data,
        raw(found.map(|found| found.objects)),
    ))
}
