//! Tendons: what MuJoCo's tendons in MJCF become. A tendon is a dummy whose custom data say along which points or joints its length is measured, and what acts along it.
//!
//! The objects are references of the dummy, so that they follow when a model is copied or read from a file.

use std::fmt::Write as _;

use super::Object;
use crate::joint::{ACTUATOR, Actuators};
use crate::{Data, Edit, Field, Handle, Namespace, References, Scene, SceneResult, ValueType};

/// Name of the custom data of a dummy that make it a tendon, and of the references of its path: see [`Tendon`].
pub const TENDON: &str = "mjcfTendon";
/// Names of the custom data of a tendon with the targets of its actuators: a force (N), a length (m) and a speed (m/s); of a tendon over joints in the units of its length.
pub const TENDON_TARGETS: [&str; 3] = ["targetForce", "targetPosition", "targetVelocity"];

/// A tendon. As text: numbers, `stiffness=100 damping=5 rest=0.1,0.1 range=0,0.5`, then a line for each part of its path: `site=0`, `pulley=2`, `joint=1 factor=0.5`; sites and joints are
/// indices of the references.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tendon {
    /// What acts along it.
    pub law: TendonLaw,
    /// What its length is measured along, in order.
    pub path: Vec<TendonPart>,
}

/// A part of the path of a tendon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TendonPart {
    /// It goes straight to this dummy from the one before.
    Site(Handle),
    /// A new branch begins, whose length counts divided by this number.
    Pulley(f64),
    /// The position of this joint times a factor is a part of its length.
    Joint(Handle, f64),
}

/// What acts along a tendon, of which the length is metres, or what its joints make it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct TendonLaw {
    /// Force per length, N/m.
    pub stiffness: f64,
    /// Force per speed, N s/m.
    pub damping: f64,
    /// Shortest and longest length at which the spring exerts no force; None for the length at the start.
    pub rest: Option<[f64; 2]>,
    /// Smallest and largest length, if it has them.
    pub range: Option<[f64; 2]>,
    /// Largest force of dry friction, N.
    pub friction: f64,
    /// Inertia of what moves with it, kg.
    pub armature: f64,
}

impl TendonLaw {
    fn write(&self, text: &mut String) {
        let numbers = [
            ("stiffness", self.stiffness),
            ("damping", self.damping),
            ("friction", self.friction),
            ("armature", self.armature),
        ];
        for (name, number) in numbers.into_iter().filter(|(_, number)| *number != 0.0) {
            let _ = write!(text, "{name}={number} ");
        }
        for (name, pair) in [("rest", self.rest), ("range", self.range)] {
            if let Some([low, high]) = pair {
                let _ = write!(text, "{name}={low},{high} ");
            }
        }
    }

    fn set(&mut self, name: &str, value: &str) {
        let number = || value.parse().ok().filter(|x: &f64| x.is_finite());
        let positive = || number().unwrap_or(0.0).max(0.0);
        match name {
            "stiffness" => self.stiffness = positive(),
            "damping" => self.damping = positive(),
            "friction" => self.friction = positive(),
            "armature" => self.armature = positive(),
            "rest" => self.rest = pair(value),
            "range" => self.range = pair(value),
            _ => {}
        }
    }
}

/// Two finite numbers that do not fall.
fn pair(text: &str) -> Option<[f64; 2]> {
    let (low, high) = text.split_once(',')?;
    let [low, high] = [low.parse().ok()?, high.parse().ok()?];
    let is_range = f64::is_finite(low) && f64::is_finite(high) && low <= high;
    is_range.then_some([low, high])
}

impl Object {
    /// The tendon that this dummy is; None if it is none, or if an object of its path is gone.
    pub fn tendon(&self) -> Option<Tendon> {
        self.dummy().ok()?;
        let text = self.text_of(TENDON)?;
        let objects = self.referenced(References::Following, TENDON);
        let mut lines = text.lines();
        let mut tendon = Tendon::default();
        for (name, value) in words(lines.next()?) {
            tendon.law.set(name, value);
        }
        tendon.path = lines
            .map(|line| part(line, objects))
            .collect::<Option<_>>()?;
        (!tendon.path.is_empty()).then_some(tendon)
    }

    /// The actuators of a tendon.
    pub fn tendon_actuators(&self) -> Actuators {
        let text = self.text_of(ACTUATOR);
        text.and_then(|text| Actuators::parse(&text))
            .unwrap_or_default()
    }

