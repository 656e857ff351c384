//! The numbered parameters of joints (`sim.jointintparam_*`, `sim.jointfloatparam_*`).
//!
//! Numbers of functionality that is gone (IK weights, Vortex) are not known here.

use geometry::pose::pose_to_array;
use nalgebra::{Quaternion, UnitQuaternion};

use crate::joint::{Control, Joint};

/// Control of old releases: a motor that is on is in position control when its controller is on, in velocity control otherwise.
fn motor_control(motor: bool, controller: bool) -> Control {
    match (motor, controller) {
        (false, _) => Control::Free,
        (true, true) => Control::Position,
        (true, false) => Control::Velocity,
    }
}

impl Joint {
    /// The value of an integer parameter; None when joints have no such parameter.
    pub fn int_param(&self, id: i64) -> Option<i64> {
        let controlled = !matches!(
            self.control,
            Control::Free | Control::Force | Control::Velocity
        );
        Some(match id {
            2000 => i64::from(self.control != Control::Free),
            2001 => i64::from(controlled),
            2030 => i64::from(self.motor_lock),
            2039 => self.control as i64,
            2040 => i64::from(self.velocity_profile),
            2041 => i64::from(self.position_profile),
            _ => return None,
        })
    }

    /// Sets an integer parameter with its side effects; false when joints have no such parameter.
    pub fn set_int_param(&mut self, id: i64, value: i64) -> bool {
        let on = value != 0;
        let was = |id| self.int_param(id) == Some(1);
        match id {
            2000 => self.set_control(motor_control(on, was(2001))),
            2001 => self.set_control(motor_control(was(2000), on)),
            2030 => self.motor_lock = on,
            2039 => match Control::from_code(value) {
                Some(control) => self.set_control(control),
                None => return false,
            },
            2040 => self.velocity_profile = on,
            2041 => self.position_profile = on,
            _ => return false,
        }
        true
    }

    /// The value of a float parameter (SI units); None when joints have no such parameter.
    pub fn float_param(&self, id: i64) -> Option<f64> {
        let element = |first: i64| (id - first) as usize;
        Some(match id {
            2002..=2004 => self.gains[0][element(2002)],
            2005..=2011 => pose_to_array(&self.intrinsic_pose())[element(2005)],
            2012 => self.velocity,
            2013..=2016 => self.spherical.coords[element(2013)],
            2018 | 2019 => self.spring[element(2018)],
            2022..=2024 => self
                .error
                .map_or(0.0, |e| e.translation.vector[element(2022)]),
            2028 => self.error.map_or(0.0, |e| e.translation.vector.norm()),
            2029 => self.error.map_or(0.0, |e| e.rotation.angle()),
            // The older name of the limit.
            2017 | 2036 => self.max_vel,
            2037 => self.max_accel,
            2038 => self.max_jerk,
            2042 => self.screw_lead,
            _ => return None,
        })
    }

    /// Sets a float parameter with its side effects; false when joints have no such parameter. NaN is ignored.
    pub fn set_float_param(&mut self, id: i64, value: f64) -> bool {
        if value.is_nan() {
            return self.float_param(id).is_some();
        }
        let element = |first: i64| (id - first) as usize;
        match id {
            // From before engines had gains of their own.
            2002..=2004 => self
                .gains
                .iter_mut()
                .for_each(|gains| gains[element(2002)] = value),
            2013..=2016 => self.set_spherical(element(2013), value),
            2018 | 2019 => self.spring[element(2018)] = value,
            2017 | 2036 => self.max_vel = value,
            2037 => self.max_accel = value,
            2038 => self.max_jerk = value,
            2042 => self.set_screw_lead(value),
            _ => return false,
        }
        true
    }

    fn set_spherical(&mut self, element: usize, value: f64) {
        let mut quaternion: Quaternion<f64> = *self.spherical.quaternion();
        quaternion.coords[element] = value;
        if let Some(unit) = UnitQuaternion::try_new(quaternion, 1e-12) {
            self.spherical = unit;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joint::{JointMode, JointType};

    #[test]
    fn upper_limit_is_that_of_the_velocity() {
        let mut joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        assert!(joint.set_float_param(2017, 0.5));
        assert_eq!((joint.max_vel, joint.float_param(2017)), (0.5, Some(0.5)));
        assert_eq!(joint.range, std::f64::consts::TAU);
    }

    #[test]
    fn control_brings_its_target_velocity() {
        let mut joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        assert!(joint.set_int_param(2039, 4));
        assert_eq!(joint.target_velocity, std::f64::consts::FRAC_PI_2);
        assert!(joint.set_int_param(2039, 12));
        assert_eq!(joint.target_velocity, 1000.0);
        assert!(!joint.set_int_param(9999, 1));
    }
}
