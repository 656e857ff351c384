//! Objects that are moved for the length of a query, and then back to where they were.
//!
//! The journal does not record it, so a cache that follows the journal is out of date for [`Displacement::moved`] until it ends.

use super::placement::{Frame, Placement, is_valid_pose, normalized};
use crate::{Handle, Pose, Scene, SceneError, SceneResult};

/// A scene some of whose objects are displaced. They are moved back when this is dropped.
#[derive(Debug)]
pub struct Displacement<'a> {
    scene: &'a mut Scene,
    before: Vec<(Handle, Original)>,
}

/// What an object had before it was displaced.
#[derive(Debug, Clone, Copy)]
enum Original {
    Pose(Pose),
    JointPosition(f64),
}

impl Scene {
    /// Begins a displacement. Nothing has moved yet.
    pub fn displace(&mut self) -> Displacement<'_> {
        Displacement {
            scene: self,
            before: Vec::new(),
        }
    }
}

impl Displacement<'_> {
    /// The scene as it is now.
    pub fn scene(&self) -> &Scene {
        self.scene
    }

    /// The objects that were moved, without those that move along.
    pub fn moved(&self) -> impl Iterator<Item = Handle> + '_ {
        self.before.iter().map(|(handle, _)| *handle)
    }

    /// Places an object as [`Scene::place`] does; the physics is not reset.
    ///
    /// # Errors
    /// When there is no such object, or the resulting pose is not valid.
    pub fn place(&mut self, handle: Handle, placement: Placement, frame: Frame) -> SceneResult<()> {
        let pose = self.scene.local_pose_of(handle, placement, frame, false)?;
        if !is_valid_pose(&pose) {
            return Err(SceneError::InvalidData);
        }
        let object = self.scene.object_mut(handle)?;
        self.before.push((handle, Original::Pose(object.pose)));
        object.pose = normalized(pose);
        Ok(())
    }

    /// Moves a joint (rad, m) as [`Scene::set_joint_position`] does, with the joints that follow it.
    ///
    /// # Errors
    /// For spherical joints, positions that are no number, and objects that are no joints.
    pub fn set_joint_position(&mut self, handle: Handle, position: f64) -> SceneResult<()> {
        let Some(position) = self.scene.accepted_position(handle, position)? else {
            return Ok(());
        };
        for (handle, position) in self.scene.positions_with_followers(handle, position) {
            let joint = self.scene.object_mut(handle)?.joint_mut()?;
            self.before
                .push((handle, Original::JointPosition(joint.position)));
            joint.position = position;
        }
        Ok(())
    }
}

impl Drop for Displacement<'_> {
    fn drop(&mut self) {
        for (handle, original) in self.before.drain(..).rev() {
            let Ok(object) = self.scene.object_mut(handle) else {
                continue;
            };
            match original {
                Original::Pose(pose) => object.pose = pose,
                Original::JointPosition(position) => {
                    drop(object.joint_mut().map(|joint| joint.position = position));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joint::{Joint, JointMode, JointType};
    use crate::object::dummy::Dummy;
    use crate::pose::check_cached_poses;
    use crate::{Kind, Topics, Unread};
    use nalgebra::Vector3;

    fn dummy(scene: &mut Scene, parent: Option<Handle>) -> Handle {
        let handle = scene.add("dummy", Kind::Dummy(Dummy::new(0.01))).unwrap();
        scene.set_parent(handle, parent, true).unwrap();
        handle
    }

    fn joint(scene: &mut Scene, mode: JointMode) -> Handle {
        scene
            .add(
                "joint",
                Kind::Joint(Box::new(Joint::new(JointType::Prismatic, mode))),
            )
            .unwrap()
    }

    fn x_of(scene: &Scene, handle: Handle) -> f64 {
        scene.world_pose(handle).unwrap().translation.vector.x
    }

    #[test]
    fn objects_go_back_and_the_journal_stays_silent() {
        let mut scene = Scene::new();
        let base = dummy(&mut scene, None);
        let below = dummy(&mut scene, Some(base));
        let mut cursor = scene.journal().follow(Topics::ALL);
        let _ = scene.journal().read(&mut cursor);
        let mut displaced = scene.displace();
        for x in [1.0, 2.0] {
            displaced
                .place(
                    base,
                    Placement::Position(Vector3::new(x, 0.0, 0.0)),
                    Frame::World,
                )
                .unwrap();
            assert_eq!(x_of(displaced.scene(), below), x);
        }
        assert_eq!(displaced.moved().collect::<Vec<_>>(), [base, base]);
        drop(displaced);
        assert_eq!(x_of(&scene, below), 0.0);
        let Unread::Changes(changes) = scene.journal().read(&mut cursor) else {
            panic!("few changes")
        };
        assert_eq!(changes.count(), 0);
    }

    #[test]
    fn cached_poses_are_right_before_and_after() {
        check_cached_poses(3_000, |scene, _| {
            let handles: Vec<Handle> = scene.objects().map(crate::Object::handle).collect();
            let mut displaced = scene.displace();
            for &handle in handles.iter().step_by(3) {
                let there = Placement::Position(Vector3::new(1.0, 2.0, 3.0));
                displaced.place(handle, there, Frame::World).unwrap();
                assert!(
                    (displaced
                        .scene()
                        .world_pose(handle)
                        .unwrap()
                        .translation
                        .vector
                        .x
                        - 1.0)
                        .abs()
                        < 1e-9
                );
            }
        });
    }

    #[test]
    fn joints_take_their_followers_along_and_stay_in_their_limits() {
        let mut scene = Scene::new();
        let (master, follower) = (
            joint(&mut scene, JointMode::Kinematic),
            joint(&mut scene, JointMode::Dependent),
        );
        scene
            .set_joint_dependency(follower, Some(master), 0.1, 2.0)
            .unwrap();
        let position =
            |scene: &Scene, handle: Handle| scene.object(handle).unwrap().joint().unwrap().position;
        let mut displaced = scene.displace();
        displaced.set_joint_position(master, 7.0).unwrap();
        assert_eq!(
            (
                position(displaced.scene(), master),
                position(displaced.scene(), follower)
            ),
            (0.5, 1.1)
        );
        drop(displaced);
        assert_eq!(
            (position(&scene, master), position(&scene, follower)),
            (0.0, 0.1)
        );
    }

    #[test]
    fn what_cannot_be_placed_is_refused() {
        let mut scene = Scene::new();
        let base = dummy(&mut scene, None);
        let mut displaced = scene.displace();
        let nowhere = Placement::Position(Vector3::new(f64::NAN, 0.0, 0.0));
        assert_eq!(
            displaced.place(base, nowhere, Frame::World),
            Err(SceneError::InvalidData)
        );
        assert!(displaced.set_joint_position(base, 0.0).is_err());
        assert_eq!(displaced.moved().count(), 0);
    }
}
