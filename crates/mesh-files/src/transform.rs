//! Affine transforms of nodes.

/// Three rows of four numbers: a matrix and a translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Transform(pub(crate) [[f64; 4]; 3]);

impl Transform {
    pub(crate) const IDENTITY: Self = Self([
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ]);

    pub(crate) fn translation([x, y, z]: [f64; 3]) -> Self {
        Self([[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z]])
    }

    pub(crate) fn scaling([x, y, z]: [f64; 3]) -> Self {
        Self([[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0]])
    }

    /// A turn by a quaternion x, y, z, w; of any length but 0, which turns by nothing.
    pub(crate) fn rotation([x, y, z, w]: [f64; 4]) -> Self {
        let square = x * x + y * y + z * z + w * w;
        if !(square > 0.0 && square.is_finite()) {
            return Self::IDENTITY;
        }
        let s = 2.0 / square;
        Self([
            [
                1.0 - s * (y * y + z * z),
                s * (x * y - z * w),
                s * (x * z + y * w),
                0.0,
            ],
            [
                s * (x * y + z * w),
                1.0 - s * (x * x + z * z),
                s * (y * z - x * w),
                0.0,
            ],
            [
                s * (x * z - y * w),
                s * (y * z + x * w),
                1.0 - s * (x * x + y * y),
                0.0,
            ],
        ])
    }

