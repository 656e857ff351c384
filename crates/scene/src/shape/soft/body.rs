//! Cloths and soft volumes: what they are.

use nalgebra::Vector3;

use super::text::{semicolon, tuples, words};

/// Largest number of points of a cloth or volume.
pub const MAX_POINTS: usize = 50_000;
/// Largest number of its triangles and tetrahedra.
pub const MAX_ELEMENTS: usize = 250_000;

/// A cloth, or a volume if it has tetrahedra. As text, `radius=0.001 ... points=0,0,1;0,0,0.5;... triangles=0,1,2;...`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Body {
    /// Distance from its surface at which it touches something, metres.
    pub radius: f64,
    /// Mass of a square metre of a cloth (kg/m2), or of a cubic metre of a volume (kg/m3).
    pub density: f64,
    /// Of a cloth: force per strain and width, N/m.
    pub stretch: f64,
    /// Of a cloth: moment per curvature and width, N m.
    pub bend: f64,
    /// Of a volume: Young's modulus, Pa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Ratio of viscous to elastic stiffness, seconds.
    pub damping: f64,
    /// What the air takes of the velocity, per second.
    pub drag: f64,
    /// Of a cloth: tension at which it tears, N/m; infinite: it does not.
    pub strength: f64,
    /// Of a closed cloth: pressure of the gas within above that outside, Pa, in the volume that it begins with.
    pub pressure: Option<f64>,
    /// Whether a cloth is flat at rest, otherwise as the points say.
    pub flat: bool,
    /// Whether it touches itself.
    pub touches_itself: bool,
    /// In the frame of the shape, metres.
    pub points: Vec<[f64; 3]>,
    /// Of a cloth, and of the surface of a volume; facing outwards.
    pub triangles: Vec<[u32; 3]>,
    /// Of a volume, in positive order.
    pub tetrahedra: Vec<[u32; 4]>,
}

impl Body {
    /// What a text says; None if it describes no cloth or volume.
    pub fn parse(text: &str) -> Option<Self> {
        let mut body = Self {
            strength: f64::INFINITY,
            ..Self::default()
        };
        for (name, value) in words(text) {
            match name {
                "flat" => body.flat = value != "0",
                "self" => body.touches_itself = value != "0",
                "pressure" => body.pressure = Some(value.parse().ok()?),
                "points" => body.points = tuples(value)?,
                "triangles" => body.triangles = tuples(value)?,
                "tetrahedra" => body.tetrahedra = tuples(value)?,
                _ => {
                    if let Some(field) = body.number(name) {
                        *field = value.parse().ok()?;
                    }
                }
            }
        }
        body.is_valid().then_some(body)
    }

    fn number(&mut self, name: &str) -> Option<&mut f64> {
        Some(match name {
            "radius" => &mut self.radius,
            "density" => &mut self.density,
            "stretch" => &mut self.stretch,
            "bend" => &mut self.bend,
            "young" => &mut self.young,
            "poisson" => &mut self.poisson,
            "damping" => &mut self.damping,
            "drag" => &mut self.drag,
            "strength" => &mut self.strength,
            _ => return None,
        })
    }

    /// Whether it is a volume.
    pub fn is_volume(&self) -> bool {
        !self.tetrahedra.is_empty()
    }

    /// Whether the physics can compute with it: [`fault`](Self::fault) finds none.
    pub fn is_valid(&self) -> bool {
        self.fault().is_none()
    }

