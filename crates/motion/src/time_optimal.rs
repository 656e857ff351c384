//! The fastest motion along a path within limits of velocity and acceleration, from rest to rest: TOPP-RA
//! (Pham and Pham, "A new approach to time-optimal path parameterization based on reachability analysis").
//!
//! The path is a spline over s from 0 to 1. On a grid, with x the square of ds/dt and u its second derivative, all limits are lines
//! in (u, x). Backwards, the largest x is found from which the end can be reached; forwards, the largest u is taken.

use thiserror::Error;

use super::spline::{Boundary, CubicSpline};

/// Number of intervals of the grid, unless the pieces of the path require more.
const INTERVALS: usize = 2000;
/// Intervals of the grid per piece of the path, at least.
const INTERVALS_PER_PIECE: usize = 4;
/// Largest square of ds/dt: bounds what no limit bounds.
const MAX_SQUARED_SPEED: f64 = 1e10;
/// Derivatives below this fraction of the largest one count as zero.
const RELATIVE_TOLERANCE: f64 = 1e-10;

/// Lowest and highest value per axis; infinity for none.
pub type Limits = Vec<[f64; 2]>;

/// Why there is no trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum TimeOptimalError {
    /// A number is NaN or infinite.
    #[error("invalid data.")]
    NotFinite,
    /// The lists do not belong together.
    #[error("Bad table size.")]
    Sizes,
    #[error(
        "path lengths must rise strictly: the path has repeated points, or its lengths are not those of its points."
    )]
    /// Path lengths do not rise strictly.
    RepeatedPoints,
    /// A lower limit is above zero, or an upper one below.
    #[error("limits must come in pairs of a minimum of at most 0 and a maximum of at least 0.")]
    Limits,
    /// A periodic path does not end where it begins.
    #[error("with the 'periodic' boundary condition, the first and the last point must be equal.")]
    NotClosed,
    /// The limits cannot be kept.
    #[error("no trajectory along the path keeps the limits.")]
    Infeasible,
}

/// A path with the times at which its points are passed.
#[derive(Debug, Clone)]
pub struct TimedPath {
    spline: CubicSpline,
    /// Grid: parameter, its velocity and the time.
    grid: Vec<[f64; 3]>,
}

impl TimedPath {
    /// The fastest motion through `path` (one point after the other), whose points lie at the given `lengths`.
    ///
    /// # Errors
    /// Every variant of [`TimeOptimalError`].
    pub fn new(
        path: &[f64],
        lengths: &[f64],
        velocity: &Limits,
        acceleration: &Limits,
        boundary: Boundary,
    ) -> Result<Self, TimeOptimalError> {
        let spline = spline(path, lengths, boundary)?;
        let sized = velocity.len() == spline.axes() && acceleration.len() == spline.axes();
        if !sized {
            return Err(TimeOptimalError::Sizes);
        }
        if !velocity
            .iter()
            .chain(acceleration)
            .all(|[low, high]| *low <= 0.0 && *high >= 0.0)
        {
            return Err(TimeOptimalError::Limits);
        }
        let places = places(spline.knots());
        let stages = stages(&spline, &places, velocity, acceleration);
        let squares = forward(&stages, &backward(&stages));
        let grid = timed(&places, &squares).ok_or(TimeOptimalError::Infeasible)?;
        Ok(Self { spline, grid })
    }

    /// Seconds from start to end.
    pub fn duration(&self) -> f64 {
        self.grid.last().map_or(0.0, |[_, _, time]| *time)
    }

    /// The configuration at a time.
    pub fn at(&self, time: f64) -> impl Iterator<Item = f64> {
        let cell = self
            .grid
            .partition_point(|[_, _, t]| *t <= time)
            .clamp(1, self.grid.len() - 1)
            - 1;
        let ([s, v, t], [next_s, next_v, next_t]) = (self.grid[cell], self.grid[cell + 1]);
        let (dt, acceleration) = (time - t, (next_v - v) / (next_t - t));
        let parameter = (s + dt * (v + 0.5 * acceleration * dt)).clamp(s, next_s);
        self.spline.at(parameter).map(|[value, ..]| value)
    }
}

