//! Where objects are: local and world poses, relative frames.

use super::{Field, Handle, Pose, Scene, SceneError, SceneResult, special};

/// The frame a pose is expressed in, as scripts name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    World,
    Parent,
    /// The inverse of the absolute pose (`sim.handle_inverse`).
    Inverse,
    Object(Handle),
}

impl Frame {
    /// The frame a script means by `raw`.
    pub fn from_raw(raw: i64) -> SceneResult<Self> {
        match raw {
            special::WORLD => Ok(Self::World),
            special::PARENT => Ok(Self::Parent),
            special::INVERSE => Ok(Self::Inverse),
            _ => Handle::from_raw(raw).map(Self::Object).ok_or(SceneError::NoSuchObject),
        }
    }
}

impl Scene {
    /// Pose in the world.
    pub fn world_pose(&self, handle: Handle) -> SceneResult<Pose> {
        let object = self.object(handle)?;
        let mut pose = object.pose();
        let mut above = object.parent();
        while let Some(parent) = above {
            let parent = self.object(parent)?;
            if let Some(intrinsic) = parent.intrinsic_pose() {
                pose = intrinsic * pose;
            }
            pose = parent.pose() * pose;
            above = parent.parent();
        }
        Ok(pose)
    }

    /// World pose of the frame the children of `handle` live in: the moving side of joints.
    pub fn full_world_pose(&self, handle: Handle) -> SceneResult<Pose> {
        let world = self.world_pose(handle)?;
        Ok(self.object(handle)?.intrinsic_pose().map_or(world, |intrinsic| world * intrinsic))
    }

    /// World pose of the frame `handle` itself lives in.
    pub fn parent_frame(&self, handle: Handle) -> SceneResult<Pose> {
        self.object(handle)?.parent().map_or(Ok(Pose::identity()), |parent| self.full_world_pose(parent))
    }

    /// World pose of `frame` as seen from `handle`. With `joint_base`, a joint means its fixed side.
    fn frame_pose(&self, handle: Handle, frame: Frame, joint_base: bool) -> SceneResult<Pose> {
        match frame {
            Frame::World | Frame::Inverse => Ok(Pose::identity()),
            Frame::Parent => self.parent_frame(handle),
            Frame::Object(other) if joint_base => self.world_pose(other),
            Frame::Object(other) => self.full_world_pose(other),
        }
    }

    /// Pose of `handle` in `frame`.
    pub fn pose_in(&self, handle: Handle, frame: Frame, joint_base: bool) -> SceneResult<Pose> {
        let object = self.object(handle)?;
        match frame {
            Frame::World => self.world_pose(handle),
            Frame::Inverse => Ok(self.world_pose(handle)?.inverse()),
            // Straight from the store, so that a get and set loop does not drift.
            Frame::Parent => Ok(object.pose()),
            Frame::Object(other) if !joint_base && object.parent() == Some(other) => Ok(object.pose()),
            Frame::Object(_) => Ok(self.frame_pose(handle, frame, joint_base)?.inverse() * self.world_pose(handle)?),
        }
    }

    /// Puts `handle` at `pose` expressed in `frame`; its children move along.
    pub fn set_pose_in(&mut self, handle: Handle, pose: Pose, frame: Frame, joint_base: bool) -> SceneResult<()> {
        let parent = self.object(handle)?.parent();
        let local = match frame {
            Frame::Parent => pose,
            Frame::Object(other) if !joint_base && parent == Some(other) => pose,
            Frame::World if parent.is_none() => pose,
            Frame::Inverse => self.parent_frame(handle)?.inverse() * pose.inverse(),
            _ => self.parent_frame(handle)?.inverse() * self.frame_pose(handle, frame, joint_base)? * pose,
        };
        self.set_local_pose(handle, local)
    }

    /// Puts `handle` at `pose` in its parent's frame.
    pub fn set_local_pose(&mut self, handle: Handle, pose: Pose) -> SceneResult<()> {
        self.modify(handle, Field::Pose, |object| object.pose = pose)
    }

    /// Puts `handle` at `pose` in the world.
    pub fn set_world_pose(&mut self, handle: Handle, pose: Pose) -> SceneResult<()> {
        self.set_pose_in(handle, pose, Frame::World, false)
    }
}
