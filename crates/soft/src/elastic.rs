//! Strains of a rod and the forces that they cause.

use nalgebra::Vector2;

use crate::V3;
use crate::assembly::Equations;
use crate::frames::{angle_about, transport, unwrap};
use crate::rod::{Node, Rod};

/// The form of a rod, and its strains.
#[derive(Debug, Clone, Default)]
pub(crate) struct Shape {
    /// By edge.
    pub tangents: Vec<V3>,
    pub lengths: Vec<f64>,
    /// Two material directions across each edge.
    pub materials: Vec<[V3; 2]>,
    /// By node: integrated curvature about the material directions; 0 at the ends.
    pub curvatures: Vec<Vector2<f64>>,
    pub twists: Vec<f64>,
    /// Angle between the reference directions of neighbours.
    pub reference_twists: Vec<f64>,
}

/// Shortest length of an edge that has a direction, metres.
const LEAST_LENGTH: f64 = 1e-12;
/// Part of the inertia of a node that the geometric stiffness of a compressed edge takes away at most.
const PART_OF_INERTIA: f64 = 0.2;
/// Bends sharper than this count as this sharp: 1 plus the cosine of the angle.
const SHARPEST: f64 = 1e-4;

/// The form with the nodes at `places`; `start` and `directions`: what reference directions are carried from.
pub(crate) fn strains(places: &[Node], start: &Shape, directions: &[V3]) -> Shape {
    let mut shape = Shape::default();
    let mut carried: Option<(V3, V3)> = None;
    shape.curvatures.push(Vector2::zeros());
    shape.twists.push(0.0);
    shape.reference_twists.push(0.0);
    for (edge, pair) in places.windows(2).enumerate() {
        let along = (pair[1] - pair[0]).xyz();
        let length = along.norm();
        let tangent = if length > LEAST_LENGTH {
            along / length
        } else {
            start.tangents[edge]
        };
        let direction = transport(&directions[edge], &start.tangents[edge], &tangent);
        if let Some((last_tangent, last_direction)) = carried {
            let expected = transport(&last_direction, &last_tangent, &tangent);
            let angle = angle_about(&tangent, &expected, &direction);
            let reference = unwrap(angle, start.reference_twists[edge]);
            shape.reference_twists.push(reference);
            shape
                .twists
                .push(pair[0].w - places[edge - 1].w + reference);
        }
        let (sine, cosine) = libm::sincos(pair[0].w);
        let other = tangent.cross(&direction);
        shape.materials.push([
            direction * cosine + other * sine,
            other * cosine - direction * sine,
        ]);
        shape.tangents.push(tangent);
        shape.lengths.push(length.max(LEAST_LENGTH));
        if edge > 0 {
            let bend = Bend::new(&shape, edge);
            shape.curvatures.push(bend.curvature);
        }
        carried = Some((tangent, direction));
    }
    shape.curvatures.push(Vector2::zeros());
    shape.twists.push(0.0);
    shape.reference_twists.push(0.0);
    shape
}

/// A vertex between two edges, and the derivatives of its strains.
struct Bend {
    curvature: Vector2<f64>,
    binormal: V3,
    sharpness: f64,
    edges: [usize; 2],
}

impl Bend {
    fn new(shape: &Shape, vertex: usize) -> Self {
        let edges = [vertex - 1, vertex];
        let [e, f] = edges.map(|edge| shape.tangents[edge]);
        let sharpness = (1.0 + e.dot(&f)).max(SHARPEST);
        let binormal = e.cross(&f) * (2.0 / sharpness);
        let sum = |side: usize| shape.materials[vertex - 1][side] + shape.materials[vertex][side];
        let curvature = Vector2::new(0.5 * binormal.dot(&sum(1)), -0.5 * binormal.dot(&sum(0)));
        Self {
            curvature,
            binormal,
            sharpness,
            edges,
        }
    }

    /// How the two curvatures and the twist depend on the unknowns of three nodes.
    fn gradients(&self, shape: &Shape) -> [[f64; 11]; 3] {
        let [e, f] = self.edges.map(|edge| shape.tangents[edge]);
        let [long_e, long_f] = self.edges.map(|edge| shape.lengths[edge]);
        let middle = (e + f) / self.sharpness;
        let side = |side: usize| {
            let sum = shape.materials[self.edges[0]][side] + shape.materials[self.edges[1]][side];
            sum / self.sharpness
        };
        let turn = |edge: usize, side: usize| {
            -0.5 * self.binormal.dot(&shape.materials[self.edges[edge]][side])
        };
        let [first, second] = [side(0), side(1)];
        let (k1, k2) = (self.curvature.x, self.curvature.y);
        [
            gradient(
                (f.cross(&second) - middle * k1) / long_e,
                (-e.cross(&second) - middle * k1) / long_f,
                [turn(0, 0), turn(1, 0)],
            ),
            gradient(
                (-f.cross(&first) - middle * k2) / long_e,
                (e.cross(&first) - middle * k2) / long_f,
                [turn(0, 1), turn(1, 1)],
            ),
            gradient(
                self.binormal * (0.5 / long_e),
                self.binormal * (0.5 / long_f),
                [-1.0, 1.0],
            ),
        ]
    }
}

