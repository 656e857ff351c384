//! Random numbers and geometries, the same on every run.

use geometry::Pose;
use geometry::pose::pose_from_array;
use test_support::random;

use crate::TriangleMesh;

pub struct Random(random::Random);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(random::Random::new(seed))
    }

    pub fn below(&mut self, end: u32) -> u32 {
        self.0.below(end as usize) as u32
    }

    /// Between -1 and 1.
    pub fn number(&mut self) -> f64 {
        self.0.signed()
    }

    pub fn point(&mut self, size: f64) -> [f64; 3] {
        self.0.vector().map(|x| x * size)
    }

    pub fn pose(&mut self, size: f64) -> Pose {
        let [x, y, z] = self.point(size);
        pose_from_array(&[
            x,
            y,
            z,
            self.number(),
            self.number(),
            self.number(),
            self.number(),
        ])
    }

    /// Triangles anywhere, some of which share corners, are flat or have one corner only.
    pub fn mesh(&mut self, triangles: u32, size: f64) -> TriangleMesh {
        let vertices: Vec<[f64; 3]> = (0..triangles + 3).map(|_| self.point(size)).collect();
        let indices: Vec<[u32; 3]> = (0..triangles)
            .map(|_| [(); 3].map(|()| self.below(triangles + 3)))
            .collect();
        TriangleMesh::new(&vertices, &[&indices[..], &[[0, 1, 2]]].concat())
            .expect("the last triangle has an area")
    }
}
