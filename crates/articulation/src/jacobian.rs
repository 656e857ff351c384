//! Jacobians of joints and inverse masses of bodies by blocks of 3 x 3, so that their zeros are not multiplied.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use crate::block_cholesky::{Block, Segment};
use crate::spatial;

/// From the velocity of a body to the six rows of a joint: `[linear lever; 0 angular]`.
#[derive(Clone, Copy)]
pub(crate) struct Jacobian {
    pub linear: Matrix3<f64>,
    /// From the angular velocity to the linear rows.
    pub lever: Matrix3<f64>,
    pub angular: Matrix3<f64>,
}

/// The response of a body to impulses about its centre of mass, world axes.
#[derive(Clone, Copy)]
pub(crate) struct InverseMass {
    /// 1/kg; 0 for bodies that no force moves.
    pub linear: f64,
    pub angular: Matrix3<f64>,
}

impl Jacobian {
    /// Impulse and angular impulse on the body of impulses along the rows.
    #[inline]
    pub(crate) fn impulse(&self, of_rows: &Segment) -> Vector6<f64> {
        let (linear, angular) = halves(of_rows);
        spatial(
            self.linear.tr_mul(&linear),
            self.lever.tr_mul(&linear) + self.angular.tr_mul(&angular),
        )
    }

    /// With zeros in the rows that are not active.
    #[inline]
    pub(crate) fn with_rows(&self, active: &[bool; 6]) -> Self {
        let mut kept = *self;
        for row in 0..3 {
            if !active[row] {
                kept.linear.row_mut(row).fill(0.0);
                kept.lever.row_mut(row).fill(0.0);
            }
            if !active[row + 3] {
                kept.angular.row_mut(row).fill(0.0);
            }
        }
        kept
    }

    /// The product with an inverse mass has the same zeros.
    #[inline]
    pub(crate) fn times(&self, mass: &InverseMass) -> Self {
        Self {
            linear: self.linear * mass.linear,
            lever: self.lever * mass.angular,
            angular: self.angular * mass.angular,
        }
    }

    /// Adds the product with the transpose of another one to a block.
    #[inline]
    pub(crate) fn add_product(&self, other: &Self, block: &mut Block) {
        self.add_lower_product(other, block);
        for column in 0..3 {
            for inner in 0..3 {
                let share = other.angular.data.0[inner][column];
                for row in 0..3 {
                    block.data.0[column + 3][row] += self.lever.data.0[inner][row] * share;
                }
            }
        }
    }

    /// As [`add_product`](Self::add_product), but for the upper right 3 x 3 block.
    #[inline]
    fn add_lower_product(&self, other: &Self, block: &mut Block) {
        for column in 0..3 {
            for inner in 0..3 {
                let [linear, lever, angular] = [&other.linear, &other.lever, &other.angular]
                    .map(|part| part.data.0[inner][column]);
                for row in 0..3 {
                    block.data.0[column][row] += self.linear.data.0[inner][row] * linear
                        + self.lever.data.0[inner][row] * lever;
                    block.data.0[column][row + 3] += self.angular.data.0[inner][row] * lever;
                    block.data.0[column + 3][row + 3] += self.angular.data.0[inner][row] * angular;
                }
            }
        }
    }

    /// Adds the lower triangle of the product with the transpose of this Jacobian times a mass, which is `other`: `rows` are those that are not
    /// zero. Linear rows are orthogonal, so that their product is diagonal.
    #[inline]
    pub(crate) fn add_own_product(
        &self,
        other: &Self,
        mass: &InverseMass,
        rows: &[bool; 6],
        block: &mut Block,
    ) {
        for row in (0..3).filter(|&row| rows[row]) {
            block.data.0[row][row] += mass.linear;
        }
        for column in 0..3 {
            for inner in 0..3 {
                let [lever, angular] =
                    [&self.lever, &self.angular].map(|part| part.data.0[inner][column]);
                for row in column..3 {
                    block.data.0[column][row] += other.lever.data.0[inner][row] * lever;
                    block.data.0[column + 3][row + 3] += other.angular.data.0[inner][row] * angular;
                }
                for row in 0..3 {
                    block.data.0[column][row + 3] += other.angular.data.0[inner][row] * lever;
                }
            }
        }
    }

