//! Engine parameters the way files keep them: per engine a row of real numbers and a row of integers, in the order of their numbers.
//!
//! Further numbers of a row are ignored; they have no counterpart.

use super::engine::{Engine, EngineOwner, EngineParam, Numbered, is_step_size, numbered};
use super::engine_values::{element, value_in, with_element};
use crate::joint::Joint;
use crate::object::dummy::Dummy;
use crate::shape::Material;
use crate::{Data, DynamicsSettings, InertValues};

/// The number of the switches of MuJoCo's scenes. Files in which nobody has written them have a zero there, with which nothing at all would act.
const MUJOCO_SWITCHES: i64 = 38_018;

/// The numbers of a row of parameters: the first one of the real ones and how many a file of 4.10 holds, then of the integers.
#[derive(Debug, Clone, Copy)]
pub struct EngineRows {
    reals: (i64, usize),
    ints: (i64, usize),
}

const fn rows(first_real: i64, reals: usize, first_int: i64, ints: usize) -> EngineRows {
    EngineRows {
        reals: (first_real, reals),
        ints: (first_int, ints),
    }
}

/// In the order of [`Engine::ALL`].
const SCENE: [EngineRows; 5] = [
    rows(1, 3, 1001, 3),
    rows(9001, 4, 10_001, 3),
    rows(18_001, 9, 19_001, 1),
    rows(27_001, 2, 28_001, 2),
    rows(37_001, 28, 38_001, 18),
];
const MATERIAL: [EngineRows; 5] = [
    rows(6001, 7, 7001, 1),
    rows(15_001, 5, 16_001, 1),
    rows(24_001, 36, 25_001, 8),
    rows(33_001, 5, 34_001, 1),
    rows(43_001, 20, 44_001, 4),
];
const JOINT: [EngineRows; 5] = [
    rows(3001, 8, 4001, 0),
    rows(12_001, 8, 13_001, 0),
    rows(21_001, 54, 22_001, 6),
    rows(30_001, 5, 31_001, 2),
    rows(40_001, 30, 41_001, 2),
];
/// Dummies have parameters of MuJoCo only.
const DUMMY: EngineRows = rows(46_001, 21, 47_001, 2);

/// Objects with engine parameters of their own.
pub trait EngineValues {
    /// Those of one engine.
    fn rows(&self, engine: Engine) -> Option<EngineRows>;
    /// The value of a parameter, or its default.
    fn value(&self, param: &EngineParam) -> Data;
    /// Sets a parameter; `value` has its type.
    fn set(&mut self, param: &'static EngineParam, value: Data);

    /// Sets the parameters of one engine from the rows of a file.
    fn load_engine(&mut self, engine: Engine, reals: &[f64], ints: &[i32]) {
        let Some(EngineRows {
            reals: (first_real, _),
            ints: (first_int, _),
        }) = self.rows(engine)
        else {
            return;
        };
        for (number, real) in (first_real..).zip(reals) {
            if real.is_finite() && !is_step_size(number) {
                self.set_number(number, *real);
            }
        }
        for (number, int) in (first_int..).zip(ints) {
            if *int != 0 || number != MUJOCO_SWITCHES {
                self.set_number(number, f64::from(*int));
            }
        }
    }

    /// The rows of one engine; zero where a number has no counterpart.
    fn engine_rows(&self, engine: Engine) -> (Vec<f64>, Vec<i32>) {
        let Some(rows) = self.rows(engine) else {
            return Default::default();
        };
        let ((first_real, reals), (first_int, ints)) = (rows.reals, rows.ints);
        let real = |at: usize| self.number(first_real + at as i64).unwrap_or_default();
        let int = |at: usize| self.number(first_int + at as i64).unwrap_or_default() as i32;
        ((0..reals).map(real).collect(), (0..ints).map(int).collect())
    }

    /// The value behind a number of the old API (`sim.bullet_*` and so on); switches are 0 and 1, joined ones bits. None for an unknown number.
    fn number(&self, number: i64) -> Option<f64> {
        Some(match numbered(number)? {
            Numbered::Element(param, at) => element(&self.value(param), *at)?,
            Numbered::Bits(switches) => {
                let on = switches
                    .iter()
                    .filter(|(param, _)| self.value(param) == Data::Bool(true));
                on.fold(0, |bits, (_, bit)| bits | bit) as f64
            }
        })
    }

    /// Sets the value behind a number of the old API; an unknown number has no effect.
    fn set_number(&mut self, number: i64, value: f64) {
        match numbered(number) {
            Some(Numbered::Element(param, at)) => {
                let old = self.value(param);
                if element(&old, *at) != Some(value) {
                    self.set(param, with_element(old, *at, value));
                }
            }
            Some(Numbered::Bits(switches)) => switches.iter().for_each(|(param, bit)| {
                self.set(param, Data::Bool(value as i64 & bit != 0));
            }),
            None => {}
        }
    }
}

impl EngineValues for Material {
    fn rows(&self, engine: Engine) -> Option<EngineRows> {
        Some(MATERIAL[engine as usize])
    }
    fn value(&self, param: &EngineParam) -> Data {
        self.engine_value(param)
    }
    fn set(&mut self, param: &'static EngineParam, value: Data) {
        self.set_engine_value(param, value);
    }
}

impl EngineValues for Joint {
    fn rows(&self, engine: Engine) -> Option<EngineRows> {
        Some(JOINT[engine as usize])
    }
    fn value(&self, param: &EngineParam) -> Data {
        self.engine_value(param)
    }
    fn set(&mut self, param: &'static EngineParam, value: Data) {
        self.set_engine_value(param, value);
    }
}

impl EngineValues for DynamicsSettings {
    fn rows(&self, engine: Engine) -> Option<EngineRows> {
        Some(SCENE[engine as usize])
    }
    fn value(&self, param: &EngineParam) -> Data {
        inert_value(&self.engine_values, param, EngineOwner::Scene)
    }
    fn set(&mut self, param: &'static EngineParam, value: Data) {
        self.engine_values.set(param.name, value);
    }
}

impl EngineValues for Dummy {
    fn rows(&self, engine: Engine) -> Option<EngineRows> {
        (engine == Engine::Mujoco).then_some(DUMMY)
    }
    fn value(&self, param: &EngineParam) -> Data {
        inert_value(&self.engine_values, param, EngineOwner::Dummy)
    }
    fn set(&mut self, param: &'static EngineParam, value: Data) {
        self.engine_values.set(param.name, value);
    }
}

fn inert_value(values: &InertValues, param: &EngineParam, owner: EngineOwner) -> Data {
    debug_assert_eq!(param.owner, owner, "numbers of one row belong to one owner");
    value_in(values, param)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_back() {
        let mut material = Material::default();
        material.load_engine(Engine::Bullet, &[0.25, 0.5, 0.75], &[1]);
        assert_eq!((material.restitution, material.friction), (0.25, 0.5));
        let (reals, ints) = material.engine_rows(Engine::Bullet);
        assert_eq!((&reals[..3], &ints[..]), (&[0.25, 0.5, 0.75][..], &[1][..]));
        let mut other = Material::default();
        Engine::ALL.into_iter().for_each(|engine| {
            let (reals, ints) = material.engine_rows(engine);
            other.load_engine(engine, &reals, &ints);
        });
        assert_eq!(
            Engine::ALL.map(|e| other.engine_rows(e)),
            Engine::ALL.map(|e| material.engine_rows(e))
        );
    }
}
