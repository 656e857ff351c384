//! Cubic splines through configurations: values and derivatives over one parameter, all axes at once.
//!
//! The ends are those of SciPy's `CubicSpline`, since trajectory code names them that way.

/// The boundary conditions of a spline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Boundary {
    /// The first two pieces are one polynomial, and the last two.
    NotAKnot,
    /// No slope.
    Clamped,
    /// No curvature.
    Natural,
    /// Closed: slope and curvature go on from the last point to the first, which are equal.
    Periodic,
}

impl Boundary {
    /// By the name scripts use.
    pub fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "not-a-knot" => Self::NotAKnot,
            "clamped" => Self::Clamped,
            "natural" => Self::Natural,
            "periodic" => Self::Periodic,
            _ => return None,
        })
    }
}

/// A spline through points of several axes.
#[derive(Debug, Clone)]
pub struct CubicSpline {
    knots: Vec<f64>,
    /// Per axis, per knot: value and slope.
    axes: Vec<Vec<[f64; 2]>>,
}

impl CubicSpline {
    /// Through `points` (one list of values per axis, as long as `knots`). The knots rise strictly, and there are two at least.
    pub fn new(knots: Vec<f64>, points: Vec<Vec<f64>>, boundary: Boundary) -> Self {
        let axis = |values: Vec<f64>| {
            let slopes = slopes(&knots, &values, boundary);
            values
                .into_iter()
                .zip(slopes)
                .map(|(value, slope)| [value, slope])
                .collect()
        };
        let axes = points.into_iter().map(axis).collect();
        Self { knots, axes }
    }

    /// The parameters at which the spline passes its points, rising.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Number of axes.
    pub fn axes(&self) -> usize {
        self.axes.len()
    }

    /// Per axis: value, first and second derivative.
    pub fn at(&self, s: f64) -> impl Iterator<Item = [f64; 3]> {
        let last_piece = self.knots.len() - 2;
        let piece = self
            .knots
            .partition_point(|knot| *knot <= s)
            .saturating_sub(1)
            .min(last_piece);
        let width = self.knots[piece + 1] - self.knots[piece];
        let t = s - self.knots[piece];
        self.axes.iter().map(move |axis| {
            let ([a, da], [b, db]) = (axis[piece], axis[piece + 1]);
            let mean = (b - a) / width;
            let (c2, c3) = (
                (3.0 * mean - 2.0 * da - db) / width,
                (da + db - 2.0 * mean) / (width * width),
            );
            [
                a + t * (da + t * (c2 + t * c3)),
                da + t * (2.0 * c2 + t * 3.0 * c3),
                2.0 * c2 + 6.0 * c3 * t,
            ]
        })
    }
}

/// A row of a tridiagonal system: below the diagonal, on it, above it, right side.
type Row = [f64; 4];

/// Slopes at the knots that make the second derivative continuous.
fn slopes(knots: &[f64], values: &[f64], boundary: Boundary) -> Vec<f64> {
    let widths: Vec<f64> = knots.windows(2).map(|k| k[1] - k[0]).collect();
    let means: Vec<f64> = values
        .windows(2)
        .zip(&widths)
        .map(|(v, h)| (v[1] - v[0]) / h)
        .collect();
    if boundary == Boundary::Periodic {
        return periodic_slopes(&widths, &means);
    }
    let (h, m) = (widths.as_slice(), means.as_slice());
    let mut rows = vec![first_row(h, m, boundary)];
    rows.extend((1..h.len()).map(|i| {
        [
            h[i],
            2.0 * (h[i - 1] + h[i]),
            h[i - 1],
            3.0 * (h[i] * m[i - 1] + h[i - 1] * m[i]),
        ]
    }));
    rows.push(last_row(h, m, boundary));
    solve(rows)
}

fn first_row(h: &[f64], m: &[f64], boundary: Boundary) -> Row {
    match (boundary, h) {
        (Boundary::Natural, _) => [0.0, 2.0, 1.0, 3.0 * m[0]],
        (Boundary::NotAKnot, [_]) => [0.0, 1.0, 0.0, m[0]],
        (Boundary::NotAKnot, [_, _]) => [0.0, 1.0, 1.0, 2.0 * m[0]],
        (Boundary::NotAKnot, [a, b, ..]) => {
            let d = a + b;
            [0.0, *b, d, ((a + 2.0 * d) * b * m[0] + a * a * m[1]) / d]
        }
        _ => [0.0, 1.0, 0.0, 0.0],
    }
}

