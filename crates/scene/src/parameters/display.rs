//! The numbered parameters of cameras, sensors, lights and voxels (`sim.visionintparam_*`, `sim.camerafloatparam_*`, ...).

use crate::sensor::force_sensor::ForceSensor;
use crate::sensor::{Camera, Entity, Light, ProximitySensor, RenderMode, View, VisionSensor};
use crate::{Field, Handle, Kind, Object, Pose, Scene, SceneResult};

/// `sim.visionintparam_*`, `sim.visionfloatparam_*`.
mod vision {
    pub const NEAR_CLIPPING: i64 = 1000;
    pub const FAR_CLIPPING: i64 = 1001;
    pub const RESOLUTION_X: i64 = 1002;
    pub const RESOLUTION_Y: i64 = 1003;
    pub const PERSPECTIVE_ANGLE: i64 = 1004;
    pub const ORTHO_SIZE: i64 = 1005;
    pub const ENTITY_TO_RENDER: i64 = 1008;
    pub const WINDOW_WIDTH: i64 = 1009;
    pub const WINDOW_HEIGHT: i64 = 1010;
    pub const RENDER_MODE: i64 = 1017;
    pub const PERSPECTIVE_OPERATION: i64 = 1018;
    pub const RGB_IGNORED: i64 = 1020;
    pub const DEPTH_IGNORED: i64 = 1021;
    pub const VIEW_FRUSTUM: i64 = 1019;

    /// Of ways of rendering that there are no more: the values they always have.
    pub const OLD_INTEGERS: [(i64, i64); 4] = [(1006, 0), (1007, 0xf81), (1013, 0), (1016, 10)];
    pub const OLD_FLOATS: [(i64, f64); 2] = [(1014, 2.0), (1015, 0.05)];
}

/// `sim.proxintparam_*`.
mod prox {
    pub const VOLUME_TYPE: i64 = 4001;
    pub const ENTITY_TO_DETECT: i64 = 4002;
}

/// `sim.forcefloatparam_*`.
mod force {
    pub const ERROR_X: i64 = 5000;
    pub const ERROR_Z: i64 = 5002;
    pub const ERROR_POS: i64 = 5006;
    pub const ERROR_ANGLE: i64 = 5007;
}

/// `sim.lightintparam_*`, `sim.lightfloatparam_*`.
mod light {
    pub const POV_CASTS_SHADOWS: i64 = 8000;
    pub const SPOT_EXPONENT: i64 = 8001;
    pub const SPOT_CUTOFF: i64 = 8002;
    pub const CONST_ATTENUATION: i64 = 8003;
    pub const QUAD_ATTENUATION: i64 = 8005;
}

/// `sim.cameraintparam_*`, `sim.camerafloatparam_*`.
mod camera {
    pub const PERSPECTIVE_ANGLE: i64 = 9001;
    pub const ORTHO_SIZE: i64 = 9002;
    pub const NEAR_CLIPPING: i64 = 9008;
    pub const FAR_CLIPPING: i64 = 9009;
    pub const PERSPECTIVE_OPERATION: i64 = 9010;
    pub const TRACKED_OBJECT: i64 = 9011;
    pub const VIEW_FRUSTUM: i64 = 9013;
}

/// `sim.octreefloatparam_voxelsize`.
const OCTREE_VOXEL_SIZE: i64 = 13000;

/// The value that a parameter of the past always has.
fn old_value<T: Copy>(table: &[(i64, T)], id: i64) -> Option<T> {
    let row = table.iter().find(|(known, _)| *known == id);
    row.map(|&(_, value)| value)
}

