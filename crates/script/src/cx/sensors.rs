//! Sensors, and queries of the geometry of the scene.

use super::Cx;
use crate::error::ApiResult;
use perception::Perception;
use scene::sensor::Detection;
use scene::{Handle, Scene};

impl Cx<'_> {
    /// Queries the geometry of the scene. The index behind that changes, but no result depends on it.
    pub fn query<R>(&self, query: impl FnOnce(&mut Perception, &Scene) -> R) -> R {
        query(
            &mut self.sim.perception.borrow_mut(),
            &self.sim.scene.borrow(),
        )
    }

    /// The same where objects are displaced for the query (`Scene::displace`).
    pub fn query_displaced<R>(
        &mut self,
        query: impl FnOnce(&mut Perception, &mut Scene) -> R,
    ) -> R {
        query(
            &mut self.sim.perception.borrow_mut(),
            &mut self.sim.scene.borrow_mut(),
        )
    }

    /// Handles a proximity sensor that is tagged for explicit handling: detects, calls its scripts, stores the result.
    ///
    /// # Errors
    /// When it is not tagged, or no proximity sensor.
    pub fn handle_proximity_sensor(&mut self, sensor: Handle) -> ApiResult<Option<Detection>> {
        Ok(self.sim.handle_proximity_sensor(sensor)?)
    }

    /// The same for all, or those that are not tagged; returns the nearest detection.
    pub fn handle_proximity_sensors(&mut self, with_explicit: bool) -> Option<Detection> {
        self.sim.handle_proximity_sensors(with_explicit)
    }

    /// Forgets what a proximity sensor detected that is tagged for explicit handling.
    ///
    /// # Errors
    /// When it is not tagged, or no proximity sensor.
    pub fn reset_proximity_sensor(&mut self, sensor: Handle) -> ApiResult<()> {
        Ok(self.scene_mut().reset_proximity_sensor(sensor)?)
    }

    /// The same for all, or those that are not tagged.
    pub fn reset_proximity_sensors(&mut self, with_explicit: bool) {
        self.scene_mut().reset_proximity_sensors(with_explicit);
    }

    /// Computes a collision object that is tagged for explicit handling.
    ///
    /// # Errors
    /// When it is not tagged, or no collision object.
    pub fn handle_collision_object(&mut self, handle: i64) -> ApiResult<Option<[Handle; 2]>> {
        Ok(self.sim.handle_collision_object(handle)?)
    }

    /// The same for all, or those that are not tagged; returns how many collide.
    pub fn handle_collision_objects(&mut self, with_explicit: bool) -> i64 {
        self.sim.handle_collision_objects(with_explicit)
    }

    /// Computes a distance object that is tagged for explicit handling.
    ///
    /// # Errors
    /// When it is not tagged, or no distance object.
    pub fn handle_distance_object(&mut self, handle: i64) -> ApiResult<Option<f64>> {
        Ok(self.sim.handle_distance_object(handle)?)
    }

    /// The same for all, or those that are not tagged; returns the smallest distance (m).
    pub fn handle_distance_objects(&mut self, with_explicit: bool) -> Option<f64> {
        self.sim.handle_distance_objects(with_explicit)
    }
}
