//! The values of engine parameters. Those the physics here uses are fields of materials and joints; all others are kept beside them as
//! they were set.

use super::engine::{
    Engine, EngineOwner, EngineParam, Numbered, SelectedEngine, engine_params, is_step_size,
    numbered,
};
use crate::joint::Joint;
use crate::shape::Material;
use crate::{Data, Field, Handle, InertValues, Object, Scene, SceneError, SceneResult};

/// The version of Bullet that has the newer friction; version 0 is Bullet 2.78.
const BULLET_283: i64 = 283;

impl Scene {
    /// The value of an engine parameter: of a shape, a joint or a dummy, or of the scene (`object` does not matter then).
    ///
    /// # Errors
    /// When the parameter belongs to another type of object.
    pub fn engine_value(&self, param: &EngineParam, object: Option<Handle>) -> SceneResult<Data> {
        let object = || self.object(object.ok_or(SceneError::InvalidArgument)?);
        Ok(match param.owner {
            EngineOwner::Scene => value_in(&self.settings().dynamics.engine_values, param),
            EngineOwner::Material => object()?.shape()?.material.engine_value(param),
            EngineOwner::Joint => object()?.joint()?.engine_value(param),
            EngineOwner::Dummy => value_in(&object()?.dummy()?.engine_values, param),
        })
    }

    /// Sets an engine parameter.
    ///
    /// # Errors
    /// When the parameter belongs to another type of object, and for values that are not finite or of another type or length.
    pub fn set_engine_value(
        &mut self,
        param: &EngineParam,
        object: Option<Handle>,
        value: Data,
    ) -> SceneResult<()> {
        let value = param
            .ty
            .accept(&param.default, value)
            .ok_or(SceneError::InvalidData)?;
        if param.owner == EngineOwner::Scene {
            self.modify_settings(|settings| settings.dynamics.engine_values.set(param.name, value));
            return Ok(());
        }
        let handle = object.ok_or(SceneError::InvalidArgument)?;
        let field = if param.works {
            Field::Dynamics
        } else {
            Field::Inert
        };
        self.try_modify(handle, field, |object| set_in(object, param, value))
    }

    /// The number an old parameter of an engine has; switches are 0 and 1.
    ///
    /// # Errors
    /// When there is no such parameter, or the object is not of its type.
    pub fn engine_param(&self, number: i64, object: Option<Handle>) -> SceneResult<f64> {
        if is_step_size(number) {
            return Ok(self.settings().dynamics.step);
        }
        match numbered(number).ok_or(SceneError::InvalidArgument)? {
            Numbered::Element(param, at) => {
                element(&self.engine_value(param, object)?, *at).ok_or(SceneError::InvalidData)
            }
            Numbered::Bits(switches) => {
                let mut bits = 0;
                for (param, bit) in switches {
                    bits |= if self.engine_value(param, object)? == Data::Bool(true) {
                        *bit
                    } else {
                        0
                    };
                }
                Ok(bits as f64)
            }
        }
    }

    /// Sets an old parameter of an engine, but for its step size, which is a setting of the simulation.
    ///
    /// # Errors
    /// When there is no such parameter, the object is not of its type, or the value is not finite.
    pub fn set_engine_param(
        &mut self,
        number: i64,
        object: Option<Handle>,
        value: f64,
    ) -> SceneResult<()> {
        if !value.is_finite() {
            return Err(SceneError::InvalidData);
        }
        match numbered(number).ok_or(SceneError::InvalidArgument)? {
            Numbered::Element(param, at) => {
                let whole = with_element(self.engine_value(param, object)?, *at, value);
                self.set_engine_value(param, object, whole)
            }
            Numbered::Bits(switches) => switches.iter().try_for_each(|(param, bit)| {
                self.set_engine_value(param, object, Data::Bool(value as i64 & bit != 0))
            }),
        }
    }

    /// Assigns a preset material or that of another shape; returns whether it was another shape's.
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

/// Values that were not set are the default.
pub(crate) fn value_in(values: &InertValues, param: &EngineParam) -> Data {
    values.get(param.name).unwrap_or(&param.default).clone()
}

fn set_in(object: &mut Object, param: &EngineParam, value: Data) -> SceneResult<()> {
    match param.owner {
        EngineOwner::Material => object.shape_mut()?.material.set_engine_value(param, value),
        EngineOwner::Joint => object.joint_mut()?.set_engine_value(param, value),
        EngineOwner::Dummy => {
            object.dummy_mut()?.engine_values.set(param.name, value);
        }
        EngineOwner::Scene => return Err(SceneError::InvalidArgument),
    }
    Ok(())
}

pub(crate) fn element(value: &Data, at: usize) -> Option<f64> {
    match value {
        Data::Bool(on) => Some(f64::from(u8::from(*on))),
        Data::Array(items) => items.get(at)?.as_f64(),
        number => number.as_f64(),
    }
}

pub(crate) fn with_element(whole: Data, at: usize, value: f64) -> Data {
    match whole {
        Data::Bool(_) => Data::Bool(value != 0.0),
        Data::Int(_) => Data::Int(value as i64),
        Data::Array(mut items) => {
            if let Some(item) = items.get_mut(at) {
                *item = Data::Float(value);
            }
            Data::Array(items)
        }
        _ => Data::Float(value),
    }
}

impl Material {
    /// The field behind a parameter that the physics here uses.
    fn field(&mut self, name: &str) -> Option<&mut f64> {
        Some(match name {
            "bullet.restitution" => &mut self.restitution,
            "bullet.frictionOld" => &mut self.friction,
            "bullet.linearDamping" => &mut self.linear_damping,
            "bullet.angularDamping" => &mut self.angular_damping,
            _ => return None,
        })
    }