    pub(crate) fn dense(&self) -> Block {
        let mut dense = Block::zeros();
        dense.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.linear);
        dense.fixed_view_mut::<3, 3>(0, 3).copy_from(&self.lever);
        dense.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.angular);
        dense
    }
}

impl InverseMass {
    /// The change of velocity by an impulse and an angular impulse.
    #[inline]
    pub(crate) fn times(&self, impulse: &Vector6<f64>) -> Vector6<f64> {
        let (linear, angular) = halves(impulse);
        spatial(linear * self.linear, self.angular * angular)
    }

    pub(crate) fn dense(&self) -> Matrix6<f64> {
        let mut dense = Matrix6::zeros();
        dense
            .fixed_view_mut::<3, 3>(0, 0)
            .fill_diagonal(self.linear);
        dense.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.angular);
        dense
    }
}

/// A matrix times the cross matrix of a vector: its rows are the cross products of the matrix's rows and the vector.
#[inline]
pub(crate) fn times_cross_matrix(matrix: &Matrix3<f64>, vector: &Vector3<f64>) -> Matrix3<f64> {
    let [x, y, z] = [0, 1, 2].map(|column| matrix.column(column).into_owned());
    Matrix3::from_columns(&[
        y * vector.z - z * vector.y,
        z * vector.x - x * vector.z,
        x * vector.y - y * vector.x,
    ])
}

/// The linear and the angular part.
#[inline]
pub(crate) fn halves(of: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (
        Vector3::new(of[0], of[1], of[2]),
        Vector3::new(of[3], of[4], of[5]),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(seed: f64) -> Matrix3<f64> {
        Matrix3::from_fn(|row, column| (seed + row as f64 * 1.7 + column as f64 * 0.6).sin())
    }

    fn jacobian(seed: f64) -> Jacobian {
        Jacobian {
            linear: matrix(seed),
            lever: matrix(seed + 1.0),
            angular: matrix(seed + 2.0),
        }
    }

    #[test]
    fn products_are_those_of_the_dense_matrices() {
        let (a, b) = (jacobian(0.3), jacobian(0.9));
        let mass = InverseMass {
            linear: 2.5,
            angular: matrix(0.1),
        };
        let vector = Vector6::from_fn(|row, _| row as f64 - 1.5);
        assert!((a.impulse(&vector) - a.dense().transpose() * vector).amax() < 1e-15);
        assert!((mass.times(&vector) - mass.dense() * vector).amax() < 1e-15);
        assert!((a.times(&mass).dense() - a.dense() * mass.dense()).amax() < 1e-15);
        let product = a.dense() * b.dense().transpose();
        let mut whole = Block::zeros();
        a.add_product(&b, &mut whole);
        assert!((whole - product).amax() < 1e-15);
    }

    #[test]
    fn a_joint_responds_to_itself_as_the_dense_matrices_say() {
        let turned = nalgebra::Rotation3::from_euler_angles(0.3, 0.5, 0.7).into_inner();
        let rows = [true, true, false, true, true, false];
        let a = Jacobian {
            linear: turned,
            lever: matrix(0.4),
            angular: turned,
        }
        .with_rows(&rows);
        let mass = InverseMass {
            linear: 2.5,
            angular: matrix(0.1) * matrix(0.1).transpose(),
        };
        let product = a.dense() * mass.dense() * a.dense().transpose();
        let mut lower = Block::zeros();
        a.add_own_product(&a.times(&mass), &mass, &rows, &mut lower);
        assert!((lower - product).lower_triangle().amax() < 1e-15);
    }

    #[test]
    fn rows_that_are_not_active_are_zero() {
        let kept = jacobian(0.2)
            .with_rows(&[true, false, true, true, true, false])
            .dense();
        assert_eq!((kept.row(1).amax(), kept.row(5).amax()), (0.0, 0.0));
        assert_eq!(kept.row(0), jacobian(0.2).dense().row(0));
    }
}
