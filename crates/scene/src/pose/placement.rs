//! Poses of objects: local poses, relative frames, setting poses. World poses are in `world`.

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use crate::joint::JointType;
use crate::{
    Data, DynamicFlags, Field, Handle, Kind, Pose, Scene, SceneError, SceneResult, special,
};

/// The frame a pose is expressed in, as scripts name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// The world frame.
    World,
    /// The frame the object lives in: that of its parent, at the moving side of a joint.
    Parent,
    /// The inverse of the absolute pose (`sim.handle_inverse`).
    Inverse,
    /// The frame of an object; for a joint its moving side, unless its fixed side is asked for.
    Object(Handle),
}

impl Frame {
    /// The frame a script means by `raw`.
    pub fn from_raw(raw: i64) -> SceneResult<Self> {
        match raw {
            special::WORLD => Ok(Self::World),
            special::PARENT => Ok(Self::Parent),
            special::INVERSE => Ok(Self::Inverse),
            _ => Handle::from_raw(raw)
                .map(Self::Object)
                .ok_or(SceneError::NoSuchObject),
        }
    }
}

impl From<Frame> for Data {
    fn from(frame: Frame) -> Self {
        let raw = match frame {
            Frame::World => special::WORLD,
            Frame::Parent => special::PARENT,
            Frame::Inverse => special::INVERSE,
            Frame::Object(object) => object.raw(),
        };
        raw.into()
    }
}

/// The part of a pose that a script sets; the rest stays as it is in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Placement {
    /// Only the position, metres.
    Position(Vector3<f64>),
    /// Only the orientation.
    Rotation(UnitQuaternion<f64>),
    /// Position and orientation.
    Pose(Pose),
}

impl Scene {
    /// World pose of the frame the children of `handle` live in: the moving side of joints.
    pub(crate) fn full_world_pose(&self, handle: Handle) -> SceneResult<Pose> {
        let world = self.world_pose(handle)?;
        Ok(self
            .object(handle)?
            .intrinsic_pose()
            .map_or(world, |intrinsic| world * intrinsic))
    }