    /// Friction and restitution that the selected engine would use.
    pub fn contact_values(&self, selected: SelectedEngine) -> (f64, f64) {
        let value = |name: &str| {
            self.named_value(name)
                .as_ref()
                .and_then(|value| element(value, 0))
                .unwrap_or_default()
        };
        match selected.engine {
            Engine::Ode => (value("ode.friction"), 0.0),
            Engine::Vortex => (
                value("vortex.linearPrimaryAxisFrictionValue"),
                value("vortex.restitution"),
            ),
            Engine::Newton => (value("newton.kineticFriction"), value("newton.restitution")),
            Engine::Mujoco => (value("mujoco.friction"), 0.0),
            Engine::Bullet if selected.version == BULLET_283 => {
                (value("bullet.friction"), self.restitution)
            }
            Engine::Bullet => (self.friction, self.restitution),
        }
    }

    fn named_value(&self, name: &str) -> Option<Data> {
        engine_params(EngineOwner::Material)
            .find(|param| param.name == name)
            .map(|param| self.engine_value(param))
    }

    pub(crate) fn engine_value(&self, param: &EngineParam) -> Data {
        match param.name {
            "bullet.restitution" => self.restitution.into(),
            "bullet.frictionOld" => self.friction.into(),
            "bullet.linearDamping" => self.linear_damping.into(),
            "bullet.angularDamping" => self.angular_damping.into(),
            _ => value_in(&self.engine_values, param),
        }
    }

    pub(crate) fn set_engine_value(&mut self, param: &EngineParam, value: Data) {
        match (self.field(param.name), value.as_f64()) {
            (Some(field), Some(number)) => *field = number,
            _ => {
                self.engine_values.set(param.name, value);
            }
        }
    }
}

impl Joint {
    pub(crate) fn engine_value(&self, param: &EngineParam) -> Data {
        engine_of_gains(param).map_or_else(
            || value_in(&self.engine_values, param),
            |engine| self.gains[engine].into(),
        )
    }

    pub(crate) fn set_engine_value(&mut self, param: &EngineParam, value: Data) {
        match engine_of_gains(param) {
            Some(engine) => {
                self.gains[engine] = [0, 1, 2].map(|at| element(&value, at).unwrap_or_default());
            }
            None => {
                self.engine_values.set(param.name, value);
            }
        }
    }
}

/// The number of the engine whose gains of position control the parameter is.
fn engine_of_gains(param: &EngineParam) -> Option<usize> {
    let (engine, "posPid") = param.split() else {
        return None;
    };
    Engine::ALL
        .into_iter()
        .position(|known| known.name() == engine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;
    use crate::joint::{JointMode, JointType};

    #[test]
    fn numbers_and_names_lead_to_the_same_value() {
        let mut scene = Scene::new();
        let joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        let joint = scene
            .add("joint", Kind::Joint(Box::new(joint)))
            .expect("there is room");
        scene
            .set_engine_param(12_007, Some(joint), 0.5)
            .expect("ODE has an integral gain");
        assert_eq!(
            scene
                .object(joint)
                .and_then(Object::joint)
                .map(|joint| joint.gains[1]),
            Ok([0.1, 0.5, 0.0])
        );
        let named = engine_params(EngineOwner::Joint)
            .find(|param| param.name == "ode.posPid")
            .expect("it has a row");
        assert_eq!(
            scene.engine_value(named, Some(joint)),
            Ok(vec![0.1, 0.5, 0.0].into())
        );
        assert_eq!(
            scene.engine_param(6003, Some(joint)),
            Err(SceneError::WrongType("shape"))
        );
    }

    #[test]
    fn the_selected_engine_decides_about_contacts() {
        let selected = |engine, version| SelectedEngine { engine, version };
        let grip = Material::rest_stack_grasp();
        assert_eq!(grip.contact_values(selected(Engine::Bullet, 0)), (1.0, 0.0));
        assert_eq!(
            grip.contact_values(selected(Engine::Bullet, BULLET_283)),
            (0.5, 0.0)
        );
        assert_eq!(
            Material::default().contact_values(selected(Engine::Ode, 0)),
            (0.71, 0.0)
        );
        assert_eq!(
            Material::default().contact_values(selected(Engine::Mujoco, 0)),
            (1.0, 0.0)
        );
    }

    #[test]
    fn joined_switches_are_set_together() {
        let mut scene = Scene::new();
        assert_eq!(scene.engine_param(1002, None), Ok(1.0));
        scene
            .set_engine_param(1002, None, 2.0)
            .expect("Bullet has global switches");
        assert_eq!(scene.engine_param(2001, None), Ok(0.0));
        assert_eq!(scene.engine_param(2002, None), Ok(1.0));
        assert!(scene.set_engine_param(1002, None, f64::NAN).is_err());
        assert!(scene.engine_param(-1, None).is_err());
    }
}
