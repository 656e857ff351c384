//! Creation of sensors from the parameters of scripts.

use super::options::{ProximityOptions, VisionOptions};
use super::volume::{Volume, VolumeType};
use super::{Entity, ProximitySensor, RenderMode, View, VisionSensor};
use crate::appearance::colour::Colour;

const DISPLAY_SIZE: f64 = 0.01;
/// Emission colour of displayed rays, as in files of CoppeliaSim.
const RAY_EMISSION: [f32; 3] = [1.0, 1.0, 0.0];

impl ProximitySensor {
    /// Default integer parameters of a sensor: faces, subdivisions, samples.
    pub const INTEGERS: [i64; 8] = [32, 32, 1, 16, 1, 1, 0, 0];

    /// A sensor with a volume of a type. `floats`: offset, range, x and y size, far x and
    /// y size, inside gap, radius, far radius, angle, angle threshold, smallest distance, display size, two spare.
    pub fn new(
        volume_type: VolumeType,
        options: ProximityOptions,
        integers: [i64; 8],
        floats: Option<[f64; 15]>,
    ) -> Self {
        let mut floats = floats.unwrap_or_else(|| default_volume(volume_type));
        let sizes = [1, 2, 3, 4, 5, 12];
        sizes
            .into_iter()
            .for_each(|i| floats[i] = floats[i].max(Volume::MIN_SIZE));
        let limit = |option: ProximityOptions, at: usize| {
            if options.contains(option) && floats[at].is_finite() {
                floats[at].max(0.0)
            } else {
                0.0
            }
        };
        Self {
            volume: volume_of(
                volume_type,
                &integers,
                &floats,
                limit(ProximityOptions::CLOSE_THRESHOLD, 11),
            ),
            explicit: options.contains(ProximityOptions::EXPLICIT_HANDLING),
            size: floats[12],
            show_volume: !options.contains(ProximityOptions::HIDE_VOLUME),
            // A sensor that ignored both would detect nothing.
            front_faces: !options.contains(ProximityOptions::IGNORE_FRONT_FACES)
                || options.contains(ProximityOptions::IGNORE_BACK_FACES),
            back_faces: !options.contains(ProximityOptions::IGNORE_BACK_FACES),
            exact: !options.contains(ProximityOptions::FAST),
            randomized: options.contains(ProximityOptions::RANDOMIZED)
                && volume_type == VolumeType::Ray,
            samples: integers[4].max(1),
            required_samples: integers[5].max(1),
            angle_threshold: limit(ProximityOptions::ANGLE_THRESHOLD, 10),
            entity: Entity::ALL,
            ray_colour: Colour {
                emission: RAY_EMISSION,
                ..Colour::new([0.0; 3])
            },
            file_faces: None,
            handled: false,
            detection: None,
        }
    }
}

fn volume_of(
    volume_type: VolumeType,
    integers: &[i64; 8],
    floats: &[f64; 15],
    close_threshold: f64,
) -> Volume {
    Volume {
        volume_type,
        offset: floats[0],
        range: floats[1],
        x_size: [floats[2], floats[4]],
        y_size: [floats[3], floats[5]],
        radius: [floats[7], floats[8]],
        angle: floats[9],
        inside_gap: floats[6],
        faces: [integers[0], integers[1]],
        subdivisions: [integers[2], integers[3]],
        close_threshold,
    }
}

/// Default parameters of a volume.
fn default_volume(volume_type: VolumeType) -> [f64; 15] {
    let [offset, range, x, y, far_x, far_y, radius, far_radius, angle] = match volume_type {
        VolumeType::Pyramid => [0.1, 0.2, 0.2, 0.1, 0.4, 0.2, 0.0, 0.0, 0.0],
        VolumeType::Cylinder => [0.1, 0.2, 0.0, 0.0, 0.0, 0.0, 0.1, 0.2, 0.0],
        VolumeType::Disc => [
            0.0,
            0.2,
            0.0,
            0.05,
            0.0,
            0.0,
            0.1,
            0.0,
            std::f64::consts::FRAC_PI_2,
        ],
        VolumeType::Cone => [
            0.0,
            0.2,
            0.0,
            0.0,
            0.0,
            0.0,
            0.1,
            0.0,
            std::f64::consts::FRAC_PI_2,
        ],
        VolumeType::Ray => [0.1, 0.4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    };
    let size = DISPLAY_SIZE;
    [
        offset, range, x, y, far_x, far_y, 0.0, radius, far_radius, angle, 0.0, 0.0, size, 0.0, 0.0,
    ]
}

impl VisionSensor {
    /// A sensor of the given resolution. `floats`: near and far plane, angle (rad) or size (m), display size, two spare, background
    /// colour, two spare.
    pub fn new(options: VisionOptions, resolution: [i64; 2], floats: Option<[f64; 11]>) -> Self {
        let perspective = options.contains(VisionOptions::PERSPECTIVE);
        let extent = if perspective { 60f64.to_radians() } else { 0.1 };
        let defaults = [
            0.01,
            10.0,
            extent,
            DISPLAY_SIZE,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
        ];
        let [near, far, extent, size, _, _, red, green, blue, ..] = floats.unwrap_or(defaults);
        let mut view = View {
            perspective,
            resolution: [1; 2],
            clipping: [near, far],
            angle: if perspective {
                extent
            } else {
                60f64.to_radians()
            },
            ortho_size: if perspective { 0.1 } else { extent },
            show_frustum: !options.contains(VisionOptions::HIDE_FRUSTUM),
        };
        view.set_resolution(resolution);
        Self {
            view,
            explicit: options.contains(VisionOptions::EXPLICIT_HANDLING),
            size,
            entity: Entity::ALL,
            render_mode: RenderMode::OPENGL,
            background: [red, green, blue].map(|part| part as f32),
            background_from_environment: !options.contains(VisionOptions::OWN_BACKGROUND),
            local_lights: options.contains(VisionOptions::LOCAL_LIGHTS),
            ignore_fog: options.contains(VisionOptions::IGNORE_FOG),
            external_image: options.contains(VisionOptions::EXTERNAL_IMAGE),
            ignore_image: false,
            ignore_depth: false,
            ignore_specular: false,
            window: [0; 2],
            omit_statistics: false,
            image: Vec::new(),
            depth: Vec::new(),
            reading: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_and_options_have_the_numbers_of_scripts() {
        assert_eq!(VolumeType::from_code(35), None);
        let ray = VolumeType::from_code(34).unwrap();
        let options = ProximityOptions::from_bits_retain(1 | 8 | 1 << 40);
        let ray = ProximitySensor::new(ray, options, ProximitySensor::INTEGERS, None);
        assert!(ray.explicit && !ray.front_faces && ray.back_faces && ray.exact && ray.show_volume);
    }
}
