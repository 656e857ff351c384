//! Content of a picture: meshes, points, lines, lights, fog and background.

use geometry::Pose;

use crate::{Material, Mesh};

/// Everything that can be seen, and what lights it. Colours are red, green, blue, 0 to 1.
#[derive(Debug, Clone, Copy)]
pub struct World<'a> {
    /// Meshes at their places.
    pub instances: &'a [Instance<'a>],
    /// Sets of points.
    pub points: &'a [Points<'a>],
    /// Sets of line segments.
    pub lines: &'a [Lines<'a>],
    /// Light sources.
    pub lights: &'a [Light],
    /// Light that comes from everywhere.
    pub ambient: [f32; 3],
    /// Fog, if there is any.
    pub fog: Option<Fog>,
    /// What is seen where nothing else is.
    pub background: Background,
    /// Whether lights that cast shadows do, by rays: several times slower. Transparent surfaces, wire frames, points and lines cast none.
    pub shadows: bool,
}

/// A mesh at a place.
#[derive(Debug, Clone, Copy)]
pub struct Instance<'a> {
    /// The geometry.
    pub mesh: &'a Mesh,
    /// From the mesh's frame to the world. An instance whose pose is not finite is not drawn.
    pub pose: Pose,
    /// The appearance.
    pub material: &'a Material,
    /// Value in [`Picture::ids`](crate::Picture) where the instance is seen.
    pub id: u32,
}

/// Square points of a fixed size on the picture, not lit.
#[derive(Debug, Clone, Copy)]
pub struct Points<'a> {
    /// Positions in the points' frame, metres.
    pub positions: &'a [[f64; 3]],
    /// One for each point, or one for all.
    pub colours: &'a [[f32; 3]],
    /// From the points' frame to the world.
    pub pose: Pose,
    /// Side of the squares, pixels.
    pub size: f32,
    /// Value in [`Picture::ids`](crate::Picture) where a point is seen.
    pub id: u32,
    /// Whether they are drawn over everything else.
    pub overlay: bool,
}

/// Line segments of a fixed width on the picture, not lit.
#[derive(Debug, Clone, Copy)]
pub struct Lines<'a> {
    /// Ends of the segments in the lines' frame, metres.
    pub segments: &'a [[[f64; 3]; 2]],
    /// One for each segment, or one for all.
    pub colours: &'a [[f32; 3]],
    /// From the lines' frame to the world.
    pub pose: Pose,
    /// Pixels, measured along the axis of the picture that is more perpendicular to the line.
    pub width: f32,
    /// Value in [`Picture::ids`](crate::Picture) where a line is seen.
    pub id: u32,
    /// Whether they are drawn over everything else.
    pub overlay: bool,
}

/// Where a light shines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    /// In all directions from a point.
    Omni,
    /// Into a cone along the light's +Z.
    Spot {
        /// Half the opening of the cone, radians.
        cutoff: f64,
        /// How much weaker the border of the cone is: the power of the cosine of the angle to the axis.
        exponent: u32,
    },
    /// Parallel rays along the light's +Z.
    Directional,
}

/// A light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Where it shines.
    pub kind: LightKind,
    /// From the light's frame to the world.
    pub pose: Pose,
    /// Colour of its diffuse light.
    pub diffuse: [f32; 3],
    /// Colour of its light in highlights.
    pub specular: [f32; 3],
    /// The light is divided by `a + b d + c d^2` at the distance d (m). Ignored by directional lights.
    pub attenuation: [f32; 3],
    /// Whether surfaces keep its light from others, where [`World::shadows`] says so.
    pub casts_shadows: bool,
}

/// Colour that replaces that of surfaces with growing depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fog {
    /// How the fog grows with depth.
    pub density: FogDensity,
    /// The colour that replaces that of surfaces.
    pub colour: [f32; 3],
}

/// How much remains of a surface's colour at the depth z (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FogDensity {
    /// `(end - z) / (end - start)`.
    Linear {
        /// Depth where the fog begins, metres.
        start: f64,
        /// Depth where nothing else is left, metres.
        end: f64,
    },
    /// `exp(-density z)`.
    Exponential(f64),
    /// `exp(-(density z)^2)`.
    ExponentialSquared(f64),
}

/// The colour where nothing is: a vertical gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Background {
    /// Below the lowest row.
    pub bottom: [f32; 3],
    /// Above the highest row.
    pub top: [f32; 3],
}

impl Background {
    /// A background of one colour.
    pub fn plain(colour: [f32; 3]) -> Self {
        Self {
            bottom: colour,
            top: colour,
        }
    }

    /// The colour of a row of a picture with that many rows.
    pub(crate) fn row(&self, row: usize, rows: usize) -> [f32; 3] {
        let height =
            (numbers::single(numbers::real(row)) + 0.5) / numbers::single(numbers::real(rows));
        [0, 1, 2].map(|i| self.bottom[i] + (self.top[i] - self.bottom[i]) * height)
    }
}

impl Fog {
    /// A surface's colour as it appears at a depth (m).
    pub(crate) fn cover(&self, colour: [f32; 3], depth: f64) -> [f32; 3] {
        let remains = match self.density {
            FogDensity::Linear { start, end } => (end - depth) / (end - start),
            FogDensity::Exponential(density) => libm::exp(-density * depth),
            FogDensity::ExponentialSquared(density) => {
                libm::exp(-(density * depth) * (density * depth))
            }
        };
        // Where start and end are equal, there is no fog before and only fog behind.
        let remains = if remains.is_nan() {
            1.0
        } else {
            numbers::single(remains.clamp(0.0, 1.0))
        };
        [0, 1, 2].map(|i| self.colour[i] + (colour[i] - self.colour[i]) * remains)
    }
}

impl Light {
    /// White, without attenuation, shining along +Z.
    pub fn new(kind: LightKind, pose: Pose) -> Self {
        Self {
            kind,
            pose,
            diffuse: [1.0; 3],
            specular: [1.0; 3],
            attenuation: [1.0, 0.0, 0.0],
            casts_shadows: true,
        }
    }
}

impl<'a> World<'a> {
    /// Nothing but a black background.
    pub const EMPTY: World<'a> = World {
        instances: &[],
        points: &[],
        lines: &[],
        lights: &[],
        ambient: [0.0; 3],
        fog: None,
        background: Background {
            bottom: [0.0; 3],
            top: [0.0; 3],
        },
        shadows: false,
    };
}
