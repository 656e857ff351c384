//! Where cloths and volumes touch each other, themselves and rods.

use std::collections::BTreeMap;

use super::Deformable;
use super::contact::{Contact, Spot, Surface};
use super::mesh::Mesh;
use crate::V3;
use crate::rod::Rod;
use crate::touch::Touch;

/// A node, an edge or a triangle of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Element {
    part: usize,
    /// Nodes, the last ones repeated.
    nodes: [usize; 3],
}

/// A box around an element.
struct Bounds {
    low: V3,
    high: V3,
}

/// The points at which cloths and volumes are nearer than `margin` (metres) to each other or to rods, or come so in a step of `step` seconds. Rods are numbered
/// after the parts; those among themselves are left to [`between`](crate::between). `friction`: of a pair; None if they do not touch.
///
/// Nodes against triangles, and edges against edges. What shares a node does not touch.
pub fn nearby(
    parts: &[Deformable],
    rods: &[Rod],
    margin: f64,
    step: f64,
    friction: impl Fn(usize, usize) -> Option<f64>,
) -> Vec<Contact> {
    let meshes = parts.iter().map(|part| part as &dyn Mesh);
    let search = Search {
        meshes: meshes
            .chain(rods.iter().map(|rod| rod as &dyn Mesh))
            .collect(),
        margin,
        step,
    };
    let mut contacts = Vec::new();
    let count = search.meshes.len();
    let whole: Vec<Bounds> = (0..count).map(|part| search.whole(part)).collect();
    for first in 0..parts.len() {
        for second in first..count {
            let is_near = whole[first].overlaps(&whole[second]);
            if let Some(friction) = friction(first, second).filter(|_| is_near) {
                search.between(first, second, friction, &mut contacts);
            }
        }
    }
    contacts
}

struct Search<'a> {
    /// Parts, and then rods.
    meshes: Vec<&'a dyn Mesh>,
    margin: f64,
    step: f64,
}

impl Search<'_> {
    /// Nodes of each against triangles of the other, and edges against edges.
    fn between(&self, first: usize, second: usize, friction: f64, contacts: &mut Vec<Contact>) {
        let mut add = |a: Element, b: Element| contacts.extend(self.touch(a, b, friction));
        self.pairs(&self.nodes(first), &self.triangles(second), &mut add);
        if first != second {
            self.pairs(&self.nodes(second), &self.triangles(first), &mut add);
        }
        self.pairs(&self.edges(first), &self.edges(second), &mut |a, b| {
            if a < b {
                add(a, b);
            }
        });
    }

    fn nodes(&self, part: usize) -> Vec<Element> {
        self.elements(part, &|mesh| mesh.surface_nodes())
    }

    fn edges(&self, part: usize) -> Vec<Element> {
        self.elements(part, &|mesh| mesh.edges())
    }

    fn triangles(&self, part: usize) -> Vec<Element> {
        self.elements(part, &|mesh| mesh.triangles())
    }

    fn elements(&self, part: usize, of: &dyn Fn(&dyn Mesh) -> Vec<[usize; 3]>) -> Vec<Element> {
        let nodes = of(self.meshes[part]).into_iter();
        let mut all: Vec<Element> = nodes.map(|nodes| Element { part, nodes }).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Where a part is in the step.
    fn whole(&self, part: usize) -> Bounds {
        let nodes = (0..self.meshes[part].len()).map(|node| {
            self.bounds(Element {
                part,
                nodes: [node; 3],
            })
        });
        let joined = |a: Bounds, b: Bounds| Bounds {
            low: a.low.inf(&b.low),
            high: a.high.sup(&b.high),
        };
        // A part has nodes.
        nodes.reduce(joined).unwrap_or(Bounds {
            low: V3::zeros(),
            high: V3::zeros(),
        })
    }

    fn place(&self, element: Element, corner: usize) -> V3 {
        self.meshes[element.part].place(element.nodes[corner])
    }

    fn velocity(&self, element: Element, weights: [f64; 3]) -> V3 {
        let mesh = self.meshes[element.part];
        let parts = element.nodes.iter().zip(weights);
        parts.fold(V3::zeros(), |sum, (node, weight)| {
            sum + mesh.velocity(*node) * weight
        })
    }

    /// Where an element is in the step.
    fn bounds(&self, element: Element) -> Bounds {
        let mesh = self.meshes[element.part];
        let reach = V3::repeat(mesh.radius() + 0.5 * self.margin);
        let [mut low, mut high] = [self.place(element, 0); 2];
        for node in element.nodes {
            let start = mesh.place(node);
            let end = start + mesh.velocity(node) * self.step;
            (low, high) = (low.inf(&start).inf(&end), high.sup(&start).sup(&end));
        }
        Bounds {
            low: low - reach,
            high: high + reach,
        }
    }

    /// Calls a function with all pairs of elements whose boxes overlap and that share no node.
    fn pairs(&self, first: &[Element], second: &[Element], add: &mut impl FnMut(Element, Element)) {
        let of = |elements: &[Element]| -> Vec<Bounds> {
            elements
                .iter()
                .map(|element| self.bounds(*element))
                .collect()
        };
        let (own, others) = (of(first), of(second));
        // Boxes that overlap are in the same cell, or in cells beside each other.
        let size = own
            .iter()
            .chain(&others)
            .map(Bounds::size)
            .fold(0.0, f64::max);
        if size <= 0.0 || !size.is_finite() {
            return;
        }
        let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
        for (number, bounds) in others.iter().enumerate() {
            cells.entry(bounds.cell(size)).or_default().push(number);
        }
        for (element, bounds) in first.iter().zip(&own) {
            let [x, y, z] = bounds.cell(size);
            let around = (0..27).map(|i| [x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1]);
            for number in around.filter_map(|cell| cells.get(&cell)).flatten() {
                let other = second[*number];
                if bounds.overlaps(&others[*number]) && !element.shares_node(&other) {
                    add(*element, other);
                }
            }
        }
    }

    fn touch(&self, first: Element, second: Element, friction: f64) -> Option<Contact> {
        let corners = |element| [0, 1, 2].map(|corner| self.place(element, corner));
        let (on_first, on_second) = if first.nodes[0] == first.nodes[2] {
            (
                [1.0, 0.0, 0.0],
                nearest_on_triangle(&self.place(first, 0), corners(second))?,
            )
        } else {
            nearest_of_edges(corners(first), corners(second))?
        };
        let at = |element, weights: [f64; 3]| {
            let [a, b, c] = corners(element);
            a * weights[0] + b * weights[1] + c * weights[2]
        };
        let place = at(second, on_second);
        let apart = at(first, on_first) - place;
        let distance = apart.norm();
        let [own, other] = [first, second].map(|e| self.meshes[e.part].radius());
        let moved = self.velocity(first, on_first) - self.velocity(second, on_second);
        let reach = own + other + self.margin + moved.norm() * self.step;
        if distance > reach || distance < 1e-9 {
            return None;
        }
        let normal = apart / distance;
        Some(Contact {
            part: first.part,
            spot: first.spot(on_first),
            surface: Surface::Soft(second.part, second.spot(on_second)),
            touch: Touch::new(place + normal * other, normal, friction),
            key: name(first, second),
        })
    }
}

