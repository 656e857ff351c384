//! What ropes, cloths and volumes have in common in the physics.

use scene::shape::soft::body::Body;
use scene::shape::soft::rope::Rope;
use scene::shape::soft::{Soft, SoftForm};
use soft::fem::{self, Deformable};
use soft::{Contact, Hold, Material, Rod, Surface, V3};

use super::obstacle::{Near, Obstacle, Search};
use super::touches;

/// Something soft that the solver moves.
pub(super) trait Part: Sized {
    /// A point at which it touches something.
    type Contact: Clone;
    /// How it moves.
    type State;
    /// Through points of the world; None if it is something else.
    fn new(soft: &Soft, points: &[V3]) -> Option<Self>;
    fn len(&self) -> usize;
    fn point(&self, node: usize) -> V3;
    fn velocity(&self, node: usize) -> V3;
    /// Distance from its surface at which it touches something, metres.
    fn radius(&self) -> f64;
    /// Nodes that share an element with one.
    fn neighbours(&self, node: usize) -> Vec<usize>;
    /// The node at the other end of the edge that is held with a node, the node at which that edge begins, and a direction that turns with it.
    fn clamp(&self, node: usize) -> Option<(usize, usize, V3)>;
    fn holds(&mut self) -> &mut Vec<Hold>;
    fn held(&self) -> &[Hold];
    fn state(&self) -> Self::State;
    fn set_state(&mut self, state: Self::State);
    /// Puts the nodes elsewhere, at rest.
    fn set_places(&mut self, points: &[V3]);
    fn break_element(&mut self, element: usize);
    /// Something has changed at once.
    fn forget_history(&mut self);
    fn tensions(&self) -> Vec<f64>;
    /// Of the gas within, above that of the air outside, Pa.
    fn pressure(&self) -> f64;
    fn is_broken(&self, element: usize) -> bool;

    /// Puts it where a script has put it.
    fn put(&mut self, form: &SoftForm) {
        let points: Vec<V3> = form.points.iter().map(|point| V3::from(*point)).collect();
        let has_moved = (0..self.len()).any(|node| points.get(node) != Some(&self.point(node)));
        if has_moved {
            self.set_places(&points);
        }
        for (element, is_broken) in form.broken.iter().enumerate() {
            if *is_broken && !self.is_broken(element) {
                self.break_element(element);
            }
        }
    }

    /// The points at which it may touch an obstacle, with the nearest point for each node that is near.
    fn touches(
        &self,
        search: &Search,
        obstacle: &Obstacle,
        nodes: Vec<Option<Near>>,
    ) -> Vec<Self::Contact>;
    /// A contact is with a body that forces move.
    fn is_with(contact: &mut Self::Contact, body: usize);

    /// Largest speed of its nodes, m/s.
    fn fastest(&self) -> f64 {
        let speeds = (0..self.len()).map(|node| self.velocity(node).norm());
        speeds.fold(0.0, f64::max)
    }
}

impl Part for Rod {
    type Contact = Contact;
    type State = Self;

    fn touches(
        &self,
        search: &Search,
        obstacle: &Obstacle,
        nodes: Vec<Option<Near>>,
    ) -> Vec<Contact> {
        touches::of_rod(self, search, obstacle, nodes)
    }

    fn is_with(contact: &mut Contact, body: usize) {
        contact.surface = Surface::Body(body);
    }

    fn new(soft: &Soft, points: &[V3]) -> Option<Self> {
        let Soft::Rope(rope) = soft else {
            return None;
        };
        let length = (rope.length > 0.0).then_some(rope.length);
        Self::new(points, length, rope.straight, material_of(rope))
    }

    fn len(&self) -> usize {
        self.len()
    }

    fn point(&self, node: usize) -> V3 {
        self.point(node)
    }

    fn velocity(&self, node: usize) -> V3 {
        self.velocity(node)
    }

    fn radius(&self) -> f64 {
        self.material.radius
    }

    fn neighbours(&self, node: usize) -> Vec<usize> {
        let last = self.len() - 1;
        (node.saturating_sub(1)..=(node + 1).min(last)).collect()
    }

    fn clamp(&self, node: usize) -> Option<(usize, usize, V3)> {
        let last = self.len() - 1;
        let edge = node.min(last - 1);
        let other = if node == last { last - 1 } else { edge + 1 };
        Some((other, edge, self.direction(edge)))
    }

    fn holds(&mut self) -> &mut Vec<Hold> {
        &mut self.holds
    }

