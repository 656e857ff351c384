//! Sites, and what holds joints or links together beside the joints of the tree.

use robot_description::mjcf::Equality;
use robot_description::{Joint as JointDescription, Mimic};

use super::{Import, RobotFormat, joints};
use scene::joint::{Joint, JointMode, JointType};
use scene::object::dummy::{Dummy, LinkType};
use scene::{Field, Handle, Kind, Layers, Pose, SceneResult};

impl Import<'_> {
    /// Adds the sites as dummies below the links that they are on.
    pub(super) fn add_sites(&mut self) -> SceneResult<()> {
        for site in &self.model.sites {
            let parent = self.nodes[site.link].carrier;
            let pose = self.placed[site.link] * site.pose;
            let dummy = self.add_dummy(&site.name, pose, parent)?;
            // Of several of a name the first one is meant.
            self.sites.entry(site.name.clone()).or_insert(dummy);
        }
        Ok(())
    }

    fn add_dummy(&mut self, name: &str, pose: Pose, parent: Option<Handle>) -> SceneResult<Handle> {
        self.add(name, Kind::Dummy(Dummy::new(joints::DUMMY)), pose, parent)
    }

    /// Joints that others lead, and loops.
    pub(super) fn add_constraints(&mut self) -> SceneResult<()> {
        for (index, joint) in self.robot.joints.iter().enumerate() {
            if let Some(Mimic {
                joint: master,
                multiplier,
                offset,
            }) = joint.mimic
                && self.can_follow(joint, master)
            {
                self.lead(index, master, offset, multiplier)?;
            }
        }
        // A loop in URDF is a mistake, of which the reader has said more.
        if self.format != RobotFormat::Urdf {
            self.close_loops()?;
        }
        for equality in &self.model.equalities {
            match equality {
                Equality::Joint {
                    joint,
                    master,
                    polynomial,
                    line,
                } => {
                    self.add_equal_joint(*joint, *master, *polynomial, *line)?;
                }
                Equality::Connect {
                    links,
                    points,
                    line,
                } => {
                    let frames = points.map(|[x, y, z]| Pose::translation(x, y, z));
                    self.connect(
                        &format!("connect_{line}"),
                        *links,
                        frames,
                        Some(JointType::Spherical),
                    )?;
                }
                Equality::Weld {
                    links,
                    frames,
                    line,
                } => {
                    self.connect(&format!("weld_{line}"), *links, *frames, None)?;
                }
            }
        }
        Ok(())
    }

    /// Joints whose links are connected by others already.
    fn close_loops(&mut self) -> SceneResult<()> {
        for index in self.robot.loop_joints() {
            let JointDescription {
                name,
                parent,
                child,
                line,
                ..
            } = &self.robot.joints[index];
            let (parent, child) = (
                &self.robot.links[*parent].name,
                &self.robot.links[*child].name,
            );
            self.message(format!(
                "line {line}: joint '{name}' closes a loop from '{parent}' to '{child}', and is not imported"
            ));
        }
        Ok(())
    }

    fn add_equal_joint(
        &mut self,
        joint: usize,
        master: Option<usize>,
        polynomial: [f64; 5],
        line: u32,
    ) -> SceneResult<()> {
        let [constant, factor, rest @ ..] = polynomial;
        let (Some(master), true) = (master, rest == [0.0; 3]) else {
            let what = if master.is_none() {
                "to a constant"
            } else {
                "by a curve"
            };
            self.message(format!(
                "line {line}: a joint that is bound {what} is not imported"
            ));
            return Ok(());
        };
        let [own, other] = [joint, master].map(|joint| self.robot.joints[joint].reference);
        self.lead(joint, master, own + constant - factor * other, factor)
    }

    /// Only what turns or slides follows, and is followed.
    fn can_follow(&mut self, joint: &JointDescription, master: usize) -> bool {
        let master = &self.robot.joints[master];
        let can = joint.kind.numbers() == 1 && master.kind.numbers() == 1;
        if !can {
            self.message(format!(
                "line {}, <joint>: '{}' cannot mimic '{}': both have to turn or slide",
                joint.line, joint.name, master.name
            ));
        }
        can
    }

    fn lead(&mut self, joint: usize, master: usize, offset: f64, factor: f64) -> SceneResult<()> {
        let (Some(joint), Some(master)) = (self.joints[joint], self.joints[master]) else {
            return Ok(());
        };
        let is_joint = |handle: &Handle| {
            self.scene
                .object(*handle)
                .is_ok_and(|object| object.joint().is_ok())
        };
        if ![joint, master].iter().all(is_joint) {
            return Ok(());
        }
        self.scene
            .modify_joint(joint, |joint| joint.set_mode(JointMode::Dependent))?;
        self.scene
            .set_joint_dependency(joint, Some(master), offset, factor)
    }

    /// Holds a frame of a link at one of another link, or lets a joint be between them.
    fn connect(
        &mut self,
        name: &str,
        links: [usize; 2],
        frames: [Pose; 2],
        joint: Option<JointType>,
    ) -> SceneResult<()> {
        let [first, second] = [0, 1].map(|side| self.placed[links[side]] * frames[side]);
        let [Some(one), Some(other)] = links.map(|link| self.nodes[link].carrier) else {
            self.message(format!("'{name}': there is nothing that it can hold"));
            return Ok(());
        };
        let mut parent = one;
        if let Some(joint_type) = joint {
            let joint = Kind::Joint(Box::new(Joint::new(joint_type, JointMode::Dynamic)));
            parent = self.add(name, joint, first, Some(one))?;
            self.scene.modify(parent, Field::Layer, |object| {
                object.layer = Layers::JOINTS.hidden();
            })?;
        }
        let tip = self.add_dummy(&format!("{name}_tip"), first, Some(parent))?;
        let target = self.add_dummy(&format!("{name}_target"), second, Some(other))?;
        self.scene.set_link_type(tip, LinkType::LoopClosure)?;
        self.scene.link_dummies(tip, Some(target))
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use permissions::Permissions;

    use super::*;
    use crate::robot_file::{RobotFile, RobotImportOptions};
    use scene::Scene;

    /// A chain of links, each of which hangs on a joint about x.
    const CHAIN: &str = "<worldbody><body name='a'><geom size='0.1'/>
        <body name='b'><joint name='one' axis='1 0 0'/><geom size='0.1'/>
        <body name='c'><joint name='two' axis='1 0 0'/><geom size='0.1'/>
        <body name='d'><joint name='three' axis='1 0 0'/><geom size='0.1'/></body></body></body></body></worldbody>";

    fn imported(equalities: &str) -> Scene {
        let text = format!("<mujoco>{CHAIN}<equality>{equalities}</equality></mujoco>");
        let (format, path) = (RobotFormat::Mjcf, Path::new("/nowhere/robot.xml"));
        let permissions = Permissions::none();
        let file = RobotFile::parse(text.as_bytes(), format, path, None, &permissions)
            .expect("it is a robot");
        let mut scene = Scene::new();
        file.add_to(&mut scene, RobotImportOptions::KEEP_POSITION)
            .expect("there are handles enough");
        scene
    }

    fn joint(scene: &Scene, name: &str) -> Handle {
        let named = |object: &&scene::Object| object.alias() == name;
        scene
            .objects()
            .find(named)
            .expect("it was imported")
            .handle()
    }

    #[test]
    fn a_chain_of_bound_joints_adds_up_factors_and_offsets() {
        let mut scene = imported(
            "<joint joint1='two' joint2='one' polycoef='0.1 2 0 0 0'/>
             <joint joint1='three' joint2='two' polycoef='-0.05 -1 0 0 0'/>",
        );
        let [one, two, three] = ["one", "two", "three"].map(|name| joint(&scene, name));
        scene
            .modify_joint(one, |joint| joint.set_mode(JointMode::Kinematic))
            .expect("it is a joint");
        scene.set_joint_position(one, 0.3).expect("it is a joint");
        let position = |handle| {
            scene
                .object(handle)
                .and_then(|o| Ok(o.joint()?.position))
                .expect("it is a joint")
        };
        assert!((position(two) - 0.7).abs() < 1e-12, "{}", position(two));
        assert!(
            (position(three) + 0.75).abs() < 1e-12,
            "{}",
            position(three)
        );
    }

    #[test]
    fn curves_are_not_imported() {
        let scene = imported("<joint joint1='two' joint2='one' polycoef='0.1 2 1 0 0'/>");
        let two = scene.object(joint(&scene, "two")).expect("it is there");
        assert_eq!(two.joint().expect("it is a joint").dependency, None);
    }
}
