//! Tetrahedra of a soft volume.
//!
//! Constant strain, co-rotational: the stress is linear in the stretch that is left when the rotation is taken out of the deformation. The energy is that of
//! Hooke's law for small strains and any rotation, finite where an element is pressed flat or turned inside out, so that it comes back from there.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion};

use super::blocks::Blocks;
use super::material::Material;
use crate::V3;

/// Angle by which a rotation counts as found: energies are exact to its square.
const ENOUGH: f64 = 1e-9;
/// Most iterations for a rotation; most elements need two or three.
const MAX_ITERATIONS: usize = 20;
/// Largest step of Newton's method for it, radians.
const LONGEST_TURN: f64 = 1.0;

/// An element of a volume.
#[derive(Debug, Clone)]
pub(crate) struct Tetrahedron {
    pub nodes: [usize; 4],
    /// At rest, m3.
    pub volume: f64,
    /// Of the shape functions of the nodes, 1/m.
    gradients: [V3; 4],
    /// The rotation and the deformation at the beginning of the step.
    rotation: UnitQuaternion<f64>,
    before: Matrix3<f64>,
    slots: [[usize; 4]; 4],
}

/// How an element is deformed.
struct Polar {
    rotation: UnitQuaternion<f64>,
    /// The symmetric factor without the identity.
    strain: Matrix3<f64>,
}

impl Tetrahedron {
    /// An element that is at rest between four points, in positive order; None if it has no volume.
    pub(crate) fn new(nodes: [usize; 4], corners: [V3; 4]) -> Option<Self> {
        let [a, b, c] = [1, 2, 3].map(|corner| corners[corner] - corners[0]);
        let edges = Matrix3::from_columns(&[a, b, c]);
        let volume = edges.determinant() / 6.0;
        let size = a.norm().max(b.norm()).max(c.norm());
        if volume.is_nan() || volume <= 1e-12 * size.powi(3) {
            return None;
        }
        let inverse = edges.try_inverse()?;
        let [a, b, c] = [0, 1, 2].map(|row| V3::from(inverse.row(row).transpose()));
        Some(Self {
            nodes,
            volume,
            gradients: [-a - b - c, a, b, c],
            rotation: UnitQuaternion::identity(),
            before: Matrix3::identity(),
            slots: [[0; 4]; 4],
        })
    }

    pub(crate) fn find_slots(&mut self, blocks: &Blocks) {
        self.slots = blocks.slots(&self.nodes);
    }

    fn deformation(&self, places: &[V3]) -> Matrix3<f64> {
        let parts = self.nodes.iter().zip(&self.gradients);
        parts.fold(Matrix3::zeros(), |sum, (node, gradient)| {
            sum + places[*node] * gradient.transpose()
        })
    }

    fn polar(&self, deformation: &Matrix3<f64>) -> Polar {
        let rotation = rotation_of(deformation, self.rotation);
        let stretch = rotation.to_rotation_matrix().transpose() * deformation;
        Polar {
            rotation,
            strain: (stretch + stretch.transpose()) * 0.5 - Matrix3::identity(),
        }
    }

    /// Begins a step at these places.
    pub(crate) fn begin(&mut self, places: &[V3]) {
        self.before = self.deformation(places);
        self.rotation = self.polar(&self.before).rotation;
    }

    /// Strain since the beginning of the step, seen from the rotation then.
    fn change(&self, deformation: &Matrix3<f64>) -> Matrix3<f64> {
        let start = self.rotation.to_rotation_matrix();
        let change = start.transpose() * (deformation - self.before);
        (change + change.transpose()) * 0.5
    }

    /// Elastic energy, with the share of damping of a step; `viscous`: ratio of viscous to elastic stiffness by the step.
    pub(crate) fn potential(&self, places: &[V3], material: &Material, viscous: f64) -> f64 {
        let deformation = self.deformation(places);
        let energy = |strain: Matrix3<f64>| 0.5 * stress(&strain, material).dot(&strain);
        let elastic = energy(self.polar(&deformation).strain);
        self.volume * (elastic + viscous * energy(self.change(&deformation)))
    }

