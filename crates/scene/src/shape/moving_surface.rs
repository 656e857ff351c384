//! Shapes whose surface moves along them, as belts do: what bodies in MJCF have.

use crate::{Data, Object, Pose};
use nalgebra::Vector3;

/// Name of the custom data of a shape that say how its surface moves: six numbers, metres per second along the axes of the shape and radians per second about them, or none. With it MuJoCo's parameters of the
/// shape (`gravcomp`, `adhesion`) count with any engine.
pub const SURFACE: &str = "mjcfSurface";

/// How a surface moves, in the frame of its shape.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MovingSurface {
    /// Of the origin, m/s.
    pub linear: [f64; 3],
    /// rad/s
    pub angular: [f64; 3],
}

impl MovingSurface {
    /// What a text says: six numbers, nothing else.
    pub fn parse(text: &str) -> Option<Self> {
        let numbers = text.split_whitespace().map(str::parse::<f64>);
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>().ok()?;
        let [x, y, z, a, b, c] = numbers[..] else {
            return None;
        };
        let is_finite = numbers.iter().all(|number| number.is_finite());
        is_finite.then_some(Self {
            linear: [x, y, z],
            angular: [a, b, c],
        })
    }

    /// The same motion in another frame, in which this one has that pose.
    pub fn seen_from(&self, pose: &Pose) -> Self {
        let turn = |v: [f64; 3]| pose.rotation * Vector3::from(v);
        let (linear, angular) = (turn(self.linear), turn(self.angular));
        let moved = linear - angular.cross(&pose.translation.vector);
        Self {
            linear: moved.into(),
            angular: angular.into(),
        }
    }
}

impl std::fmt::Display for MovingSurface {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let numbers = self.linear.iter().chain(&self.angular);
        let texts: Vec<String> = numbers.map(f64::to_string).collect();
        f.write_str(&texts.join(" "))
    }
}

impl Object {
    /// Whether MuJoCo's parameters of this shape count with any engine.
    pub fn is_of_mujoco(&self) -> bool {
        self.custom_data.typed(SURFACE).is_some()
    }

    /// How the surface of this shape moves, if it says so.
    pub fn moving_surface(&self) -> Option<MovingSurface> {
        let (_, value) = self.custom_data.typed(SURFACE)?;
        match value {
            Data::Text(text) | Data::Buffer(text) => {
                MovingSurface::parse(&String::from_utf8_lossy(text))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_is_six_numbers() {
        let surface = MovingSurface {
            linear: [0.4, 0.0, -1.0],
            angular: [0.0, 0.5, 0.0],
        };
        assert_eq!(MovingSurface::parse(&surface.to_string()), Some(surface));
        for text in ["", "1 2 3", "1 2 3 4 5 x", "1 2 3 4 5 inf", "1 2 3 4 5 6 7"] {
            assert_eq!(MovingSurface::parse(text), None, "{text}");
        }
    }

    /// Points of the surface have the same velocity in both frames.
    #[test]
    fn a_motion_is_the_same_seen_from_elsewhere() {
        let surface = MovingSurface {
            linear: [0.4, 0.1, -1.0],
            angular: [0.2, 0.5, -0.3],
        };
        let turn = nalgebra::UnitQuaternion::from_euler_angles(0.3, -0.7, 1.1);
        let pose = Pose::from_parts(nalgebra::Translation3::new(1.0, 2.0, 3.0), turn);
        let there = surface.seen_from(&pose);
        let at = |motion: &MovingSurface, point: Vector3<f64>| {
            Vector3::from(motion.linear) + Vector3::from(motion.angular).cross(&point)
        };
        let point = Vector3::new(0.3, -0.2, 0.7);
        let placed = (pose * nalgebra::Point3::from(point)).coords;
        let difference = at(&there, placed) - turn * at(&surface, point);
        assert!(difference.norm() < 1e-12);
    }
}
