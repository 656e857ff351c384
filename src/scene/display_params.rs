//! The numbered parameters of cameras, sensors, lights and voxels (`sim.visionintparam_*`, `sim.camerafloatparam_*`, ...).

use super::force_sensor::ForceSensor;
use super::sensors::{Camera, Light, ProximitySensor, View, VisionSensor};
use super::{Field, Handle, Kind, Object, Pose, Scene, SceneResult};

impl View {
    fn float_param(&self, id: i64, [near, far, angle, ortho]: [i64; 4]) -> Option<f64> {
        Some(match id {
            _ if id == near => self.clipping[0],
            _ if id == far => self.clipping[1],
            _ if id == angle => self.angle,
            _ if id == ortho => self.ortho_size,
            _ => return None,
        })
    }

    fn set_float_param(&mut self, id: i64, [near, far, angle, ortho]: [i64; 4], value: f64) -> bool {
        match id {
            _ if id == near => self.clipping[0] = value,
            _ if id == far => self.clipping[1] = value,
            _ if id == angle => self.angle = value,
            _ if id == ortho => self.ortho_size = value,
            _ => return false,
        }
        true
    }
}

/// Numbers of near and far plane, angle and size.
const OF_VISION_SENSOR: [i64; 4] = [1000, 1001, 1004, 1005];
const OF_CAMERA: [i64; 4] = [9008, 9009, 9001, 9002];

impl VisionSensor {
    fn int_param(&self, id: i64) -> Option<i64> {
        Some(match id {
            1002 | 1003 => self.view.resolution[(id - 1002) as usize].into(),
            1008 => self.entity,
            1017 => self.render_mode,
            1018 => self.view.perspective.into(),
            1020 => self.ignore_image.into(),
            1021 => self.ignore_depth.into(),
            _ => return None,
        })
    }

    fn set_int_param(&mut self, id: i64, value: i64) -> bool {
        let [width, height] = self.view.resolution.map(i64::from);
        match id {
            1002 => self.set_resolution([value, height]),
            1003 => self.set_resolution([width, value]),
            1008 => self.entity = value,
            1017 => self.render_mode = value,
            1018 => self.view.perspective = value != 0,
            1020 => self.ignore_image = value != 0,
            1021 => self.ignore_depth = value != 0,
            _ => return false,
        }
        true
    }
}

impl ProximitySensor {
    fn int_param(&self, id: i64) -> Option<i64> {
        match id {
            4001 => Some(self.volume_type),
            4002 => Some(self.entity),
            _ => None,
        }
    }
}

impl Light {
    fn float_param(&self, id: i64) -> Option<f64> {
        Some(match id {
            8001 => self.spot_exponent as f64,
            8002 => self.spot_cutoff,
            8003..=8005 => self.attenuation[(id - 8003) as usize],
            _ => return None,
        })
    }

    fn set_float_param(&mut self, id: i64, value: f64) -> bool {
        match id {
            8001 => self.spot_exponent = value as i64,
            8002 => self.spot_cutoff = value,
            8003..=8005 => self.attenuation[(id - 8003) as usize] = value,
            _ => return false,
        }
        true
    }
}

impl ForceSensor {
    /// How far the physics moved the sides of the sensor apart: along the axes, in all, and the angle.
    fn float_param(&self, id: i64) -> Option<f64> {
        let error = self.error.unwrap_or_else(Pose::identity);
        Some(match id {
            5000..=5002 => error.translation.vector[(id - 5000) as usize],
            5006 => error.translation.vector.norm(),
            5007 => error.rotation.angle(),
            _ => return None,
        })
    }
}

impl Camera {
    fn int_param(&self, id: i64) -> Option<i64> {
        match id {
            9010 => Some(self.view.perspective.into()),
            9011 => Some(self.tracked.map_or(-1, Handle::raw)),
            _ => None,
        }
    }
}