    /// Adds the gradient of the potential, and its stiffness without what would make it negative.
    pub(crate) fn add(
        &self,
        places: &[V3],
        material: &Material,
        viscous: f64,
        gradient: &mut [V3],
        blocks: &mut Blocks,
    ) {
        let deformation = self.deformation(places);
        let Polar { rotation, strain } = self.polar(&deformation);
        let rotation = rotation.to_rotation_matrix().into_inner();
        let damping = stress(&self.change(&deformation), material) * viscous;
        let start = self.rotation.to_rotation_matrix().into_inner();
        let force = (rotation * stress(&strain, material) + start * damping) * self.volume;
        let turning = turning_stiffness(&strain, material) * self.volume;
        let strained = self.volume * (1.0 + viscous);
        let (lambda, shear) = (material.lambda * strained, material.shear * strained);
        for (i, (node, a)) in self.nodes.iter().zip(&self.gradients).enumerate() {
            gradient[*node] += force * a;
            let turned = a.cross_matrix() * turning;
            for (j, b) in self.gradients.iter().enumerate().take(i + 1) {
                let shearing = (Matrix3::identity() * a.dot(b) + b * a.transpose()) * shear;
                let local = a * b.transpose() * lambda + shearing - turned * b.cross_matrix();
                let block = rotation * local * rotation.transpose();
                blocks.add(self.slots[i][j], &block);
                if i != j {
                    blocks.add(self.slots[j][i], &block.transpose());
                }
            }
        }
    }
}

/// Hooke's law.
fn stress(strain: &Matrix3<f64>, material: &Material) -> Matrix3<f64> {
    let pressure = Matrix3::identity() * (material.lambda * strain.trace());
    strain * (2.0 * material.shear) + pressure
}

/// What an element resists with against turning its edges apart from its rotation, by that axis; without what would be negative.
///
/// From the derivative of the rotation: it turns about w by (tr(S) I - S)^-1 times the axis of the skew part.
fn turning_stiffness(strain: &Matrix3<f64>, material: &Material) -> Matrix3<f64> {
    let along = 2.0 * material.shear - material.lambda * strain.trace();
    let parts = strain.symmetric_eigen();
    let trace = strain.trace() + 3.0;
    let left = parts.eigenvalues.map(|stretch| {
        let others = trace - (stretch + 1.0);
        if others > 1e-9 {
            (material.shear - along / others).max(0.0)
        } else {
            0.0
        }
    });
    parts.eigenvectors * Matrix3::from_diagonal(&left) * parts.eigenvectors.transpose()
}

