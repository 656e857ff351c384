//! Shortest curves of a car that drives forwards and has a least turning radius (L. E. Dubins, *On curves of minimal length with a constraint
//! on average curvature*, 1957; the formulas of A. M. Shkel and V. Lumelsky, *Classification of the Dubins set*, 2001).

use std::f64::consts::TAU;

use super::component::wrapped;

/// A piece of a curve: left, right, or straight on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Turn {
    Left,
    Straight,
    Right,
}

use Turn::{Left, Right, Straight};

/// The curves that can be shortest.
const WORDS: [[Turn; 3]; 6] = [
    [Left, Straight, Left],
    [Right, Straight, Right],
    [Right, Straight, Left],
    [Left, Straight, Right],
    [Right, Left, Right],
    [Left, Right, Left],
];

/// A shortest curve.
pub(super) struct Curve {
    start: [f64; 3],
    radius: f64,
    turns: [Turn; 3],
    /// Angles of the pieces, and of the straight one its length divided by the radius.
    pieces: [f64; 3],
    /// It is driven from its end to its start.
    is_reversed: bool,
}

/// The shortest curve from x, y, angle to another. `symmetric`: or the one back, which is driven the other way round then.
pub(super) fn curve(from: &[f64], to: &[f64], radius: f64, symmetric: bool) -> Curve {
    let there = forwards(from, to, radius);
    if symmetric {
        let back = forwards(to, from, radius);
        if back.length() < there.length() {
            return Curve {
                is_reversed: true,
                ..back
            };
        }
    }
    there
}

fn forwards(from: &[f64], to: &[f64], radius: f64) -> Curve {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let direction = libm::atan2(dy, dx);
    let distance = libm::hypot(dx, dy) / radius;
    let (alpha, beta) = (turned(from[2] - direction), turned(to[2] - direction));
    let pieces = WORDS
        .iter()
        .filter_map(|word| Some((*word, pieces(*word, distance, alpha, beta)?)));
    let sum = |pieces: &[f64; 3]| pieces.iter().sum::<f64>();
    let shortest = pieces.min_by(|(_, a), (_, b)| sum(a).total_cmp(&sum(b)));
    // Two of the words exist for all states.
    let (turns, pieces) = shortest.unwrap_or((WORDS[0], [0.0; 3]));
    Curve {
        start: [from[0], from[1], from[2]],
        radius,
        turns,
        pieces,
        is_reversed: false,
    }
}

/// An angle from 0 to 2π; what is nearly a whole turn is none.
fn turned(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if TAU - turned < 1e-9 { 0.0 } else { turned }
}

/// The pieces of one kind of curve, for radius 1; None if there is none.
fn pieces(word: [Turn; 3], d: f64, alpha: f64, beta: f64) -> Option<[f64; 3]> {
    let ((sa, ca), (sb, cb)) = (libm::sincos(alpha), libm::sincos(beta));
    let cos = libm::cos(alpha - beta);
    let root = |square: f64| (square >= -1e-9).then(|| square.max(0.0).sqrt());
    match word {
        [Left, Straight, Left] => {
            let p = root(2.0 + d * d - 2.0 * cos + 2.0 * d * (sa - sb))?;
            let angle = libm::atan2(cb - ca, d + sa - sb);
            Some([turned(angle - alpha), p, turned(beta - angle)])
        }
        [Right, Straight, Right] => {
            let p = root(2.0 + d * d - 2.0 * cos + 2.0 * d * (sb - sa))?;
            let angle = libm::atan2(ca - cb, d - sa + sb);
            Some([turned(alpha - angle), p, turned(angle - beta)])
        }
        [Left, Straight, Right] => {
            let p = root(d * d - 2.0 + 2.0 * cos + 2.0 * d * (sa + sb))?;
            let angle = libm::atan2(-ca - cb, d + sa + sb) - libm::atan2(-2.0, p);
            Some([turned(angle - alpha), p, turned(angle - beta)])
        }
        [Right, Straight, Left] => {
            let p = root(d * d - 2.0 + 2.0 * cos - 2.0 * d * (sa + sb))?;
            let angle = libm::atan2(ca + cb, d - sa - sb) - libm::atan2(2.0, p);
            Some([turned(alpha - angle), p, turned(beta - angle)])
        }
        [Right, Left, Right] => {
            let c = (6.0 - d * d + 2.0 * cos + 2.0 * d * (sa - sb)) / 8.0;
            let p = (c.abs() <= 1.0).then(|| TAU - libm::acos(c))?;
            let t = turned(alpha - libm::atan2(ca - cb, d - sa + sb) + p / 2.0);
            Some([t, p, turned(alpha - beta - t + p)])
        }
        _ => {
            let c = (6.0 - d * d + 2.0 * cos + 2.0 * d * (sb - sa)) / 8.0;
            let p = (c.abs() <= 1.0).then(|| TAU - libm::acos(c))?;
            let t = turned(-alpha + libm::atan2(-ca + cb, d + sa - sb) + p / 2.0);
            Some([t, p, turned(beta - alpha - t + p)])
        }
    }
}

impl Curve {
    pub(super) fn length(&self) -> f64 {
        self.radius * self.pieces.iter().sum::<f64>()
    }

    /// The state at `part` (0 to 1) of the way.
    pub(super) fn state_at(&self, part: f64) -> [f64; 3] {
        let part = if self.is_reversed { 1.0 - part } else { part };
        let mut left = part * self.pieces.iter().sum::<f64>();
        let (mut x, mut y, mut angle) = (0.0, 0.0, self.start[2]);
        for (turn, piece) in self.turns.iter().zip(self.pieces) {
            let piece = piece.min(left);
            left -= piece;
            let (sin, cos) = libm::sincos(angle);
            match turn {
                Left => {
                    let (sin_after, cos_after) = libm::sincos(angle + piece);
                    (x, y, angle) = (x + sin_after - sin, y - cos_after + cos, angle + piece);
                }
                Right => {
                    let (sin_after, cos_after) = libm::sincos(angle - piece);
                    (x, y, angle) = (x - sin_after + sin, y + cos_after - cos, angle - piece);
                }
                Straight => (x, y) = (x + piece * cos, y + piece * sin),
            }
        }
        [
            self.start[0] + self.radius * x,
            self.start[1] + self.radius * y,
            wrapped(angle),
        ]
    }
}
