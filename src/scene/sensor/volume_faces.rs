//! Faces of the volume of a proximity sensor: derived numbers that files store beside it.

use nalgebra::Vector3;

use super::ProximitySensor;
use super::volume::{Volume, VolumeType};

type Plane = [f64; 4];

/// Lists of numbers as files have them: of planes the normal, which points outwards, and the distance of the origin behind them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VolumeFaces {
    pub planes_inside: Vec<f64>,
    pub planes_outside: Vec<f64>,
    pub normals_inside: Vec<f64>,
    pub normals_outside: Vec<f64>,
    /// End points of the edges.
    pub edges: Vec<f64>,
    /// End points of the edges of the part that is too close.
    pub close_edges: Vec<f64>,
}

/// The faces that a file contains, with the volume they belong to.
#[derive(Debug, Clone, PartialEq)]
pub struct FileFaces {
    volume: Volume,
    faces: VolumeFaces,
}

impl ProximitySensor {
    /// Stores the faces a file contains; they are valid until the volume changes. Faces equal to the computed ones are not stored.
    pub fn set_file_faces(&mut self, faces: VolumeFaces) {
        if faces == self.faces() {
            return;
        }
        self.file_faces = Some(Box::new(FileFaces { volume: self.volume.clone(), faces }));
    }

    /// The faces of the volume: those of the file, else computed ones. For discs, cones and volumes with an inside gap, no planes are
    /// computed.
    pub fn faces(&self) -> VolumeFaces {
        match self.file_faces.as_deref().filter(|known| known.volume == self.volume) {
            Some(known) => known.faces.clone(),
            None => VolumeFaces {
                planes_inside: self.volume.planes().concat(),
                edges: self.volume.edges().as_flattened().concat(),
                close_edges: self.volume.close_edges().as_flattened().concat(),
                ..VolumeFaces::default()
            },
        }
    }
}

impl Volume {
    /// The planes around a pyramid or a cylinder without a gap.
    fn planes(&self) -> Vec<Plane> {
        if !matches!(self.volume_type, VolumeType::Pyramid | VolumeType::Cylinder) || self.inside_gap != 0.0 {
            return Vec::new();
        }
        let [near, far] = self.ends().map(|end| end.into_iter().map(Vector3::from).collect::<Vec<_>>());
        let caps = [[0.0, 0.0, -1.0, self.offset], [0.0, 0.0, 1.0, -(self.offset + self.range)]];
        let side = |i: usize| {
            let next = (i + 1) % near.len();
            // One of the ends may be a point, whose sides have no direction.
            let along = (far[next] - far[i]) + (near[next] - near[i]);
            let normal = along.cross(&(far[i] - near[i])).try_normalize(0.0)?;
            let middle = 0.25 * (near[i] + near[next] + far[i] + far[next]);
            let outwards = if normal.xy().dot(&middle.xy()) < 0.0 { -normal } else { normal };
            Some([outwards.x, outwards.y, outwards.z, -outwards.dot(&middle)])
        };
        caps.into_iter().chain((0..near.len()).filter_map(side)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::sensor::ProximityOptions;

    fn sensor(volume_type: VolumeType) -> ProximitySensor {
        ProximitySensor::new(volume_type, ProximityOptions::empty(), ProximitySensor::INTEGERS, None)
    }

    #[test]
    fn planes_are_those_seen_in_files() {
        let mut sensor = sensor(VolumeType::Cylinder);
        (sensor.volume.offset, sensor.volume.range) = (0.0, 0.06);
        (sensor.volume.radius, sensor.volume.faces) = ([0.005, 0.025], [12, 0]);
        let faces = sensor.faces();
        assert_eq!((faces.planes_inside.len(), faces.edges.len()), (56, 216));
        let expected = [0.95188, 0.0, -0.30648, -0.0046];
        let near = |plane: &Plane| plane.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5);
        assert!(faces.planes_inside.as_chunks().0.iter().any(near), "{:?}", faces.planes_inside);
    }

    #[test]
    fn points_inside_are_behind_all_planes() {
        for volume_type in [VolumeType::Pyramid, VolumeType::Cylinder] {
            let sensor = sensor(volume_type);
            let middle = sensor.volume.offset + 0.5 * sensor.volume.range;
            let planes = sensor.faces().planes_inside;
            assert!(planes.as_chunks::<4>().0.iter().all(|[_, _, z, distance]| z * middle + distance < 0.0));
        }
    }

    #[test]
    fn what_was_kept_holds_while_the_volume_does() {
        let mut sensor = sensor(VolumeType::Cone);
        let kept = VolumeFaces { planes_outside: vec![1.0; 4], ..VolumeFaces::default() };
        sensor.set_file_faces(kept.clone());
        assert_eq!(sensor.faces(), kept);
        sensor.volume.range *= 2.0;
        assert!(sensor.faces().planes_outside.is_empty() && !sensor.faces().edges.is_empty());
    }
}
