//! Parameters of physics engines. Those that mean something here live in materials, joints and settings; all others are kept as they
//! were set, with the defaults of SPEC-dynamics sections 5 and 6 and SPEC-joints section 2.

use super::joint::Joint;
use super::shape::Material;
use super::{Data, Field, Handle, Kind, Scene, SceneError, SceneResult};

/// First numbers of the three position gains of joints, for each engine by its number.
const GAINS: [i64; 5] = [3006, 12006, 21052, 30003, 40028];
/// The step size of each engine.
const STEP_SIZES: [i64; 4] = [1, 9001, 18001, 27001];

impl Scene {
    /// The value of an engine parameter of an object (None: a global one). Booleans are 0 and 1.
    ///
    /// # Errors
    /// When nobody set it and its default is not known.
    pub fn engine_param(&self, id: i64, object: Option<Handle>) -> SceneResult<f64> {
        let meaning = match object.map(|handle| self.object(handle)).transpose()?.map(|object| &object.kind) {
            Some(Kind::Shape(shape)) => shape.material.engine_param(id),
            Some(Kind::Joint(joint)) => self.gain_in_use(id).map(|gain| joint.pid[gain]),
            Some(_) => None,
            None => STEP_SIZES.contains(&id).then(|| self.settings().dynamics.step),
        };
        let kept = || self.engine_params.get(&(id, object.map_or(-1, Handle::raw))).and_then(Data::as_f64);
        meaning.or_else(kept).or_else(|| default(id)).ok_or(SceneError::InvalidArgument)
    }

    /// Sets an engine parameter of an object (None: a global one).
    ///
    /// # Errors
    /// For unknown objects and values that are no number.
    pub fn set_engine_param(&mut self, id: i64, object: Option<Handle>, value: f64) -> SceneResult<()> {
        if !value.is_finite() {
            return Err(SceneError::InvalidData);
        }
        let gain = self.gain_in_use(id);
        match object {
            Some(handle) => {
                let taken = self.modify(handle, Field::Dynamics, |object| match &mut object.kind {
                    Kind::Shape(shape) => shape.material.set_engine_param(id, value),
                    Kind::Joint(joint) => gain.is_some_and(|gain| set_gain(joint, gain, value)),
                    _ => false,
                })?;
                if !taken {
                    self.engine_params.insert((id, handle.raw()), value.into());
                }
            }
            None if STEP_SIZES.contains(&id) => {
                self.modify_settings(|settings| settings.dynamics.step = value.clamp(1e-5, settings.time_step));
            }
            None => {
                self.engine_params.insert((id, -1), value.into());
            }
        }
        Ok(())
    }

    /// Which gain of position control a parameter is, if it belongs to the engine that is selected.
    fn gain_in_use(&self, id: i64) -> Option<usize> {
        let first = *GAINS.get(usize::try_from(self.settings().dynamics.engine[0]).ok()?)?;
        (first..first + 3).contains(&id).then(|| (id - first) as usize)
    }

    /// Gives a shape a preset material, or that of another shape; tells whether it was another shape's.
    ///
    /// # Errors
    /// When `source` is neither a preset nor a shape.
    pub fn set_shape_material(&mut self, handle: Handle, source: i64) -> SceneResult<bool> {
        let preset = Material::preset(source);
        let copied = preset.is_none();
        let material = match preset {
            Some(preset) => preset,
            None => {
                let other = Handle::from_raw(source).ok_or(SceneError::NoSuchObject)?;
                self.object(other)?.shape()?.material.clone()
            }
        };
        self.try_modify(handle, Field::Dynamics, |object| {
            object.shape_mut()?.material = material;
            Ok(copied)
        })
    }
}

fn set_gain(joint: &mut Joint, gain: usize, value: f64) -> bool {
    joint.pid[gain] = value;
    true
}

impl Material {
    fn field(&mut self, id: i64) -> Option<&mut f64> {
        Some(match id {
            6001 => &mut self.restitution,
            6002 => &mut self.friction,
            6003 => &mut self.other_engines.bullet_new,
            6004 => &mut self.linear_damping,
            6005 => &mut self.angular_damping,
            15001 => &mut self.other_engines.ode,
            33001 => &mut self.other_engines.newton_static,
            33002 => &mut self.other_engines.newton_kinetic,
            _ => return None,
        })
    }

    fn engine_param(&self, id: i64) -> Option<f64> {
        self.clone().field(id).copied()
    }

    fn set_engine_param(&mut self, id: i64, value: f64) -> bool {
        self.field(id).map(|field| *field = value).is_some()
    }
}

/// The value of a parameter nobody has set.
fn default(id: i64) -> Option<f64> {
    bullet(id).or_else(|| ode(id)).or_else(|| newton(id)).or_else(|| mujoco(id)).or_else(|| gains(id))
}

/// Position control starts as 0.1, 0, 0 with every engine.
fn gains(id: i64) -> Option<f64> {
    GAINS.iter().find(|&&first| (first..first + 3).contains(&id)).map(|&first| if id == first { 0.1 } else { 0.0 })
}

fn bullet(id: i64) -> Option<f64> {
    Some(match id {
        2 => 10.0,
        3 | 6006 => 0.1,
        1001 => 100.0,
        2001 | 8003 => 1.0,
        3001 => 0.2,
        6007 => 0.002,
        1003 | 3002 | 3003 => 0.0,
        _ => return None,
    })
}

fn ode(id: i64) -> Option<f64> {
    Some(match id {
        9002 | 11002 | 12004 => 1.0,
        9003 | 12002 | 12005 => 1e-5,
        9004 | 12001 => 0.6,
        10001 => 100.0,
        10003 => -1.0,
        15002 => 0.2,
        16001 => 64.0,
        12003 | 15003 | 15004 | 15005 => 0.0,
        _ => return None,
    })
}

fn newton(id: i64) -> Option<f64> {
    Some(match id {
        27002 => 0.01,
        28001 => 8.0,
        33003..=33005 => 0.0,
        _ => return None,
    })
}

fn mujoco(id: i64) -> Option<f64> {
    /// solref, solimp: of limits and of contacts.
    const SOLVER: [f64; 7] = [0.02, 1.0, 0.9, 0.95, 0.001, 0.5, 2.0];
    Some(match id {
        37002 | 37019 | 43001 => 1.0,
        37018 => 1000.0,
        38002 => 100.0,
        38010 => 63.0,
        40001..=40007 => SOLVER[(id - 40001) as usize],
        43002 => 0.005,
        43003 => 0.0001,
        43009 => 0.05,
        43004..=43010 => SOLVER[(id - 43004) as usize],
        44001 => 3.0,
        37003..=37005 | 40008 | 40016..=40018 | 40021 | 40022 | 43012 => 0.0,
        _ => return None,
    })
}
