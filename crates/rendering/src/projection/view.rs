//! How points are projected onto a picture.

use geometry::{Finite, Pose};
use nalgebra::{Matrix3, Vector3};

use crate::camera::{Camera, Projection};
use wide::f64x4;

use crate::coverage::face::{Face, GUARD_BAND, Plane, UNIT, UNIT_BITS};

/// A camera in the form that projecting needs.
///
/// Points in front of the camera have *view coordinates*: x to the right and y upwards in units in which a pixel has size 1 (at depth 1
/// in perspective), and z the depth in metres. A *ray* is `[x, y]` on the picture, from its centre: the pixel with column `i` and row `j`
/// has its centre at `[i + 0.5 - centre[0], j + 0.5 - centre[1]]`.
#[derive(Debug, Clone, Copy)]
pub struct View {
    /// From the world, relative to `eye`, to view coordinates.
    rotation: Matrix3<f64>,
    eye: Vector3<f64>,
    /// Pixels per metre, at depth 1 in perspective.
    pub scale: f64,
    /// One divided by `scale`.
    pub over_scale: f64,
    pub perspective: bool,
    pub near: f64,
    pub far: f64,
    pub resolution: [u32; 2],
    /// Half of the resolution.
    pub centre: [f64; 2],
}

impl View {
    /// None where the camera sees nothing: numbers that are not finite, no opening, no depth.
    pub fn new(camera: &Camera) -> Option<Self> {
        let resolution = camera
            .resolution
            .map(|side| side.min(Camera::MAX_RESOLUTION));
        let larger = f64::from(resolution[0].max(resolution[1]));
        let (perspective, extent) = match camera.projection {
            Projection::Perspective { angle } if angle > 0.0 && angle < std::f64::consts::PI => {
                (true, 2.0 * libm::tan(angle / 2.0))
            }
            Projection::Orthographic { size } => (false, size),
            Projection::Perspective { .. } => return None,
        };
        let scale = larger / extent;
        let sees =
            scale > 0.0 && scale.is_finite() && camera.near < camera.far && camera.far.is_finite();
        let starts = camera.near.is_finite() && (!perspective || camera.near > 0.0);
        (sees && starts && camera.pose.is_finite()).then(|| Self {
            rotation: Matrix3::from_diagonal(&Vector3::new(-scale, scale, 1.0))
                * camera
                    .pose
                    .rotation
                    .to_rotation_matrix()
                    .matrix()
                    .transpose(),
            eye: camera.pose.translation.vector,
            scale,
            over_scale: 1.0 / scale,
            perspective,
            near: camera.near,
            far: camera.far,
            resolution,
            centre: resolution.map(|side| f64::from(side) / 2.0),
        })
    }

    /// From a frame of the world to view coordinates. The eye is subtracted before anything is rotated, so that nothing is lost far
    /// from the origin.
    pub fn transform(&self, pose: &Pose) -> Transform {
        Transform {
            rotation: self.rotation * pose.rotation.to_rotation_matrix().matrix(),
            translation: self.rotation * (pose.translation.vector - self.eye),
        }
    }

    /// From view coordinates to metres along the camera's axes: right, up, depth.
    pub fn in_metres(&self, vector: Vector3<f64>) -> Vector3<f64> {
        Vector3::new(
            vector.x * self.over_scale,
            vector.y * self.over_scale,
            vector.z,
        )
    }

    /// Value in the depth buffer: larger is closer, linear on the picture, and 0 at the far plane or beyond it (in perspective the
    /// reciprocal of the depth, where `far_closeness` is the limit).
    pub fn closeness(&self, z: f64) -> f64 {
        if self.perspective {
            1.0 / z
        } else {
            (self.far - z) / (self.far - self.near)
        }
    }

    /// How much closeness changes over a depth of one pixel's size.
    pub fn closeness_of_pixel(&self, z: f64) -> f64 {
        let change = if self.perspective {
            self.closeness(z.max(self.near))
        } else {
            1.0 / (self.far - self.near)
        };
        change * self.over_scale
    }

    /// The closeness of the far plane.
    pub fn far_closeness(&self) -> f64 {
        self.closeness(self.far)
    }

    /// `(z - near) / (far - near)` of a face at a ray and at the three pixels to the right.
    pub fn relative_depths(&self, face: &Face, ray: [f64; 2]) -> [f32; 4] {
        let [least, most] = face.range.map(|limit| f64x4::splat(limit.into()));
        let columns = f64x4::new([0.0, 1.0, 2.0, 3.0]);
        let closeness = (columns * face.closeness.a + face.closeness.at(ray))
            .fast_max(least)
            .fast_min(most);
        let depth = match self.perspective {
            true => (f64x4::ONE / closeness - self.near) * (1.0 / (self.far - self.near)),
            false => f64x4::ONE - closeness,
        };
        depth
            .fast_max(f64x4::ZERO)
            .fast_min(f64x4::ONE)
            .to_array()
            .map(numbers::single)
    }

    /// Whether a ball in view coordinates may be visible; `radius` is in metres.
    pub fn may_see(&self, centre: Vector3<f64>, radius: f64) -> bool {
        if centre.z + radius < self.near || centre.z - radius > self.far {
            return false;
        }
        (0..2).all(|axis| self.distance_outside(centre[axis].abs(), centre.z, axis) <= radius)
    }

    /// How far a point is beyond the border of the picture, metres.
    fn distance_outside(&self, offset: f64, z: f64, axis: usize) -> f64 {
        let (offset, border) = (offset / self.scale, self.centre[axis] / self.scale);
        if self.perspective {
            (offset - border * z) / (1.0 + border * border).sqrt()
        } else {
            offset - border
        }
    }

