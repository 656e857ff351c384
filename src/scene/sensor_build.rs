//! Making sensors from the numbers scripts give.

use super::sensors::{ProximitySensor, VisionSensor};

/// Smallest sizes, m.
const SMALLEST: f64 = 1e-5;
const DISPLAY_SIZE: f64 = 0.01;

impl ProximitySensor {
    /// The integers of a sensor nobody gave any: faces, subdivisions, samples.
    pub const INTEGERS: [i64; 8] = [32, 32, 1, 16, 1, 1, 0, 0];

    /// A sensor of a volume type (`sim.proximitysensor_*`); None for unknown types. `floats`: offset, range, x and y size, far x and
    /// y size, inside gap, radius, far radius, angle, angle threshold, smallest distance, display size, two spare.
    pub fn new(volume_type: i64, options: i64, integers: [i64; 8], floats: Option<[f64; 15]>) -> Option<Self> {
        let usual = usual_volume(volume_type)?;
        let mut floats = floats.unwrap_or(usual);
        let sizes = [1, 2, 3, 4, 5, 12];
        sizes.into_iter().for_each(|i| floats[i] = floats[i].max(SMALLEST));
        Some(Self {
            volume_type,
            explicit: options & 1 != 0,
            size: floats[12],
            integers: integers.to_vec(),
            floats: floats.to_vec(),
            front_faces: options & 8 == 0,
            back_faces: options & 16 == 0,
            exact: options & 32 == 0,
            entity: -1,
        })
    }
}

/// The numbers of a volume nobody described.
fn usual_volume(volume_type: i64) -> Option<[f64; 15]> {
    let [offset, range, x, y, far_x, far_y, radius, far_radius, angle] = match volume_type {
        30 => [0.1, 0.2, 0.2, 0.1, 0.4, 0.2, 0.0, 0.0, 0.0],
        31 => [0.1, 0.2, 0.0, 0.0, 0.0, 0.0, 0.1, 0.2, 0.0],
        32 => [0.0, 0.2, 0.0, 0.05, 0.0, 0.0, 0.1, 0.0, std::f64::consts::FRAC_PI_2],
        33 => [0.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.1, 0.0, std::f64::consts::FRAC_PI_2],
        34 => [0.1, 0.4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        _ => return None,
    };
    let size = DISPLAY_SIZE;
    Some([offset, range, x, y, far_x, far_y, 0.0, radius, far_radius, angle, 0.0, 0.0, size, 0.0, 0.0])
}

impl VisionSensor {
    /// A sensor of the given resolution. `floats`: near and far plane, angle (rad) or size (m), display size, background colour.
    pub fn new(options: i64, resolution: [i64; 2], floats: Option<[f64; 11]>) -> Self {
        let perspective = options & 2 != 0;
        let view = if perspective { 60f64.to_radians() } else { 0.1 };
        let usual = [0.01, 10.0, view, DISPLAY_SIZE, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let [near, far, view, size, ..] = floats.unwrap_or(usual);
        Self {
            explicit: options & 1 != 0,
            perspective,
            resolution: resolution.map(|pixels| pixels.clamp(1, 4096) as u32),
            clipping: [near, far],
            view_angle: if perspective { view } else { 60f64.to_radians() },
            ortho_size: if perspective { 0.1 } else { view },
            size,
            entity: -1,
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
        assert!(ray.explicit && !ray.front_faces && ray.back_faces && ray.exact);
    }
}
