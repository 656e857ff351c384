//! Vision sensors: their pictures, and the scripts that look at them. Read a picture with `Cx::scene` and the methods of `VisionSensor`.

use super::Cx;
use crate::error::{ApiError, ApiResult};
use perception::vision::Channels;
use scene::sensor::{Entity, VisionReading, VisionSensor};
use scene::{Field, Handle, SceneError};

impl Cx<'_> {
    /// Takes a picture with a sensor, lets its scripts look at it, and returns the results.
    ///
    /// # Errors
    /// When `sensor` is no vision sensor.
    pub fn handle_vision_sensor(&mut self, sensor: Handle) -> ApiResult<VisionReading> {
        self.sim
            .handle_vision_sensor(sensor)
            .map_err(ApiError::Scene)
    }

    /// The same with an entity of the caller's choice; the sensor is as before afterwards. Returns the picture too.
    ///
    /// # Errors
    /// When `sensor` is no vision sensor.
    pub fn check_vision_sensor(
        &mut self,
        sensor: Handle,
        entity: Entity,
    ) -> ApiResult<(VisionReading, VisionSensor)> {
        self.sim
            .check_vision_sensor(sensor, entity)
            .map_err(ApiError::Scene)
    }

    /// Width, height, and red, green, blue of each pixel (the lowest row first) of the last picture of a vision sensor; without one, and for
    /// a camera, of what it sees now.
    ///
    /// # Errors
    /// When `from` is neither a camera nor a vision sensor.
    pub fn seen_image(&self, from: Handle) -> ApiResult<([u32; 2], Vec<u8>)> {
        let scene = self.scene();
        if let Ok(sensor) = scene.object(from)?.vision_sensor()
            && !sensor.image.is_empty()
        {
            return Ok((sensor.view.resolution, sensor.image.clone()));
        }
        let mut perception = self.sim.perception.borrow_mut();
        let picture = perception
            .vision
            .view(&scene, Some(from), None, Channels::COLOUR)?;
        Ok((picture.resolution, picture.colour))
    }

    /// Replaces the image of a sensor (red, green, blue of each pixel, from the lowest row), then calls its scripts, unless they are
    /// looking at its picture already.
    ///
    /// # Errors
    /// When `sensor` is no vision sensor, or there are not as many bytes as its resolution needs.
    pub fn set_vision_image(&mut self, sensor: Handle, image: Vec<u8>) -> ApiResult<()> {
        self.change_picture(sensor, |sensor| {
            let fits = image.len() == sensor.image_len();
            if fits {
                sensor.image = image;
            }
            fits
        })?;
        self.evaluate_set_picture(sensor)
    }

    /// Replaces the depths of a sensor (0 near to 1 far, from the lowest row). Its scripts are not called.
    ///
    /// # Errors
    /// When `sensor` is no vision sensor, or there are not as many depths as its resolution needs.
    pub fn set_vision_depth(&mut self, sensor: Handle, depth: Vec<f32>) -> ApiResult<()> {
        self.change_picture(sensor, |sensor| {
            let fits = depth.len() == sensor.pixels();
            if fits {
                sensor.depth = depth;
            }
            fits
        })
    }

    /// Changes the picture of a sensor; `change` returns false when it was passed the wrong number of values.
    ///
    /// # Errors
    /// Then, and when `sensor` is no vision sensor.
    pub fn change_picture(
        &mut self,
        sensor: Handle,
        change: impl FnOnce(&mut VisionSensor) -> bool,
    ) -> ApiResult<()> {
        let refused = || SceneError::Refused("incorrect buffer size.".into());
        Ok(self
            .scene_mut()
            .try_modify(sensor, Field::Measured, |object| {
                if change(object.vision_sensor_mut()?) {
                    Ok(())
                } else {
                    Err(refused())
                }
            })?)
    }

    /// Calls the scripts of a sensor for a picture that was set, unless they are looking at its picture already.
    ///
    /// # Errors
    /// When `sensor` is no vision sensor.
    pub fn evaluate_set_picture(&mut self, sensor: Handle) -> ApiResult<()> {
        self.sim
            .evaluate_set_picture(sensor)
            .map_err(ApiError::Scene)
    }

    /// Forgets the results of a sensor.
    pub fn reset_vision_sensor(&mut self, sensor: Handle) {
        self.scene_mut().set_vision_reading(sensor, None);
    }
}
