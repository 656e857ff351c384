//! Handling of the collision and distance objects of old scenes: what is found is stored (spec: sensors 2.1).

use crate::host::Sim;
use perception::entity::Entity;
use scene::{Handle, Scene, SceneError, SceneResult};

impl Sim {
    /// Handles one collision object, which must be tagged for that; returns what collides.
    ///
    /// # Errors
    /// When there is no such object, or it is not tagged for explicit handling.
    pub(crate) fn handle_collision_object(&self, handle: i64) -> SceneResult<Option<[Handle; 2]>> {
        let explicit = self
            .scene
            .borrow()
            .collision_objects()
            .get(handle)
            .map(|object| object.explicit);
        if explicit.ok_or(SceneError::NoSuchCollisionObject)? {
            Ok(self.compute_collision(handle))
        } else {
            Err(SceneError::NotExplicit)
        }
    }

    /// Handles all collision objects, or those that are not tagged for explicit handling; returns how many collide.
    pub(crate) fn handle_collision_objects(&self, with_explicit: bool) -> i64 {
        let handles = self
            .scene
            .borrow()
            .collision_objects()
            .handles(with_explicit);
        numbers::count(
            handles
                .into_iter()
                .filter(|&handle| self.compute_collision(handle).is_some())
                .count(),
        )
    }

    /// Handles one distance object, which must be tagged for that; returns the distance (m) if it is below the threshold.
    ///
    /// # Errors
    /// As [`Sim::handle_collision_object`].
    pub(crate) fn handle_distance_object(&self, handle: i64) -> SceneResult<Option<f64>> {
        let explicit = self
            .scene
            .borrow()
            .distance_objects()
            .get(handle)
            .map(|object| object.explicit);
        if explicit.ok_or(SceneError::NoSuchDistanceObject)? {
            Ok(self.compute_distance(handle))
        } else {
            Err(SceneError::NotExplicit)
        }
    }

    /// Handles all distance objects, or those that are not tagged for explicit handling; returns the smallest distance (m).
    pub(crate) fn handle_distance_objects(&self, with_explicit: bool) -> Option<f64> {
        let handles = self
            .scene
            .borrow()
            .distance_objects()
            .handles(with_explicit);
        handles
            .into_iter()
            .filter_map(|handle| self.compute_distance(handle))
            .reduce(f64::min)
    }

    /// Stores what an object finds, and returns it.
    fn compute_collision(&self, handle: i64) -> Option<[Handle; 2]> {
        let found = {
            let scene = self.scene.borrow();
            let entities = entities(&scene, scene.collision_objects().get(handle)?.entities);
            let entities = entities.filter(|_| scene.settings().calculations.collision);
            entities.and_then(|entities| self.perception.borrow_mut().collision(&scene, entities))
        };
        self.scene
            .borrow_mut()
            .collision_objects_mut()
            .get_mut(handle)?
            .result = Some(found);
        found
    }

    fn compute_distance(&self, handle: i64) -> Option<f64> {
        let found = {
            let scene = self.scene.borrow();
            let object = scene.distance_objects().get(handle)?;
            let below = if object.threshold > 0.0 {
                object.threshold
            } else {
                f64::INFINITY
            };
            let entities = entities(&scene, object.entities)
                .filter(|_| scene.settings().calculations.distance);
            entities.and_then(|entities| {
                self.perception
                    .borrow_mut()
                    .distance(&scene, entities, below)
            })
        };
        let distance = found.map(|found| found.distance);
        self.scene
            .borrow_mut()
            .distance_objects_mut()
            .get_mut(handle)?
            .result = Some(distance);
        distance
    }
}

/// None where one of them is gone.
fn entities(scene: &Scene, [first, second]: [i64; 2]) -> Option<[Entity; 2]> {
    Some([
        Entity::named(scene, first).ok()?,
        Entity::named_or_all(scene, second).ok()?,
    ])
}