fn spline(
    path: &[f64],
    lengths: &[f64],
    boundary: Boundary,
) -> Result<CubicSpline, TimeOptimalError> {
    let count = lengths.len();
    if count < 2 || path.len() < count || !path.len().is_multiple_of(count) {
        return Err(TimeOptimalError::Sizes);
    }
    if !path.iter().chain(lengths).all(|x| x.is_finite()) {
        return Err(TimeOptimalError::NotFinite);
    }
    let axes = path.len() / count;
    let (start, total) = (lengths[0], lengths[count - 1] - lengths[0]);
    let knots: Vec<f64> = lengths
        .iter()
        .map(|length| (length - start) / total)
        .collect();
    if total.is_nan() || total <= 0.0 || !knots.windows(2).all(|pair| pair[0] < pair[1]) {
        return Err(TimeOptimalError::RepeatedPoints);
    }
    let axis = |axis: usize| path.iter().skip(axis).step_by(axes).copied().collect();
    let points: Vec<Vec<f64>> = (0..axes).map(axis).collect();
    if boundary == Boundary::Periodic
        && points
            .iter()
            .any(|axis| (axis[0] - axis[count - 1]).abs() > 1e-9)
    {
        return Err(TimeOptimalError::NotClosed);
    }
    Ok(CubicSpline::new(knots, points, boundary))
}

/// The grid: all knots, and as many equal parts between them as their distance requires.
fn places(knots: &[f64]) -> Vec<f64> {
    let mut places = vec![0.0];
    for pair in knots.windows(2) {
        let parts =
            (((pair[1] - pair[0]) * INTERVALS as f64).ceil() as usize).max(INTERVALS_PER_PIECE);
        places.extend((1..=parts).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / parts as f64));
    }
    places
}

/// `u * a + x * b <= c`.
#[derive(Debug, Clone, Copy)]
struct Line {
    a: f64,
    b: f64,
    c: f64,
}

/// The constraints between a grid point and the next one.
struct Stage {
    lines: Vec<Line>,
    /// Bound of x.
    fastest: f64,
    /// Twice the way to the next place: x changes by `u` times this.
    reach: f64,
}

fn stages(
    spline: &CubicSpline,
    places: &[f64],
    velocity: &Limits,
    acceleration: &Limits,
) -> Vec<Stage> {
    let derivatives: Vec<Vec<[f64; 2]>> = places
        .iter()
        .map(|s| spline.at(*s).map(|[_, d, dd]| [d, dd]).collect())
        .collect();
    let largest = derivatives
        .iter()
        .flatten()
        .flatten()
        .fold(0.0_f64, |m, d| m.max(d.abs()));
    let negligible = RELATIVE_TOLERANCE * largest;
    let stage = |i: usize| {
        let reach = 2.0 * (places[i + 1] - places[i]);
        let mut lines = Vec::new();
        for ((here, next), [low, high]) in derivatives[i]
            .iter()
            .zip(&derivatives[i + 1])
            .zip(acceleration)
        {
            // The limits hold at both ends of the interval: else u jumps to and fro where a derivative passes zero.
            for [a, b] in [*here, [next[0] + reach * next[1], next[1]]] {
                if a.abs() > negligible || b.abs() > negligible {
                    lines.push(Line { a, b, c: *high });
                    lines.push(Line {
                        a: -a,
                        b: -b,
                        c: -*low,
                    });
                }
            }
        }
        lines.retain(|line| line.c.is_finite());
        Stage {
            lines,
            fastest: fastest(&derivatives[i], velocity, negligible),
            reach,
        }
    };
    (0..places.len() - 1).map(stage).collect()
}

/// The largest x that the limits of velocity allow.
fn fastest(derivatives: &[[f64; 2]], velocity: &Limits, negligible: f64) -> f64 {
    let bound = |([derivative, _], [low, high]): (&[f64; 2], &[f64; 2])| {
        let limit = if *derivative > 0.0 { high } else { low };
        if derivative.abs() > negligible {
            (limit / derivative).powi(2)
        } else {
            MAX_SQUARED_SPEED
        }
    };
    derivatives
        .iter()
        .zip(velocity)
        .map(bound)
        .fold(MAX_SQUARED_SPEED, f64::min)
}

impl Stage {
    /// All lines, with those that keep the next x between 0 and `next`.
    fn lines(&self, next: f64) -> impl Iterator<Item = Line> {
        let within = [
            Line {
                a: self.reach,
                b: 1.0,
                c: next,
            },
            Line {
                a: -self.reach,
                b: -1.0,
                c: 0.0,
            },
        ];
        self.lines.iter().copied().chain(within)
    }

