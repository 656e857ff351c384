//! `sim.*`: the collision and distance objects of scenes from before 4.2, by their names.

use api_macro::api;

use crate::objects::old_name::{OldName, suffix_of_script};
use crate::{ApiFn, Cx, Result, functions};
use scene::{Data, Handle, Scene, SceneError, special};
use script::{Number, Results};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_collision_handle,
    handle_collision,
    read_collision,
    reset_collision,
    get_distance_handle,
    handle_distance,
    read_distance,
    reset_distance,
];

/// Looks up an old name.
pub(crate) fn handle_of(
    cx: &Cx,
    name: &str,
    find: impl Fn(&Scene, &str) -> Option<i64>,
    missing: SceneError,
) -> Result<i64> {
    let name = OldName::read(name, suffix_of_script(cx));
    match find(&cx.scene(), &name.name) {
        None if name.no_error => Ok(-1),
        found => found.ok_or(missing.into()),
    }
}

/// Whether a number means all objects, or all but those that are handled explicitly; None where it means one.
pub(super) fn with_explicit(number: i64) -> Option<bool> {
    match number {
        special::ALL => Some(true),
        special::ALL_EXCEPT_EXPLICIT => Some(false),
        _ => None,
    }
}

fn collision(pair: Option<[Handle; 2]>) -> Results {
    Results(pair.map_or(vec![0.into()], |pair| {
        vec![1.into(), pair.map(Handle::raw).to_vec().into()]
    }))
}

fn distance(distance: Option<f64>) -> Results {
    Results(distance.map_or(vec![0.into()], |distance| {
        vec![1.into(), Data::from(distance)]
    }))
}

/// A collision object of an old scene.
///
/// @param objectName its name; with `@silentError`: -1 if there is none
/// @return collisionHandle its handle
#[api("sim.getCollisionHandle")]
fn get_collision_handle(cx: &Cx, object_name: String) -> Result<i64> {
    handle_of(
        cx,
        &object_name,
        |scene, name| scene.collision_objects().named(name),
        SceneError::NoSuchCollisionObject,
    )
}

/// Computes collision objects of old scenes. The default main script does it for those that are not tagged for explicit handling.
///
/// @param collisionHandle a collision object that is tagged for explicit handling, sim.handle_all or sim.handle_all_except_explicit
/// @return result, collidingObjects how many collide; of a single one 0, or 1 and the handles of both objects
#[api("sim.handleCollision")]
fn handle_collision(cx: &mut Cx, collision_handle: Number) -> Result<Results> {
    match with_explicit(collision_handle.0) {
        Some(explicit) => Ok(Results(vec![cx.handle_collision_objects(explicit).into()])),
        None => cx
            .handle_collision_object(collision_handle.0)
            .map(collision),
    }
}

/// What was found when a collision object was last handled.
///
/// @param collisionHandle the collision object
/// @return result, collidingObjects 0, or 1 and the handles of both objects
#[api("sim.readCollision")]
fn read_collision(cx: &Cx, collision_handle: Number) -> Result<Results> {
    let scene = cx.scene();
    let object = scene
        .collision_objects()
        .get(collision_handle.0)
        .ok_or(SceneError::NoSuchCollisionObject)?;
    Ok(collision(object.result.flatten()))
}

/// Forgets what was found of collision objects.
///
/// @param collisionHandle as for sim.handleCollision
/// @return result 1
#[api("sim.resetCollision")]
fn reset_collision(cx: &mut Cx, collision_handle: Number) -> Result<i64> {
    let mut scene = cx.scene_mut();
    let objects = scene.collision_objects_mut();
    match with_explicit(collision_handle.0) {
        Some(explicit) => objects.reset(explicit),
        None => match objects.get_mut(collision_handle.0) {
            None => return Err(SceneError::NoSuchCollisionObject.into()),
            Some(object) if !object.explicit => return Err(SceneError::NotExplicit.into()),
            Some(object) => object.result = None,
        },
    }
    Ok(1)
}

/// A distance object of an old scene.
///
/// @param objectName its name; with `@silentError`: -1 if there is none
/// @return distanceHandle its handle
#[api("sim.getDistanceHandle")]
fn get_distance_handle(cx: &Cx, object_name: String) -> Result<i64> {
    handle_of(
        cx,
        &object_name,
        |scene, name| scene.distance_objects().named(name),
        SceneError::NoSuchDistanceObject,
    )
}

/// Computes distance objects of old scenes. The default main script does it for those that are not tagged for explicit handling.
///
/// @param distanceHandle a distance object that is tagged for explicit handling, sim.handle_all or sim.handle_all_except_explicit
/// @return result, smallestDistance 0, or 1 and the smallest distance, metres
#[api("sim.handleDistance")]
fn handle_distance(cx: &mut Cx, distance_handle: Number) -> Result<Results> {
    match with_explicit(distance_handle.0) {
        Some(explicit) => Ok(distance(cx.handle_distance_objects(explicit))),
        None => cx.handle_distance_object(distance_handle.0).map(distance),
    }
}

/// The distance when a distance object was last handled.
///
/// @param distanceHandle the distance object
/// @return result, smallestDistance 0 if there was none below the threshold, or 1 and the distance, metres
#[api("sim.readDistance")]
fn read_distance(cx: &Cx, distance_handle: Number) -> Result<Results> {
    let scene = cx.scene();
    let object = scene
        .distance_objects()
        .get(distance_handle.0)
        .ok_or(SceneError::NoSuchDistanceObject)?;
    Ok(distance(object.result.flatten()))
}

/// Forgets the distances of distance objects.
///
/// @param distanceHandle as for sim.handleDistance
/// @return result 1
#[api("sim.resetDistance")]
fn reset_distance(cx: &mut Cx, distance_handle: Number) -> Result<i64> {
    let mut scene = cx.scene_mut();
    let objects = scene.distance_objects_mut();
    match with_explicit(distance_handle.0) {
        Some(explicit) => objects.reset(explicit),
        None => match objects.get_mut(distance_handle.0) {
            None => return Err(SceneError::NoSuchDistanceObject.into()),
            Some(object) if !object.explicit => return Err(SceneError::NotExplicit.into()),
            Some(object) => object.result = None,
        },
    }
    Ok(1)
}
