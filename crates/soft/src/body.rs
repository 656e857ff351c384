//! Rigid bodies that rods pull at or touch.

use nalgebra::{Matrix6, Vector6};

use crate::V3;

/// A rigid body during a step. Six-vectors are linear first, then angular, along the axes of the world, and refer to the centre of mass.
#[derive(Debug, Clone)]
pub struct Body {
    /// Centre of mass at the beginning of the step.
    pub com: V3,
    /// Velocity that it would have at the end of the step without the rods.
    pub velocity: Vector6<f64>,
    /// Velocity that an impulse adds: for a free body the inverse of mass and inertia, for a linked one that of all that is linked with it.
    pub response: Matrix6<f64>,
    /// Out: the impulse of all rods (N s, N m s).
    pub impulse: Vector6<f64>,
}

impl Body {
    /// A free body.
    pub fn new(com: V3, velocity: Vector6<f64>, response: Matrix6<f64>) -> Self {
        Self {
            com,
            velocity,
            response,
            impulse: Vector6::zeros(),
        }
    }
}

/// How many times heavier than the rods a body is at most: what a robot holds fast would be infinitely so.
const HEAVIEST: f64 = 1e6;

/// A body as unknowns of the step: its displacement.
pub(crate) struct Unknown {
    /// Resistance to displacements: the inverse of the response by the square of the step.
    pub resistance: Matrix6<f64>,
    /// Displacement without rods, and the one found.
    pub free: Vector6<f64>,
    pub moved: Vector6<f64>,
}

impl Unknown {
    /// `rods`: mass and moment of inertia of all rods, as a scale.
    pub(crate) fn new(body: &Body, rods: [f64; 2], step: f64) -> Self {
        let mut regular = (body.response + body.response.transpose()) * 0.5;
        for axis in 0..6 {
            regular[(axis, axis)] += 1.0 / (HEAVIEST * rods[axis / 3]);
        }
        let inverse = regular.cholesky().map(|factors| factors.inverse());
        // A response that is no response: the body goes on as it would.
        let rigid = || {
            let [mass, moment] = rods.map(|scale| HEAVIEST * scale);
            Matrix6::from_diagonal(&Vector6::new(mass, mass, mass, moment, moment, moment))
        };
        let free = body.velocity * step;
        Self {
            resistance: inverse.unwrap_or_else(rigid) / (step * step),
            free,
            moved: free,
        }
    }

    /// The potential of its inertia.
    pub(crate) fn potential(&self) -> f64 {
        let beyond = self.moved - self.free;
        0.5 * beyond.dot(&(self.resistance * beyond))
    }

    /// Displacement of a point that is `lever` away from the centre of mass.
    pub(crate) fn displacement(&self, lever: &V3) -> V3 {
        let linear: V3 = self.moved.fixed_rows::<3>(0).into();
        let angular: V3 = self.moved.fixed_rows::<3>(3).into();
        linear + angular.cross(lever)
    }
}
