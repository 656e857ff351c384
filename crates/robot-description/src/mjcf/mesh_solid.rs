//! Volume, centre and inertia of what triangles bound.

use nalgebra::{Matrix3, Vector3};

use super::Triangles;

/// Volume, centre, and inertia about it at a density of 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    pub volume: f64,
    pub centre: Vector3<f64>,
    pub inertia: Matrix3<f64>,
}

/// How the volume of a mesh is counted (MuJoCo's `inertia` of a mesh).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Volume {
    /// Each tetrahedron between a triangle and the middle of the surface counts, wherever the triangle looks: of a mesh with hollows, too much.
    #[default]
    Legacy,
    /// What is inside of a closed mesh.
    Exact,
}

/// The solid of a mesh, stretched by a factor for each axis; `None` without volume. As MuJoCo does: the centre is that of the tetrahedra between the triangles
/// and the middle of the surface, volume and inertia are those of the tetrahedra between the triangles and that centre.
pub fn solid(mesh: &Triangles, scale: [f64; 3], volume: Volume) -> Option<Solid> {
    let factors = Vector3::from(scale);
    let at = |corner: u32| {
        mesh.vertices
            .get(corner as usize)
            .map(|v| Vector3::from(*v).component_mul(&factors))
    };
    let triangles = || {
        mesh.corners
            .iter()
            .filter_map(|[a, b, c]| Some([at(*a)?, at(*b)?, at(*c)?]))
    };
    let flip = if scale.iter().product::<f64>() < 0.0 {
        -1.0
    } else {
        1.0
    };
    let counted = |[a, b, c]: &[Vector3<f64>; 3]| {
        let signed = flip * a.dot(&b.cross(c)) / 6.0;
        if volume == Volume::Legacy {
            signed.abs()
        } else {
            signed
        }
    };
    let about = |middle: Vector3<f64>| {
        triangles().map(move |triangle| triangle.map(|corner| corner - middle))
    };
    let middle = middle(triangles())?;
    let (mut total, mut first) = (0.0, Vector3::zeros());
    for triangle in about(middle) {
        let part = counted(&triangle);
        total += part;
        first += triangle.iter().sum::<Vector3<f64>>() * (part / 4.0);
    }
    let centre = middle + first / total;
    let (mut total, mut second) = (0.0, Matrix3::zeros());
    for triangle in about(centre) {
        let part = counted(&triangle);
        let sum: Vector3<f64> = triangle.iter().sum();
        let squares = triangle
            .iter()
            .chain([&sum])
            .map(|v| v * v.transpose())
            .sum::<Matrix3<f64>>();
        total += part;
        second += squares * (part / 20.0);
    }
    let inertia = Matrix3::from_diagonal_element(second.trace()) - second;
    (total > 0.0 && total.is_finite()).then_some(Solid {
        volume: total,
        centre,
        inertia,
    })
}

/// The centre of a surface.
fn middle(triangles: impl Iterator<Item = [Vector3<f64>; 3]>) -> Option<Vector3<f64>> {
    let (mut area, mut sum) = (0.0, Vector3::zeros());
    for [a, b, c] in triangles {
        let part = (b - a).cross(&(c - a)).norm();
        area += part;
        sum += (a + b + c) * (part / 3.0);
    }
    (area > 0.0).then(|| sum / area)
}
