//! Random numbers and geometries, the same on every run.

use geometry::Pose;
use geometry::pose::pose_from_array;

use crate::TriangleMesh;

/// A linear congruential generator with permuted output (M. O'Neill, *PCG*, 2014).
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u32 {
        let state = self.0;
        self.0 = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((((state >> 18) ^ state) >> 27) as u32).rotate_right((state >> 59) as u32)
    }

    pub fn below(&mut self, end: u32) -> u32 {
        self.bits() % end
    }

    /// Between -1 and 1.
    pub fn number(&mut self) -> f64 {
        f64::from(self.bits()) / f64::from(u32::MAX) * 2.0 - 1.0
    }

    pub fn point(&mut self, size: f64) -> [f64; 3] {
        [self.number() * size, self.number() * size, self.number() * size]
    }

    pub fn pose(&mut self, size: f64) -> Pose {
        let [x, y, z] = self.point(size);
        pose_from_array(&[x, y, z, self.number(), self.number(), self.number(), self.number()])
    }

    /// Triangles anywhere, some of which share corners, are flat or have one corner only.
    pub fn mesh(&mut self, triangles: u32, size: f64) -> TriangleMesh {
        let vertices: Vec<[f64; 3]> = (0..triangles + 3).map(|_| self.point(size)).collect();
        let indices: Vec<[u32; 3]> = (0..triangles).map(|_| [(); 3].map(|()| self.below(triangles + 3))).collect();
        TriangleMesh::new(&vertices, &[&indices[..], &[[0, 1, 2]]].concat()).expect("the last triangle has an area")
    }
}
