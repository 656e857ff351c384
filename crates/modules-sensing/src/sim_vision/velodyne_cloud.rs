//! The point cloud a laser scanner of `simVision` fills.

use nalgebra::Point3;

use super::velodyne::Points;
use crate::{Cx, Result};
use scene::numbers;
use scene::voxels::point_cloud::CloudPoint;
use scene::{Field, Handle, Pose};

/// Where the points of a scanner go.
#[derive(Clone, Copy)]
pub(super) struct TargetCloud {
    pub(super) handle: Handle,
    /// It holds the points of the last call only.
    pub(super) is_current_only: bool,
}

impl TargetCloud {
    /// Adds points, which are in the frame of `front`, the pose of the front sensor in the world.
    ///
    /// # Errors
    /// When the point cloud is gone.
    pub(super) fn fill(self, cx: &mut Cx, front: &Pose, points: &Points) -> Result<()> {
        let mut scene = cx.scene_mut();
        let to_cloud = scene.world_pose(self.handle)?.inverse() * front;
        let own_colour = scene
            .object(self.handle)?
            .colour
            .ambient_diffuse
            .map(|part| numbers::level((255.0 * part).into()));
        let colours = points.colours.as_chunks::<3>().0;
        let added = points
            .places
            .iter()
            .enumerate()
            .map(|(n, place)| CloudPoint {
                position: (to_cloud * Point3::from(*place)).into(),
                colour: colours.get(n).copied().unwrap_or(own_colour),
            });
        Ok(scene.try_modify(self.handle, Field::Geometry, |object| {
            let cloud = object.point_cloud_mut()?;
            if self.is_current_only {
                cloud.points.clear();
            }
            cloud.insert(added, 0.0);
            Ok(())
        })?)
    }
}
