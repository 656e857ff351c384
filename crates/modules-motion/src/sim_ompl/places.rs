//! States in the scene: read from objects and joints, and written to them.

use geometry::pose::euler::{rotation_from_euler, rotation_to_euler};
use geometry::pose::{pose_from_array, pose_to_array};
use nalgebra::{Isometry3, Translation3, Vector3};

use super::Result;
use super::spaces::{Kind, StateSpace};
use scene::pose::displacement::Displacement;
use scene::{Frame, Handle, Placement, Pose, Scene, SceneError, SceneResult};

/// What moves objects: the scene, or a displacement of it.
pub(super) trait Mover {
    fn scene(&self) -> &Scene;
    fn place(&mut self, object: Handle, placement: Placement, frame: Frame) -> SceneResult<()>;
    fn set_joint_position(&mut self, joint: Handle, position: f64) -> SceneResult<()>;
}

impl Mover for Scene {
    fn scene(&self) -> &Scene {
        self
    }

    fn place(&mut self, object: Handle, placement: Placement, frame: Frame) -> SceneResult<()> {
        Scene::place(self, object, placement, frame, false)
    }

    fn set_joint_position(&mut self, joint: Handle, position: f64) -> SceneResult<()> {
        Scene::set_joint_position(self, joint, position).map(drop)
    }
}

impl Mover for Displacement<'_> {
    fn scene(&self) -> &Scene {
        Displacement::scene(self)
    }

    fn place(&mut self, object: Handle, placement: Placement, frame: Frame) -> SceneResult<()> {
        Displacement::place(self, object, placement, frame)
    }

    fn set_joint_position(&mut self, joint: Handle, position: f64) -> SceneResult<()> {
        Displacement::set_joint_position(self, joint, position)
    }
}

/// The present state of some spaces.
///
/// # Errors
/// When an object is gone, or of another type.
pub(super) fn read(spaces: &[StateSpace], scene: &Scene) -> Result<Vec<f64>> {
    let mut state = Vec::new();
    for space in spaces {
        read_one(space, scene, &mut state)?;
    }
    Ok(state)
}

fn object(space: &StateSpace) -> SceneResult<Handle> {
    Handle::from_raw(space.object).ok_or(SceneError::NoSuchObject)
}

fn read_one(space: &StateSpace, scene: &Scene, state: &mut Vec<f64>) -> Result<()> {
    let object = object(space)?;
    if let Some(Kind::JointPosition | Kind::CyclicJointPosition) = space.kind {
        let joint = scene.object(object)?.joint()?;
        joint.single_axis()?;
        state.push(joint.position);
        return Ok(());
    }
    let pose = scene.pose_in(object, space.frame(), false)?;
    let [x, y, z, ..] = pose_to_array(&pose);
    match space.kind {
        Some(Kind::Position2d) => state.extend([x, y]),
        Some(Kind::Position3d) => state.extend([x, y, z]),
        Some(Kind::Pose3d) => state.extend(pose_to_array(&pose)),
        _ => state.extend([x, y, rotation_to_euler(&pose.rotation)[2]]),
    }
    Ok(())
}

/// Moves the objects of some spaces. The state has as many numbers as they have.
///
/// # Errors
/// When an object is gone or of another type, or a number is none.
pub(super) fn write(spaces: &[StateSpace], mover: &mut impl Mover, state: &[f64]) -> Result<()> {
    let mut rest = state;
    for space in spaces {
        let (numbers, others) = rest.split_at(space.dimension());
        write_one(space, mover, numbers)?;
        rest = others;
    }
    Ok(())
}

fn write_one(space: &StateSpace, mover: &mut impl Mover, numbers: &[f64]) -> Result<()> {
    let object = object(space)?;
    match (space.kind, numbers) {
        (Some(Kind::JointPosition | Kind::CyclicJointPosition), &[position]) => {
            mover.set_joint_position(object, position)?;
        }
        (_, &[x, y, z, qx, qy, qz, qw]) => {
            let pose = pose_from_array(&[x, y, z, qx, qy, qz, qw]);
            mover.place(object, Placement::Pose(pose), space.frame())?;
        }
        (Some(Kind::Position3d), &[x, y, z]) => {
            mover.place(
                object,
                Placement::Position(Vector3::new(x, y, z)),
                space.frame(),
            )?;
        }
        (_, &[x, y]) => {
            let height = mover
                .scene()
                .pose_in(object, space.frame(), false)?
                .translation
                .vector
                .z;
            mover.place(
                object,
                Placement::Position(Vector3::new(x, y, height)),
                space.frame(),
            )?;
        }
        (_, &[x, y, angle]) => {
            let pose = turned(
                &mover.scene().pose_in(object, space.frame(), false)?,
                [x, y, angle],
            );
            mover.place(object, Placement::Pose(pose), space.frame())?;
        }
        _ => {}
    }
    Ok(())
}

/// A pose with another x, y and third Euler angle.
fn turned(pose: &Pose, [x, y, angle]: [f64; 3]) -> Pose {
    let [alpha, beta, _] = rotation_to_euler(&pose.rotation);
    let rotation = rotation_from_euler(&[alpha, beta, angle]);
    Isometry3::from_parts(Translation3::new(x, y, pose.translation.vector.z), rotation)
}
