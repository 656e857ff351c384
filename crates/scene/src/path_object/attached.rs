//! Paths in a scene: their position, and the dummies that move with it (spec: vrep-era 3.5).

use nalgebra::Point3;

use super::PathObject;
use crate::{Field, Frame, Handle, Placement, Pose, Scene, SceneError, SceneResult};

/// How a dummy moves with the path it belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Attachment {
    /// At the position of its parent path, plus its offset.
    Fixed,
    /// On the point of its parent path that is closest to it.
    Free,
    /// Somewhere below a path: it is turned as the closest point of it.
    Orientation,
}

/// How a dummy follows a path, as files store it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PathFollowing {
    /// Bit 1: assigned to the parent path, bit 2: free, bit 3: orientation only.
    pub bits: u8,
    /// Metres of length. The second number is the first of the file.
    pub offsets: [f64; 2],
}

impl PathFollowing {
    /// The bits that have a meaning.
    pub const BITS: u8 = 0xe;

    fn attachment(self, is_child_of_path: bool) -> Option<Attachment> {
        match self.bits {
            bits if bits & 0x2 != 0 && is_child_of_path && bits & 0x4 == 0 => {
                Some(Attachment::Fixed)
            }
            bits if bits & 0x2 != 0 && is_child_of_path => Some(Attachment::Free),
            bits if bits & 0x8 != 0 && !is_child_of_path => Some(Attachment::Orientation),
            _ => None,
        }
    }
}

impl Scene {
    /// All paths in the order of their creation.
    pub fn paths(&self) -> Vec<Handle> {
        self.objects.paths().collect()
    }

    /// Moves the position of a path, and the dummies that move with it.
    ///
    /// # Errors
    /// When the object is no path.
    pub fn set_path_position(&mut self, path: Handle, position: f64) -> SceneResult<()> {
        self.modify_path(path, |path| path.set_position(position))?;
        self.move_attached(path)
    }

    /// Moves the position of a path by `dt` seconds, and the dummies with it.
    ///
    /// # Errors
    /// When the object is no path.
    pub fn handle_path(&mut self, path: Handle, dt: f64) -> SceneResult<()> {
        if self.settings().calculations.paths {
            self.modify_path(path, |path| path.advance(dt))?;
        }
        self.move_attached(path)
    }

    /// Puts a path back to its position and velocities at the start of the simulation.
    ///
    /// # Errors
    /// When the object is no path.
    pub fn reset_path(&mut self, path: Handle) -> SceneResult<()> {
        let initial = self
            .object(path)?
            .initial
            .as_ref()
            .and_then(|initial| initial.path_motion());
        self.modify_path(path, |path| {
            initial
                .into_iter()
                .for_each(|motion| path.restore_motion(motion));
        })?;
        self.move_attached(path)
    }

    /// Changes a path, in a way that does not move it.
    ///
    /// # Errors
    /// When the object is no path.
    pub fn modify_path<R>(
        &mut self,
        path: Handle,
        change: impl FnOnce(&mut PathObject) -> R,
    ) -> SceneResult<R> {
        self.try_modify(path, Field::Sensor, |object| Ok(change(object.path_mut()?)))
    }

    fn move_attached(&mut self, path: Handle) -> SceneResult<()> {
        for dummy in self.subtree(path) {
            let object = self.object(dummy)?;
            let Ok(data) = object.dummy() else { continue };
            let (offset, parent) = (data.path_following.offsets[0], object.parent());
            match data.path_following.attachment(parent == Some(path)) {
                None => {}
                Some(Attachment::Fixed) => {
                    let line = self.object(path)?.path()?;
                    let pose = line.at(line.position() + offset).map(|point| point.pose);
                    self.set_pose_on_path(dummy, pose)?;
                }
                Some(Attachment::Free) => {
                    let pose = closest(self.object(path)?.path()?, &self.object(dummy)?.pose());
                    self.set_pose_on_path(dummy, pose)?;
                }
                Some(Attachment::Orientation) => self.turn_as_path(dummy, path)?,
            }
        }
        Ok(())
    }

    fn set_pose_on_path(&mut self, dummy: Handle, pose: Option<Pose>) -> SceneResult<()> {
        pose.map_or(Ok(()), |pose| self.set_local_pose(dummy, pose))
    }

    fn turn_as_path(&mut self, dummy: Handle, path: Handle) -> SceneResult<()> {
        let world = self.world_pose(path)?;
        let Some(pose) = closest(
            self.object(path)?.path()?,
            &(world.inverse() * self.world_pose(dummy)?),
        ) else {
            return Ok(());
        };
        self.place(
            dummy,
            Placement::Rotation(world.rotation * pose.rotation),
            Frame::World,
            false,
        )
    }

    /// Returns a path that is handled explicitly.
    ///
    /// # Errors
    /// When the object is no path, or is handled together with the others.
    pub fn explicit_path(&self, path: Handle) -> SceneResult<&PathObject> {
        let path = self.object(path)?.path()?;
        if path.explicit {
            Ok(path)
        } else {
            Err(SceneError::NotExplicit)
        }
    }

    /// A point of a path in the world.
    ///
    /// # Errors
    /// When the object does not exist.
    pub fn on_path_in_world(&self, path: Handle, pose: Pose) -> SceneResult<Pose> {
        Ok(self.world_pose(path)? * pose)
    }
}

/// The pose of the point of a path that is closest to a pose in its frame.
fn closest(path: &PathObject, pose: &Pose) -> Option<Pose> {
    let point: Point3<f64> = pose.translation.vector.into();
    path.at(path.closest_position(&point.coords)?)
        .map(|point| point.pose)
}
