//! Sensors, cameras and lights as data. What sensors measure is computed by the layer `perception`.

pub(crate) mod build;
pub mod force_sensor;
pub mod options;
mod results;
pub mod vision;
pub mod volume;
pub mod volume_faces;
pub mod volume_planes;

use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;

use super::Handle;
use super::appearance::colour::Colour;
use volume::Volume;
use volume_faces::FileFaces;

pub use options::{ProximityOptions, VisionOptions};
pub use vision::{Area, RenderMode, VisionReading, VisionSensor};

/// A proximity sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct ProximitySensor {
    /// Where it detects.
    pub volume: Volume,
    /// Handled only when a script asks for this sensor, not with all others.
    pub explicit: bool,
    /// Size of the displayed symbol, metres.
    pub size: f64,
    /// The volume is displayed.
    pub show_volume: bool,
    /// Detects the outer side of surfaces.
    pub front_faces: bool,
    /// Detects the inner side of surfaces.
    pub back_faces: bool,
    /// Finds the closest point, not just any.
    pub exact: bool,
    /// Rays only: several random directions per reading.
    pub randomized: bool,
    /// Number of random rays per reading.
    pub samples: i64,
    /// How many of the samples have to detect something.
    pub required_samples: i64,
    /// Largest angle between ray and surface normal that is detected, radians; 0 for any.
    pub angle_threshold: f64,
    /// What it detects.
    pub entity: Entity,
    /// Colour of the displayed ray and detected point.
    pub ray_colour: Colour,
    /// The faces of the volume that its file contains, if they differ from the computed ones.
    pub file_faces: Option<Box<FileFaces>>,
    /// Whether it was handled since it was reset.
    pub handled: bool,
    /// The result of the last handling.
    pub detection: Option<Detection>,
}

impl ProximitySensor {
    /// Forgets the results.
    pub fn reset(&mut self) {
        (self.handled, self.detection) = (false, None);
    }
}

/// Entity that a sensor detects or renders: all objects, an object, or a collection. Unknown handles are stored as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entity(i64);

impl Entity {
    /// All objects.
    pub const ALL: Self = Self(-1);

    /// From the number of a script or file: -1 for all, or a handle of an object or a collection.
    pub fn from_raw(raw: i64) -> Self {
        Self(raw)
    }

    /// The number scripts and files know: -1 for all, or a handle.
    pub fn raw(self) -> i64 {
        self.0
    }

    /// The object, if it is one.
    pub fn object(self) -> Option<Handle> {
        Handle::from_raw(self.0)
    }
}

impl From<Handle> for Entity {
    fn from(object: Handle) -> Self {
        Self(object.raw())
    }
}

/// A detection of a proximity sensor, in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Detection {
    /// The detected shape, octree or other object.
    pub object: Handle,
    /// The detected point, metres.
    pub point: [f64; 3],
    /// Unit normal of the surface there.
    pub normal: [f64; 3],
}

impl Detection {
    /// Distance of the point from the origin of the sensor, metres.
    pub fn distance(&self) -> f64 {
        Vector3::from(self.point).norm()
    }
}

/// The projection of a camera or vision sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Perspective projection instead of an orthographic one.
    pub perspective: bool,
    /// Width and height, pixels.
    pub resolution: [u32; 2],
    /// Distances of the near and far clipping plane, metres.
    pub clipping: [f64; 2],
    /// Opening angle of a perspective view along its larger side, radians.
    pub angle: f64,
    /// Extent of an orthographic view along its larger side, metres.
    pub ortho_size: f64,
    /// The view volume is displayed.
    pub show_frustum: bool,
}

impl View {
    /// Largest resolution along an axis, pixels.
    pub const MAX_RESOLUTION: i64 = 4096;

    /// Half width, half height and distance of the picture `distance` metres ahead.
    pub fn frustum_corner(&self, distance: f64) -> [f64; 3] {
        let large = if self.perspective {
            distance * libm::tan(self.angle / 2.0)
        } else {
            self.ortho_size / 2.0
        };
        let [width, height] = self.resolution.map(f64::from);
        let larger = width.max(height);
        [large * width / larger, large * height / larger, distance]
    }

    /// Sets the resolution, within 1 and [`View::MAX_RESOLUTION`].
    pub fn set_resolution(&mut self, resolution: [i64; 2]) {
        self.resolution = resolution.map(|pixels| pixels.clamp(1, Self::MAX_RESOLUTION) as u32);
    }
}

/// A camera: a viewpoint for display, along its z axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// Its projection.
    pub view: View,
    /// Size of its symbol, metres.
    pub size: f64,
    /// The object it follows.
    pub tracked: Option<Handle>,
}

impl Default for Camera {
    fn default() -> Self {
        let view = View {
            perspective: true,
            resolution: [256, 256],
            clipping: [0.05, 30.0],
            angle: 60f64.to_radians(),
            ortho_size: 2.0,
            show_frustum: false,
        };
        Self {
            view,
            size: 0.05,
            tracked: None,
        }
    }
}

/// `sim.light_*`: where a light shines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightType {
    /// In all directions from a point.
    Omnidirectional = 1,
    /// Within a cone along z.
    Spot = 2,
    /// Parallel rays along z.
    Directional = 3,
}

impl LightType {
    /// The type of that number; the first or last one for numbers below or above all types.
    pub fn nearest(number: i64) -> Self {
        match number {
            ..=1 => Self::Omnidirectional,
            2 => Self::Spot,
            3.. => Self::Directional,
        }
    }

    /// The number of `sim.light_*`.
    pub fn code(self) -> i64 {
        self as i64
    }
}

/// A light source.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Where it shines.
    pub light_type: LightType,
    /// Whether it is on.
    pub enabled: bool,
    /// The colour of its light.
    pub colour: Colour,
    /// Size of its symbol, metres.
    pub size: f64,
    /// How fast a spot fades away from its axis; 0 is even.
    pub spot_exponent: i64,
    /// Half the opening angle of a spot, radians.
    pub spot_cutoff: f64,
    /// Constant, linear and quadratic factor of the attenuation with distance in metres.
    pub attenuation: [f64; 3],
    /// Whether renderers with shadows draw them for this light.
    pub casts_shadows: bool,
}

impl Light {
    /// A white light of that type with default settings.
    pub fn new(light_type: LightType) -> Self {
        Self {
            light_type,
            enabled: true,
            colour: Colour::new([0.5; 3]),
            size: 0.1,
            spot_exponent: 5,
            spot_cutoff: FRAC_PI_2,
            attenuation: [0.5, 0.0, 0.25],
            casts_shadows: true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angle_is_that_of_the_larger_side() {
        let mut view = Camera::default().view;
        (view.angle, view.resolution) = (FRAC_PI_2, [200, 100]);
        let [x, y, z] = view.frustum_corner(2.0);
        assert!((x - 2.0).abs() < 1e-12 && (y - 1.0).abs() < 1e-12 && z == 2.0);
        view.perspective = false;
        assert_eq!(view.frustum_corner(7.0), [1.0, 0.5, 7.0]);
    }
}