impl Object {
    /// The value of a parameter that is a list of numbers: the upper right corners of the near and the far side of what a camera or
    /// vision sensor sees, in metres.
    pub fn float_array_param(&self, id: i64) -> Option<Vec<f64>> {
        let view = match (&self.kind, id) {
            (Kind::VisionSensor(sensor), vision::VIEW_FRUSTUM) => &sensor.view,
            (Kind::Camera(camera), camera::VIEW_FRUSTUM) => &camera.view,
            _ => return None,
        };
        Some(
            view.clipping
                .map(|distance| view.frustum_corner(distance))
                .concat(),
        )
    }
}

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

    fn set_float_param(
        &mut self,
        id: i64,
        [near, far, angle, ortho]: [i64; 4],
        value: f64,
    ) -> bool {
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

/// Parameter numbers of the near and far clipping plane, the opening angle and the orthographic size.
const VISION_SENSOR_VIEW: [i64; 4] = [
    vision::NEAR_CLIPPING,
    vision::FAR_CLIPPING,
    vision::PERSPECTIVE_ANGLE,
    vision::ORTHO_SIZE,
];
const CAMERA_VIEW: [i64; 4] = [
    camera::NEAR_CLIPPING,
    camera::FAR_CLIPPING,
    camera::PERSPECTIVE_ANGLE,
    camera::ORTHO_SIZE,
];

impl VisionSensor {
    fn int_param(&self, id: i64) -> Option<i64> {
        Some(match id {
            vision::RESOLUTION_X => self.view.resolution[0].into(),
            vision::RESOLUTION_Y => self.view.resolution[1].into(),
            vision::ENTITY_TO_RENDER => self.entity.raw(),
            vision::WINDOW_WIDTH => self.window[0],
            vision::WINDOW_HEIGHT => self.window[1],
            vision::RENDER_MODE => self.render_mode.0,
            vision::PERSPECTIVE_OPERATION => self.view.perspective.into(),
            vision::RGB_IGNORED => self.ignore_image.into(),
            vision::DEPTH_IGNORED => self.ignore_depth.into(),
            _ => return old_value(&vision::OLD_INTEGERS, id),
        })
    }

    fn set_int_param(&mut self, id: i64, value: i64) -> bool {
        let [width, height] = self.view.resolution.map(i64::from);
        match id {
            vision::RESOLUTION_X => self.set_resolution([value, height]),
            vision::RESOLUTION_Y => self.set_resolution([width, value]),
            vision::ENTITY_TO_RENDER => self.entity = Entity::from_raw(value),
            vision::WINDOW_WIDTH => self.window[0] = value,
            vision::WINDOW_HEIGHT => self.window[1] = value,
            vision::RENDER_MODE => self.render_mode = RenderMode(value),
            vision::PERSPECTIVE_OPERATION => self.view.perspective = value != 0,
            vision::RGB_IGNORED => self.ignore_image = value != 0,
            vision::DEPTH_IGNORED => self.ignore_depth = value != 0,
            _ => return false,
        }
        true
    }
}

impl ProximitySensor {
    fn int_param(&self, id: i64) -> Option<i64> {
        match id {
            prox::VOLUME_TYPE => Some(self.volume.volume_type.index()),
            prox::ENTITY_TO_DETECT => Some(self.entity.raw()),
            _ => None,
        }
    }
}

impl Light {
    fn float_param(&self, id: i64) -> Option<f64> {
        Some(match id {
            light::SPOT_EXPONENT => self.spot_exponent as f64,
            light::SPOT_CUTOFF => self.spot_cutoff,
            light::CONST_ATTENUATION..=light::QUAD_ATTENUATION => {
                self.attenuation[(id - light::CONST_ATTENUATION) as usize]
            }
            _ => return None,
        })
    }

    fn set_float_param(&mut self, id: i64, value: f64) -> bool {
        match id {
            light::SPOT_EXPONENT => self.spot_exponent = value as i64,
            light::SPOT_CUTOFF => self.spot_cutoff = value,
            light::CONST_ATTENUATION..=light::QUAD_ATTENUATION => {
                self.attenuation[(id - light::CONST_ATTENUATION) as usize] = value;
            }
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
            force::ERROR_X..=force::ERROR_Z => {
                error.translation.vector[(id - force::ERROR_X) as usize]
            }
            force::ERROR_POS => error.translation.vector.norm(),
            force::ERROR_ANGLE => error.rotation.angle(),
            _ => return None,
        })
    }
}

impl Camera {
    fn int_param(&self, id: i64) -> Option<i64> {
        match id {
            camera::PERSPECTIVE_OPERATION => Some(self.view.perspective.into()),
            camera::TRACKED_OBJECT => Some(self.tracked.map_or(-1, Handle::raw)),
            _ => None,
        }
    }
}

impl Object {
    /// An integer parameter of a camera, sensor or light; None when it has no such parameter.
    pub(crate) fn display_int_param(&self, id: i64) -> Option<i64> {
        match &self.kind {
            Kind::VisionSensor(sensor) => sensor.int_param(id),
            Kind::ProximitySensor(sensor) => sensor.int_param(id),
            Kind::Camera(camera) => camera.int_param(id),
            Kind::Light(light) if id == light::POV_CASTS_SHADOWS => {
                Some(light.casts_shadows.into())
            }
            _ => None,
        }
    }

