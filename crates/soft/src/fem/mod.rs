//! Cloths, membranes and soft volumes as finite elements of constant strain, in contact with friction, coupled with rigid bodies.
//!
//! # Method
//!
//! - A cloth is a mesh of triangles that resist stretch and shear in their plane, and bending across their edges; a closed one may hold gas. A volume is a mesh of
//!   tetrahedra. Mass is at the nodes.
//! - Time is integrated by the implicit Euler method: what the step cannot resolve is damped out, and no stiffness is too high for a step. It damps what moves with
//!   the angular frequency w by w h / 2 of the critical damping.
//! - The places at the end of a step are those of the least potential: of inertia, elasticity, contacts and gravity. Newton's method finds them, with a line search.
//!   What of the stiffness would be negative is left out, so that each step goes down.
//! - The linear equations are solved by conjugate gradients, with the inverses of the blocks of nodes and bodies as preconditioner. How many iterations that takes
//!   depends on how far a wave of stress runs in a step, in elements: the cost grows linearly with a mesh that gets larger, and faster with one that gets finer.
//! - Rigid bodies are unknowns as for rods. What is held goes exactly with what holds it. Contacts are as for rods.
//! - What has nothing to do with each other is solved on its own.
//! - Rods that touch a cloth or volume are solved together with it: their nodes and angles are unknowns too, and the factors of their banded matrices are the
//!   preconditioner for these.
//! - Largest friction forces are those of the first iterations of a step, so that the rest of them has a potential.
//!
//! # Limits
//!
//! Elements are linear: volumes of few layers bend too stiffly (by 18 % with four layers, by 6 % with eight), and those that hardly change their volume (Poisson's
//! ratio above 0.45) more so.

mod bending;
mod blocks;
mod contact;
mod coupled_rod;
mod gas;
mod islands;
mod material;
mod membrane;
mod mesh;
mod nearby;
mod newton;
mod nodes;
mod part_step;
mod sparse;
mod system;
mod tetrahedron;

use crate::V3;
use crate::rod::Hold;
use bending::Bending;
use blocks::Blocks;
use gas::{Gas, volume_of};
use membrane::Membrane;
use tetrahedron::Tetrahedron;

pub use contact::{Contact, Spot, Surface};
pub use islands::{Parts, solve};
pub use material::Material;
pub use nearby::nearby;

/// A cloth, a membrane around gas, or a volume.
#[derive(Debug, Clone)]
pub struct Deformable {
    material: Material,
    /// Where nodes are held; their directions do not matter.
    pub holds: Vec<Hold>,
    /// Kilograms.
    masses: Vec<f64>,
    /// Whether nodes belong to the surface.
    on_surface: Vec<bool>,
    places: Vec<V3>,
    velocities: Vec<V3>,
    membranes: Vec<Membrane>,
    bending: Bending,
    tetrahedra: Vec<Tetrahedron>,
    /// Triangles of the surface, facing outwards.
    surface: Vec<[usize; 3]>,
    gas: Option<Gas>,
    blocks: Blocks,
    /// Shortest edge at rest, metres.
    shortest: f64,
}

impl Deformable {
    /// A cloth of triangles that is at rest as the points say, with so much mass on a square metre. `is_flat`: it is not bent at rest, whatever the points say.
    /// None if an index is out of range, a triangle has no area or a point belongs to none.
    pub fn cloth(
        points: &[V3],
        triangles: &[[usize; 3]],
        is_flat: bool,
        area_density: f64,
        material: Material,
    ) -> Option<Self> {
        let corners = |nodes: &[usize; 3]| all_of(points, nodes);
        let membranes: Option<Vec<Membrane>> = triangles
            .iter()
            .map(|nodes| Membrane::new(*nodes, corners(nodes)?))
            .collect();
        let membranes = membranes?;
        let Material { bend, poisson, .. } = material;
        let bending = Bending::new(triangles, points, is_flat, bend, poisson)?;
        let mut masses = vec![0.0; points.len()];
        for membrane in &membranes {
            let third = membrane.area * area_density / 3.0;
            membrane
                .nodes
                .iter()
                .for_each(|node| masses[*node] += third);
        }
        Self {
            membranes,
            bending,
            ..Self::empty(points, masses, triangles, material)
        }
        .assembled()
    }

