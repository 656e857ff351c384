//! Dividing a mesh into convex pieces, by parry's voxels (V-HACD).

use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

use super::mesh::Mesh;

/// Meshes thinner than this part of their length have no inside to divide.
const FLATTEST: f64 = 1e-4;
/// How many voxels a hull steps over when it collects its points.
const DOWNSAMPLING: u32 = 4;

impl Mesh {
    /// Convex pieces that together are about this mesh; none when it is flat. A convex mesh is its own hull.
    pub fn convex_pieces(&self) -> Vec<Mesh> {
        if self.is_convex() {
            return Mesh::convex_hull(&self.vertices).into_iter().collect();
        }
        let Some((low, high)) = self.aabb() else { return Vec::new() };
        let (low, size) = (Vector3::from(low), Vector3::from(high) - Vector3::from(low));
        if !size.max().is_finite() || size.min() <= FLATTEST * size.max() {
            return Vec::new();
        }
        // parry's tolerances are absolute: it gets a mesh of unit size.
        let scale = size.max();
        let points: Vec<Vector> =
            self.points().iter().map(|p| Vector::from_array(((p - low) / scale).into())).collect();
        let parts = VHACD::decompose(&VHACDParameters::default(), &points, &self.triangles, false);
        let back = |p: &Vector| <[f64; 3]>::from(Vector3::from(p.to_array()) * scale + low);
        let hulls = parts.compute_convex_hulls(DOWNSAMPLING);
        hulls.iter().filter_map(|(points, _)| Mesh::convex_hull(&points.iter().map(back).collect::<Vec<_>>())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::Pose;
    use super::super::mesh::samples::{block, tetrahedron};
    use super::*;

    #[test]
    fn an_angle_is_two_blocks() {
        let mut angle = block([1.0, 0.2, 0.2]);
        angle.append(&block([0.2, 1.0, 0.2]), &Pose::translation(0.4, 0.5, 0.0));
        let pieces = angle.convex_pieces();
        let volume: f64 = pieces.iter().map(Mesh::volume).sum();
        assert!(pieces.len() >= 2 && pieces.iter().all(Mesh::is_convex));
        assert!((volume - 0.072).abs() < 0.012, "{volume}");
    }

    #[test]
    fn what_is_convex_or_flat() {
        assert_eq!(tetrahedron().convex_pieces().len(), 1);
        let flat = Mesh::new(vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]], vec![[0, 1, 2]]).unwrap();
        assert!(flat.convex_pieces().is_empty());
    }
}
