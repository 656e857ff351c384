//! Numbered parameters by object type: where a value is stored, and side effects of a change.

use crate::object::dummy::LinkType;
use crate::{Field, Handle, Kind, Scene, SceneResult};

/// Parameters of shapes whose change needs a new rigid body.
const BODY_PARAMS: [i64; 4] = [3003, 3004, 3005, 3030];

impl Scene {
    /// The value of an integer parameter of the object's type; None when it has no such parameter.
    pub(crate) fn kind_int_param(&self, handle: Handle, id: i64) -> SceneResult<Option<i64>> {
        Ok(match &self.object(handle)?.kind {
            Kind::Joint(joint) => joint.int_param(id),
            Kind::Shape(shape) => shape.int_param(id),
            Kind::Dummy(dummy) if id == 10000 => Some(dummy.link_type as i64),
            _ => self.object(handle)?.display_int_param(id),
        })
    }

    /// Sets an integer parameter of the object's type; false when it has no such parameter.
    pub(crate) fn set_kind_int_param(
        &mut self,
        handle: Handle,
        id: i64,
        value: i64,
    ) -> SceneResult<bool> {
        match &self.object(handle)?.kind {
            Kind::Joint(_) => self.modify_joint(handle, |joint| joint.set_int_param(id, value)),
            Kind::Shape(_) => {
                self.set_shape_param(handle, id, |shape| shape.set_int_param(id, value))
            }
            Kind::Dummy(_) if id == 10000 => match LinkType::from_code(value) {
                Some(link_type) => self.set_link_type(handle, link_type).map(|()| true),
                None => Ok(false),
            },
            _ => self.set_display_int(handle, id, value),
        }
    }

    /// The value of a float parameter of the object's type (SI units); None when it has no such parameter.
    pub(crate) fn kind_float_param(&self, handle: Handle, id: i64) -> SceneResult<Option<f64>> {
        Ok(match &self.object(handle)?.kind {
            Kind::Joint(joint) if id == 2012 && joint.dependency.is_some() => {
                Some(self.joint_velocity(handle)?)
            }
            Kind::Joint(joint) => joint.float_param(id),
            Kind::Shape(shape) => shape.float_param(id),
            Kind::Dummy(dummy) if id == 10003 => Some(dummy.size),
            _ => self.object(handle)?.display_float_param(id),
        })
    }

    /// Sets a float parameter of the object's type; false when it has no such parameter.
    pub fn set_kind_float_param(
        &mut self,
        handle: Handle,
        id: i64,
        value: f64,
    ) -> SceneResult<bool> {
        match &self.object(handle)?.kind {
            Kind::Joint(_) => {
                let known = self.modify_joint(handle, |joint| joint.set_float_param(id, value))?;
                self.relimit_joint(handle)?;
                Ok(known)
            }
            Kind::Shape(_) => {
                self.set_shape_param(handle, id, |shape| shape.set_float_param(id, value))
            }
            Kind::Dummy(_) if id == 10003 && value.is_finite() => {
                self.try_modify(handle, Field::Appearance, |object| {
                    object.dummy_mut()?.size = value;
                    Ok(true)
                })
            }
            _ => self.set_display_float(handle, id, value),
        }
    }

    fn set_shape_param(
        &mut self,
        handle: Handle,
        id: i64,
        set: impl FnOnce(&mut crate::shape::Shape) -> bool,
    ) -> SceneResult<bool> {
        self.try_modify(handle, Field::Dynamics, |object| {
            let known = set(object.shape_mut()?);
            object.dynamics_reset |= known && BODY_PARAMS.contains(&id);
            Ok(known)
        })
    }
}
