//! Motion along a path: between two points of the line the acceleration is constant (spec: vrep-era 3.4).

use super::{PathAttributes, PathObject};

/// Limit of segments that one call passes.
const MAX_SLICES: usize = 100;
/// Slower motion counts as rest, m/s.
const REST_VELOCITY: f64 = 1e-6;

/// The state of a motion along a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Travel {
    /// Length from the start of the path, metres.
    pub position: f64,
    /// Where the relative velocity is 1, m/s.
    pub nominal_velocity: f64,
    /// The velocity that the nominal one approaches, m/s.
    pub target_velocity: f64,
}

/// How a motion changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TravelLimits {
    /// Of the nominal velocity, m/s^2; None: it is the target velocity at once.
    pub acceleration: Option<f64>,
    /// The velocity changes its sign at the ends of an open path.
    pub inverts_at_ends: bool,
}

/// A motion within one segment.
struct Slice {
    /// Seconds it takes.
    duration: f64,
    /// Where it ends.
    position: f64,
}

impl PathObject {
    /// Moves the position by `dt` seconds.
    pub fn advance(&mut self, dt: f64) {
        let start = Travel {
            position: self.position,
            nominal_velocity: self.nominal_velocity,
            target_velocity: self.target_velocity,
        };
        let infinite = self
            .attributes
            .contains(PathAttributes::INFINITE_ACCELERATION);
        let limits = TravelLimits {
            acceleration: (!infinite).then_some(self.max_acceleration),
            inverts_at_ends: self.attributes.contains(PathAttributes::INVERT_VELOCITY),
        };
        let end = self.travel(start, limits, dt);
        (self.position, self.nominal_velocity) = (end.position, end.nominal_velocity);
        self.target_velocity = end.target_velocity;
    }

    /// The motion after `dt` seconds. The position of the path itself does not change.
    pub fn travel(&self, mut travel: Travel, limits: TravelLimits, dt: f64) -> Travel {
        if self.lengths.len() < 2 || self.length() <= 0.0 {
            return travel;
        }
        if limits.acceleration.is_none() {
            travel.nominal_velocity = travel.target_velocity;
        }
        let turns_back = travel.nominal_velocity * travel.target_velocity < 0.0;
        if self.is_at_end(travel.position) && turns_back && !limits.inverts_at_ends {
            travel.nominal_velocity = 0.0;
        }
        let mut rest = dt;
        for _ in 0..MAX_SLICES {
            if rest <= 0.0 {
                break;
            }
            rest -= self.slice(&mut travel, limits, rest);
        }
        travel
    }

    /// Moves up to the next point of the line; returns the seconds used.
    fn slice(&self, travel: &mut Travel, limits: TravelLimits, rest: f64) -> f64 {
        if self.leaves(travel) {
            if !limits.inverts_at_ends {
                travel.nominal_velocity = approached(travel, limits, rest);
                return rest;
            }
            travel.nominal_velocity = -travel.nominal_velocity;
            travel.target_velocity = -travel.target_velocity;
        }
        let slice = self.motion_in_segment(travel, rest);
        travel.position = slice.position;
        travel.nominal_velocity = approached(travel, limits, slice.duration);
        slice.duration
    }

    fn is_at_end(&self, position: f64) -> bool {
        !self.is_closed() && (position <= 0.0 || position >= self.length())
    }

    /// Whether the motion leads out of an open path.
    fn leaves(&self, travel: &Travel) -> bool {
        let out_at_start = travel.position <= 0.0 && travel.nominal_velocity < 0.0;
        let out_at_end = travel.position >= self.length() && travel.nominal_velocity > 0.0;
        !self.is_closed() && (out_at_start || out_at_end)
    }

    /// The way from a position to the end of its segment in the direction of travel, at constant acceleration.
    fn motion_in_segment(&self, travel: &Travel, rest: f64) -> Slice {
        let forward = travel.nominal_velocity >= 0.0;
        let segment = self.segment_ahead(travel.position, forward);
        let (begin, end) = if forward {
            (segment, segment + 1)
        } else {
            (segment + 1, segment)
        };
        let [from, to] = [begin, end].map(|at| self.lengths[at]);
        let span = (to - from).abs();
        if span <= 0.0 {
            return Slice {
                duration: 0.0,
                position: self.at_junction(to, forward),
            };
        }
        let [v0, v1] = [begin, end].map(|at| (travel.nominal_velocity * self.velocities[at]).abs());
        let acceleration = (v1 * v1 - v0 * v0) / (2.0 * span);
        let done = (self.unwrapped(travel.position, forward) - from).abs();
        let speed = (v0 * v0 + 2.0 * acceleration * done).max(0.0).sqrt();
        if speed < REST_VELOCITY && acceleration <= 0.0 {
            return Slice {
                duration: rest,
                position: travel.position,
            };
        }
        let to_end = 2.0 * (span - done) / (speed + v1).max(f64::MIN_POSITIVE);
        if to_end <= rest {
            return Slice {
                duration: to_end,
                position: self.at_junction(to, forward),
            };
        }
        let way = speed * rest + 0.5 * acceleration * rest * rest;
        let position = if forward {
            from + done + way
        } else {
            from - done - way
        };
        Slice {
            duration: rest,
            position: self.on_path(position),
        }
    }

    /// The segment that lies ahead.
    fn segment_ahead(&self, position: f64, forward: bool) -> usize {
        if forward {
            return self.segment_at(position);
        }
        let position = self.unwrapped(position, forward);
        self.lengths[1..self.lengths.len() - 1].partition_point(|&length| length < position)
    }

    /// The start of a closed path is also its end.
    fn unwrapped(&self, position: f64, forward: bool) -> f64 {
        if !forward && position <= 0.0 && self.is_closed() {
            self.length()
        } else {
            position
        }
    }

    /// A point of the line, as the position that lies before the next segment.
    fn at_junction(&self, length: f64, forward: bool) -> f64 {
        if forward && length >= self.length() && self.is_closed() {
            0.0
        } else {
            length
        }
    }
}

/// The nominal velocity after some seconds on its way to the target.
fn approached(travel: &Travel, limits: TravelLimits, seconds: f64) -> f64 {
    let Some(acceleration) = limits.acceleration else {
        return travel.target_velocity;
    };
    let change = acceleration.max(0.0) * seconds;
    let missing = travel.target_velocity - travel.nominal_velocity;
    travel.nominal_velocity + missing.clamp(-change, change)
}