    /// A volume of tetrahedra, each in positive order, with the triangles of its surface, facing outwards. None as for [`cloth`](Self::cloth).
    pub fn volume(
        points: &[V3],
        tetrahedra: &[[usize; 4]],
        surface: &[[usize; 3]],
        density: f64,
        material: Material,
    ) -> Option<Self> {
        let corners = |nodes: &[usize; 4]| all_of(points, nodes);
        let elements: Option<Vec<Tetrahedron>> = tetrahedra
            .iter()
            .map(|nodes| Tetrahedron::new(*nodes, corners(nodes)?))
            .collect();
        let elements = elements?;
        let mut masses = vec![0.0; points.len()];
        for element in &elements {
            let quarter = element.volume * density / 4.0;
            element
                .nodes
                .iter()
                .for_each(|node| masses[*node] += quarter);
        }
        Self {
            tetrahedra: elements,
            ..Self::empty(points, masses, surface, material)
        }
        .assembled()
    }

    fn empty(points: &[V3], masses: Vec<f64>, surface: &[[usize; 3]], material: Material) -> Self {
        Self {
            material,
            holds: Vec::new(),
            masses,
            on_surface: on_surface(surface, points.len()),
            velocities: vec![V3::zeros(); points.len()],
            places: points.to_vec(),
            membranes: Vec::new(),
            bending: Bending::default(),
            tetrahedra: Vec::new(),
            surface: surface.to_vec(),
            gas: None,
            blocks: Blocks::default(),
            shortest: 0.0,
        }
    }

    /// Finds the form of the matrix.
    fn assembled(mut self) -> Option<Self> {
        let is_sound = |mass: &f64| mass.is_finite() && *mass > 0.0;
        if self.places.is_empty() || !self.masses.iter().all(is_sound) {
            return None;
        }
        let triangles = self.membranes.iter().map(|element| &element.nodes[..]);
        let tetrahedra = self.tetrahedra.iter().map(|element| &element.nodes[..]);
        let elements = || triangles.clone().chain(tetrahedra.clone());
        let blocks = Blocks::new(self.places.len(), elements());
        let pairs = elements().flat_map(|nodes| nodes.iter().zip(&nodes[1..]));
        let lengths = pairs.map(|(a, b)| (self.places[*a] - self.places[*b]).norm());
        self.shortest = lengths.fold(f64::MAX, f64::min);
        self.membranes
            .iter_mut()
            .for_each(|element| element.find_slots(&blocks));
        self.tetrahedra
            .iter_mut()
            .for_each(|element| element.find_slots(&blocks));
        self.blocks = blocks;
        Some(self)
    }

    /// Fills a closed cloth with gas of a pressure above that of the air outside (Pa), in the volume that it has now. Does nothing where it encloses none.
    pub fn fill(&mut self, pressure: f64) {
        let volume = self.enclosed();
        self.gas = (volume > 0.0).then(|| Gas::new(pressure, volume));
    }

    /// Volume within the surface, m3; has no meaning where that is open.
    pub fn enclosed(&self) -> f64 {
        volume_of(&self.surface, &self.places)
    }

    /// Pressure of the gas within, above that of the air outside, Pa; 0 without gas.
    pub fn pressure(&self) -> f64 {
        let gas = self.gas.map(|gas| gas.pressure(self.enclosed()));
        gas.unwrap_or(0.0)
    }

    /// What it is made of.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// The nodes that share an element with one, and that one.
    pub fn neighbours(&self, node: usize) -> &[usize] {
        self.blocks.columns(node)
    }

