//! Triangles that resist being stretched and sheared in their plane.
//!
//! Constant strain, the material of Saint Venant and Kirchhoff in plane stress: the membrane force is linear in Green's strain.

use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2};

use super::blocks::Blocks;
use super::material::Material;
use crate::V3;

/// A triangle of a cloth.
#[derive(Debug, Clone)]
pub(crate) struct Membrane {
    pub nodes: [usize; 3],
    /// Area at rest, m2.
    pub area: f64,
    /// Torn: it resists nothing.
    pub is_broken: bool,
    /// Of the shape functions of the nodes, in the plane of the triangle at rest, 1/m.
    gradients: [Vector2<f64>; 3],
    /// Green's strain at the beginning of the step.
    before: Matrix2<f64>,
    slots: [[usize; 3]; 3],
}

impl Membrane {
    /// A triangle that is at rest between three points; None if it has no area.
    pub(crate) fn new(nodes: [usize; 3], corners: [V3; 3]) -> Option<Self> {
        let [first, second] = [1, 2].map(|corner| corners[corner] - corners[0]);
        let normal = first.cross(&second);
        let along = first.try_normalize(0.0)?;
        let across = normal.cross(&first).try_normalize(0.0)?;
        let flat = |edge: V3| Vector2::new(edge.dot(&along), edge.dot(&across));
        let inverse = Matrix2::from_columns(&[flat(first), flat(second)]).try_inverse()?;
        let [a, b] = [0, 1].map(|row| inverse.row(row).transpose());
        Some(Self {
            nodes,
            area: 0.5 * normal.norm(),
            is_broken: false,
            gradients: [-a - b, a, b],
            before: Matrix2::zeros(),
            slots: [[0; 3]; 3],
        })
    }

    pub(crate) fn find_slots(&mut self, blocks: &Blocks) {
        self.slots = blocks.slots(&self.nodes);
    }

    fn deformation(&self, places: &[V3]) -> Matrix3x2<f64> {
        let parts = self.nodes.iter().zip(&self.gradients);
        parts.fold(Matrix3x2::zeros(), |sum, (node, gradient)| {
            sum + places[*node] * gradient.transpose()
        })
    }

    fn strain(&self, places: &[V3]) -> Matrix2<f64> {
        let deformation = self.deformation(places);
        (deformation.transpose() * deformation - Matrix2::identity()) * 0.5
    }

    /// Begins a step at these places.
    pub(crate) fn begin(&mut self, places: &[V3]) {
        self.before = self.strain(places);
    }

    /// Largest tension in the plane, N/m.
    pub(crate) fn tension(&self, places: &[V3], material: &Material) -> f64 {
        if self.is_broken {
            return 0.0;
        }
        let force = force(&self.strain(places), material);
        force.symmetric_eigenvalues().max()
    }

    /// Elastic energy, with the share of damping of a step; `viscous`: ratio of viscous to elastic stiffness by the step.
    pub(crate) fn potential(&self, places: &[V3], material: &Material, viscous: f64) -> f64 {
        if self.is_broken {
            return 0.0;
        }
        let strain = self.strain(places);
        let energy = |strain: Matrix2<f64>| 0.5 * force(&strain, material).dot(&strain);
        self.area * (energy(strain) + viscous * energy(strain - self.before))
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
        if self.is_broken {
            return;
        }
        let deformation = self.deformation(places);
        let strain = self.strain(places);
        let stress = force(&(strain + (strain - self.before) * viscous), material) * self.area;
        for (node, direction) in self.nodes.iter().zip(&self.gradients) {
            gradient[*node] += deformation * (stress * direction);
        }
        let tension = positive_part(&stress);
        let stiffness = material.stretch * self.area * (1.0 + viscous);
        for (i, a) in self.gradients.iter().enumerate() {
            for (j, b) in self.gradients.iter().enumerate() {
                let geometric = a.dot(&(tension * b));
                let material = in_plane(a, b, material.poisson) * stiffness;
                let block = deformation * material * deformation.transpose()
                    + Matrix3::from_diagonal_element(geometric);
                blocks.add(self.slots[i][j], &block);
            }
        }
    }
}

/// Second Piola and Kirchhoff's membrane force, N/m.
fn force(strain: &Matrix2<f64>, material: &Material) -> Matrix2<f64> {
    let sideways = Matrix2::identity() * (material.poisson * strain.trace());
    (strain * (1.0 - material.poisson) + sideways) * material.stretch
}

/// How the force at one node changes with the displacement of another, in the plane and for a stiffness of one.
fn in_plane(a: &Vector2<f64>, b: &Vector2<f64>, poisson: f64) -> Matrix2<f64> {
    let shear = Matrix2::identity() * a.dot(b) + b * a.transpose();
    a * b.transpose() * poisson + shear * (0.5 * (1.0 - poisson))
}

/// A symmetric matrix without its negative eigenvalues.
fn positive_part(matrix: &Matrix2<f64>) -> Matrix2<f64> {
    let mean = 0.5 * matrix.trace();
    let half = 0.5 * (matrix[(0, 0)] - matrix[(1, 1)]);
    let radius = (half * half + matrix[(0, 1)] * matrix[(1, 0)]).sqrt();
    let (low, high) = (mean - radius, mean + radius);
    if low >= 0.0 {
        *matrix
    } else if high <= 0.0 {
        Matrix2::zeros()
    } else {
        (matrix - Matrix2::identity() * low) * (high / (high - low))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_tension_is_left() {
        let pressed = Matrix2::new(-1.0, 0.5, 0.5, -2.0);
        assert_eq!(positive_part(&pressed), Matrix2::zeros());
        let sheared = positive_part(&Matrix2::new(0.0, 2.0, 2.0, 0.0));
        assert!((sheared - Matrix2::new(1.0, 1.0, 1.0, 1.0)).norm() < 1e-12);
    }
}
