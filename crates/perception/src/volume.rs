//! The volume of a proximity sensor, prepared for searches.

use std::cell::OnceCell;

use proximity::{Bounds, Filter, Hit, Placed, closest_in_volume};

use scene::Pose;
use scene::sensor::volume::Volume;
use scene::sensor::volume_planes::{ConvexPiece, Plane};

/// This near to a hole (m), a point is outside of it.
const TOUCHING: f64 = 1e-12;

/// A volume as the searches of the crate `proximity` need it.
#[derive(Debug)]
pub(super) struct SearchVolume {
    pub(super) source: Volume,
    pieces: Vec<ConvexPiece>,
    /// The volume with its holes filled.
    filled: proximity::Volume,
    /// The volume as pieces without holes, which are many: only made where the nearest point is in a hole.
    hollow: OnceCell<proximity::Volume>,
    /// In the frame of the sensor.
    pub(super) bounds: Bounds,
}

impl SearchVolume {
    pub(super) fn new(source: &Volume) -> Self {
        let pieces = source.pieces();
        let filled = proximity::Volume {
            pieces: pieces.iter().map(|piece| piece.planes.clone()).collect(),
        };
        let [min, max] = source.extent();
        Self {
            source: source.clone(),
            pieces,
            filled,
            hollow: OnceCell::new(),
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
        let hit = closest_in_volume(on, sensor, &self.filled, below, filter)?;
        if !self.is_in_hole(&hit.point) {
            return Some(hit);
        }
        closest_in_volume(on, sensor, self.hollow(), below, filter)
    }

    /// The parts of a segment (m, in the frame of the sensor) that are inside.
    pub(super) fn parts_of_segment(&self, segment: &[[f64; 3]; 2]) -> Vec<[[f64; 3]; 2]> {
        self.hollow()
            .pieces
            .iter()
            .filter_map(|planes| clipped(*segment, planes))
            .collect()
    }

    fn hollow(&self) -> &proximity::Volume {
        self.hollow.get_or_init(|| proximity::Volume {
            pieces: self.pieces.iter().flat_map(without_holes).collect(),
        })
    }

    /// Whether a point of the filled volume is in holes of all pieces around it.
    fn is_in_hole(&self, point: &[f64; 3]) -> bool {
        let inside = |planes: &[Plane], margin: f64| {
            planes.iter().all(|plane| height(plane, point) < margin)
        };
        let mut around = self
            .pieces
            .iter()
            .filter(|piece| inside(&piece.planes, TOUCHING))
            .peekable();
        around.peek().is_some()
            && around.all(|piece| piece.holes.iter().any(|hole| inside(hole, -TOUCHING)))
    }
}

fn height([x, y, z, d]: &Plane, point: &[f64; 3]) -> f64 {
    x * point[0] + y * point[1] + z * point[2] + d
}

/// The part of a segment that is inside of all planes.
fn clipped([from, to]: [[f64; 3]; 2], planes: &[Plane]) -> Option<[[f64; 3]; 2]> {
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
    let at = |share: f64| [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * share);
    let is_finite = from.iter().chain(&to).all(|c| c.is_finite());
    (is_finite && enter <= leave).then(|| [at(enter), at(leave)])
}

/// Pieces whose union is a piece without its holes: one behind each plane of a hole.
fn without_holes(piece: &ConvexPiece) -> Vec<Vec<Plane>> {
    let behind = |[x, y, z, d]: &Plane| [-x, -y, -z, -d];
    piece
        .holes
        .iter()
        .fold(vec![piece.planes.clone()], |pieces, hole| {
            let cut = |planes: &Vec<Plane>| {
                let planes = planes.clone();
                hole.iter().map(move |side| {
                    std::iter::once(behind(side))
                        .chain(planes.iter().copied())
                        .collect()
                })
            };
            pieces.iter().flat_map(cut).collect()
        })
}
