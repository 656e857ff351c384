//! What scripts say of a new rope.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::options::{check_names, number, numbers, positive, triples, truth, wrong};
use crate::{ApiError, Result};
use scene::Data;
use scene::shape::soft::rope::{MAX_POINTS, Rope};

/// How much less than a solid rod a rope resists bending and twist.
const ROPE_BENDING: f64 = 1e-3;
/// Edges between two ends, if no number is given.
const EDGES: f64 = 40.0;

const NAMES: &[&str] = &[
    "points",
    "from",
    "to",
    "count",
    "length",
    "radius",
    "density",
    "mass",
    "young",
    "poisson",
    "stretchStiffness",
    "bendStiffness",
    "twistStiffness",
    "damping",
    "drag",
    "friction",
    "strength",
    "straight",
    "selfContact",
    "color",
];

/// Which defaults hold.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Rope,
    Cable,
}

impl Kind {
    pub(super) fn alias(self) -> &'static str {
        match self {
            Self::Rope => "rope",
            Self::Cable => "cable",
        }
    }
}

/// A rope that is to be made.
pub(super) struct Described {
    pub rope: Rope,
    /// Kilograms, of all.
    pub mass: f64,
    pub friction: f64,
    pub colour: [f32; 3],
}

/// What a table of options describes.
pub(super) fn described(options: &Data, kind: Kind) -> Result<Described> {
    check_names(options, NAMES)?;
    let points = points(options)?;
    let (young, slackness) = match kind {
        Kind::Rope => (1e8, ROPE_BENDING),
        Kind::Cable => (2e7, 1.0),
    };
    let radius = positive(options, "radius", 0.005)?;
    let young = positive(options, "young", young)?;
    let shear = young / (2.0 * (1.0 + number(options, "poisson", 0.4)?));
    let (area, second_moment) = (PI * radius * radius, PI * radius.powi(4) / 4.0);
    let length = number(options, "length", 0.0)?;
    let extent = if length > 0.0 {
        length
    } else {
        length_of(&points)
    };
    let of_density = positive(options, "density", 1000.0)? * area;
    let rope = Rope {
        radius,
        line_density: positive(options, "mass", of_density * extent)? / extent,
        stretch: positive(options, "stretchStiffness", young * area)?,
        bend: positive(options, "bendStiffness", young * second_moment * slackness)?,
        twist: positive(
            options,
            "twistStiffness",
            shear * 2.0 * second_moment * slackness,
        )?,
        damping: number(options, "damping", 1e-3)?,
        drag: number(options, "drag", 0.1)?,
        strength: positive(options, "strength", f64::INFINITY)?,
        length,
        straight: truth(options, "straight", true)?,
        touches_itself: truth(options, "selfContact", false)?,
        points,
    };
    if !rope.is_valid() {
        return Err(ApiError::Other("these options describe no rope.".into()));
    }
    let colour = numbers::<3>(options, "color")?.unwrap_or([0.2, 0.2, 0.22]);
    Ok(Described {
        mass: rope.line_density * extent,
        rope,
        friction: number(options, "friction", 0.7)?.clamp(0.0, 100.0),
        colour: colour.map(|part| part as f32),
    })
}

/// The points of the rope, of equal distance if their number is given.
fn points(options: &Data) -> Result<Vec<[f64; 3]>> {
    let listed = triples(options, "points")?;
    let ends = [numbers(options, "from")?, numbers(options, "to")?];
    let (corners, default) = match (listed, ends) {
        (Some(points), [None, None]) => (points, 0.0),
        (None, [Some(from), Some(to)]) => (vec![from, to], EDGES),
        _ => {
            return Err(ApiError::Other(
                "a rope needs 'points', or 'from' and 'to'.".into(),
            ));
        }
    };
    let count = number(options, "count", default)?;
    if count == 0.0 {
        return Ok(corners);
    }
    if count >= MAX_POINTS as f64 || count.fract() != 0.0 {
        return Err(wrong("count"));
    }
    Ok(divided(&corners, count as usize))
}

fn length_of(points: &[[f64; 3]]) -> f64 {
    let edges = points.windows(2);
    edges
        .map(|pair| (Vector3::from(pair[1]) - Vector3::from(pair[0])).norm())
        .sum()
}

/// Points in equal distances along a line through corners.
fn divided(corners: &[[f64; 3]], edges: usize) -> Vec<[f64; 3]> {
    let step = length_of(corners) / edges as f64;
    let mut points = Vec::new();
    let mut passed = 0.0;
    for pair in corners.windows(2) {
        let (from, to) = (Vector3::from(pair[0]), Vector3::from(pair[1]));
        let length = (to - from).norm();
        while points.len() < edges && points.len() as f64 * step <= passed + length {
            let part = (points.len() as f64 * step - passed) / length;
            points.push(from.lerp(&to, part).into());
        }
        passed += length;
    }
    points.extend(corners.last());
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_in_equal_distances_along_corners() {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
        let points = divided(&corners, 4);
        let expected = [
            [0.0; 3],
            [0.5, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 0.5, 0.0],
            [1.0, 1.0, 0.0],
        ];
        assert_eq!(points, expected);
    }
}
