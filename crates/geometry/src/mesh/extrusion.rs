//! The mesh of a section moved along a path.

use nalgebra::Vector3;

use super::{Mesh, MeshError};
use crate::Pose;

/// Points of a section closer than this are one, metres.
const SAME_POINT: f64 = 1e-9;

/// How the section follows the path.
#[derive(Debug, Clone, Copy)]
pub struct Extrusion {
    /// The last pose is followed by the first.
    pub closed: bool,
    /// The y of the section is turned towards it, and its z goes along the path; without it, the poses say how the section lies.
    pub up: Option<[f64; 3]>,
}

impl Extrusion {
    /// The surface that `section` (points x, y) covers on its way. It is open at both ends of the path. A section whose last point is
    /// its first is closed.
    ///
    /// # Errors
    /// [`MeshError::Empty`] for fewer than two poses or points, [`MeshError::NotFinite`].
    pub fn mesh(self, path: &[Pose], section: &[[f64; 2]]) -> Result<Mesh, MeshError> {
        if path.len() < 2 || section.len() < 2 {
            return Err(MeshError::Empty);
        }
        let mut frames = match self.up {
            Some(up) => self.directed(path, Vector3::from(up)),
            None => path
                .iter()
                .map(|pose| {
                    axes(
                        pose,
                        pose.rotation * Vector3::x(),
                        pose.rotation * Vector3::y(),
                    )
                })
                .collect(),
        };
        if self.closed {
            frames.push(frames[0]);
        }
        let place = |[origin, x, y]: &[Vector3<f64>; 3], [u, v]: &[f64; 2]| {
            (origin + x * *u + y * *v).into()
        };
        let vertices = frames
            .iter()
            .flat_map(|frame| section.iter().map(move |point| place(frame, point)))
            .collect();
        let mut mesh = Mesh::new(vertices, bands(frames.len(), section.len()))?;
        mesh.merge_duplicates(SAME_POINT);
        if mesh.triangles.is_empty() {
            Err(MeshError::Empty)
        } else {
            Ok(mesh)
        }
    }

    /// Origin, x and y of the section at each pose, with its z along the path.
    fn directed(self, path: &[Pose], up: Vector3<f64>) -> Vec<[Vector3<f64>; 3]> {
        let at = |i: usize| path[i].translation.vector;
        let last = path.len() - 1;
        let mut side = Vector3::x();
        let mut frames = Vec::new();
        for (i, pose) in path.iter().enumerate() {
            let before = if i > 0 {
                i - 1
            } else if self.closed {
                last
            } else {
                0
            };
            let after = if i < last {
                i + 1
            } else if self.closed {
                0
            } else {
                last
            };
            let along = (at(after) - at(before))
                .try_normalize(0.0)
                .unwrap_or_else(Vector3::z);
            // Where the path goes straight up, the section keeps its side.
            side = up
                .cross(&along)
                .try_normalize(1e-9 * up.norm())
                .unwrap_or(side);
            frames.push(axes(pose, side, along.cross(&side)));
        }
        frames
    }
}

fn axes(pose: &Pose, x: Vector3<f64>, y: Vector3<f64>) -> [Vector3<f64>; 3] {
    [pose.translation.vector, x, y]
}

/// Two triangles between each pair of neighbours of each pair of sections.
fn bands(sections: usize, points: usize) -> Vec<[u32; 3]> {
    let index = |section: usize, point: usize| (section * points + point) as u32;
    let quads = (0..sections - 1).flat_map(|s| (0..points - 1).map(move |p| (s, p)));
    let triangles = |(s, p)| {
        let (a, b, c, d) = (
            index(s, p),
            index(s, p + 1),
            index(s + 1, p + 1),
            index(s + 1, p),
        );
        [[a, b, c], [a, c, d]]
    };
    quads.flat_map(triangles).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 5] = [
        [0.1, -0.1],
        [0.1, 0.1],
        [-0.1, 0.1],
        [-0.1, -0.1],
        [0.1, -0.1],
    ];

    #[test]
    fn a_straight_tube() {
        let path = [
            Pose::translation(0.0, 0.0, 0.0),
            Pose::translation(2.0, 0.0, 0.0),
        ];
        let mesh = Extrusion {
            closed: false,
            up: Some([0.0, 0.0, 1.0]),
        }
        .mesh(&path, &SQUARE)
        .unwrap();
        assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (8, 8));
        let (low, high) = mesh.aabb().unwrap();
        assert_eq!((low, high), ([0.0, -0.1, -0.1], [2.0, 0.1, 0.1]));
        // Without the ends, a third of what is enclosed is missing at most: the sign shows that normals point outward.
        assert!(mesh.volume() > 0.0);
    }

    #[test]
    fn a_ring_is_closed() {
        let pose = |i: u32| {
            let angle = f64::from(i) * std::f64::consts::TAU / 64.0;
            Pose::translation(angle.cos(), angle.sin(), 0.0)
        };
        let path: Vec<Pose> = (0..64).map(pose).collect();
        let mesh = Extrusion {
            closed: true,
            up: Some([0.0, 0.0, 1.0]),
        }
        .mesh(&path, &SQUARE)
        .unwrap();
        assert!(
            (mesh.volume() - 0.04 * std::f64::consts::TAU).abs() < 1e-3,
            "{}",
            mesh.volume()
        );
        let flat = Extrusion {
            closed: false,
            up: None,
        };
        assert_eq!(flat.mesh(&path[..1], &SQUARE), Err(MeshError::Empty));
        assert_eq!(
            flat.mesh(&path, &[[f64::NAN, 0.0]; 3]),
            Err(MeshError::NotFinite)
        );
    }
}
