//! What acts along the axis of a joint beside its motor, and motors that are springs: what robots in MJCF have.
//!
//! Spring, damper, armature and friction are MuJoCo's parameters of the joint, which scene files have. They count when MuJoCo is the selected engine, and with any engine
//! for a joint with the custom data [`ACTUATOR`], which says what its motor does as well.

use std::fmt;

use super::{Control, Joint};
use crate::parameters::engine::Engine;
use crate::parameters::engine_values::element;
use crate::parameters::mujoco::Surrounding;
use crate::{Data, Object};

/// Name of the custom data of a joint that say what its motor does: see [`Actuator`].
pub const ACTUATOR: &str = "mjcfActuator";

/// Parameters of joints of MuJoCo that count.
const ARMATURE: &str = "mujoco.armature";
const FRICTION: &str = "mujoco.frictionLoss";
const STIFFNESS: &str = "mujoco.springStiffness";
const DAMPING: &str = "mujoco.springDamping";
const REST: &str = "mujoco.springRef";

/// What acts along the axis of a joint beside its motor. Of a revolute joint: N m, rad; of a prismatic one: N, m.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Passive {
    /// Inertia of the motor's rotor, reflected to the axis: kg m² or kg.
    pub armature: f64,
    /// Torque or force per distance from `rest`.
    pub stiffness: f64,
    /// Position where the spring exerts no force, rad or m.
    pub rest: f64,
    /// Torque or force against each rad/s or m/s.
    pub damping: f64,
    /// Largest torque or force of dry friction.
    pub friction: f64,
}

/// A motor as MuJoCo has it: its force is its control, or a spring and damper about its control, within a range.
///
/// As text: the kind, then numbers, `position stiffness=100 damping=5 bias=0 lowest=-20 highest=20`; what is not there is 0, a range that is not there has no end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Actuator {
    /// What a script sets it.
    pub kind: ActuatorKind,
    /// Torque or force per distance from the target position.
    pub stiffness: f64,
    /// Torque or force per difference of velocity.
    pub damping: f64,
    /// Torque or force that is always there.
    pub bias: f64,
    /// Lowest and highest torque or force, N m or N.
    pub range: [f64; 2],
}

/// What a script tells an actuator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActuatorKind {
    /// A joint without an actuator.
    None,
    /// The target force, in force control.
    Force,
    /// The target position, in position control.
    Position,
    /// The target velocity, in velocity control.
    Velocity,
}

/// The motors of a joint: at most one of each kind that a script can tell something, the one whose control the joint has first.
///
/// As text: their texts with a `;` between them.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Actuators([Option<Actuator>; 3]);

/// How a joint is moved where MuJoCo's parameters count.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Actuation {
    /// Beside the motor.
    pub passive: Passive,
    /// What its motors do, if not what CoppeliaSim's motor does; none otherwise.
    pub actuators: Actuators,
}

impl Actuation {
    /// What of it acts where MuJoCo's switches let it.
    pub fn within(mut self, surrounding: &Surrounding) -> Self {
        if !surrounding.has_passive_forces {
            (self.passive.stiffness, self.passive.damping) = (0.0, 0.0);
        }
        if !surrounding.has_joint_friction {
            self.passive.friction = 0.0;
        }
        self
    }
}

impl ActuatorKind {
    const ALL: [(Self, &'static str); 4] = [
        (Self::None, "none"),
        (Self::Force, "force"),
        (Self::Position, "position"),
        (Self::Velocity, "velocity"),
    ];

    /// The control mode of the joint in which it has a control.
    pub fn control(self) -> Control {
        match self {
            Self::None => Control::Free,
            Self::Force => Control::Force,
            Self::Position => Control::Position,
            Self::Velocity => Control::Velocity,
        }
    }
}

impl Actuators {
    /// Adds a motor. One of a kind that there is already becomes one with it: their springs, dampers, forces and ranges are added.
    pub fn add(&mut self, actuator: Actuator) {
        let same =
            |other: &&mut Option<Actuator>| other.is_none_or(|other| other.kind == actuator.kind);
        let place = self.0.iter_mut().find(same);
        if let Some(place) = place.filter(|_| actuator.kind != ActuatorKind::None) {
            *place = Some(place.map_or(actuator, |other| other.together(&actuator)));
        }
    }

    /// The motors, the one whose control the joint has first.
    pub fn iter(&self) -> impl Iterator<Item = &Actuator> {
        self.0.iter().flatten()
    }

    /// What a text says; None if nothing in it names a kind.
    pub fn parse(text: &str) -> Option<Self> {
        let mut found = text.split(';').filter_map(Actuator::parse).peekable();
        found.peek()?;
        let mut actuators = Self::default();
        found.for_each(|actuator| actuators.add(actuator));
        Some(actuators)
    }
}

impl fmt::Display for Actuators {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let texts: Vec<String> = self.iter().map(Actuator::to_string).collect();
        match texts.as_slice() {
            [] => Actuator::new(ActuatorKind::None).fmt(f),
            texts => f.write_str(&texts.join("; ")),
        }
    }
}

