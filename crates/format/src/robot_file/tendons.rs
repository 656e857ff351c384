//! Tendons of MJCF: dummies that say what their length is measured along.

use robot_description::mjcf::{self, Target};
use scene::joint::{ACTUATOR, Actuators};
use scene::object::dummy::Dummy;
use scene::object::tendon::{TENDON_TARGETS, Tendon, TendonLaw, TendonPart};
use scene::{Data, Handle, Kind, Pose, SceneResult, ValueType};

use super::joints::{DUMMY, initial_target, motor_of};
use super::{Import, RobotImportOptions};

impl Import<'_> {
    /// Adds the tendons as dummies below what carries the world, or the first of what they lead over.
    pub(super) fn add_tendons(&mut self) -> SceneResult<()> {
        for (number, description) in self.model.tendons.iter().enumerate() {
            let joint = |name: &str| {
                let index = self.robot.joint(name)?;
                self.joints.get(index).copied().flatten()
            };
            let site = |name: &str| self.sites.get(name).copied();
            let Some(tendon) = resolved(description, joint, site) else {
                self.message(format!(
                    "line {}: the tendon '{}' is over what became no object",
                    description.line, description.name
                ));
                continue;
            };
            let Some(first) = tendon.path.iter().find_map(object_of) else {
                continue;
            };
            let base = self.scene.root_of(first);
            let kind = Kind::Dummy(Dummy::new(DUMMY));
            let dummy = self.add(&description.name, kind, Pose::identity(), Some(base))?;
            self.scene.set_tendon(dummy, &tendon)?;
            if !self.options.contains(RobotImportOptions::FREE_JOINTS) {
                self.add_actuators(number, dummy)?;
            }
        }
        Ok(())
    }

    /// The actuators of a tendon, with what they are told at first.
    fn add_actuators(&mut self, tendon: usize, dummy: Handle) -> SceneResult<()> {
        let mut made = Actuators::default();
        let model = self.model;
        let all = model.actuators.iter().flatten();
        for actuator in all.filter(|actuator| actuator.target == Target::Tendon(tendon)) {
            made.add(motor_of(actuator));
            let (name, target) = initial_target(actuator);
            let name = TENDON_TARGETS[name as usize];
            self.set_custom_data(dummy, name, (ValueType::Float, Data::Float(target)))?;
        }
        if made.iter().next().is_some() {
            let text = Data::text(&made.to_string());
            self.set_custom_data(dummy, ACTUATOR, (ValueType::String, text))?;
        }
        Ok(())
    }
}

fn object_of(part: &TendonPart) -> Option<Handle> {
    match part {
        TendonPart::Site(handle) | TendonPart::Joint(handle, _) => Some(*handle),
        TendonPart::Pulley(_) => None,
    }
}

/// What a tendon of MJCF is between objects of a scene, which `joint` and `site` find by their names; None if something of it is missing.
pub fn resolved(
    description: &mjcf::Tendon,
    joint: impl Fn(&str) -> Option<Handle>,
    site: impl Fn(&str) -> Option<Handle>,
) -> Option<Tendon> {
    let parts = description.path.iter().map(|part| {
        Some(match part {
            mjcf::TendonPart::Site(name) => TendonPart::Site(site(name)?),
            mjcf::TendonPart::Pulley(divisor) => TendonPart::Pulley(*divisor),
            mjcf::TendonPart::Joint(name, factor) => TendonPart::Joint(joint(name)?, *factor),
        })
    });
    Some(Tendon {
        law: TendonLaw {
            stiffness: description.stiffness,
            damping: description.damping,
            rest: description.rest,
            range: description.range,
            friction: description.friction,
            armature: description.armature,
        },
        path: parts.collect::<Option<_>>()?,
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use permissions::Permissions;

    use super::*;
    use crate::robot_file::{RobotFile, RobotFormat};
    use scene::{Object, Scene};

    /// Two fingers with a tendon over both joints, and one from the palm to a finger.
    const GRIPPER: &str = "<mujoco><worldbody><body name='palm'><geom size='0.1'/><site name='high' pos='0 0 1'/>
        <body><joint name='left'/><geom size='0.1'/><site name='tip' pos='1 0 0'/></body>
        <body><joint name='right'/><geom size='0.1'/></body></body></worldbody>
        <tendon><fixed name='grip' stiffness='4' range='-1 1'><joint joint='left' coef='0.5'/><joint joint='right' coef='-0.5'/></fixed>
        <spatial name='string' damping='2'><site site='high'/><pulley divisor='2'/><site site='high'/><site site='tip'/></spatial></tendon>
        <actuator><position tendon='grip' kp='10' ctrlrange='0.2 1'/><motor tendon='grip' ctrlrange='-3 3'/></actuator></mujoco>";

    fn imported(options: RobotImportOptions) -> (Scene, Vec<String>) {
        let (path, permissions) = (Path::new("/nowhere/robot.xml"), Permissions::none());
        let bytes = GRIPPER.as_bytes();
        let file = RobotFile::parse(bytes, RobotFormat::Mjcf, path, None, &permissions);
        let mut scene = Scene::new();
        let all = options | RobotImportOptions::KEEP_POSITION;
        let imported = file.expect("it is a robot").add_to(&mut scene, all);
        let messages = imported.expect("there are handles enough").messages;
        (scene, messages)
    }

    fn named<'a>(scene: &'a Scene, name: &str) -> &'a Object {
        let mut all = scene.objects();
        all.find(|object| object.alias() == name).expect(name)
    }

    #[test]
    fn tendons_are_dummies_that_know_their_objects() {
        let (scene, messages) = imported(RobotImportOptions::empty());
        assert_eq!(messages, [] as [&str; 0]);
        let handle = |name: &str| named(&scene, name).handle();
        let grip = named(&scene, "grip");
        let tendon = grip.tendon().expect("a tendon");
        let path = [
            TendonPart::Joint(handle("left"), 0.5),
            TendonPart::Joint(handle("right"), -0.5),
        ];
        assert_eq!(tendon.path, path);
        assert_eq!(
            (tendon.law.stiffness, tendon.law.range),
            (4.0, Some([-1.0, 1.0]))
        );
        let actuators = grip.tendon_actuators().to_string();
        assert_eq!(
            actuators,
            "position stiffness=10; force lowest=-3 highest=3"
        );
        assert_eq!(grip.tendon_targets(), [0.0, 0.2, 0.0]);
        let string = named(&scene, "string").tendon().expect("a tendon");
        let [high, tip] = ["high", "tip"].map(|name| TendonPart::Site(handle(name)));
        assert_eq!(string.path, [high, TendonPart::Pulley(2.0), high, tip]);
        // They are part of the model.
        let root = scene.root_of(handle("left"));
        assert_eq!(scene.root_of(grip.handle()), root);
    }

    #[test]
    fn without_motors_tendons_have_none() {
        let (scene, _) = imported(RobotImportOptions::FREE_JOINTS);
        let grip = named(&scene, "grip");
        assert!(grip.tendon().is_some());
        assert_eq!(grip.tendon_actuators(), Actuators::default());
    }
}
