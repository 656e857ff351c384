//! What MuJoCo's parameters of the scene, of shapes and of dummies mean, while it is the selected engine. Those of joints are in `joint::actuation`.

use crate::object::dummy::{Dummy, LinkType};
use crate::object::tendon::TendonLaw;
use crate::shape::{Fluid, Material};
use crate::{Data, DynamicsSettings, InertValues};

use super::engine::Engine;
use super::engine_values::element;

/// What surrounds all bodies, and what is switched off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surrounding {
    /// What slows bodies down.
    pub fluid: Option<Fluid>,
    /// Velocity of the fluid, m/s.
    pub wind: [f64; 3],
    /// Whether gravity pulls.
    pub has_gravity: bool,
    /// Whether bodies collide.
    pub has_contacts: bool,
    /// Whether springs and dampers of joints and tendons act, the fluid, and compensation of gravity.
    pub has_passive_forces: bool,
    /// Whether joints have dry friction.
    pub has_joint_friction: bool,
    /// Whether joints have limits.
    pub has_joint_limits: bool,
    /// Whether loops are closed, and joints follow others.
    pub has_equalities: bool,
    /// Whether motors move joints.
    pub has_motors: bool,
    /// Smallest mass, kg, and moment of inertia, kg m2, of bodies.
    pub least: [f64; 2],
    /// Whether moments that no body has are made equal.
    pub balances_inertia: bool,
}

impl Default for Surrounding {
    fn default() -> Self {
        Self {
            fluid: None,
            wind: [0.0; 3],
            has_gravity: true,
            has_contacts: true,
            has_passive_forces: true,
            has_joint_friction: true,
            has_joint_limits: true,
            has_equalities: true,
            has_motors: true,
            least: [0.0; 2],
            balances_inertia: false,
        }
    }
}

impl DynamicsSettings {
    /// What MuJoCo's parameters of the scene say, if it is the selected engine.
    pub fn surrounding(&self) -> Surrounding {
        let values = &self.engine_values;
        if self.engine.engine != Engine::Mujoco {
            return Surrounding::default();
        }
        let is_on = |name: &str| values.get(name) != Some(&Data::Bool(false));
        let number = |name: &str, place: usize| number(values, name, place).unwrap_or(0.0);
        let has_passive_forces = is_on("mujoco.passiveEnable");
        let fluid = Fluid {
            density: number("mujoco.density", 0).max(0.0),
            viscosity: number("mujoco.viscosity", 0).max(0.0),
        };
        let acts = has_passive_forces && fluid != Fluid::default();
        Surrounding {
            fluid: acts.then_some(fluid),
            wind: [0, 1, 2].map(|axis| number("mujoco.wind", axis)),
            has_gravity: is_on("mujoco.gravityEnable"),
            has_contacts: is_on("mujoco.contactEnable"),
            has_passive_forces,
            has_joint_friction: is_on("mujoco.frictionlossEnable"),
            has_joint_limits: is_on("mujoco.limitEnable"),
            has_equalities: is_on("mujoco.equalityEnable"),
            has_motors: is_on("mujoco.actuationEnable"),
            least: [
                number("mujoco.boundMass", 0),
                chosen_moment(number("mujoco.boundInertia", 0)),
            ],
            balances_inertia: values.get("mujoco.balanceInertias") == Some(&Data::Bool(true)),
        }
    }
}

impl Material {
    /// Part of its weight by which a body is lifted.
    pub fn gravity_compensation(&self) -> f64 {
        number(&self.engine_values, "mujoco.gravcomp", 0).unwrap_or(0.0)
    }

