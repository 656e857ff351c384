//! Mass, centre of mass and inertia of rigid shapes.
//!
//! As in CoppeliaSim the inertia is stored per unit mass: changing the mass alone rescales the absolute
//! inertia. Masses in kg, lengths in m, absolute inertias in kg m2.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};

use super::primitive::{PrimitiveKind, creation_mass, has_pure_size};
use crate::Mesh;
use crate::pose::{Pose, pose_from_matrix, pose_to_matrix};

/// Smallest mass of a shape (kg).
pub const MIN_MASS: f64 = 1e-7;
/// Smallest principal moment per unit mass (m2).
pub const MIN_MOMENT: f64 = 1e-8;
/// A moment below this part of the largest one is zero but for rounding.
const POSITIVE: f64 = 1e-12;
/// Largest mass (kg), so that no product overflows.
const MAX_MASS: f64 = 1e30;

/// The inertial properties of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// In kg, at least [`MIN_MASS`].
    pub mass: f64,
    /// Centre of mass in the shape frame (m).
    pub com: [f64; 3],
    /// Inertia per unit mass (m2) about the centre of mass, along the axes of the shape frame; symmetric.
    pub inertia: Matrix3<f64>,
}

impl Default for MassProperties {
    /// The mass and inertia of a new mesh, independent of its geometry: 1 kg at the frame, 0.01 m2 about all axes.
    fn default() -> Self {
        Self::diagonal(1.0, [0.01; 3])
    }
}

impl MassProperties {
    /// Mass at the origin with a diagonal inertia per unit mass (m2).
    pub fn diagonal(mass: f64, moments: [f64; 3]) -> Self {
        let mut properties = Self {
            mass: 1.0,
            com: [0.0; 3],
            inertia: Matrix3::from_diagonal(&moments.into()),
        };
        properties.set_mass(mass);
        properties
    }

    /// The mass and inertia from `sim.createPrimitiveShape`, see [`creation_mass`]; `density` in kg/m3.
    pub fn of_primitive_at_creation(kind: PrimitiveKind, size: [f64; 3], density: f64) -> Self {
        match creation_mass(kind, size, density) {
            (_, [0.0, ..]) => Self::default(),
            (mass, moments) => Self::diagonal(mass, moments),
        }
    }

    /// `sim.setShapeMass`: at least [`MIN_MASS`]; the absolute inertia follows. NaN changes nothing.
    pub fn set_mass(&mut self, mass: f64) {
        if !mass.is_nan() {
            self.mass = mass.clamp(MIN_MASS, MAX_MASS);
        }
    }

    /// Absolute inertia (kg m2) about the centre of mass in shape axes, row by row.
    pub fn absolute_inertia(&self) -> [f64; 9] {
        let absolute = self.inertia * self.mass;
        [0, 1, 2, 3, 4, 5, 6, 7, 8].map(|i| absolute[(i / 3, i % 3)])
    }

    /// The frame `sim.getShapeInertia` reports: unrotated, at the centre of mass, in the shape frame.
    pub fn com_matrix(&self) -> [f64; 12] {
        pose_to_matrix(&Pose::translation(self.com[0], self.com[1], self.com[2]))
    }

    /// `sim.setShapeInertia`: `tensor` (kg m2, only the upper triangle is read) about the centre of mass,
    /// along the axes of `frame`, which lies at the centre of mass in the shape frame. Divided by the present
    /// mass. Numbers that are not finite change nothing.
    pub fn set_absolute_inertia(&mut self, tensor: &[f64; 9], frame: &[f64; 12]) {
        let upper = [0, 1, 2, 4, 5, 8].map(|i| tensor[i]);
        if !upper.iter().chain(frame).all(|x| x.is_finite()) {
            return;
        }
        let [xx, xy, xz, yy, yz, zz] = upper;
        let pose = pose_from_matrix(frame);
        let absolute = turned(
            &Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
            &pose.rotation,
        );
        self.inertia = absolute / self.mass;
        for axis in 0..3 {
            let moment = &mut self.inertia[(axis, axis)];
            *moment = moment.max(MIN_MOMENT);
        }
        self.com = pose.translation.vector.into();
    }

    /// The body made of several, each with the pose of its shape frame in the new frame: masses add, the
    /// centre is their mean, inertias follow the parallel axes. `None` for no parts.
    pub fn combine(parts: &[(Pose, MassProperties)]) -> Option<Self> {
        let parts: Vec<Self> = parts
            .iter()
            .map(|(pose, part)| part.reexpressed(pose))
            .collect();
        let mass: f64 = parts.iter().map(|p| p.mass).sum();
        let weighted = |p: &Self| Vector3::from(p.com) * (p.mass / mass);
        let com: Vector3<f64> = parts.iter().map(weighted).sum();
        let about_com =
            |p: &Self| (p.inertia + steiner(&(Vector3::from(p.com) - com))) * (p.mass / mass);
        let inertia = parts.iter().map(about_com).sum();
        (!parts.is_empty()).then(|| Self {
            mass,
            com: com.into(),
            inertia,
        })
    }

