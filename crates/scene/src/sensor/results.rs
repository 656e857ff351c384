//! What sensors found last.

use super::{Detection, VisionReading};
use crate::{Field, Handle, Object, Scene, SceneError, SceneResult};

impl Scene {
    /// The proximity sensors: all, or those that are not tagged for explicit handling.
    pub fn proximity_sensors(&self, with_explicit: bool) -> Vec<Handle> {
        let is_handled = |object: &&Object| {
            object
                .proximity_sensor()
                .is_ok_and(|sensor| with_explicit || !sensor.explicit)
        };
        self.objects()
            .filter(is_handled)
            .map(Object::handle)
            .collect()
    }

    /// Stores the result of a proximity sensor; readers of properties are notified if it has changed.
    ///
    /// # Errors
    /// When `sensor` is no proximity sensor.
    pub fn set_detection(
        &mut self,
        sensor: Handle,
        handled: bool,
        detection: Option<Detection>,
    ) -> SceneResult<()> {
        let known = self.object(sensor)?.proximity_sensor()?;
        if (known.handled, known.detection) == (handled, detection) {
            return Ok(());
        }
        self.try_modify(sensor, Field::Measured, |object| {
            let data = object.proximity_sensor_mut()?;
            (data.handled, data.detection) = (handled, detection);
            Ok(())
        })
    }

    /// Forgets what one proximity sensor detected, which must be tagged for explicit handling.
    ///
    /// # Errors
    /// When it is not tagged, or no proximity sensor.
    pub fn reset_proximity_sensor(&mut self, sensor: Handle) -> SceneResult<()> {
        if !self.object(sensor)?.proximity_sensor()?.explicit {
            return Err(SceneError::NotExplicit);
        }
        self.set_detection(sensor, false, None)
    }

    /// Forgets what all proximity sensors detected, or those that are not tagged for explicit handling.
    pub fn reset_proximity_sensors(&mut self, with_explicit: bool) {
        for sensor in self.proximity_sensors(with_explicit) {
            // The handles were just read.
            let _ = self.set_detection(sensor, false, None);
        }
    }

    /// Stores the results of a vision sensor, or removes them. A sensor that is gone has none.
    pub fn set_vision_reading(&mut self, sensor: Handle, reading: Option<VisionReading>) {
        let _ = self.try_modify(sensor, Field::Measured, |object| {
            object.vision_sensor_mut()?.reading = reading;
            Ok(())
        });
    }
}