    /// The lines that bound u most at `x`: from below and from above.
    fn bounds(&self, x: f64, next: f64) -> (Line, Line) {
        let u = |line: &Line| (line.c - line.b * x) / line.a;
        let of_sign = |sign: f64| self.lines(next).filter(move |line| line.a * sign > 0.0);
        // Both are there: the last two lines of every stage.
        let none = Line {
            a: 1.0,
            b: 0.0,
            c: f64::INFINITY,
        };
        let low = of_sign(-1.0)
            .max_by(|l, m| u(l).total_cmp(&u(m)))
            .unwrap_or(none);
        let high = of_sign(1.0)
            .min_by(|l, m| u(l).total_cmp(&u(m)))
            .unwrap_or(none);
        (low, high)
    }

    /// The largest x from which an x of at most `next` can be reached. The room for u shrinks ever faster with x, so that where its
    /// two bounds meet is never too low: Newton's method from above ends exactly.
    fn largest_x(&self, next: f64) -> f64 {
        let upright = self
            .lines
            .iter()
            .filter(|line| line.a == 0.0 && line.b > 0.0)
            .map(|line| line.c / line.b);
        let mut x = upright.fold(self.fastest, f64::min);
        for _ in 0..2 * self.lines.len() + 8 {
            let (low, high) = self.bounds(x, next);
            let slope = low.b / low.a - high.b / high.a;
            let meeting = (low.c / low.a - high.c / high.a) / slope;
            let room = (high.c - high.b * x) / high.a - (low.c - low.b * x) / low.a;
            if room >= 0.0 || meeting.is_nan() || meeting >= x {
                break;
            }
            x = meeting.max(0.0);
        }
        x
    }

    /// The largest x at the next place, coming with `x`.
    fn step(&self, x: f64, next: f64) -> f64 {
        let (low, high) = self.bounds(x, next);
        let at = |line: Line| (line.c - line.b * x) / line.a;
        // If rounding leaves an empty interval, the middle is used.
        let u = if at(low) <= at(high) {
            at(high)
        } else {
            0.5 * (at(low) + at(high))
        };
        (x + self.reach * u).clamp(0.0, next)
    }
}

/// Per place, the largest x from which the end can be reached at rest.
fn backward(stages: &[Stage]) -> Vec<f64> {
    let mut reachable = vec![0.0; stages.len() + 1];
    for (i, stage) in stages.iter().enumerate().rev() {
        reachable[i] = stage.largest_x(reachable[i + 1]);
    }
    reachable
}

/// From rest, always as fast as possible.
fn forward(stages: &[Stage], reachable: &[f64]) -> Vec<f64> {
    let mut squares = vec![0.0];
    let mut x = 0.0;
    for (stage, next) in stages.iter().zip(&reachable[1..]) {
        x = stage.step(x, *next);
        squares.push(x);
    }
    squares
}

/// Parameter, velocity and time; `None` when the motion gets stuck.
fn timed(places: &[f64], squares: &[f64]) -> Option<Vec<[f64; 3]>> {
    let mut time = 0.0;
    let mut grid = vec![[places[0], squares[0].sqrt(), 0.0]];
    for i in 1..places.len() {
        let speeds = squares[i - 1].sqrt() + squares[i].sqrt();
        time += 2.0 * (places[i] - places[i - 1]) / speeds;
        grid.push([places[i], squares[i].sqrt(), time]);
    }
    let rising = grid.windows(2).all(|pair| pair[0][2] < pair[1][2]);
    (time.is_finite() && rising).then_some(grid)
}

#[cfg(test)]
mod tests {
    use test_support::random::Random;

    use super::*;

    fn timed_path(path: &[f64], lengths: &[f64], v: f64, a: f64, boundary: Boundary) -> TimedPath {
        let limits = |limit: f64| vec![[-limit, limit]; path.len() / lengths.len()];
        TimedPath::new(path, lengths, &limits(v), &limits(a), boundary)
            .expect("a path that can be followed")
    }

    #[test]
    fn straight_lines_are_trapezoids() {
        // Distance 2 at 0.5 m/s and 1 m/s2: 2 / 0.5 + 0.5 / 1. Distance 1 without reaching the limit: 2 sqrt(1).
        for (path, v, duration) in [
            ([0.0, 2.0], 0.5, 4.5),
            ([1.0, 0.0], 9.0, 2.0),
            ([0.0, -1.0], f64::INFINITY, 2.0),
        ] {
            let timed = timed_path(&path, &[0.0, 1.0], v, 1.0, Boundary::NotAKnot);
            assert!(
                (timed.duration() - duration).abs() < 1e-3,
                "{} is not {duration}",
                timed.duration()
            );
            assert_eq!(timed.at(0.0).next(), Some(path[0]));
            assert!((timed.at(duration).next().unwrap() - path[1]).abs() < 1e-6);
        }
    }

