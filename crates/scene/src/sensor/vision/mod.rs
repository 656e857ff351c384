//! Vision sensors: their settings, the picture they hold, and the results of their last handling.

pub mod picture;
pub mod statistics;

use super::{Entity, View};

pub use picture::Area;

/// How a vision sensor makes its image (`sim.visionintparam_render_mode`). Scripts and files may choose modes that are not known here;
/// they are stored as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RenderMode(pub i64);

impl RenderMode {
    /// Visible colours.
    pub const OPENGL: Self = Self(0);
    /// Objects have their auxiliary colours, whatever the light.
    pub const AUXILIARY: Self = Self(1);
    /// The colour of an object is its handle.
    pub const HANDLES: Self = Self(2);
    /// An external renderer.
    pub const EXTERNAL: Self = Self(5);
    /// Visible colours, by the OpenGL 3 renderer of CoppeliaSim.
    pub const OPENGL3: Self = Self(7);

    /// Whether lights cast shadows: with ray tracers.
    pub fn has_shadows(self) -> bool {
        (3..=6).contains(&self.0)
    }
}

/// A vision sensor: a camera whose images scripts read.
#[derive(Debug, Clone, PartialEq)]
pub struct VisionSensor {
    /// Its projection.
    pub view: View,
    /// Handled only when a script asks for this sensor, not with all others.
    pub explicit: bool,
    /// Size of its symbol, metres.
    pub size: f64,
    /// What it renders.
    pub entity: Entity,
    /// How it renders.
    pub render_mode: RenderMode,
    /// Colour of the image where no object is: red, green, blue, 0 to 1.
    pub background: [f32; 3],
    /// The background is that of the scene instead.
    pub background_from_environment: bool,
    /// Only lights that are attached to the sensor shine.
    pub local_lights: bool,
    /// Images have no fog.
    pub ignore_fog: bool,
    /// The picture comes from scripts.
    pub external_image: bool,
    /// No colour image is rendered.
    pub ignore_image: bool,
    /// No depth image is rendered.
    pub ignore_depth: bool,
    /// Surfaces have no highlights, as in the pictures that simVision.handleSpherical composes.
    pub ignore_specular: bool,
    /// Width and height of a window that is not shown, pixels, as scripts set them.
    pub window: [i64; 2],
    /// The first packet of results is not computed.
    pub omit_statistics: bool,
    /// Red, green, blue of each pixel, the bottom row first; empty before there was an image.
    pub image: Vec<u8>,
    /// Depth of each pixel, 0 at the near to 1 at the far clipping plane; empty before there was an image.
    pub depth: Vec<f32>,
    /// The results of the last handling.
    pub reading: Option<VisionReading>,
}

/// Result of handling a vision sensor (spec: sensors 3).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VisionReading {
    /// Whether a script reported a detection in the image.
    pub triggered: bool,
    /// Statistics of the image, then what scripts computed from it.
    pub packets: Vec<Vec<f32>>,
}

impl VisionSensor {
    /// How many pixels a picture has.
    pub fn pixels(&self) -> usize {
        self.view
            .resolution
            .iter()
            .map(|&side| side as usize)
            .product()
    }

    /// How many bytes a picture has.
    pub fn image_len(&self) -> usize {
        self.pixels() * 3
    }

    /// Changes the resolution and drops the image.
    pub fn set_resolution(&mut self, resolution: [i64; 2]) {
        self.view.set_resolution(resolution);
        (self.image, self.depth) = (Vec::new(), Vec::new());
    }
}