/// The first row of the spline that runs the other way.
fn last_row(h: &[f64], m: &[f64], boundary: Boundary) -> Row {
    let (mut h, mut m) = (h.to_vec(), m.to_vec());
    h.reverse();
    m.reverse();
    let [_, on, above, right] = first_row(&h, &m, boundary);
    [above, on, 0.0, right]
}

/// Thomas' algorithm: the rows of splines need no pivots.
fn solve(mut rows: Vec<Row>) -> Vec<f64> {
    for i in 1..rows.len() {
        let [_, on, above, right] = rows[i - 1];
        let factor = rows[i][0] / on;
        rows[i][1] -= factor * above;
        rows[i][3] -= factor * right;
    }
    let mut solution = vec![0.0; rows.len()];
    let mut next = 0.0;
    for (i, [_, on, above, right]) in rows.iter().enumerate().rev() {
        next = (right - above * next) / on;
        solution[i] = next;
    }
    solution
}

/// As [`slopes`] for closed curves: the corners of the system are filled (Sherman-Morrison).
fn periodic_slopes(h: &[f64], m: &[f64]) -> Vec<f64> {
    let n = h.len();
    let mut slopes = match n {
        1 => vec![m[0]],
        2 => vec![(m[0] / h[0] + m[1] / h[1]) / (1.0 / h[0] + 1.0 / h[1]); 2],
        _ => cyclic_slopes(h, m),
    };
    slopes.push(slopes[0]);
    slopes
}

fn cyclic_slopes(h: &[f64], m: &[f64]) -> Vec<f64> {
    let n = h.len();
    let row = |i: usize| {
        let before = (i + n - 1) % n;
        [
            h[i],
            2.0 * (h[before] + h[i]),
            h[before],
            3.0 * (h[i] * m[before] + h[before] * m[i]),
        ]
    };
    let mut rows: Vec<Row> = (0..n).map(row).collect();
    let (corner_top, corner_bottom) = (rows[0][0], rows[n - 1][2]);
    let gamma = -rows[0][1];
    rows[0][1] -= gamma;
    rows[n - 1][1] -= corner_top * corner_bottom / gamma;
    let mut corner = rows.clone();
    corner.iter_mut().for_each(|row| row[3] = 0.0);
    (corner[0][3], corner[n - 1][3]) = (gamma, corner_bottom);
    let (x, z) = (solve(rows), solve(corner));
    let weight = |v: &[f64]| v[0] + corner_top * v[n - 1] / gamma;
    let factor = weight(&x) / (1.0 + weight(&z));
    x.iter().zip(&z).map(|(x, z)| x - factor * z).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn slopes_are(knots: &[f64], values: &[f64], boundary: Boundary, expected: &[f64]) {
        let found = slopes(knots, values, boundary);
        assert!(
            found
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-12),
            "{found:?} is not {expected:?}"
        );
    }

    #[test]
    fn not_a_knot_reproduces_cubics() {
        let knots = [0.0, 0.3, 1.0, 1.2, 2.0];
        let cubic = |s: f64| s * s * s - 2.0 * s + 1.0;
        slopes_are(
            &knots,
            &knots.map(cubic),
            Boundary::NotAKnot,
            &knots.map(|s| 3.0 * s * s - 2.0),
        );
        slopes_are(
            &[0.0, 1.0, 3.0],
            &[0.0, 1.0, 9.0],
            Boundary::NotAKnot,
            &[0.0, 2.0, 6.0],
        );
        slopes_are(&[0.0, 2.0], &[1.0, 5.0], Boundary::NotAKnot, &[2.0, 2.0]);
        slopes_are(&[0.0, 2.0], &[1.0, 5.0], Boundary::Natural, &[2.0, 2.0]);
        slopes_are(&[0.0, 2.0], &[1.0, 5.0], Boundary::Clamped, &[0.0, 0.0]);
    }

    #[test]
    fn closed_curves_go_on() {
        for n in [2, 3, 4, 7] {
            let knots: Vec<f64> = (0..=n)
                .map(|i| f64::from(i) + 0.1 * f64::from(i * i))
                .collect();
            let mut values: Vec<f64> = (0..n).map(|i| f64::from(i * 7 % 5)).collect();
            values.push(values[0]);
            let end = knots[n as usize];
            let spline = CubicSpline::new(knots, vec![values], Boundary::Periodic);
            let (first, last) = (
                spline.at(0.0).next().unwrap(),
                spline.at(end).next().unwrap(),
            );
            assert!(
                first.iter().zip(last).all(|(a, b)| (a - b).abs() < 1e-9),
                "{n}: {first:?} {last:?}"
            );
        }
    }
}