    fn held(&self) -> &[Hold] {
        &self.holds
    }

    fn state(&self) -> Self {
        self.clone()
    }

    fn set_state(&mut self, state: Self) {
        *self = state;
    }

    fn set_places(&mut self, points: &[V3]) {
        self.set_motion(points, &vec![V3::zeros(); points.len()]);
    }

    fn break_element(&mut self, element: usize) {
        self.break_edge(element);
    }

    fn forget_history(&mut self) {
        self.forget_history();
    }

    fn tensions(&self) -> Vec<f64> {
        self.tensions().to_vec()
    }

    fn pressure(&self) -> f64 {
        0.0
    }

    fn is_broken(&self, element: usize) -> bool {
        self.is_broken(element)
    }
}

fn material_of(rope: &Rope) -> Material {
    Material {
        radius: rope.radius,
        line_density: rope.line_density,
        stretch: rope.stretch,
        bend: rope.bend,
        twist: rope.twist,
        damping: rope.damping,
        drag: rope.drag,
        strength: rope.strength,
    }
}

impl Part for Deformable {
    type Contact = fem::Contact;
    /// Places and velocities. What was torn stays so.
    type State = [Vec<V3>; 2];

    fn touches(
        &self,
        search: &Search,
        obstacle: &Obstacle,
        nodes: Vec<Option<Near>>,
    ) -> Vec<fem::Contact> {
        touches::of_deformable(self, search, obstacle, nodes)
    }

    fn is_with(contact: &mut fem::Contact, body: usize) {
        contact.surface = fem::Surface::Body(body);
    }

    fn new(soft: &Soft, points: &[V3]) -> Option<Self> {
        let Soft::Body(body) = soft else {
            return None;
        };
        // At rest it is as it began, wherever it is now.
        let rest: Vec<V3> = body.points.iter().map(|point| V3::from(*point)).collect();
        let triangles: Vec<_> = body
            .triangles
            .iter()
            .map(|nodes| nodes.map(index))
            .collect();
        let mut part = if body.is_volume() {
            let tetrahedra: Vec<_> = body
                .tetrahedra
                .iter()
                .map(|nodes| nodes.map(index))
                .collect();
            Self::volume(
                &rest,
                &tetrahedra,
                &triangles,
                body.density,
                elasticity_of(body),
            )?
        } else {
            Self::cloth(
                &rest,
                &triangles,
                body.flat,
                body.density,
                elasticity_of(body),
            )?
        };
        if let Some(pressure) = body.pressure {
            part.fill(pressure);
        }
        part.set_places(points);
        Some(part)
    }

    fn len(&self) -> usize {
        self.len()
    }

    fn point(&self, node: usize) -> V3 {
        self.points()[node]
    }

    fn velocity(&self, node: usize) -> V3 {
        self.velocities()[node]
    }

    fn radius(&self) -> f64 {
        self.material().radius
    }

    fn neighbours(&self, node: usize) -> Vec<usize> {
        self.neighbours(node).to_vec()
    }

    fn clamp(&self, _: usize) -> Option<(usize, usize, V3)> {
        None
    }

    fn holds(&mut self) -> &mut Vec<Hold> {
        &mut self.holds
    }

    fn held(&self) -> &[Hold] {
        &self.holds
    }

    fn state(&self) -> [Vec<V3>; 2] {
        [self.points(), self.velocities()].map(<[V3]>::to_vec)
    }

    fn set_state(&mut self, [places, velocities]: [Vec<V3>; 2]) {
        self.set_motion(&places, &velocities);
    }

    fn set_places(&mut self, points: &[V3]) {
        self.set_motion(points, &vec![V3::zeros(); points.len()]);
    }

    fn break_element(&mut self, element: usize) {
        self.tear(element);
    }

    fn forget_history(&mut self) {}

    fn tensions(&self) -> Vec<f64> {
        self.tensions()
    }

    fn pressure(&self) -> f64 {
        self.pressure()
    }

    fn is_broken(&self, element: usize) -> bool {
        self.is_torn(element)
    }
}

fn index(number: u32) -> usize {
    number as usize
}

fn elasticity_of(body: &Body) -> fem::Material {
    fem::Material {
        radius: body.radius,
        stretch: body.stretch,
        bend: body.bend,
        damping: body.damping,
        drag: body.drag,
        strength: body.strength,
        ..fem::Material::solid(body.young, body.poisson)
    }
}
