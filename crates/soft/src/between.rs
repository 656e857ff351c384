//! Where rods touch each other and themselves.

use std::collections::BTreeMap;

use crate::V3;
use crate::contact::{Contact, Surface};
use crate::rod::Rod;
use crate::touch::Touch;

/// Edges of a rod nearer than this along it, in diameters, do not touch each other.
const APART: f64 = 2.0;

/// An edge of a rod.
type Edge = (usize, usize);

/// The points at which edges of rods are or come nearer than `margin` (metres) to each other. `friction`: of a pair of rods; None if they do not touch.
pub fn between(
    rods: &[Rod],
    margin: f64,
    friction: impl Fn(usize, usize) -> Option<f64>,
) -> Vec<Contact> {
    let mut contacts = Vec::new();
    let size = rods
        .iter()
        .map(|rod| reach(rod, margin))
        .fold(0.0, f64::max);
    if size <= 0.0 {
        return contacts;
    }
    let mut cells: BTreeMap<[i64; 3], Vec<Edge>> = BTreeMap::new();
    for (place, rod) in rods.iter().enumerate() {
        for edge in 0..rod.len() - 1 {
            cells
                .entry(cell(&middle(rod, edge), size))
                .or_default()
                .push((place, edge));
        }
    }
    for (cell, edges) in &cells {
        for other in neighbours(*cell).filter_map(|other| cells.get(&other)) {
            for (&first, &second) in edges.iter().flat_map(|a| other.iter().map(move |b| (a, b))) {
                if first < second
                    && let Some(friction) = friction(first.0, second.0)
                {
                    contacts.extend(touch(rods, first, second, margin, friction));
                }
            }
        }
    }
    contacts
}

/// Farthest that the middles of two edges that touch are apart.
fn reach(rod: &Rod, margin: f64) -> f64 {
    let longest = rod.shape.lengths.iter().copied().fold(0.0, f64::max);
    longest + 2.0 * rod.material.radius + margin
}

fn middle(rod: &Rod, edge: usize) -> V3 {
    (rod.point(edge) + rod.point(edge + 1)) * 0.5
}

fn cell(place: &V3, size: f64) -> [i64; 3] {
    [place.x, place.y, place.z].map(|x| (x / size).floor() as i64)
}

fn neighbours([x, y, z]: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    (0..27).map(move |i| [x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1])
}

fn touch(rods: &[Rod], first: Edge, second: Edge, margin: f64, friction: f64) -> Option<Contact> {
    let [a, b] = [first, second].map(|(rod, _)| &rods[rod]);
    if first.0 == second.0 && is_near_along(a, first.1, second.1) {
        return None;
    }
    let segment = |(rod, edge): Edge| [rods[rod].point(edge), rods[rod].point(edge + 1)];
    let (s, t) = nearest(segment(first), segment(second));
    let on = |[start, end]: [V3; 2], weight: f64| start * (1.0 - weight) + end * weight;
    let (on_first, on_second) = (on(segment(first), s), on(segment(second), t));
    let apart = on_first - on_second;
    let distance = apart.norm();
    let radii = a.material.radius + b.material.radius;
    if distance > radii + margin || distance < 1e-9 {
        return None;
    }
    let normal = apart / distance;
    Some(Contact {
        rod: first.0,
        edge: first.1,
        weight: s,
        surface: Surface::Rod(second.0, second.1, t),
        touch: Touch::new(on_second + normal * b.material.radius, normal, friction),
        key: 1 << 63 | (second.0 as u64) << 20 | second.1 as u64,
    })
}

fn is_near_along(rod: &Rod, first: usize, second: usize) -> bool {
    let (low, high) = (first.min(second), first.max(second));
    let between: f64 = rod.rest_lengths[(low + 1).min(high)..high].iter().sum();
    high - low <= 1 || between < APART * 2.0 * rod.material.radius
}

/// Where two segments are nearest, on each of them (0 to 1).
fn nearest([a0, a1]: [V3; 2], [b0, b1]: [V3; 2]) -> (f64, f64) {
    let (u, v, w) = (a1 - a0, b1 - b0, a0 - b0);
    let (uu, uv, vv, uw, vw) = (u.dot(&u), u.dot(&v), v.dot(&v), u.dot(&w), v.dot(&w));
    let area = uu * vv - uv * uv;
    let s = if area > 1e-12 * uu * vv {
        ((uv * vw - vv * uw) / area).clamp(0.0, 1.0)
    } else {
        0.5
    };
    let t = ((uv * s + vw) / vv).clamp(0.0, 1.0);
    let s = ((uv * t - uw) / uu).clamp(0.0, 1.0);
    (s, t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_are_nearest_where_they_cross_or_end() {
        let across = nearest(
            [V3::zeros(), V3::x()],
            [V3::new(0.25, -1.0, 0.1), V3::new(0.25, 1.0, 0.1)],
        );
        assert!((across.0 - 0.25).abs() < 1e-12 && (across.1 - 0.5).abs() < 1e-12);
        let beyond = nearest(
            [V3::zeros(), V3::x()],
            [V3::new(2.0, 0.0, 0.0), V3::new(3.0, 1.0, 0.0)],
        );
        assert_eq!(beyond, (1.0, 0.0));
    }
}