    /// Force with which a body adheres to what it touches, N; 0 without.
    pub fn adhesion(&self) -> f64 {
        let values = &self.engine_values;
        if values.get("mujoco.adhesion") != Some(&Data::Bool(true)) {
            return 0.0;
        }
        let value = |name: &str, usual: f64| number(values, name, 0).unwrap_or(usual);
        let within = |name: &str, x: f64| {
            let ends = [(0, 0.0), (1, 1000.0)];
            let [low, high] = ends.map(|(end, usual)| number(values, name, end).unwrap_or(usual));
            x.max(low).min(high)
        };
        let control = within(
            "mujoco.adhesionctrlrange",
            value("mujoco.adhesionctrl", 0.0),
        );
        let force = value("mujoco.adhesiongain", 1.0) * control;
        // -1, as in MuJoCo: limited if there is a range.
        let is_limited = value("mujoco.adhesionforcelimited", -1.0) != 0.0;
        let limited = if is_limited {
            within("mujoco.adhesionforcerange", force)
        } else {
            force
        };
        limited.max(0.0)
    }
}

impl Dummy {
    /// The tendon between this dummy and its partner, by the parameters of this one; None if their link is another one.
    pub fn tendon(&self) -> Option<TendonLaw> {
        let values = &self.engine_values;
        let value = |name: &str| number(values, name, 0).unwrap_or(0.0).max(0.0);
        let is_limited = values.get("mujoco.limitsEnabled") == Some(&Data::Bool(true));
        let end = |end: usize| number(values, "mujoco.limitsRange", end).unwrap_or(0.0);
        let range = [end(0), end(1)];
        let rest = number(values, "mujoco.springLength", 0);
        (self.link_type == LinkType::Tendon).then(|| TendonLaw {
            stiffness: value("mujoco.springStiffness"),
            damping: value("mujoco.springDamping"),
            rest: rest
                .filter(|length| *length >= 0.0)
                .map(|length| [length; 2]),
            range: (is_limited && range[0] <= range[1]).then_some(range),
            ..TendonLaw::default()
        })
    }
}

/// A smallest moment of inertia that somebody chose: the 1e-6 kg m2 of all files do not bound small parts of robots, which the solver has no trouble with.
fn chosen_moment(moment: f64) -> f64 {
    const OF_FILES: f64 = 1.000_001e-6;
    if moment > OF_FILES { moment } else { 0.0 }
}

