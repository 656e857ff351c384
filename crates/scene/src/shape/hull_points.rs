//! Points for the convex hull of objects.

use nalgebra::Point3;

use crate::voxels::octree::OcTree;
use crate::{Handle, Kind, Scene, SceneResult};

impl Scene {
    /// In the world: vertices of a shape, the place of a dummy, points of a point cloud, corners of an octree's cells; none of others.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn points_for_hull(&self, handle: Handle) -> SceneResult<Vec<[f64; 3]>> {
        let object = self.object(handle)?;
        let points = match &object.kind {
            Kind::Shape(shape) => shape.mesh().vertices.clone(),
            Kind::Dummy(_) => vec![[0.0; 3]],
            Kind::PointCloud(cloud) => cloud.points.iter().map(|point| point.position).collect(),
            Kind::OcTree(tree) => corners(tree),
            _ => Vec::new(),
        };
        let pose = self.world_pose(handle)?;
        Ok(points
            .into_iter()
            .map(|point| (pose * Point3::from(point)).into())
            .collect())
    }
}

fn corners(tree: &OcTree) -> Vec<[f64; 3]> {
    let half = tree.voxel_size() / 2.0;
    let of = |centre: [f64; 3]| {
        (0..8).map(move |i| {
            [0, 1, 2].map(|axis| centre[axis] + if i >> axis & 1 == 0 { -half } else { half })
        })
    };
    tree.voxels().flat_map(|(centre, _)| of(centre)).collect()
}
