//! Dividing a mesh into convex pieces, by parry's voxels (V-HACD).

use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

use super::Mesh;

/// Meshes thinner than this fraction of their length have no inside to divide.
const MIN_RELATIVE_THICKNESS: f64 = 1e-4;
/// Minimum and maximum number of voxels along the longest side: memory is proportional to its cube.
const SIDES: [f64; 2] = [8.0, 256.0];

/// Largest step between the voxels that are examined.
const MAX_DOWNSAMPLING: u32 = 16;

/// Parameters of a convex decomposition.
#[derive(Debug, Clone, Copy)]
pub struct DecompositionParameters {
    /// In a cube around the mesh.
    pub voxels: f64,
    /// Maximum difference between a piece and its hull, as a fraction of the volume.
    pub concavity: f64,
    /// Voxels between the planes that are tried as cuts.
    pub plane_downsampling: u32,
    /// Voxels that a hull steps over when it collects its points.
    pub hull_downsampling: u32,
    /// Weight of cuts along planes of symmetry.
    pub alpha: f64,
    /// Weight of cuts along axes of revolution.
    pub beta: f64,
}

impl Default for DecompositionParameters {
    fn default() -> Self {
        let default = VHACDParameters::default();
        Self {
            voxels: f64::from(default.resolution).powi(3),
            concavity: default.concavity,
            plane_downsampling: default.plane_downsampling,
            hull_downsampling: default.convex_hull_downsampling,
            alpha: default.alpha,
            beta: default.beta,
        }
    }
}

impl DecompositionParameters {
    fn parameters(self) -> VHACDParameters {
        VHACDParameters {
            resolution: libm::cbrt(self.voxels).round().clamp(SIDES[0], SIDES[1]) as u32,
            concavity: self.concavity,
            plane_downsampling: self.plane_downsampling.clamp(1, MAX_DOWNSAMPLING),
            convex_hull_downsampling: self.hull_downsampling.clamp(1, MAX_DOWNSAMPLING),
            alpha: self.alpha,
            beta: self.beta,
            ..VHACDParameters::default()
        }
    }
}

impl Mesh {
    /// Convex pieces that together are about this mesh; none when it is flat. A convex mesh is its own hull.
    pub fn convex_pieces(&self, fineness: DecompositionParameters) -> Vec<Mesh> {
        if self.is_convex() {
            return Mesh::convex_hull(&self.vertices).into_iter().collect();
        }
        let Some((low, high)) = self.aabb() else {
            return Vec::new();
        };
        let (low, size) = (Vector3::from(low), Vector3::from(high) - Vector3::from(low));
        if !size.max().is_finite() || size.min() <= MIN_RELATIVE_THICKNESS * size.max() {
            return Vec::new();
        }
        // parry's tolerances are absolute: it gets a mesh of unit size.
        let scale = size.max();
        let points: Vec<Vector> = self
            .points()
            .iter()
            .map(|p| Vector::from_array(((p - low) / scale).into()))
            .collect();
        let parameters = fineness.parameters();
        let parts = VHACD::decompose(&parameters, &points, &self.triangles, false);
        let back = |p: &Vector| <[f64; 3]>::from(Vector3::from(p.to_array()) * scale + low);
        let hulls = parts.compute_convex_hulls(parameters.convex_hull_downsampling);
        hulls
            .iter()
            .filter_map(|(points, _)| {
                Mesh::convex_hull(&points.iter().map(back).collect::<Vec<_>>())
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pose;
    use crate::mesh::samples::{block, tetrahedron};

    #[test]
    fn an_angle_is_two_blocks() {
        let mut angle = block([1.0, 0.2, 0.2]);
        angle.append(&block([0.2, 1.0, 0.2]), &Pose::translation(0.4, 0.5, 0.0));
        let pieces = angle.convex_pieces(DecompositionParameters::default());
        let volume: f64 = pieces.iter().map(Mesh::volume).sum();
        assert!(pieces.len() >= 2 && pieces.iter().all(Mesh::is_convex));
        assert!((volume - 0.072).abs() < 0.012, "{volume}");
    }

    #[test]
    fn what_is_convex_or_flat() {
        assert_eq!(
            tetrahedron()
                .convex_pieces(DecompositionParameters::default())
                .len(),
            1
        );
        let flat = Mesh::new(
            vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]],
            vec![[0, 1, 2]],
        )
        .unwrap();
        assert!(
            flat.convex_pieces(DecompositionParameters::default())
                .is_empty()
        );
    }
}