    /// The same body in another frame, in which the old shape frame has the pose `old_in_new`.
    pub fn reexpressed(&self, old_in_new: &Pose) -> Self {
        let com = old_in_new.rotation * Vector3::from(self.com) + old_in_new.translation.vector;
        Self {
            mass: self.mass,
            com: com.into(),
            inertia: turned(&self.inertia, &old_in_new.rotation),
        }
    }

    /// The body with all lengths scaled, `sim.scaleObjects`: mass by the cube, inertia per unit mass by the
    /// square, centre of mass linearly. A factor that is not positive and finite changes nothing.
    pub fn scaled(&self, factor: f64) -> Self {
        if !(factor.is_finite() && factor > 0.0) {
            return *self;
        }
        let mut scaled = Self {
            com: self.com.map(|c| c * factor),
            inertia: self.inertia * factor.powi(2),
            ..*self
        };
        scaled.set_mass(self.mass * factor.powi(3));
        scaled
    }

    /// Axes of the principal frame (its rotation in the shape frame) and the moments per unit mass (m2) along
    /// them, ascending and at least [`MIN_MOMENT`]. The axes and order of a diagonal inertia are preserved.
    pub fn principal_axes(&self) -> (UnitQuaternion<f64>, [f64; 3]) {
        let floor = |m: Vector3<f64>| <[f64; 3]>::from(m.map(|x| x.max(MIN_MOMENT)));
        let diagonal = Matrix3::from_diagonal(&self.inertia.diagonal());
        if self.inertia == diagonal || !self.inertia.iter().all(|x| x.is_finite()) {
            return (UnitQuaternion::identity(), floor(self.inertia.diagonal()));
        }
        let scale = self.inertia.amax();
        let Some(eigen) = SymmetricEigen::try_new(self.inertia / scale, f64::EPSILON, 1000) else {
            return (UnitQuaternion::identity(), floor(self.inertia.diagonal()));
        };
        let mut order = [0, 1, 2];
        order.sort_by(|i, j| eigen.eigenvalues[*i].total_cmp(&eigen.eigenvalues[*j]));
        let [x, y, _] = order.map(|i| eigen.eigenvectors.column(i).normalize());
        let axes = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
        let moments = Vector3::from(order.map(|i| eigen.eigenvalues[i] * scale));
        (UnitQuaternion::from_rotation_matrix(&axes), floor(moments))
    }
}

impl MassProperties {
    /// The body as physics moves it. Moments that are not positive, which no body has and no solver inverts, are raised to [`MIN_MOMENT`], and then the
    /// two smaller ones, by equal amounts, until they reach the largest together, as those of any real body do. An inertia whose moments are all
    /// positive stays as it is, to the bit.
    pub fn with_positive_moments(&self) -> Self {
        let (axes, moments) = self.principal_axes();
        let largest = moments.iter().copied().fold(0.0, f64::max);
        let is_positive = |moment: &f64| *moment > MIN_MOMENT && *moment > largest * POSITIVE;
        if moments.iter().all(is_positive) || !self.inertia.iter().all(|x| x.is_finite()) {
            return *self;
        }
        let missing = (2.0 * largest - moments.iter().sum::<f64>()).max(0.0) / 2.0;
        let raised = moments.map(|moment| {
            if moment == largest {
                moment
            } else {
                moment + missing
            }
        });
        Self {
            inertia: turned(&Matrix3::from_diagonal(&raised.into()), &axes),
            ..*self
        }
    }
}

impl MassProperties {
    /// The body as MuJoCo's compiler has it: moments (kg m2) that no body has, of which one is larger than the other two together, all become their mean if they are to be balanced; mass (kg) and moments
    /// are then no smaller than the bounds. Nothing changes where nothing has to.
    pub fn bounded(&self, least_mass: f64, least_moment: f64, is_balanced: bool) -> Self {
        let (axes, per_mass) = self.principal_axes();
        let moments = per_mass.map(|moment| moment * self.mass);
        let [low, middle, high] = sorted(moments);
        let mut wanted = moments;
        if is_balanced && low + middle < high {
            wanted = [(low + middle + high) / 3.0; 3];
        }
        wanted = wanted.map(|moment| moment.max(least_moment));
        let mass = self.mass.max(least_mass);
        if (mass, wanted) == (self.mass, moments) || !mass.is_finite() {
            return *self;
        }
        let per_mass = wanted.map(|moment| moment / mass);
        Self {
            mass,
            inertia: turned(&Matrix3::from_diagonal(&per_mass.into()), &axes),
            ..*self
        }
    }
}