/// Of a quantity that depends on two edges and their angles.
fn gradient(by_first: V3, by_second: V3, by_angles: [f64; 2]) -> [f64; 11] {
    let middle = by_first - by_second;
    let [a, b] = by_angles;
    [
        -by_first.x,
        -by_first.y,
        -by_first.z,
        a,
        middle.x,
        middle.y,
        middle.z,
        b,
        by_second.x,
        by_second.y,
        by_second.z,
    ]
}

/// What the elastic forces of a step depend on.
pub(crate) struct Elastic<'a> {
    pub shape: &'a Shape,
    /// Ratio of the viscous stiffness in this step to the elastic one.
    pub viscous: f64,
    /// The form is a guess, so that the geometric stiffness is that of the last step's tension.
    pub is_guess: bool,
    /// What a mass is multiplied with for its resistance to displacements.
    pub inverse_square: f64,
}

impl Elastic<'_> {
    /// Adds the elastic and viscous forces of a rod.
    pub(crate) fn add_forces(&self, rod: &Rod, equations: &mut Equations) {
        for edge in (0..rod.rest_lengths.len()).filter(|&edge| !rod.broken[edge]) {
            self.add_stretch(rod, edge, equations);
        }
        for vertex in 1..rod.len() - 1 {
            let Some(stiffnesses) = rod.vertex_stiffness(vertex) else {
                continue;
            };
            let excess = excess(rod, self.shape, vertex);
            let rates = rates(rod, self.shape, vertex);
            let gradients = Bend::new(self.shape, vertex).gradients(self.shape);
            for (quantity, stiffness) in stiffnesses.into_iter().enumerate() {
                let force = stiffness * (excess[quantity] + self.viscous * rates[quantity]);
                equations.add_spring(
                    4 * (vertex - 1),
                    &gradients[quantity],
                    force,
                    stiffness * (1.0 + self.viscous),
                );
            }
        }
    }

    fn add_stretch(&self, rod: &Rod, edge: usize, equations: &mut Equations) {
        let stiffness = rod.material.stretch / rod.rest_lengths[edge];
        let (length, tangent) = (self.shape.lengths[edge], self.shape.tangents[edge]);
        let elastic = stiffness * (length - rod.rest_lengths[edge]);
        let rate = length - rod.shape.lengths[edge];
        let tension = elastic + stiffness * self.viscous * rate;
        let known = if self.is_guess {
            rod.tensions[edge]
        } else {
            tension
        };
        // Compression takes stiffness away, at most what inertia has.
        let lightest = rod.mass(edge).min(rod.mass(edge + 1));
        let across = (known / length).max(-PART_OF_INERTIA * lightest * self.inverse_square);
        let along = stiffness * (1.0 + self.viscous) - across;
        let gradient = [
            -tangent.x, -tangent.y, -tangent.z, 0.0, tangent.x, tangent.y, tangent.z,
        ];
        equations.add_spring(4 * edge, &gradient, tension, along);
        for axis in 0..3 {
            let (first, second) = (4 * edge + axis, 4 * edge + 4 + axis);
            equations.matrix.add(first, first, across);
            equations.matrix.add(second, second, across);
            equations.matrix.add(second, first, -across);
        }
    }
}

/// Elastic energy of a rod in a form, joules, and the potential of its viscous forces.
pub(crate) fn elastic_potential(rod: &Rod, shape: &Shape, viscous: f64) -> f64 {
    let mut sum = 0.0;
    for edge in (0..rod.rest_lengths.len()).filter(|&edge| !rod.broken[edge]) {
        let rest = rod.rest_lengths[edge];
        let stiffness = rod.material.stretch / rest;
        let (stretched, rate) = (
            shape.lengths[edge] - rest,
            shape.lengths[edge] - rod.shape.lengths[edge],
        );
        sum += 0.5 * stiffness * (stretched * stretched + viscous * rate * rate);
    }
    for vertex in 1..rod.len() - 1 {
        let stiffnesses = rod.vertex_stiffness(vertex).unwrap_or([0.0; 3]);
        let (excess, rates) = (excess(rod, shape, vertex), rates(rod, shape, vertex));
        for (quantity, stiffness) in stiffnesses.into_iter().enumerate() {
            let (strain, rate) = (excess[quantity], rates[quantity]);
            sum += 0.5 * stiffness * (strain * strain + viscous * rate * rate);
        }
    }
    sum
}

/// The curvatures and the twist of a vertex.
fn bent(shape: &Shape, vertex: usize) -> [f64; 3] {
    let curvature = shape.curvatures[vertex];
    [curvature.x, curvature.y, shape.twists[vertex]]
}

/// By how much a vertex is bent and twisted more than at rest.
fn excess(rod: &Rod, shape: &Shape, vertex: usize) -> [f64; 3] {
    let (now, rest) = (bent(shape, vertex), rod.rest_curvatures[vertex]);
    let rest = [rest.x, rest.y, rod.rest_twists[vertex]];
    std::array::from_fn(|i| now[i] - rest[i])
}

/// By how much it is bent and twisted more than at the beginning of the step.
fn rates(rod: &Rod, shape: &Shape, vertex: usize) -> [f64; 3] {
    let (now, before) = (bent(shape, vertex), bent(&rod.shape, vertex));
    std::array::from_fn(|i| now[i] - before[i])
}