    #[inline(always)]
    /// A point on the picture, in units of 1 / `UNIT` pixel; None where it is closer than the near plane or beyond the guard band.
    pub fn project(&self, point: &Vector3<f64>) -> Option<[i32; 2]> {
        let over_depth = if self.perspective { 1.0 / point.z } else { 1.0 };
        let offset = [point.x * over_depth, point.y * over_depth];
        let visible =
            point.z >= self.near && offset[0].abs() <= GUARD_BAND && offset[1].abs() <= GUARD_BAND;
        visible.then(|| self.grid_point(offset))
    }

    /// A point that was cut off at the near plane and the guard band.
    pub fn project_clipped(&self, point: &Vector3<f64>) -> [i32; 2] {
        let depth = if self.perspective { point.z } else { 1.0 };
        self.grid_point(
            [point.x / depth, point.y / depth].map(|offset| offset.clamp(-GUARD_BAND, GUARD_BAND)),
        )
    }

    #[inline(always)]
    fn grid_point(&self, offset: [f64; 2]) -> [i32; 2] {
        // Shifted so that it is positive, where conversion rounds downwards.
        const SHIFT: f64 = 2.0 * GUARD_BAND;
        [0, 1].map(|axis| {
            numbers::truncated_i32(
                (offset[axis] + self.centre[axis] + SHIFT) * f64::from(UNIT) + 0.5,
            ) - numbers::truncated_i32(SHIFT) * UNIT
        })
    }

    /// The pixels whose centres are within a rectangle: first and last column and row.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "columns and rows of a picture, limited to it; checks would slow down every triangle"
    )]
    #[inline(always)]
    pub fn pixels(&self, low: [i32; 2], high: [i32; 2]) -> Option<[[u16; 2]; 2]> {
        // Shifting divides by `UNIT` and rounds downwards.
        let range = |axis: usize| {
            let first = ((low[axis] + UNIT / 2 - 1) >> UNIT_BITS).max(0);
            let last =
                ((high[axis] - UNIT / 2) >> UNIT_BITS).min(self.resolution[axis].cast_signed() - 1);
            (first <= last).then_some([first as u16, last as u16])
        };
        Some([range(0)?, range(1)?])
    }

    /// How far a point is on the inner side of a plane; negative beyond it.
    pub fn inside(&self, plane: ClipPlane, point: &Vector3<f64>) -> f64 {
        let border = GUARD_BAND * if self.perspective { point.z } else { 1.0 };
        match plane {
            ClipPlane::Near => point.z - self.near,
            ClipPlane::Left => border + point.x,
            ClipPlane::Right => border - point.x,
            ClipPlane::Bottom => border + point.y,
            ClipPlane::Top => border - point.y,
        }
    }

    /// How far in columns and rows the centre of a pixel is from the centre of the picture.
    pub fn ray(&self, column: usize, row: usize) -> [f64; 2] {
        // From 32 bits, which is one instruction.
        let [x, y] = [numbers::count_u32(column), numbers::count_u32(row)].map(f64::from);
        [x + 0.5 - self.centre[0], y + 0.5 - self.centre[1]]
    }

    /// A point such that its x and y divided by its z are its place on the picture.
    pub fn homogeneous(&self, point: Vector3<f64>) -> Vector3<f64> {
        Vector3::new(
            point.x,
            point.y,
            if self.perspective { point.z } else { 1.0 },
        )
    }

    /// How the closeness on a plane through a point changes from column to column and from row to row. The normal is that of the plane in
    /// view coordinates.
    pub fn closeness_gradient(&self, normal: &Vector3<f64>, point: &Vector3<f64>) -> [f64; 2] {
        let distance = if self.perspective {
            normal.dot(point)
        } else {
            normal.z * (self.far - self.near)
        };
        [normal.x / distance, normal.y / distance]
    }

    #[inline(always)]
    /// The closeness on the plane through three points, on the picture. Not finite where the plane is seen edge-on.
    pub fn closeness_on_plane(&self, [a, b, c]: &[Vector3<f64>; 3]) -> Plane {
        let normal = (b - a).cross(&(c - a));
        let distance = normal.dot(a);
        if self.perspective {
            let over_distance = 1.0 / distance;
            return Plane {
                a: normal.x * over_distance,
                b: normal.y * over_distance,
                c: normal.z * over_distance,
            };
        }
        let (over_z, over_range) = (1.0 / normal.z, 1.0 / (self.far - self.near));
        let [x, y] = [
            normal.x * over_z * over_range,
            normal.y * over_z * over_range,
        ];
        Plane {
            a: x,
            b: y,
            c: (self.far - distance * over_z) * over_range,
        }
    }
}

/// Plane that clips triangles and lines.
#[derive(Debug, Clone, Copy)]
pub enum ClipPlane {
    Near,
    Left,
    Right,
    Bottom,
    Top,
}

impl ClipPlane {
    /// The near plane first: the others mean nothing behind the eye.
    pub const ALL: [Self; 5] = [Self::Near, Self::Left, Self::Right, Self::Bottom, Self::Top];
}

/// A rigid motion into view coordinates.
#[derive(Debug, Clone, Copy)]
pub struct Transform {
    pub rotation: Matrix3<f64>,
    pub translation: Vector3<f64>,
}

impl Transform {
    pub fn apply(&self, point: &[f64; 3]) -> Vector3<f64> {
        self.rotation * Vector3::from(*point) + self.translation
    }
}