    /// Targets of the actuators of a tendon, from scripts: force, length, speed.
    pub fn tendon_targets(&self) -> [f64; 3] {
        TENDON_TARGETS.map(|name| {
            let value = self.custom_data.typed(name).map(|(_, value)| value);
            let number = value.and_then(Data::as_f64);
            number.filter(|x| x.is_finite()).unwrap_or(0.0)
        })
    }

    fn text_of(&self, name: &str) -> Option<String> {
        match self.custom_data.typed(name)?.1 {
            Data::Text(text) | Data::Buffer(text) => Some(String::from_utf8_lossy(text).into()),
            _ => None,
        }
    }
}

fn words(line: &str) -> impl Iterator<Item = (&str, &str)> {
    line.split_whitespace()
        .filter_map(|word| word.split_once('='))
}

fn part(line: &str, objects: &[i64]) -> Option<TendonPart> {
    let object = |text: &str| {
        let raw = objects.get(text.parse::<usize>().ok()?)?;
        Handle::from_raw(*raw).filter(|_| *raw >= 0)
    };
    let number = |text: &str| text.parse().ok().filter(|x: &f64| x.is_finite());
    let mut words = words(line);
    let (kind, value) = words.next()?;
    match kind {
        "site" => Some(TendonPart::Site(object(value)?)),
        "pulley" => Some(TendonPart::Pulley(
            number(value).filter(|divisor| *divisor > 0.0)?,
        )),
        "joint" => {
            let (_, factor) = words.find(|(name, _)| *name == "factor")?;
            Some(TendonPart::Joint(object(value)?, number(factor)?))
        }
        _ => None,
    }
}

impl Scene {
    /// Makes a dummy a tendon.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn set_tendon(&mut self, dummy: Handle, tendon: &Tendon) -> SceneResult<()> {
        let (mut text, mut objects) = (String::new(), Vec::new());
        tendon.law.write(&mut text);
        for part in &tendon.path {
            let number = objects.len();
            let _ = match part {
                TendonPart::Site(_) => write!(text, "\nsite={number}"),
                TendonPart::Pulley(divisor) => write!(text, "\npulley={divisor}"),
                TendonPart::Joint(_, factor) => write!(text, "\njoint={number} factor={factor}"),
            };
            if let TendonPart::Site(object) | TendonPart::Joint(object, _) = part {
                objects.push(object.raw());
            }
        }
        self.set_references(dummy, References::Following, TENDON, &objects)?;
        let value = (ValueType::String, Data::text(&text));
        let edit = Edit::Name(TENDON, Some(value));
        self.edit_named_values(Some(dummy), Namespace::CustomData, edit)?;
        self.modify(dummy, Field::Other, |_| ())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;
    use crate::joint::{Joint, JointMode, JointType};
    use crate::object::dummy::Dummy;

    fn dummy(scene: &mut Scene) -> Handle {
        scene
            .add("end", Kind::Dummy(Dummy::new(0.01)))
            .expect("room")
    }

    #[test]
    fn a_tendon_is_what_was_said_as_long_as_its_objects_are_there() {
        let mut scene = Scene::new();
        let joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        let joint = scene
            .add("joint", Kind::Joint(Box::new(joint)))
            .expect("room");
        let [own, site] = [0; 2].map(|_| dummy(&mut scene));
        let tendon = Tendon {
            law: TendonLaw {
                stiffness: 2.0,
                friction: 0.5,
                rest: Some([0.1, 0.2]),
                range: Some([-1.0, 3.0]),
                ..TendonLaw::default()
            },
            path: vec![
                TendonPart::Site(site),
                TendonPart::Pulley(2.0),
                TendonPart::Joint(joint, -0.5),
            ],
        };
        scene.set_tendon(own, &tendon).expect("a dummy");
        let read = |scene: &Scene| scene.object(own).expect("exists").tendon();
        assert_eq!(read(&scene), Some(tendon));
        scene.remove(&[site]).expect("exists");
        assert_eq!(read(&scene), None);
        assert_eq!(scene.object(joint).expect("exists").tendon(), None);
    }

    #[test]
    fn what_a_text_does_not_mean_is_left_out() {
        let mut law = TendonLaw::default();
        for (name, value) in [
            ("stiffness", "-1"),
            ("damping", "inf"),
            ("range", "2,1"),
            ("rest", "1"),
            ("odd", "3"),
        ] {
            law.set(name, value);
        }
        assert_eq!(law, TendonLaw::default());
        for line in [
            "site=7",
            "site=x",
            "pulley=0",
            "joint=0",
            "joint=0 factor=nan",
            "wheel=0",
            "",
        ] {
            assert_eq!(part(line, &[5]), None, "{line}");
        }
    }
}
