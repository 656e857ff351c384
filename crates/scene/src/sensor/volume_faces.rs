//! Faces of the volume of a proximity sensor: derived numbers that files store beside it.

use super::ProximitySensor;
use super::volume::Volume;
use super::volume_planes::ConvexPiece;

/// Lists of numbers as files have them: of planes the normal, which points outwards, and the distance of the origin behind them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VolumeFaces {
    /// Planes around the volume.
    pub planes_inside: Vec<f64>,
    /// Planes around the part that is left out of it.
    pub planes_outside: Vec<f64>,
    /// Normals around the volume, as files have them.
    pub normals_inside: Vec<f64>,
    /// Normals around the part that is left out, as files have them.
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
        self.file_faces = Some(Box::new(FileFaces {
            volume: self.volume.clone(),
            faces,
        }));
    }

    /// The faces of the volume: those of the file, else computed ones. For volumes that are no convex piece with at most one hole, no
    /// planes are computed.
    pub fn faces(&self) -> VolumeFaces {
        match self
            .file_faces
            .as_deref()
            .filter(|known| known.volume == self.volume)
        {
            Some(known) => known.faces.clone(),
            None => self.computed_faces(),
        }
    }

    fn computed_faces(&self) -> VolumeFaces {
        let piece = match self.volume.pieces().as_mut_slice() {
            [piece] if piece.holes.len() < 2 => std::mem::take(piece),
            _ => ConvexPiece::default(),
        };
        VolumeFaces {
            planes_inside: piece.planes.concat(),
            planes_outside: piece.holes.concat().concat(),
            edges: self.volume.edges().as_flattened().concat(),
            close_edges: self.volume.close_edges().as_flattened().concat(),
            ..VolumeFaces::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::ProximityOptions;
    use crate::sensor::volume::VolumeType;
    use crate::sensor::volume_planes::Plane;

    fn sensor(volume_type: VolumeType) -> ProximitySensor {
        ProximitySensor::new(
            volume_type,
            ProximityOptions::empty(),
            ProximitySensor::INTEGERS,
            None,
        )
    }

    #[test]
    fn planes_are_those_seen_in_files() {
        let mut sensor = sensor(VolumeType::Cylinder);
        (sensor.volume.offset, sensor.volume.range) = (0.0, 0.06);
        (sensor.volume.radius, sensor.volume.faces) = ([0.005, 0.025], [12, 0]);
        let faces = sensor.faces();
        assert_eq!((faces.planes_inside.len(), faces.edges.len()), (56, 216));
        let expected = [0.95188, 0.0, -0.30648, -0.0046];
        let near = |plane: &Plane| {
            plane
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-5)
        };
        assert!(
            faces.planes_inside.as_chunks().0.iter().any(near),
            "{:?}",
            faces.planes_inside
        );
    }

    #[test]
    fn what_was_kept_holds_while_the_volume_does() {
        let mut sensor = sensor(VolumeType::Cone);
        let faces = VolumeFaces {
            planes_outside: vec![1.0; 4],
            ..VolumeFaces::default()
        };
        sensor.set_file_faces(faces.clone());
        assert_eq!(sensor.faces(), faces);
        sensor.volume.range *= 2.0;
        assert!(sensor.faces().planes_outside.len() > 4 && !sensor.faces().edges.is_empty());
    }
}
