//! The environment of a scene: ambient light, fog, background.

/// Settings of the scene for rendering and display.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    /// Fog in images of cameras and vision sensors.
    pub fog: Fog,
    /// Ambient light: red, green, blue, 0 to 1.
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

/// Fog in front of distant objects.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fog {
    /// Whether there is fog.
    pub enabled: bool,
    /// How it grows with distance.
    pub fog_type: FogType,
    /// Distance from the camera where linear fog begins, metres.
    pub start: f64,
    /// Distance where linear fog is opaque, metres; None if the file has none.
    pub end: Option<f64>,
    /// Density of exponential fog, 1/m.
    pub density: f64,
    /// Red, green, blue, 0 to 1; None if the file has none.
    pub colour: Option<[f32; 3]>,
}

/// How fog grows with distance. Other numbers are stored as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FogType(pub i32);

impl FogType {
    /// Linear between start and end.
    pub const LINEAR: Self = Self(0);
    /// One minus exp(-density * distance).
    pub const EXPONENTIAL: Self = Self(1);
    /// One minus exp(-(density * distance)^2).
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