    #[test]
    fn the_slower_axis_and_the_weaker_side_decide() {
        let v = vec![[-9.0, 9.0], [-0.25, 9.0]];
        let a = vec![[-4.0, 9.0], [-9.0, 9.0]];
        let timed = TimedPath::new(
            &[0.0, 0.0, 2.0, -1.0],
            &[0.0, 1.0],
            &v,
            &a,
            Boundary::NotAKnot,
        )
        .unwrap();
        // Axis 1 at 0.25: 4 s; axis 0 reaches 0.5 with 9 and stops with 4: half of both times more.
        let duration = 4.0 + 0.5 * (0.5 / 9.0 + 0.5 / 4.0);
        assert!(
            (timed.duration() - duration).abs() < 1e-3,
            "{} is not {duration}",
            timed.duration()
        );
    }

    #[test]
    fn limits_are_kept_everywhere() {
        let mut random = Random::new(1);
        for boundary in [Boundary::NotAKnot, Boundary::Natural, Boundary::Clamped] {
            for points in [3, 4, 10] {
                let path: Vec<f64> = (0..3 * points).map(|_| random.signed()).collect();
                let lengths: Vec<f64> = (0..points).map(f64::from).collect();
                let timed = timed_path(&path, &lengths, 1.0, 2.0, boundary);
                let h = timed.duration() / 5000.0;
                let at = |i: usize| timed.at(h * i as f64).collect::<Vec<f64>>();
                for i in 1..5000 {
                    let (before, here, after) = (at(i - 1), at(i), at(i + 1));
                    for axis in 0..3 {
                        let velocity = (after[axis] - before[axis]) / (2.0 * h);
                        let acceleration =
                            (after[axis] - 2.0 * here[axis] + before[axis]) / (h * h);
                        assert!(
                            velocity.abs() < 1.001,
                            "{boundary:?} {points}: velocity {velocity}"
                        );
                        assert!(
                            acceleration.abs() < 2.05,
                            "{boundary:?} {points}: acceleration {acceleration}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn what_cannot_be_followed_is_refused() {
        let limits = vec![[-1.0, 1.0]];
        let new = |path: &[f64], lengths: &[f64], v: &Limits, a: &Limits, boundary| {
            TimedPath::new(path, lengths, v, a, boundary).err()
        };
        let knot = Boundary::NotAKnot;
        let one = [0.0, 1.0];
        assert_eq!(
            new(&one, &[0.0], &limits, &limits, knot),
            Some(TimeOptimalError::Sizes)
        );
        assert_eq!(
            new(&one, &one, &vec![], &limits, knot),
            Some(TimeOptimalError::Sizes)
        );
        assert_eq!(
            new(&[0.0, f64::NAN], &one, &limits, &limits, knot),
            Some(TimeOptimalError::NotFinite)
        );
        for lengths in [[0.0, 0.0], [1.0, 0.0]] {
            assert_eq!(
                new(&one, &lengths, &limits, &limits, knot),
                Some(TimeOptimalError::RepeatedPoints)
            );
        }
        assert_eq!(
            new(&[0.0, 1.0, 1.0], &[0.0, 1.0, 1.0], &limits, &limits, knot),
            Some(TimeOptimalError::RepeatedPoints)
        );
        for bad in [[1.0, 2.0], [f64::NAN, 1.0]] {
            assert_eq!(
                new(&one, &one, &vec![bad], &limits, knot),
                Some(TimeOptimalError::Limits)
            );
            assert_eq!(
                new(&one, &one, &limits, &vec![bad], knot),
                Some(TimeOptimalError::Limits)
            );
        }
        let zero = vec![[0.0, 0.0]];
        assert_eq!(
            new(&one, &one, &zero, &limits, knot),
            Some(TimeOptimalError::Infeasible)
        );
        assert_eq!(
            new(&one, &one, &limits, &zero, knot),
            Some(TimeOptimalError::Infeasible)
        );
        assert_eq!(
            new(&one, &one, &limits, &limits, Boundary::Periodic),
            Some(TimeOptimalError::NotClosed)
        );
        assert!(
            new(&[1e300, -1e300], &[0.0, 1e300], &limits, &limits, knot)
                .is_none_or(|e| e == TimeOptimalError::Infeasible)
        );
    }
}
