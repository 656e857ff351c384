//! Creation of sensors from the parameters of scripts.

use super::volume::{CONE, CYLINDER, DISC, PYRAMID, RAY, Volume};
use super::{ProximitySensor, View, VisionSensor};
use crate::scene::appearance::colour::Colour;

const DISPLAY_SIZE: f64 = 0.01;
/// What a ray looks like, as files of the original hold it.
const RAY_GLOW: [f32; 3] = [1.0, 1.0, 0.0];

impl ProximitySensor {
    /// Default integer parameters of a sensor: faces, subdivisions, samples.
    pub const INTEGERS: [i64; 8] = [32, 32, 1, 16, 1, 1, 0, 0];

    /// A sensor of a volume type (`sim.proximitysensor_*`); None for unknown types. `floats`: offset, range, x and y size, far x and
    /// y size, inside gap, radius, far radius, angle, angle threshold, smallest distance, display size, two spare.
    pub fn new(volume_type: i64, options: i64, integers: [i64; 8], floats: Option<[f64; 15]>) -> Option<Self> {
        let usual = usual_volume(volume_type)?;
        let mut floats = floats.unwrap_or(usual);
        let sizes = [1, 2, 3, 4, 5, 12];
        sizes.into_iter().for_each(|i| floats[i] = floats[i].max(Volume::SMALLEST));
        let option = |bit: i64| options & bit != 0;
        let limit = |bit: i64, at: usize| if option(bit) && floats[at].is_finite() { floats[at].max(0.0) } else { 0.0 };
        Some(Self {
            volume_type,
            volume: volume_of(&integers, &floats, limit(256, 11)),
            explicit: option(1),
            size: floats[12],
            show_volume: !option(4),
            front_faces: !option(8),
            back_faces: !option(16),
            exact: !option(32),
            randomized: option(512) && volume_type == RAY,
            samples: integers[4].max(1),
            required_samples: integers[5].max(1),
            angle_threshold: limit(64, 10),
            entity: -1,
            ray_colour: Colour { emission: RAY_GLOW, ..Colour::new([0.0; 3]) },
            known_faces: None,
            detection: None,
        })
    }
}

fn volume_of(integers: &[i64; 8], floats: &[f64; 15], close_threshold: f64) -> Volume {
    Volume {
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
fn usual_volume(volume_type: i64) -> Option<[f64; 15]> {
    let [offset, range, x, y, far_x, far_y, radius, far_radius, angle] = match volume_type {
        PYRAMID => [0.1, 0.2, 0.2, 0.1, 0.4, 0.2, 0.0, 0.0, 0.0],
        CYLINDER => [0.1, 0.2, 0.0, 0.0, 0.0, 0.0, 0.1, 0.2, 0.0],
        DISC => [0.0, 0.2, 0.0, 0.05, 0.0, 0.0, 0.1, 0.0, std::f64::consts::FRAC_PI_2],
        CONE => [0.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.1, 0.0, std::f64::consts::FRAC_PI_2],
        RAY => [0.1, 0.4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        _ => return None,
    };
    let size = DISPLAY_SIZE;
    Some([offset, range, x, y, far_x, far_y, 0.0, radius, far_radius, angle, 0.0, 0.0, size, 0.0, 0.0])
}

impl VisionSensor {
    /// A sensor of the given resolution. `floats`: near and far plane, angle (rad) or size (m), display size, two spare, background
    /// colour, two spare.
    pub fn new(options: i64, resolution: [i64; 2], floats: Option<[f64; 11]>) -> Self {
        let option = |bit: i64| options & bit != 0;
        let perspective = option(2);
        let extent = if perspective { 60f64.to_radians() } else { 0.1 };
        let usual = [0.01, 10.0, extent, DISPLAY_SIZE, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let [near, far, extent, size, _, _, red, green, blue, ..] = floats.unwrap_or(usual);
        let mut view = View {
            perspective,
            resolution: [1; 2],
            clipping: [near, far],
            angle: if perspective { extent } else { 60f64.to_radians() },
            ortho_size: if perspective { 0.1 } else { extent },
            show_frustum: !option(4),
        };
        view.set_resolution(resolution);
        Self {
            view,
            explicit: option(1),
            size,
            entity: -1,
            render_mode: 0,
            background: [red, green, blue].map(|part| part as f32),
            background_from_environment: !option(128),
            external_image: option(16),
            ignore_image: false,
            ignore_depth: false,
            omit_statistics: false,
            image: Vec::new(),
            depth: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_volumes_are_refused() {
        assert_eq!(ProximitySensor::new(35, 0, ProximitySensor::INTEGERS, None), None);
        let ray = ProximitySensor::new(34, 1 | 8, ProximitySensor::INTEGERS, None).unwrap();
        assert!(ray.explicit && !ray.front_faces && ray.back_faces && ray.exact && ray.show_volume);
    }
}