impl Object {
    /// An integer parameter of a camera, sensor or light; None when it has no such parameter.
    pub(super) fn display_int_param(&self, id: i64) -> Option<i64> {
        match &self.kind {
            Kind::VisionSensor(sensor) => sensor.int_param(id),
            Kind::ProximitySensor(sensor) => sensor.int_param(id),
            Kind::Camera(camera) => camera.int_param(id),
            Kind::Light(light) if id == 8000 => Some(light.casts_shadows.into()),
            _ => None,
        }
    }

    /// Sets it; false when there is no such parameter, or only one to read.
    fn set_display_int_param(&mut self, id: i64, value: i64) -> bool {
        match &mut self.kind {
            Kind::VisionSensor(sensor) => return sensor.set_int_param(id, value),
            Kind::ProximitySensor(sensor) if id == 4002 => sensor.entity = value,
            Kind::Camera(camera) if id == 9010 => camera.view.perspective = value != 0,
            Kind::Light(light) if id == 8000 => light.casts_shadows = value != 0,
            _ => return false,
        }
        true
    }

    /// A float parameter of a camera, sensor or light (SI units); None when it has no such parameter.
    pub(super) fn display_float_param(&self, id: i64) -> Option<f64> {
        match &self.kind {
            Kind::VisionSensor(sensor) => sensor.view.float_param(id, OF_VISION_SENSOR),
            Kind::Camera(camera) => camera.view.float_param(id, OF_CAMERA),
            Kind::Light(light) => light.float_param(id),
            Kind::ForceSensor(sensor) => sensor.float_param(id),
            Kind::OcTree(octree) if id == 13000 => Some(octree.voxel_size),
            _ => None,
        }
    }

    fn set_display_float_param(&mut self, id: i64, value: f64) -> bool {
        match &mut self.kind {
            Kind::VisionSensor(sensor) => sensor.view.set_float_param(id, OF_VISION_SENSOR, value),
            Kind::Camera(camera) => camera.view.set_float_param(id, OF_CAMERA, value),
            Kind::Light(light) => light.set_float_param(id, value),
            _ => false,
        }
    }
}

impl Scene {
    /// Makes a camera follow an object; handles of nothing mean none.
    ///
    /// # Errors
    /// When `handle` is no camera.
    pub fn track(&mut self, handle: Handle, tracked: i64) -> SceneResult<()> {
        let tracked = Handle::from_raw(tracked).filter(|&tracked| self.exists(tracked));
        self.try_modify(handle, Field::Other, |object| {
            object.camera_mut()?.tracked = tracked;
            Ok(())
        })
    }

    pub(super) fn set_display_int(&mut self, handle: Handle, id: i64, value: i64) -> SceneResult<bool> {
        if id == 9011 && self.object(handle)?.camera().is_ok() {
            return self.track(handle, value).map(|()| true);
        }
        self.modify(handle, Field::Sensor, |object| object.set_display_int_param(id, value))
    }

    /// Numbers that are not finite change nothing.
    pub(super) fn set_display_float(&mut self, handle: Handle, id: i64, value: f64) -> SceneResult<bool> {
        if !value.is_finite() {
            return Ok(self.object(handle)?.display_float_param(id).is_some());
        }
        self.modify(handle, Field::Sensor, |object| object.set_display_float_param(id, value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_of_a_camera_are_its_own() {
        let mut scene = Scene::new();
        let camera = scene.add("c", Kind::Camera(Box::default())).expect("there is room");
        assert_eq!(scene.set_display_float(camera, 9001, 0.5), Ok(true));
        assert_eq!(scene.set_display_float(camera, 1004, 0.7), Ok(false));
        assert_eq!(scene.set_display_float(camera, 9001, f64::NAN), Ok(true));
        assert_eq!(scene.object(camera).unwrap().display_float_param(9001), Some(0.5));
        assert_eq!(scene.set_display_int(camera, 9011, camera.raw() + 1), Ok(true));
        assert_eq!(scene.object(camera).unwrap().display_int_param(9011), Some(-1));
    }
}