    /// World pose of the frame `handle` itself lives in.
    pub(crate) fn parent_frame(&self, handle: Handle) -> SceneResult<Pose> {
        self.object(handle)?
            .parent()
            .map_or(Ok(Pose::identity()), |parent| self.full_world_pose(parent))
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
            Frame::Object(other) if !joint_base && object.parent() == Some(other) => {
                Ok(object.pose())
            }
            Frame::Object(_) => {
                Ok(self.frame_pose(handle, frame, joint_base)?.inverse()
                    * self.world_pose(handle)?)
            }
        }
    }

    /// Puts `handle` at `pose` expressed in `frame`; its children move along.
    pub(crate) fn set_pose_in(
        &mut self,
        handle: Handle,
        pose: Pose,
        frame: Frame,
        joint_base: bool,
    ) -> SceneResult<()> {
        let pose = if frame == Frame::Inverse {
            pose.inverse()
        } else {
            pose
        };
        let local = self
            .frame_to_parent(handle, frame, joint_base)?
            .map_or(pose, |to_parent| to_parent * pose);
        self.set_local_pose(handle, local)
    }

    /// Puts `handle` at `pose` in its parent's frame.
    ///
    /// # Errors
    /// When the pose is not valid: see [`is_valid_pose`].
    pub fn set_local_pose(&mut self, handle: Handle, pose: Pose) -> SceneResult<()> {
        if !is_valid_pose(&pose) {
            return Err(SceneError::InvalidData);
        }
        self.modify(handle, Field::Pose, |object| object.pose = normalized(pose))
    }

    /// Puts `handle` at `pose` in the world.
    pub fn set_world_pose(&mut self, handle: Handle, pose: Pose) -> SceneResult<()> {
        self.set_pose_in(handle, pose, Frame::World, false)
    }

    /// Places `handle` for a script; its children move along. What the physics moves is taken out of it and put back at the
    /// new place, so that it loses its velocity; not so where a joint or sensor is placed, which takes the bodies behind it along.
    pub fn place(
        &mut self,
        handle: Handle,
        placement: Placement,
        frame: Frame,
        joint_base: bool,
    ) -> SceneResult<()> {
        let local = self.local_pose_of(handle, placement, frame, joint_base)?;
        self.set_local_pose(handle, local)?;
        let object = self.object(handle)?;
        if object.dynamic_flag.intersects(!DynamicFlags::RESPONDABLE)
            && !matches!(object.kind, Kind::Joint(_) | Kind::ForceSensor(_))
        {
            self.reset_dynamics_below(handle)?;
        }
        Ok(())
    }

    /// The pose in the parent's frame that `placement` means.
    pub(super) fn local_pose_of(
        &self,
        handle: Handle,
        placement: Placement,
        frame: Frame,
        joint_base: bool,
    ) -> SceneResult<Pose> {
        let object = self.object(handle)?;
        let to_local = self
            .frame_to_parent(handle, frame, joint_base)?
            .unwrap_or_else(Pose::identity);
        let inverse = frame == Frame::Inverse;
        Ok(match placement {
            Placement::Pose(pose) => to_local * if inverse { pose.inverse() } else { pose },
            Placement::Position(position) => {
                let position = to_local * nalgebra::Point3::from(position);
                Pose::from_parts(Translation3::from(position), object.pose().rotation)
            }
            Placement::Rotation(rotation) => {
                let rotation = if inverse {
                    rotation.inverse()
                } else {
                    rotation
                };
                Pose::from_parts(object.pose().translation, to_local.rotation * rotation)
            }
        })
    }

    /// From `frame` to the frame `handle` lives in; None where the two are the same.
    fn frame_to_parent(
        &self,
        handle: Handle,
        frame: Frame,
        joint_base: bool,
    ) -> SceneResult<Option<Pose>> {
        let parent = self.object(handle)?.parent();
        let is_same = match frame {
            Frame::Parent => true,
            Frame::World => parent.is_none(),
            Frame::Object(other) => !joint_base && parent == Some(other),
            Frame::Inverse => false,
        };
        if is_same {
            return Ok(None);
        }
        Ok(Some(
            self.parent_frame(handle)?.inverse() * self.frame_pose(handle, frame, joint_base)?,
        ))
    }

    /// Requests that the physics rebuilds `handle` and all below it.
    pub(crate) fn reset_dynamics_below(&mut self, handle: Handle) -> SceneResult<()> {
        for object in self.subtree(handle) {
            self.modify(object, Field::Dynamics, |object| {
                object.dynamics_reset = true;
            })?;
        }
        Ok(())
    }

    /// Turns the moving side of a spherical joint; false when `handle` is anything else.
    pub fn set_spherical_rotation(
        &mut self,
        handle: Handle,
        rotation: UnitQuaternion<f64>,
    ) -> SceneResult<bool> {
        match &self.object(handle)?.kind {
            Kind::Joint(joint) if joint.joint_type == JointType::Spherical => {}
            _ => return Ok(false),
        }
        self.try_modify(handle, Field::JointPosition, |object| {
            object.joint_mut()?.spherical = rotation;
            Ok(true)
        })
    }
}

/// Largest coordinate of a position, metres. Beyond it, composing the poses of a chain of objects could overflow.
const MAX_TRANSLATION: f64 = 1e100;

/// Whether all numbers of a pose are finite, and small enough that composed poses are finite too.
pub fn is_valid_pose(pose: &Pose) -> bool {
    pose.translation
        .vector
        .iter()
        .all(|x| x.abs() <= MAX_TRANSLATION)
        && pose.rotation.coords.iter().all(|x| x.is_finite())
}

/// The pose with a rotation of length one. Composing poses lets the length drift, and each further composition doubles the
/// error.
pub fn normalized(pose: Pose) -> Pose {
    const ROUNDING: f64 = 1e-13;
    let mut rotation = pose.rotation;
    let length = rotation.norm_squared();
    if length > 0.0 && (length - 1.0).abs() > ROUNDING {
        rotation.renormalize();
    }
    Pose::from_parts(pose.translation, rotation)
}