fn number(values: &InertValues, name: &str, place: usize) -> Option<f64> {
    values.get(name).and_then(|value| element(value, place))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::engine_blocks::EngineValues as _;

    fn material(values: &[(&'static str, Data)]) -> Material {
        let mut material = Material::of_friction(1.0);
        for (name, value) in values {
            material.engine_values.set(name, value.clone());
        }
        material
    }

    #[test]
    fn adhesion_is_gain_times_control_within_both_ranges() {
        let on = ("mujoco.adhesion", Data::Bool(true));
        let with = |more: &[(&'static str, Data)]| {
            let mut values = vec![on.clone(), ("mujoco.adhesionctrl", Data::Float(3.0))];
            values.extend_from_slice(more);
            material(&values).adhesion()
        };
        assert_eq!(with(&[]), 3.0);
        assert_eq!(with(&[("mujoco.adhesiongain", Data::Float(5.0))]), 15.0);
        let range = |name: &'static str, high: f64| (name, Data::from(vec![0.0, high]));
        assert_eq!(with(&[range("mujoco.adhesionctrlrange", 2.0)]), 2.0);
        let force = range("mujoco.adhesionforcerange", 1.0);
        assert_eq!(with(std::slice::from_ref(&force)), 1.0);
        let free = ("mujoco.adhesionforcelimited", Data::Int(0));
        assert_eq!(with(&[force, free]), 3.0);
        assert_eq!(with(&[("mujoco.adhesiongain", Data::Float(-5.0))]), 0.0);
        assert_eq!(
            material(&[("mujoco.adhesionctrl", Data::Float(3.0))]).adhesion(),
            0.0
        );
    }

    #[test]
    fn the_scene_is_usual_with_other_engines() {
        let mut settings = DynamicsSettings::default();
        let switches = ["mujoco.gravityEnable", "mujoco.passiveEnable"];
        for name in switches {
            settings.engine_values.set(name, Data::Bool(false));
        }
        settings
            .engine_values
            .set("mujoco.density", Data::Float(1.2));
        assert_eq!(settings.surrounding(), Surrounding::default());
        settings.engine.engine = Engine::Mujoco;
        let none = settings.surrounding();
        assert_eq!((none.has_gravity, none.fluid), (false, None));
        settings
            .engine_values
            .set("mujoco.passiveEnable", Data::Bool(true));
        let density = settings.surrounding().fluid.map(|fluid| fluid.density);
        assert_eq!(density, Some(1.2));
    }

    /// A scene of 4.10 has all its switches in one number, of which 4095 is the usual one.
    #[test]
    fn switches_are_bits_of_files() {
        let mut settings = DynamicsSettings::default();
        settings.engine.engine = Engine::Mujoco;
        let (reals, mut ints) = settings.engine_rows(Engine::Mujoco);
        assert_eq!((ints[0], ints[17]), (0, 4095));
        settings.load_engine(Engine::Mujoco, &reals, &ints);
        assert_eq!(
            settings.surrounding(),
            Surrounding {
                wind: [0.0; 3],
                ..Surrounding::default()
            }
        );
        // A file from before they were written.
        ints[17] = 0;
        settings.load_engine(Engine::Mujoco, &reals, &ints);
        assert!(settings.surrounding().has_gravity);
        ints[17] = 4095 - 0x1 - 0x2 - 0x4 - 0x8 - 0x10 - 0x20 - 0x80;
        settings.load_engine(Engine::Mujoco, &reals, &ints);
        let off = settings.surrounding();
        let switches = [
            off.has_equalities,
            off.has_joint_friction,
            off.has_joint_limits,
            off.has_contacts,
            off.has_passive_forces,
            off.has_gravity,
            off.has_motors,
        ];
        assert_eq!(switches, [false; 7]);
        // A file of before has no such number, and all of them on.
        let mut old = DynamicsSettings::default();
        old.engine.engine = Engine::Mujoco;
        old.load_engine(Engine::Mujoco, &reals[..19], &ints[..10]);
        assert_eq!(old.surrounding(), Surrounding::default());
    }

    #[test]
    fn bounds_of_inertia_are_those_that_were_chosen() {
        let mut settings = DynamicsSettings::default();
        settings.engine.engine = Engine::Mujoco;
        let mut set = |name: &'static str, value: f64| {
            settings.engine_values.set(name, Data::Float(value));
            settings.surrounding().least
        };
        assert_eq!(set("mujoco.boundMass", 0.5), [0.5, 0.0]);
        assert_eq!(set("mujoco.boundInertia", 9.999_999_974e-7), [0.5, 0.0]);
        assert_eq!(set("mujoco.boundInertia", 1e-3), [0.5, 1e-3]);
    }

    #[test]
    fn a_tendon_has_what_its_dummy_says() {
        let mut dummy = Dummy::new(0.1);
        assert_eq!(dummy.tendon(), None);
        dummy.link_type = LinkType::Tendon;
        let values = &mut dummy.engine_values;
        values.set("mujoco.springStiffness", Data::Float(100.0));
        values.set("mujoco.limitsRange", Data::from(vec![0.0, 2.0]));
        let tendon = dummy.tendon().expect("a tendon");
        assert_eq!(
            (tendon.stiffness, tendon.rest, tendon.range),
            (100.0, None, None)
        );
        let values = &mut dummy.engine_values;
        values.set("mujoco.limitsEnabled", Data::Bool(true));
        values.set("mujoco.springLength", Data::Float(0.0));
        let tendon = dummy.tendon().expect("a tendon");
        assert_eq!(
            (tendon.rest, tendon.range),
            (Some([0.0; 2]), Some([0.0, 2.0]))
        );
    }
}