    /// A turn by the cosine and sine of an angle about an axis of any length (Rodrigues' formula).
    pub(crate) fn about(axis: [f64; 3], cos: f64, sin: f64) -> Self {
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return Self::IDENTITY;
        }
        let [x, y, z] = axis.map(|a| a / length);
        let t = 1.0 - cos;
        Self([
            [
                t * x * x + cos,
                t * x * y - sin * z,
                t * x * z + sin * y,
                0.0,
            ],
            [
                t * x * y + sin * z,
                t * y * y + cos,
                t * y * z - sin * x,
                0.0,
            ],
            [
                t * x * z - sin * y,
                t * y * z + sin * x,
                t * z * z + cos,
                0.0,
            ],
        ])
    }

    /// First `other`, then this.
    pub(crate) fn after(&self, other: &Self) -> Self {
        let mut product = [[0.0; 4]; 3];
        for (row, a) in product.iter_mut().zip(&self.0) {
            for (column, x) in row.iter_mut().enumerate() {
                let sum = a[0] * other.0[0][column]
                    + a[1] * other.0[1][column]
                    + a[2] * other.0[2][column];
                *x = if column == 3 { sum + a[3] } else { sum };
            }
        }
        Self(product)
    }

    pub(crate) fn apply(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.0
            .map(|row| row[0] * x + row[1] * y + row[2] * z + row[3])
    }

    /// Turns normals: by the cofactors of the matrix, which differ from its inverse transposed by a factor only.
    pub(crate) fn normal(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = self.0;
        let cross = |p: [f64; 4], q: [f64; 4]| {
            [
                p[1] * q[2] - p[2] * q[1],
                p[2] * q[0] - p[0] * q[2],
                p[0] * q[1] - p[1] * q[0],
            ]
        };
        let sign = if self.mirrors() { -1.0 } else { 1.0 };
        let turned = [cross(b, c), cross(c, a), cross(a, b)]
            .map(|row| sign * (row[0] * x + row[1] * y + row[2] * z));
        unit(turned)
    }

    /// Its place and directions without scales, shears and mirrors: x as it is, y in the plane of x and y (Gram and Schmidt). What has no
    /// direction is not turned.
    pub(crate) fn rigid(&self) -> Self {
        let column = |k: usize| self.0.map(|row| row[k]);
        let x = unit(column(0));
        let y = column(1);
        let along = x.iter().zip(y).map(|(a, b)| a * b).sum::<f64>();
        let y = unit([0, 1, 2].map(|k| y[k] - along * x[k]));
        let z = cross(x, y);
        let [x, y, z] = if unit(z) == [0.0; 3] {
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        } else {
            [x, y, z]
        };
        Self([0, 1, 2].map(|k| [x[k], y[k], z[k], self.0[k][3]]))
    }

    /// The way back from a rigid transform.
    pub(crate) fn rigid_inverse(&self) -> Self {
        let [a, b, c] = self.0;
        let turned = [0, 1, 2].map(|k| [a[k], b[k], c[k]]);
        Self(turned.map(|[x, y, z]| [x, y, z, -(x * a[3] + y * b[3] + z * c[3])]))
    }

    /// The unit quaternion x, y, z, w of a rigid transform, by its largest component (S. W. Shepperd 1978).
    pub(crate) fn quaternion(&self) -> [f64; 4] {
        let [[xx, xy, xz, _], [yx, yy, yz, _], [zx, zy, zz, _]] = self.0;
        let squares = [
            1.0 + xx - yy - zz,
            1.0 - xx + yy - zz,
            1.0 - xx - yy + zz,
            1.0 + xx + yy + zz,
        ];
        let largest = (0..4).fold(
            3,
            |best, k| if squares[k] > squares[best] { k } else { best },
        );
        let rows = [
            [squares[0], xy + yx, xz + zx, zy - yz],
            [xy + yx, squares[1], yz + zy, xz - zx],
            [xz + zx, yz + zy, squares[2], yx - xy],
            [zy - yz, xz - zx, yx - xy, squares[3]],
        ];
        let length = rows[largest].iter().map(|x| x * x).sum::<f64>().sqrt();
        rows[largest].map(|x| x / length)
    }

    /// Whether it turns a mesh inside out.
    pub(crate) fn mirrors(&self) -> bool {
        let [a, b, c] = self.0;
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
            < 0.0
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Of length 1, or zero if it has no direction.
pub(crate) fn unit(vector: [f64; 3]) -> [f64; 3] {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() {
        vector.map(|x| x / length)
    } else {
        [0.0; 3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_about_z_takes_x_to_y() {
        let half = 0.5_f64.sqrt();
        for turn in [
            Transform::rotation([0.0, 0.0, half, half]),
            Transform::about([0.0, 0.0, 3.0], 0.0, 1.0),
        ] {
            let turned = turn.apply([1.0, 0.0, 0.0]);
            assert!(
                turned
                    .iter()
                    .zip([0.0, 1.0, 0.0])
                    .all(|(a, b)| (a - b).abs() < 1e-15)
            );
        }
    }

    #[test]
    fn what_is_rigid_of_a_transform_has_its_place_and_quaternion() {
        let turns = [
            [0.5, 0.5, 0.5, 0.5],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 0.6, 0.8, 0.0],
            [-0.1, 0.7, -0.1, 0.7],
            [0.0, 0.0, 0.0, 1.0],
        ];
        for turn in turns {
            let placed = Transform::translation([1.0, -2.0, 3.0]).after(&Transform::rotation(turn));
            let rigid = placed.after(&Transform::scaling([2.0, 3.0, 4.0])).rigid();
            let [x, y, z, w] = rigid.quaternion();
            let along: f64 = turn.iter().zip([x, y, z, w]).map(|(a, b)| a * b).sum();
            assert!(
                (along.abs() - 1.0).abs() < 1e-14,
                "{turn:?} became {:?}",
                [x, y, z, w]
            );
            let back = rigid.rigid_inverse().after(&rigid);
            let both = back
                .0
                .as_flattened()
                .iter()
                .zip(Transform::IDENTITY.0.as_flattened());
            assert!(
                both.into_iter().all(|(a, b)| (a - b).abs() < 1e-14),
                "{back:?}"
            );
        }
        assert_eq!(Transform::scaling([0.0; 3]).rigid(), Transform::IDENTITY);
    }

    #[test]
    fn normals_stay_perpendicular_under_uneven_and_mirroring_scales() {
        let scale = Transform::scaling([1.0, -4.0, 1.0]);
        let (along, normal) = (
            scale.apply([1.0, 1.0, 0.0]),
            scale.normal(unit([1.0, -1.0, 0.0])),
        );
        assert!(
            along
                .iter()
                .zip(normal)
                .map(|(a, b)| a * b)
                .sum::<f64>()
                .abs()
                < 1e-15
        );
        assert!(scale.mirrors() && normal[0] > 0.0);
    }
}
