//! The volume of a proximity sensor, prepared for searches.

use proximity::{Bounds, Filter, Hit, Piece, Placed, closest_in_volume};

use scene::Pose;
use scene::sensor::volume::Volume;
use scene::sensor::volume_planes::{ConvexPiece, Plane};

/// A volume as the searches of the crate `proximity` need it.
#[derive(Debug)]
pub(super) struct SearchVolume {
    pub(super) source: Volume,
    volume: proximity::Volume,
    /// In the frame of the sensor.
    pub(super) bounds: Bounds,
}

impl SearchVolume {
    pub(super) fn new(source: &Volume) -> Self {
        let piece = |ConvexPiece { planes, holes }| proximity::Piece { planes, holes };
        let pieces = source.pieces().into_iter().map(piece).collect();
        let [min, max] = source.extent();
        Self {
            source: source.clone(),
            volume: proximity::Volume { pieces },
            bounds: Bounds { min, max },
        }
    }

    /// The nearest point of a geometry in the volume of a sensor at a pose.
    pub(super) fn closest(
        &self,
        on: Placed,
        sensor: &Pose,
        below: f64,
        filter: &Filter,
    ) -> Option<Hit> {
        closest_in_volume(on, sensor, &self.volume, below, filter)
    }

    /// The parts of a segment (m, in the frame of the sensor) that are inside.
    pub(super) fn parts_of_segment(&self, segment: &[[f64; 3]; 2]) -> Vec<[[f64; 3]; 2]> {
        self.volume
            .pieces
            .iter()
            .flat_map(|piece| parts_in_piece(*segment, piece))
            .collect()
    }
}

/// The parts of a segment that are in a piece and in none of its holes.
fn parts_in_piece(segment: [[f64; 3]; 2], piece: &Piece) -> Vec<[[f64; 3]; 2]> {
    let is_finite = segment.as_flattened().iter().all(|c| c.is_finite());
    let inside = is_finite.then(|| shares_inside(segment, &piece.planes));
    let mut parts: Vec<[f64; 2]> = inside.flatten().into_iter().collect();
    for hole in &piece.holes {
        if let Some([enter, leave]) = shares_inside(segment, hole) {
            let around = |[from, to]: [f64; 2]| [[from, to.min(enter)], [from.max(leave), to]];
            parts = parts.into_iter().flat_map(around).collect();
            // Where it ends within the hole, no point of it is left there.
            parts.retain(|[from, to]| from < to);
        }
    }
    let [from, to] = segment;
    let at = |share: f64| [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * share);
    parts.into_iter().map(|part| part.map(at)).collect()
}

/// From and to which fraction of its length a segment is inside of all planes.
fn shares_inside([from, to]: [[f64; 3]; 2], planes: &[Plane]) -> Option<[f64; 2]> {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for plane in planes {
        let (a, b) = (height(plane, &from), height(plane, &to));
        let crossing = a / (a - b);
        match (a > 0.0, b > 0.0) {
            (true, true) => return None,
            (true, false) => enter = enter.max(crossing),
            (false, true) => leave = leave.min(crossing),
            (false, false) => {}
        }
    }
    (enter <= leave).then_some([enter, leave])
}

fn height([x, y, z, d]: &Plane, point: &[f64; 3]) -> f64 {
    x * point[0] + y * point[1] + z * point[2] + d
}
