//! Ropes and cables: what they are, and their mesh.

use geometry::Mesh;
use nalgebra::Vector3;

use super::body::are_places;
use super::text::{semicolon, tuples, words};

/// Largest number of points of a rope.
pub const MAX_POINTS: usize = 2000;
/// Corners of a cross section.
const SIDES: usize = 8;

/// A rope or cable. As text, `radius=0.005 ... points=0,0,1;0,0,0.5`.
#[derive(Debug, Clone, PartialEq)]
pub struct Rope {
    /// Radius, metres.
    pub radius: f64,
    /// Mass of a metre, kg.
    pub line_density: f64,
    /// Force per strain, N.
    pub stretch: f64,
    /// Moment per curvature, N m2.
    pub bend: f64,
    /// Torque per twist of a metre, N m2.
    pub twist: f64,
    /// Ratio of viscous to elastic stiffness, seconds.
    pub damping: f64,
    /// What the air takes of the velocity, per second.
    pub drag: f64,
    /// Tension at which it breaks, N; infinite: it does not.
    pub strength: f64,
    /// Length at rest, metres; 0: that of the points.
    pub length: f64,
    /// Whether it is straight at rest, otherwise as the points say.
    pub straight: bool,
    /// Whether it touches itself.
    pub touches_itself: bool,
    /// In the frame of the shape, metres.
    pub points: Vec<[f64; 3]>,
}

impl Rope {
    /// What a text says; None if it describes no rope.
    pub fn parse(text: &str) -> Option<Self> {
        let mut rope = Self {
            radius: 0.0,
            line_density: 0.0,
            stretch: 0.0,
            bend: 0.0,
            twist: 0.0,
            damping: 0.0,
            drag: 0.0,
            strength: f64::INFINITY,
            length: 0.0,
            straight: true,
            touches_itself: false,
            points: Vec::new(),
        };
        for (name, value) in words(text) {
            match name {
                "straight" => rope.straight = value != "0",
                "self" => rope.touches_itself = value != "0",
                "points" => rope.points = tuples(value)?,
                _ => {
                    if let Some(field) = rope.number(name) {
                        *field = value.parse().ok()?;
                    }
                }
            }
        }
        rope.is_valid().then_some(rope)
    }

    fn number(&mut self, name: &str) -> Option<&mut f64> {
        Some(match name {
            "radius" => &mut self.radius,
            "lineDensity" => &mut self.line_density,
            "stretch" => &mut self.stretch,
            "bend" => &mut self.bend,
            "twist" => &mut self.twist,
            "damping" => &mut self.damping,
            "drag" => &mut self.drag,
            "strength" => &mut self.strength,
            "length" => &mut self.length,
            _ => return None,
        })
    }

    /// Whether numbers are in the ranges that they can be computed with, and neighbours apart.
    pub fn is_valid(&self) -> bool {
        let positive = [
            self.radius,
            self.line_density,
            self.stretch,
            self.bend,
            self.twist,
        ];
        let others = [self.damping, self.drag, self.length];
        positive.iter().all(|x| x.is_finite() && *x > 0.0)
            && others.iter().all(|x| x.is_finite() && *x >= 0.0)
            && self.strength > 0.0
            && (2..=MAX_POINTS).contains(&self.points.len())
            && is_line(&self.points)
    }
}

impl std::fmt::Display for Rope {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "radius={} lineDensity={} ",
            self.radius, self.line_density
        )?;
        write!(
            f,
            "stretch={} bend={} twist={} ",
            self.stretch, self.bend, self.twist
        )?;
        write!(f, "damping={} drag={} ", self.damping, self.drag)?;
        write!(f, "strength={} length={} ", self.strength, self.length)?;
        write!(
            f,
            "straight={} self={} ",
            u8::from(self.straight),
            u8::from(self.touches_itself)
        )?;
        write!(f, "points={}", semicolon(&self.points))
    }
}

/// Whether points are in the range of the physics, and neighbours apart.
pub(super) fn is_line(points: &[[f64; 3]]) -> bool {
    let apart = |pair: &[[f64; 3]]| Vector3::from(pair[0]) != Vector3::from(pair[1]);
    are_places(points) && points.windows(2).all(apart)
}

/// A tube around points, without the edges that are broken.
pub(super) fn tube(points: &[[f64; 3]], radius: f64, broken: &[bool]) -> Mesh {
    let mut mesh = Mesh::default();
    let points: Vec<Vector3<f64>> = points.iter().map(|point| Vector3::from(*point)).collect();
    let mut first = 0;
    for end in 1..points.len() {
        if broken.get(end - 1).copied().unwrap_or(false) {
            add_tube(&points[first..end], radius, &mut mesh);
            first = end;
        }
    }
    add_tube(&points[first..], radius, &mut mesh);
    mesh
}

fn add_tube(points: &[Vector3<f64>], radius: f64, mesh: &mut Mesh) {
    let mut across: Option<Vector3<f64>> = None;
    for (index, point) in points.iter().enumerate() {
        let before = points[index.saturating_sub(1)];
        let after = points[(index + 1).min(points.len() - 1)];
        let Some(tangent) = (after - before).try_normalize(0.0) else {
            return;
        };
        // Carried along, so that the tube is not twisted.
        let known = across.and_then(|x| (x - tangent * tangent.dot(&x)).try_normalize(1e-6));
        let side = known.unwrap_or_else(|| {
            let mut axis = Vector3::zeros();
            axis[tangent.iamin()] = 1.0;
            tangent.cross(&axis).normalize()
        });
        across = Some(side);
        add_ring(
            *point,
            [side, tangent.cross(&side)],
            radius,
            index > 0,
            mesh,
        );
    }
    if points.len() > 1 {
        let count = mesh.vertices.len() as u32;
        let first = count - (points.len() * SIDES) as u32;
        add_cap(first, true, mesh);
        add_cap(count - SIDES as u32, false, mesh);
    }
}

fn add_ring(
    center: Vector3<f64>,
    across: [Vector3<f64>; 2],
    radius: f64,
    is_joined: bool,
    mesh: &mut Mesh,
) {
    let start = mesh.vertices.len() as u32;
    let count = SIDES as u32;
    for side in 0..count {
        let angle = 2.0 * std::f64::consts::PI * f64::from(side) / f64::from(count);
        let (sine, cosine) = libm::sincos(angle);
        let vertex = center + (across[0] * cosine + across[1] * sine) * radius;
        mesh.vertices.push(vertex.into());
        if is_joined {
            let next = (side + 1) % count;
            let [a, b] = [start - count + side, start - count + next];
            let [c, d] = [start + side, start + next];
            mesh.triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
}

fn add_cap(start: u32, faces_back: bool, mesh: &mut Mesh) {
    for side in 1..SIDES as u32 - 1 {
        let [a, b] = [start + side, start + side + 1];
        mesh.triangles.push(if faces_back {
            [start, b, a]
        } else {
            [start, a, b]
        });
    }
}