    /// Whether a node belongs to the surface.
    pub fn is_on_surface(&self, node: usize) -> bool {
        self.on_surface[node]
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there are no nodes; there are.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Places of the nodes.
    pub fn points(&self) -> &[V3] {
        &self.places
    }

    /// Velocities of the nodes.
    pub fn velocities(&self) -> &[V3] {
        &self.velocities
    }

    /// Triangles of the surface, facing outwards; those of a cloth in the order in which they were given.
    pub fn surface(&self) -> &[[usize; 3]] {
        &self.surface
    }

    /// Whether a triangle of a cloth is torn.
    pub fn is_torn(&self, triangle: usize) -> bool {
        let membrane = self.membranes.get(triangle);
        membrane.is_some_and(|membrane| membrane.is_broken)
    }

    /// Tears a triangle of a cloth, and lets the gas within go.
    pub fn tear(&mut self, triangle: usize) {
        let Some(membrane) = self.membranes.get_mut(triangle) else {
            return;
        };
        membrane.is_broken = true;
        self.gas = None;
        self.bending.remove(triangle);
    }

    /// Puts the nodes elsewhere, with new velocities; extra points are ignored.
    pub fn set_motion(&mut self, points: &[V3], velocities: &[V3]) {
        for (place, point) in self.places.iter_mut().zip(points) {
            *place = *point;
        }
        for (own, velocity) in self.velocities.iter_mut().zip(velocities) {
            *own = *velocity;
        }
    }

    /// Largest tension of each triangle of a cloth, N/m; empty for a volume.
    pub fn tensions(&self) -> Vec<f64> {
        let membranes = self.membranes.iter();
        membranes
            .map(|membrane| membrane.tension(&self.places, &self.material))
            .collect()
    }

    /// Sum of kinetic and elastic energy, joules.
    pub fn energy(&self) -> f64 {
        let squares = self.velocities.iter().zip(&self.masses);
        let kinetic: f64 = squares.map(|(v, m)| 0.5 * m * v.norm_squared()).sum();
        kinetic + self.elastic_potential(&self.places, 0.0)
    }

    fn elastic_potential(&self, places: &[V3], viscous: f64) -> f64 {
        let material = &self.material;
        let membranes = self.membranes.iter();
        let membranes: f64 = membranes
            .map(|e| e.potential(places, material, viscous))
            .sum();
        let tetrahedra = self.tetrahedra.iter();
        let tetrahedra: f64 = tetrahedra
            .map(|e| e.potential(places, material, viscous))
            .sum();
        membranes + self.bending.potential(places) + tetrahedra
    }

    /// Begins a step where the nodes are.
    fn begin_step(&mut self) {
        let places = &self.places;
        self.membranes
            .iter_mut()
            .for_each(|element| element.begin(places));
        self.bending.begin(places);
        self.tetrahedra
            .iter_mut()
            .for_each(|element| element.begin(places));
    }

    /// Writes the stiffness, and adds the gradient of the elastic potential.
    fn assemble(&mut self, places: &[V3], viscous: f64, gradient: &mut [V3]) {
        let (material, blocks) = (&self.material, &mut self.blocks);
        blocks.clear();
        for membrane in &self.membranes {
            membrane.add(places, material, viscous, gradient, blocks);
        }
        self.bending.add(places, gradient);
        for element in &self.tetrahedra {
            element.add(places, material, viscous, gradient, blocks);
        }
    }

    /// Tears the triangle with the largest tension, if that is more than it bears: what was stretched with it has to find out first.
    fn tear_weakest(&mut self) {
        if self.material.strength == f64::INFINITY {
            return;
        }
        let loaded = self.tensions().into_iter().enumerate();
        let most = loaded.max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((triangle, tension)) = most
            && tension > self.material.strength
        {
            self.tear(triangle);
        }
    }
}

fn on_surface(surface: &[[usize; 3]], nodes: usize) -> Vec<bool> {
    let mut on_surface = vec![false; nodes];
    for node in surface.as_flattened() {
        if let Some(is_on) = on_surface.get_mut(*node) {
            *is_on = true;
        }
    }
    on_surface
}

fn all_of<const N: usize>(points: &[V3], nodes: &[usize; N]) -> Option<[V3; N]> {
    let is_there = nodes.iter().all(|node| *node < points.len());
    is_there.then(|| nodes.map(|node| points[node]))
}