    /// What is wrong with it, if something is.
    pub fn fault(&self) -> Option<&'static str> {
        if !self.has_valid_counts() {
            Some("there are too few or too many points or elements")
        } else if !self.has_valid_indices() {
            Some("a point is missing, or its place is no place")
        } else if !self.has_extent() {
            Some(
                "a triangle has no area, a tetrahedron no positive volume, or a point belongs to none",
            )
        } else if !self.has_valid_numbers() {
            Some("a number is out of range")
        } else {
            None
        }
    }

    fn has_valid_numbers(&self) -> bool {
        let stiffness = if self.is_volume() {
            self.young
        } else {
            self.stretch
        };
        let positive = [self.density, stiffness];
        let others = [
            self.radius,
            self.bend,
            self.damping,
            self.drag,
            self.poisson,
        ];
        positive.iter().all(|x| x.is_finite() && *x > 0.0)
            && others.iter().all(|x| x.is_finite() && *x >= 0.0)
            && self.poisson < 0.5
            && self.strength > 0.0
            && self.pressure.is_none_or(|x| x.is_finite() && x > -1e5)
    }

    fn has_valid_counts(&self) -> bool {
        let elements = self.triangles.len() + self.tetrahedra.len();
        (3..=MAX_POINTS).contains(&self.points.len())
            && (1..=MAX_ELEMENTS).contains(&elements)
            && !self.triangles.is_empty()
    }

    fn has_valid_indices(&self) -> bool {
        let indices = self.triangles.as_flattened().iter();
        let mut indices = indices.chain(self.tetrahedra.as_flattened());
        indices.all(|index| (*index as usize) < self.points.len()) && are_places(&self.points)
    }

    /// Whether all elements have an extent, and all points belong to one.
    fn has_extent(&self) -> bool {
        let mut used = vec![false; self.points.len()];
        let mut take = |indices: &[u32]| {
            for index in indices {
                used[*index as usize] = true;
            }
        };
        let have_extent = if self.is_volume() {
            self.tetrahedra.iter().all(|element| {
                take(element);
                self.volume_of(element) > 0.0
            })
        } else {
            self.triangles.iter().all(|triangle| {
                take(triangle);
                self.area_of(triangle) > 0.0
            })
        };
        have_extent && used.iter().all(|is_used| *is_used)
    }

    fn corners<const N: usize>(&self, indices: &[u32; N]) -> [Vector3<f64>; N] {
        indices.map(|index| Vector3::from(self.points[index as usize]))
    }

    fn area_of(&self, triangle: &[u32; 3]) -> f64 {
        let [a, b, c] = self.corners(triangle);
        0.5 * (b - a).cross(&(c - a)).norm()
    }

    fn volume_of(&self, element: &[u32; 4]) -> f64 {
        let [a, b, c, d] = self.corners(element);
        (b - a).dot(&(c - a).cross(&(d - a))) / 6.0
    }

    /// Its area, m2, or its volume, m3; 0 where an index is out of range.
    pub fn extent(&self) -> f64 {
        if !self.has_valid_indices() {
            return 0.0;
        }
        if self.is_volume() {
            self.tetrahedra
                .iter()
                .map(|element| self.volume_of(element))
                .sum()
        } else {
            self.triangles
                .iter()
                .map(|triangle| self.area_of(triangle))
                .sum()
        }
    }
}

/// Whether all are in the range of the physics.
pub(super) fn are_places(points: &[[f64; 3]]) -> bool {
    let numbers = points.as_flattened();
    numbers.iter().all(|x| x.is_finite() && x.abs() < 1e4)
}

impl std::fmt::Display for Body {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "radius={} density={} ", self.radius, self.density)?;
        write!(f, "stretch={} bend={} ", self.stretch, self.bend)?;
        write!(f, "young={} poisson={} ", self.young, self.poisson)?;
        write!(f, "damping={} drag={} ", self.damping, self.drag)?;
        write!(f, "strength={} ", self.strength)?;
        if let Some(pressure) = self.pressure {
            write!(f, "pressure={pressure} ")?;
        }
        let [flat, own] = [self.flat, self.touches_itself].map(u8::from);
        write!(f, "flat={flat} self={own} ")?;
        write!(f, "points={} ", semicolon(&self.points))?;
        write!(f, "triangles={} ", semicolon(&self.triangles))?;
        write!(f, "tetrahedra={}", semicolon(&self.tetrahedra))
    }
}
