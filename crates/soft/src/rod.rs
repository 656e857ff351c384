//! A rod: its nodes, what it is at rest, and how it moves.

use nalgebra::{Vector2, Vector4};

use crate::V3;
use crate::elastic::{Shape, elastic_potential, strains};
use crate::frames::{across, transport};
use crate::material::Material;

/// The unknowns of a node: its place, and the angle by which the edge after it is turned about its tangent.
pub(crate) type Node = Vector4<f64>;

/// Where a node is held.
#[derive(Debug, Clone, PartialEq)]
pub struct Hold {
    /// The node.
    pub node: usize,
    /// What holds it.
    pub target: Target,
    /// Where the material direction of the edge at the node points at the end of the step, so that the rod does not turn about its axis there; None: it may.
    pub direction: Option<V3>,
    /// Out: the force on the node, newtons.
    pub force: V3,
    /// Out: the torque on the edge about its axis, N m.
    pub torque: V3,
}

impl Hold {
    /// A node that is held where `target` says.
    pub fn new(node: usize, target: Target, direction: Option<V3>) -> Self {
        Self {
            node,
            target,
            direction,
            force: V3::zeros(),
            torque: V3::zeros(),
        }
    }
}

/// What holds a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// A place at the end of the step.
    Place(V3),
    /// A rigid body, by its index, at so much from its centre of mass at the beginning of the step (world axes).
    Body(usize, V3),
}

/// A rope or cable.
#[derive(Debug, Clone)]
pub struct Rod {
    /// What it is made of.
    pub material: Material,
    /// Where nodes are held.
    pub holds: Vec<Hold>,
    /// Kilograms, and for the last unknown kg m2.
    pub(crate) masses: Vec<Node>,
    pub(crate) now: Motion,
    pub(crate) before: Motion,
    /// Length of the step that led from `before` to `now`; 0: none did.
    pub(crate) last_step: f64,
    /// Lengths of the edges at rest.
    pub(crate) rest_lengths: Vec<f64>,
    pub(crate) rest_curvatures: Vec<Vector2<f64>>,
    pub(crate) rest_twists: Vec<f64>,
    /// A direction across each edge, carried along in time.
    pub(crate) directions: Vec<V3>,
    /// The form of the last step.
    pub(crate) shape: Shape,
    pub(crate) tensions: Vec<f64>,
    pub(crate) broken: Vec<bool>,
    /// Whether that step looked back at the one before it.
    pub(crate) looked_back: bool,
    /// Number of steps in which nothing was near.
    pub(crate) calm_steps: u32,
}

/// Places and velocities of nodes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Motion {
    pub places: Vec<Node>,
    pub velocities: Vec<Node>,
}

