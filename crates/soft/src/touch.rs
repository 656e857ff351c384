//! A point at which something soft touches a surface.

use nalgebra::Matrix3;

use crate::V3;

/// Where two surfaces touch, or may in this step, and what they exert there.
#[derive(Debug, Clone, PartialEq)]
pub struct Touch {
    /// The point of what is touched that is nearest, at the beginning of the step.
    pub point: V3,
    /// Points to what is soft.
    pub normal: V3,
    /// Coulomb's coefficient.
    pub friction: f64,
    /// Elongation of the spring along the surface, metres, of what is soft against what it touches.
    pub stick: V3,
    /// Out: impulse on what is soft, N s.
    pub impulse: V3,
}

impl Touch {
    /// A new one.
    pub fn new(point: V3, normal: V3, friction: f64) -> Self {
        Self {
            point,
            normal,
            friction,
            stick: V3::zeros(),
            impulse: V3::zeros(),
        }
    }

    /// Goes on with the friction of the same touch in the step before.
    pub(crate) fn carry_on(&mut self, before: &Self) {
        self.stick = before.stick - self.normal * self.normal.dot(&before.stick);
    }
}

/// Force on what is soft, and how it changes with a displacement.
pub(crate) struct Push {
    pub force: V3,
    pub stiffness: Matrix3<f64>,
    pub stick: V3,
}

/// Where a touch is in a trial.
pub(crate) struct Placed {
    /// Negative: penetration, metres.
    pub distance: f64,
    /// How far what is soft has moved against what it touches since the beginning of the step.
    pub slip: V3,
    /// N/m
    pub stiffness: f64,
}

impl Placed {
    /// The spring along the surface, if nothing gives way.
    fn stick(&self, touch: &Touch) -> V3 {
        let stick = touch.stick + self.slip;
        stick - touch.normal * touch.normal.dot(&stick)
    }

    /// Largest elongation of the spring along the surface.
    pub(crate) fn limit(&self, touch: &Touch) -> f64 {
        touch.friction * (-self.distance).max(0.0)
    }

    /// The force for a largest elongation of the spring along the surface; None where the surfaces are apart. A limit that was found while they touched holds on
    /// until the end of the step.
    pub(crate) fn push(&self, touch: &Touch, limit: f64) -> Option<Push> {
        if self.distance >= 0.0 && limit <= 0.0 {
            return None;
        }
        let (normal, stiffness) = (touch.normal, self.stiffness);
        let outer = normal * normal.transpose();
        let along = Matrix3::identity() - outer;
        let stick = self.stick(touch);
        let length = stick.norm();
        let (stick, resistance) = if length <= limit {
            (stick, along * stiffness)
        } else {
            // Where it slips, the largest stiffness that has this force: Newton's own would go too far along the surface.
            let part = limit / length;
            (stick * part, along * (stiffness * part))
        };
        let depth = (-self.distance).max(0.0);
        let pressed = if depth > 0.0 { stiffness } else { 0.0 };
        Some(Push {
            force: (normal * depth - stick) * stiffness,
            stiffness: outer * pressed + resistance,
            stick,
        })
    }

    /// The potential, for a largest elongation of the spring along the surface.
    pub(crate) fn potential(&self, touch: &Touch, limit: f64) -> f64 {
        let depth = (-self.distance).max(0.0);
        let length = self.stick(touch).norm();
        let along = if length <= limit {
            0.5 * length * length
        } else {
            limit * (length - 0.5 * limit)
        };
        self.stiffness * (0.5 * depth * depth + along)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(distance: f64, slip: f64) -> Placed {
        Placed {
            distance,
            slip: V3::x() * slip,
            stiffness: 1000.0,
        }
    }

    #[test]
    fn friction_sticks_up_to_its_limit() {
        let touch = Touch::new(V3::zeros(), V3::z(), 0.5);
        let push = |distance, slip| {
            let placed = placed(distance, slip);
            placed.push(&touch, placed.limit(&touch))
        };
        let sticks = push(-1e-3, 4e-4).unwrap();
        assert!((sticks.force - V3::new(-0.4, 0.0, 1.0)).norm() < 1e-12);
        let slips = push(-1e-3, 4e-2).unwrap();
        assert!((slips.force - V3::new(-0.5, 0.0, 1.0)).norm() < 1e-12);
        assert!(push(1e-9, 1.0).is_none());
    }
}
