//! The environment of a scene: ambient light, fog, background.

#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    pub fog: Fog,
    /// The light that comes from everywhere.
    pub ambient_light: [f32; 3],
    /// Background colours, upper and lower; None if the file has none.
    pub background: Option<[[f32; 3]; 2]>,
    /// Bits of a file for what is shown: textures, emitters, receivers.
    pub display: u8,
    /// Largest side of triangles in calculations (m), and the smallest beside the object.
    pub triangle_sizes: [f64; 2],
    /// Settings of renderers, such as `openGL3 {...}`.
    pub extension_string: String,
}

#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fog {
    pub enabled: bool,
    pub fog_type: FogType,
    /// Metres.
    pub start: f64,
    pub end: Option<f64>,
    pub density: f64,
    pub colour: Option<[f32; 3]>,
}

/// How fog grows with distance. Other numbers are stored as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FogType(pub i32);

impl FogType {
    pub const LINEAR: Self = Self(0);
    pub const EXPONENTIAL: Self = Self(1);
    pub const EXPONENTIAL_SQUARED: Self = Self(2);
}

impl Default for Environment {
    fn default() -> Self {
        Self {
            fog: Fog::default(),
            ambient_light: [0.4; 3],
            background: None,
            display: 0,
            triangle_sizes: [0.3, 0.02],
            extension_string: String::new(),
        }
    }
}