impl Actuator {
    /// One without spring, damper and bounds.
    pub fn new(kind: ActuatorKind) -> Self {
        Self {
            kind,
            stiffness: 0.0,
            damping: 0.0,
            bias: 0.0,
            range: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// What a text says; None if it names no kind. Words that mean nothing are not looked at.
    pub fn parse(text: &str) -> Option<Self> {
        let mut words = text.split_whitespace();
        let kind = words.next()?;
        let (kind, _) = ActuatorKind::ALL
            .into_iter()
            .find(|(_, word)| *word == kind)?;
        let mut actuator = Self::new(kind);
        for (name, number) in words.filter_map(|word| word.split_once('=')) {
            let (Some(field), Ok(number)) = (actuator.field(name), number.parse::<f64>()) else {
                continue;
            };
            if number.is_finite() {
                *field = number;
            }
        }
        Some(actuator)
    }

    fn field(&mut self, name: &str) -> Option<&mut f64> {
        Some(match name {
            "stiffness" => &mut self.stiffness,
            "damping" => &mut self.damping,
            "bias" => &mut self.bias,
            "lowest" => &mut self.range[0],
            "highest" => &mut self.range[1],
            _ => return None,
        })
    }

    /// Two motors that are told the same.
    fn together(&self, other: &Self) -> Self {
        Self {
            kind: self.kind,
            stiffness: self.stiffness + other.stiffness,
            damping: self.damping + other.damping,
            bias: self.bias + other.bias,
            range: [0, 1].map(|end| self.range[end] + other.range[end]),
        }
    }

    /// A force within the range.
    pub fn limited(&self, force: f64) -> f64 {
        force.max(self.range[0]).min(self.range[1])
    }
}

impl fmt::Display for Actuator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = ActuatorKind::ALL
            .into_iter()
            .find(|(kind, _)| *kind == self.kind);
        f.write_str(word.map_or("none", |(_, word)| word))?;
        let [lowest, highest] = self.range;
        let numbers = [
            ("stiffness", self.stiffness),
            ("damping", self.damping),
            ("bias", self.bias),
            ("lowest", lowest),
            ("highest", highest),
        ];
        numbers
            .into_iter()
            .filter(|(_, number)| *number != 0.0 && number.is_finite())
            .try_for_each(|(name, number)| write!(f, " {name}={number}"))
    }
}

impl Joint {
    /// Sets MuJoCo's parameters of the joint.
    pub fn set_passive(&mut self, passive: &Passive) {
        let numbers = [
            (ARMATURE, passive.armature),
            (FRICTION, passive.friction),
            (STIFFNESS, passive.stiffness),
            (DAMPING, passive.damping),
            (REST, passive.rest),
        ];
        for (name, number) in numbers.into_iter().filter(|(_, number)| *number != 0.0) {
            self.engine_values.set(name, Data::Float(number));
        }
    }

    /// What MuJoCo's parameters of the joint say.
    pub fn passive(&self) -> Passive {
        let number = |name: &str| {
            let value = self.engine_values.get(name);
            value.and_then(|value| element(value, 0)).unwrap_or(0.0)
        };
        Passive {
            armature: number(ARMATURE),
            friction: number(FRICTION),
            stiffness: number(STIFFNESS),
            damping: number(DAMPING),
            rest: number(REST),
        }
    }
}

impl Object {
    /// How this joint is moved with that engine beside what its control says; None for other objects and where nothing of that counts.
    pub fn actuation(&self, engine: Engine) -> Option<Actuation> {
        let joint = self.joint().ok()?;
        let actuators = self
            .custom_data
            .typed(ACTUATOR)
            .and_then(|(_, value)| match value {
                Data::Text(text) | Data::Buffer(text) => {
                    Actuators::parse(&String::from_utf8_lossy(text))
                }
                _ => None,
            });
        (actuators.is_some() || engine == Engine::Mujoco).then(|| Actuation {
            passive: joint.passive(),
            actuators: actuators.unwrap_or_default(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_actuator_is_what_its_text_says() {
        let actuator = Actuator {
            stiffness: 100.0,
            damping: 0.5,
            range: [f64::NEG_INFINITY, 3.0],
            ..Actuator::new(ActuatorKind::Position)
        };
        let text = actuator.to_string();
        assert_eq!(text, "position stiffness=100 damping=0.5 highest=3");
        assert_eq!(Actuator::parse(&text), Some(actuator));
        assert_eq!(actuator.limited(7.0), 3.0);
        let none = Actuator::parse("none");
        assert_eq!(none, Some(Actuator::new(ActuatorKind::None)));
    }

    #[test]
    fn motors_of_several_kinds_are_a_text() {
        let text = "position stiffness=100; velocity damping=5; force highest=3";
        let actuators = Actuators::parse(text).expect("three kinds");
        assert_eq!(actuators.to_string(), text);
        assert_eq!(actuators.iter().count(), 3);
        let none = Actuators::parse("none").expect("a kind");
        assert_eq!(
            (none.iter().count(), none.to_string().as_str()),
            (0, "none")
        );
        assert_eq!(Actuators::parse("spin; "), None);
    }

    #[test]
    fn motors_of_a_kind_are_one() {
        let text =
            "force lowest=-1 highest=2 bias=1; force lowest=-3 highest=4; position stiffness=2";
        let actuators = Actuators::parse(text).expect("two kinds");
        assert_eq!(
            actuators.to_string(),
            "force bias=1 lowest=-4 highest=6; position stiffness=2"
        );
        let endless = Actuators::parse("force highest=2; force lowest=-3").expect("a kind");
        assert_eq!(endless.to_string(), "force");
    }

    #[test]
    fn what_a_text_does_not_mean_is_left_out() {
        assert_eq!(Actuator::parse("spin stiffness=1"), None);
        assert_eq!(Actuator::parse(""), None);
        let odd = Actuator::parse("force stiffness=inf damping=x odd=1 =");
        assert_eq!(odd, Some(Actuator::new(ActuatorKind::Force)));
    }
}