/// The rotation nearest to a deformation, from one near it: Newton's method for the rotation that makes the rest symmetric, where that rest is far from flat; else
/// steps that are shorter and always go there, of M. Mueller, J. Bender, N. Chentanez and M. Macklin, *A robust method to extract the rotational part of
/// deformations* (2016).
fn rotation_of(deformation: &Matrix3<f64>, start: UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    let mut rotation = start;
    for _ in 0..MAX_ITERATIONS {
        let turned = rotation.to_rotation_matrix().transpose() * deformation;
        let skew = V3::new(
            turned[(2, 1)] - turned[(1, 2)],
            turned[(0, 2)] - turned[(2, 0)],
            turned[(1, 0)] - turned[(0, 1)],
        );
        let symmetric = (turned + turned.transpose()) * 0.5;
        let resistance = Matrix3::from_diagonal_element(symmetric.trace()) - symmetric;
        let newton = resistance.cholesky().map(|factors| factors.solve(&skew));
        let newton = newton.filter(|turn| turn.norm() < LONGEST_TURN);
        let turn = newton.unwrap_or_else(|| skew / (f64::abs(symmetric.trace()) + 1e-9));
        let half = Quaternion::from_parts(1.0, turn * 0.5);
        rotation *= UnitQuaternion::new_normalize(half);
        if turn.norm() < ENOUGH {
            break;
        }
    }
    rotation
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners() -> [V3; 4] {
        [V3::zeros(), V3::x(), V3::y(), V3::z()]
    }

    #[test]
    fn a_turn_costs_nothing() {
        let mut element = Tetrahedron::new([0, 1, 2, 3], corners()).unwrap();
        let material = Material::solid(1e5, 0.3);
        let turn = UnitQuaternion::from_scaled_axis(V3::new(1.0, -2.0, 0.5));
        let turned = corners().map(|corner| turn * corner + V3::x());
        element.begin(&turned);
        assert!(element.potential(&turned, &material, 0.0) < 1e-12);
        // Hooke: one direction is stretched by a hundredth.
        let stretched = turned
            .map(|corner| corner + turn * V3::x() * 0.01 * (turn.inverse() * (corner - V3::x())).x);
        let energy = 0.5 * (material.lambda + 2.0 * material.shear) * 1e-4 / 6.0;
        assert!((element.potential(&stretched, &material, 0.0) / energy - 1.0).abs() < 1e-9);
    }

    #[test]
    fn damping_has_the_gradient_of_its_potential() {
        let mut element = Tetrahedron::new([0, 1, 2, 3], corners()).unwrap();
        let material = Material::solid(1e5, 0.3);
        let start = [0.0, 1.1, 0.2, 0.3].map(|x| V3::new(x, 0.3 * x * x, 0.1));
        element.begin(&[0, 1, 2, 3].map(|i| corners()[i] + start[i] * 0.3));
        let places = [0, 1, 2, 3].map(|i| corners()[i] * 1.1 + start[3 - i] * 0.4);
        let mut blocks = Blocks::new(4, std::iter::once(&element.nodes[..]));
        element.find_slots(&blocks);
        let mut gradient = vec![V3::zeros(); 4];
        element.add(&places, &material, 2.0, &mut gradient, &mut blocks);
        for (node, axis) in (0..12).map(|i| (i / 3, i % 3)) {
            let at = |change: f64| {
                let mut places = places;
                places[node][axis] += change;
                element.potential(&places, &material, 2.0)
            };
            let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
            let size = gradient[node].norm();
            assert!(
                (slope - gradient[node][axis]).abs() < 1e-5 * size,
                "{slope}"
            );
        }
    }

    #[test]
    fn the_stiffness_is_that_of_the_gradient() {
        let element = Tetrahedron::new([0, 1, 2, 3], corners()).unwrap();
        let material = Material::solid(1e5, 0.3);
        // Stretched in all directions, so that nothing of the stiffness is negative.
        let places = [
            V3::zeros(),
            V3::new(1.2, 0.1, 0.0),
            V3::new(-0.05, 1.3, 0.1),
            V3::new(0.1, 0.0, 1.25),
        ];
        let at = |places: &[V3]| {
            let mut blocks = Blocks::new(4, std::iter::once(&element.nodes[..]));
            let mut element = element.clone();
            element.find_slots(&blocks);
            let mut gradient = vec![V3::zeros(); 4];
            element.add(places, &material, 0.0, &mut gradient, &mut blocks);
            (gradient, blocks)
        };
        let (gradient, blocks) = at(&places);
        let step = [0.3, -0.2, 0.5, 0.1].map(|x| V3::new(x, 0.4 - x, x * x));
        let moved = |size: f64| [0, 1, 2, 3].map(|node| places[node] + step[node] * size);
        let potential = |size: f64| element.potential(&moved(size), &material, 0.0);
        let slope = (potential(1e-5) - potential(-1e-5)) / 2e-5;
        let along: f64 = gradient.iter().zip(&step).map(|(a, b)| a.dot(b)).sum();
        assert!((slope / along - 1.0).abs() < 1e-6, "{slope} {along}");
        let mut product = vec![V3::zeros(); 4];
        blocks.multiply(&step, &mut product);
        for (node, product) in product.iter().enumerate() {
            let change = (at(&moved(1e-5)).0[node] - at(&moved(-1e-5)).0[node]) / 2e-5;
            assert!(
                (change - product).norm() < 1e-6 * change.norm(),
                "{change} {product}"
            );
        }
    }
}