    /// Sets it; false when there is no such parameter, or only one to read.
    fn set_display_int_param(&mut self, id: i64, value: i64) -> bool {
        match &mut self.kind {
            Kind::VisionSensor(sensor) => return sensor.set_int_param(id, value),
            Kind::ProximitySensor(sensor) if id == prox::ENTITY_TO_DETECT => {
                sensor.entity = Entity::from_raw(value);
            }
            Kind::Camera(camera) if id == camera::PERSPECTIVE_OPERATION => {
                camera.view.perspective = value != 0;
            }
            Kind::Light(light) if id == light::POV_CASTS_SHADOWS => {
                light.casts_shadows = value != 0;
            }
            _ => return false,
        }
        true
    }

    /// A float parameter of a camera, sensor or light (SI units); None when it has no such parameter.
    pub(crate) fn display_float_param(&self, id: i64) -> Option<f64> {
        match &self.kind {
            Kind::VisionSensor(sensor) => sensor
                .view
                .float_param(id, VISION_SENSOR_VIEW)
                .or_else(|| old_value(&vision::OLD_FLOATS, id)),
            Kind::Camera(camera) => camera.view.float_param(id, CAMERA_VIEW),
            Kind::Light(light) => light.float_param(id),
            Kind::ForceSensor(sensor) => sensor.float_param(id),
            Kind::OcTree(octree) if id == OCTREE_VOXEL_SIZE => Some(octree.voxel_size()),
            _ => None,
        }
    }

    fn set_display_float_param(&mut self, id: i64, value: f64) -> bool {
        match &mut self.kind {
            Kind::VisionSensor(sensor) => {
                sensor.view.set_float_param(id, VISION_SENSOR_VIEW, value)
            }
            Kind::Camera(camera) => camera.view.set_float_param(id, CAMERA_VIEW, value),
            Kind::Light(light) => light.set_float_param(id, value),
            _ => false,
        }
    }
}

impl Scene {
    /// Makes a camera track an object; an unknown handle ends the tracking.
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

    pub(crate) fn set_display_int(
        &mut self,
        handle: Handle,
        id: i64,
        value: i64,
    ) -> SceneResult<bool> {
        if id == camera::TRACKED_OBJECT && self.object(handle)?.camera().is_ok() {
            return self.track(handle, value).map(|()| true);
        }
        self.modify(handle, Field::Sensor, |object| {
            object.set_display_int_param(id, value)
        })
    }

    /// Values that are not finite are ignored.
    pub(crate) fn set_display_float(
        &mut self,
        handle: Handle,
        id: i64,
        value: f64,
    ) -> SceneResult<bool> {
        if !value.is_finite() {
            return Ok(self.object(handle)?.display_float_param(id).is_some());
        }
        self.modify(handle, Field::Sensor, |object| {
            object.set_display_float_param(id, value)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::VisionOptions;

    #[test]
    fn the_window_of_a_vision_sensor_keeps_the_size_it_is_given() {
        let mut scene = Scene::new();
        let sensor = VisionSensor::new(VisionOptions::empty(), [4, 4], None);
        let sensor = scene
            .add("eye", Kind::VisionSensor(Box::new(sensor)))
            .expect("there is room");
        let read = |scene: &Scene, id| scene.object(sensor).unwrap().display_int_param(id);
        assert_eq!([1009, 1010].map(|id| read(&scene, id)), [Some(0); 2]);
        assert_eq!(scene.set_display_int(sensor, 1009, 640), Ok(true));
        assert_eq!(scene.set_display_int(sensor, 1010, 480), Ok(true));
        assert_eq!(
            [1009, 1010, 1002].map(|id| read(&scene, id)),
            [Some(640), Some(480), Some(4)]
        );
    }

    #[test]
    fn the_numbers_of_a_camera_are_its_own() {
        let mut scene = Scene::new();
        let camera = scene
            .add("c", Kind::Camera(Box::default()))
            .expect("there is room");
        assert_eq!(scene.set_display_float(camera, 9001, 0.5), Ok(true));
        assert_eq!(scene.set_display_float(camera, 1004, 0.7), Ok(false));
        assert_eq!(scene.set_display_float(camera, 9001, f64::NAN), Ok(true));
        assert_eq!(
            scene.object(camera).unwrap().display_float_param(9001),
            Some(0.5)
        );
        assert_eq!(
            scene.set_display_int(camera, 9011, camera.raw() + 1),
            Ok(true)
        );
        assert_eq!(
            scene.object(camera).unwrap().display_int_param(9011),
            Some(-1)
        );
    }
}