impl Rod {
    /// A rod at rest through points, of a total length at rest of `length` (None: that of the points). `is_straight`: it is straight at rest, otherwise as the
    /// points say. None with fewer than two points, or where neighbours coincide.
    pub fn new(
        points: &[V3],
        length: Option<f64>,
        is_straight: bool,
        material: Material,
    ) -> Option<Self> {
        let lengths: Vec<f64> = points
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).norm())
            .collect();
        let total: f64 = lengths.iter().sum();
        let is_usable = |length: &f64| length.is_finite() && *length > total * 1e-9;
        if lengths.is_empty() || !lengths.iter().all(is_usable) {
            return None;
        }
        let factor = length.map_or(1.0, |length| length / total);
        if !(factor.is_finite() && factor > 0.0) {
            return None;
        }
        let rest_lengths: Vec<f64> = lengths.iter().map(|length| length * factor).collect();
        let places: Vec<Node> = points.iter().map(|point| point.push(0.0)).collect();
        let now = Motion {
            velocities: vec![Node::zeros(); places.len()],
            places,
        };
        let mut rod = Self {
            masses: masses(&rest_lengths, &material),
            before: now.clone(),
            last_step: 0.0,
            rest_curvatures: vec![Vector2::zeros(); points.len()],
            rest_twists: vec![0.0; points.len()],
            directions: directions(points),
            shape: Shape::default(),
            tensions: vec![0.0; rest_lengths.len()],
            broken: vec![false; rest_lengths.len()],
            looked_back: false,
            calm_steps: 0,
            holds: Vec::new(),
            material,
            rest_lengths,
            now,
        };
        rod.find_shape();
        if !is_straight {
            rod.rest_curvatures.clone_from(&rod.shape.curvatures);
        }
        Some(rod)
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.now.places.len()
    }

    /// Whether there are no nodes; there are at least two.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Places of the nodes.
    pub fn points(&self) -> impl ExactSizeIterator<Item = V3> + '_ {
        self.now.places.iter().map(|node| node.xyz())
    }

    /// Place of a node.
    pub fn point(&self, node: usize) -> V3 {
        self.now.places[node].xyz()
    }

    /// Velocity of a node.
    pub fn velocity(&self, node: usize) -> V3 {
        self.now.velocities[node].xyz()
    }

    /// Puts the nodes elsewhere, with new velocities; extra points are ignored. Frames are carried there.
    pub fn set_motion(&mut self, points: &[V3], velocities: &[V3]) {
        for (node, point) in self.now.places.iter_mut().zip(points) {
            node.fixed_rows_mut::<3>(0).copy_from(point);
        }
        for (node, velocity) in self.now.velocities.iter_mut().zip(velocities) {
            node.fixed_rows_mut::<3>(0).copy_from(velocity);
        }
        self.forget_history();
        self.find_shape();
    }

    /// The next step does not look back: something has changed at once.
    pub fn forget_history(&mut self) {
        (self.looked_back, self.calm_steps) = (false, 0);
    }

    /// Mass of a node, kilograms.
    pub fn mass(&self, node: usize) -> f64 {
        self.masses[node].x
    }

    /// Tensions of the edges, newtons; negative where they are pressed.
    pub fn tensions(&self) -> &[f64] {
        &self.tensions
    }

    /// Whether an edge is broken.
    pub fn is_broken(&self, edge: usize) -> bool {
        self.broken[edge]
    }

    /// Breaks an edge.
    pub fn break_edge(&mut self, edge: usize) {
        if let Some(broken) = self.broken.get_mut(edge) {
            *broken = true;
            self.tensions[edge] = 0.0;
            self.forget_history();
        }
    }

    /// Breaks the edge with the largest tension, if that is more than it bears: what was stretched with it has to find out first.
    pub(crate) fn break_weakest(&mut self) {
        let loaded = self.tensions.iter().copied().enumerate();
        let most = loaded.max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((edge, tension)) = most
            && tension > self.material.strength
        {
            self.break_edge(edge);
        }
    }

    /// The material direction across an edge, which turns with the rod.
    pub fn direction(&self, edge: usize) -> V3 {
        self.shape.materials[edge][0]
    }

    /// Sum of kinetic and elastic energy, joules.
    pub fn energy(&self) -> f64 {
        let squares = self.now.velocities.iter().zip(&self.masses);
        let kinetic: f64 = squares.map(|(v, m)| v.component_mul(v).dot(m)).sum();
        0.5 * kinetic + elastic_potential(self, &self.shape, 0.0)
    }

    /// Mass, and moment of inertia about an end.
    pub(crate) fn scale(&self) -> [f64; 2] {
        let length: f64 = self.rest_lengths.iter().sum();
        let mass = length * self.material.line_density;
        [mass, mass * length * length]
    }

    /// Stiffnesses of a vertex against its two curvatures and its twist, N m; None where an edge is broken.
    pub(crate) fn vertex_stiffness(&self, vertex: usize) -> Option<[f64; 3]> {
        let length = self.free_length(vertex)?;
        let bend = self.material.bend / length;
        Some([bend, bend, self.material.twist / length])
    }

    /// Length that bends and twists at a vertex; None where an edge is broken. An edge whose two nodes are held does not bend.
    fn free_length(&self, vertex: usize) -> Option<f64> {
        if self.broken[vertex - 1] || self.broken[vertex] {
            return None;
        }
        let [before, after] = [vertex - 1, vertex].map(|edge| self.is_clamped(edge));
        let part = |is_clamped: bool, edge: usize| {
            if is_clamped && before != after {
                0.0
            } else {
                0.5 * self.rest_lengths[edge]
            }
        };
        Some(part(before, vertex - 1) + part(after, vertex))
    }

    fn is_clamped(&self, edge: usize) -> bool {
        let is_held = |node: usize| self.holds.iter().any(|hold| hold.node == node);
        is_held(edge) && is_held(edge + 1)
    }

    /// Takes the present form over as the one that the next step starts from.
    pub(crate) fn find_shape(&mut self) {
        let before = std::mem::take(&mut self.shape);
        let start = if before.tangents.is_empty() {
            let tangents = tangents(&self.now.places);
            Shape {
                tangents,
                twists: vec![0.0; self.len()],
                reference_twists: vec![0.0; self.len()],
                ..before
            }
        } else {
            before
        };
        self.shape = strains(&self.now.places, &start, &self.directions);
        let carried = self
            .directions
            .iter()
            .zip(start.tangents.iter().zip(&self.shape.tangents));
        self.directions = carried
            .map(|(direction, (from, to))| {
                let across = transport(direction, from, to);
                (across - to * to.dot(&across)).normalize()
            })
            .collect();
    }
}

fn tangents(places: &[Node]) -> Vec<V3> {
    places
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).xyz().normalize())
        .collect()
}

/// Directions across the edges that do not turn from edge to edge.
fn directions(points: &[V3]) -> Vec<V3> {
    let mut directions: Vec<V3> = Vec::new();
    let mut last: Option<V3> = None;
    for pair in points.windows(2) {
        let tangent = (pair[1] - pair[0]).normalize();
        let direction = match (last, directions.last()) {
            (Some(from), Some(direction)) => transport(direction, &from, &tangent),
            _ => across(&tangent),
        };
        directions.push(direction);
        last = Some(tangent);
    }
    directions
}

/// Half of the edges beside it for each node; the angle has the moment of inertia of its edge.
fn masses(lengths: &[f64], material: &Material) -> Vec<Node> {
    let of_edge = |edge: Option<usize>| {
        let length = edge.and_then(|edge| lengths.get(edge));
        length.map_or(0.0, |length| length * material.line_density)
    };
    let node = |node: usize| {
        let mass = 0.5 * (of_edge(node.checked_sub(1)) + of_edge(Some(node)));
        // The last angle belongs to no edge.
        let turning = of_edge(Some(node)).max(mass) * 0.5 * material.radius * material.radius;
        Node::new(mass, mass, mass, turning)
    };
    (0..=lengths.len()).map(node).collect()
}