fn sorted(mut numbers: [f64; 3]) -> [f64; 3] {
    numbers.sort_by(f64::total_cmp);
    numbers
}

/// `sim.computeMassAndInertia` for a density in kg/m3: exact for cuboids, balls, ellipsoids, cylinders and
/// capsules that physics knows, else the solid convex hull of the `vertices` (m, shape frame).
///
/// Compounds pass all their vertices and no primitive. `None` (CoppeliaSim's 0) for flat geometry and for a
/// density that is not positive and finite.
pub fn compute_mass_and_inertia(
    primitive: Option<(PrimitiveKind, [f64; 3])>,
    vertices: &[[f64; 3]],
    density: f64,
) -> Option<MassProperties> {
    if !(density.is_finite() && density > 0.0) {
        return None;
    }
    let exact = primitive.and_then(|(kind, size)| exact_solid(kind, size, density));
    exact.or_else(|| solid(&Mesh::convex_hull(vertices)?, density))
}

/// A solid of a density (kg/m3) bounded by a closed mesh; `None` without a positive volume.
pub fn solid(mesh: &Mesh, density: f64) -> Option<MassProperties> {
    let (low, high) = mesh.aabb()?;
    let centre = Vector3::from(low).lerp(&high.into(), 0.5);
    let corner = |i: u32| Vector3::from(mesh.vertices[i as usize]) - centre;
    let tetrahedra: Vec<_> = mesh
        .triangles
        .iter()
        .map(|t| Tetrahedron::new(t.map(corner)))
        .collect();
    let volume: f64 = tetrahedra.iter().map(|t| t.volume).sum();
    let offset = tetrahedra
        .iter()
        .map(|t| t.first * t.volume)
        .sum::<Vector3<f64>>()
        / volume;
    let second = tetrahedra
        .iter()
        .map(|t| t.second * t.volume)
        .sum::<Matrix3<f64>>()
        / volume;
    let second = second - offset * offset.transpose();
    let inertia = Matrix3::from_diagonal_element(second.trace()) - second;
    let usable = volume > 0.0 && inertia.iter().all(|x| x.is_finite());
    let mut properties = MassProperties {
        mass: 1.0,
        com: (centre + offset).into(),
        inertia,
    };
    properties.set_mass(volume * density);
    usable.then_some(properties)
}

/// Volume, mean and second moment of a tetrahedron with one corner at the origin.
struct Tetrahedron {
    volume: f64,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

impl Tetrahedron {
    fn new([a, b, c]: [Vector3<f64>; 3]) -> Self {
        let sum = a + b + c;
        let squares = [a, b, c, sum]
            .iter()
            .map(|v| v * v.transpose())
            .sum::<Matrix3<f64>>();
        Self {
            volume: a.dot(&b.cross(&c)) / 6.0,
            first: sum / 4.0,
            second: squares / 20.0,
        }
    }
}

/// The solids for which MuJoCo has formulas; `None` for the others.
fn exact_solid(kind: PrimitiveKind, size: [f64; 3], density: f64) -> Option<MassProperties> {
    if !(size.iter().all(|s| s.is_finite() && *s > 0.0) && has_pure_size(kind, size)) {
        return None;
    }
    let (mass, moments) = match kind {
        PrimitiveKind::Cuboid | PrimitiveKind::Spheroid | PrimitiveKind::Cylinder => {
            creation_mass(kind, size, density)
        }
        PrimitiveKind::Capsule => capsule(0.5 * size[0], size[2] - size[0], density),
        _ => return None,
    };
    Some(MassProperties::diagonal(mass, moments))
}

/// Mass and per-unit-mass moments of a capsule of radius `r` around a cylinder of length `l`.
fn capsule(r: f64, l: f64, density: f64) -> (f64, [f64; 3]) {
    let (cylinder, balls) = (
        PI * r * r * l * density,
        4.0 / 3.0 * PI * r.powi(3) * density,
    );
    let mass = cylinder + balls;
    let along = (cylinder * r * r / 2.0 + balls * 0.4 * r * r) / mass;
    let ball_across = 0.4 * r * r + 0.375 * r * l + l * l / 4.0;
    let across = (cylinder * (3.0 * r * r + l * l) / 12.0 + balls * ball_across) / mass;
    (mass, [across, across, along])
}

/// A tensor given along axes that `rotation` turns, along the axes it is turned from.
fn turned(tensor: &Matrix3<f64>, rotation: &UnitQuaternion<f64>) -> Matrix3<f64> {
    let r = rotation.to_rotation_matrix();
    let full = r * tensor * r.transpose();
    (full + full.transpose()) * 0.5
}

/// Inertia of a unit mass at `d` about the origin.
fn steiner(d: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(d.norm_squared()) - d * d.transpose()
}

#[cfg(test)]
mod tests;