/// Names a pair of elements; other pairs have other names but for a chance that does not matter, since only the friction of a contact goes on under it.
fn name(first: Element, second: Element) -> u64 {
    let [a, b, _] = first.nodes;
    let numbers = [a, b, second.part].into_iter().chain(second.nodes);
    let mixed = numbers.fold(0_u64, |sum, number| {
        (sum ^ number as u64)
            .wrapping_mul(0x9e37_79b9_7f4a_7c15)
            .rotate_left(23)
    });
    mixed | 1 << 63
}

impl Element {
    fn shares_node(&self, other: &Self) -> bool {
        self.part == other.part && self.nodes.iter().any(|node| other.nodes.contains(node))
    }

    fn spot(&self, weights: [f64; 3]) -> Spot {
        [0, 1, 2].map(|corner| (self.nodes[corner], weights[corner]))
    }
}

impl Bounds {
    fn size(&self) -> f64 {
        (self.high - self.low).max()
    }

    fn cell(&self, size: f64) -> [i64; 3] {
        let middle = (self.low + self.high) * (0.5 / size);
        [middle.x, middle.y, middle.z].map(|x| x.floor() as i64)
    }

    fn overlaps(&self, other: &Self) -> bool {
        (0..3).all(|i| self.low[i] <= other.high[i] && other.low[i] <= self.high[i])
    }
}

/// Weights of the corners of the point within a triangle that is nearest to a place; None where that is on an edge, which others find.
fn nearest_on_triangle(place: &V3, [a, b, c]: [V3; 3]) -> Option<[f64; 3]> {
    let (ab, ac, ap) = (b - a, c - a, place - a);
    let normal = ab.cross(&ac);
    let area = normal.norm_squared();
    if area <= 0.0 {
        return None;
    }
    let third = ab.cross(&ap).dot(&normal) / area;
    let second = ap.cross(&ac).dot(&normal) / area;
    let weights = [1.0 - second - third, second, third];
    weights
        .iter()
        .all(|weight| *weight >= 0.0)
        .then_some(weights)
}

/// Weights of the ends where two edges are nearest; None where one of them ends there.
fn nearest_of_edges([a, b, _]: [V3; 3], [c, d, _]: [V3; 3]) -> Option<([f64; 3], [f64; 3])> {
    let (u, v, w) = (b - a, d - c, a - c);
    let (uu, uv, vv, uw, vw) = (u.dot(&u), u.dot(&v), v.dot(&v), u.dot(&w), v.dot(&w));
    let area = uu * vv - uv * uv;
    if area <= 1e-9 * uu * vv {
        return None;
    }
    let s = (uv * vw - vv * uw) / area;
    let t = (uu * vw - uv * uw) / area;
    let is_within = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
    is_within.then_some(([1.0 - s, s, 0.0], [1.0 - t, t, 0.0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_nearest_within_a_triangle() {
        let triangle = [V3::zeros(), V3::x(), V3::y()];
        let weights = nearest_on_triangle(&V3::new(0.25, 0.5, 3.0), triangle).unwrap();
        assert!(
            weights
                .iter()
                .zip([0.25, 0.25, 0.5])
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        assert!(nearest_on_triangle(&V3::new(0.6, 0.6, 0.0), triangle).is_none());
    }

    #[test]
    fn edges_are_nearest_where_they_cross() {
        let first = [V3::zeros(), V3::x(), V3::x()];
        let over = [
            V3::new(0.25, -1.0, 0.1),
            V3::new(0.25, 3.0, 0.1),
            V3::zeros(),
        ];
        let (on_first, on_second) = nearest_of_edges(first, over).unwrap();
        assert!((on_first[1] - 0.25).abs() < 1e-12 && (on_second[1] - 0.25).abs() < 1e-12);
        let beside = [V3::new(1.5, -1.0, 0.1), V3::new(1.5, 3.0, 0.1), V3::zeros()];
        assert!(nearest_of_edges(first, beside).is_none());
    }
}
