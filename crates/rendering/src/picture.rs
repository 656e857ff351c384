//! Results of a renderer.

use crate::Background;

/// Which parts of a picture are computed. What is not asked for costs nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Channels {
    /// The colour of each pixel.
    pub colour: bool,
    /// The depth of each pixel.
    pub depth: bool,
    /// The id of what is seen in each pixel.
    pub ids: bool,
}

/// A picture: rows from the bottom up, each from left to right. Channels that were not asked for are empty.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Picture {
    /// Width and height, pixels.
    pub resolution: [u32; 2],
    /// Red, green, blue of each pixel.
    pub colour: Vec<u8>,
    /// `(z - near) / (far - near)` of each pixel, z being the depth along the camera's axis; 1 where nothing is.
    pub depth: Vec<f32>,
    /// The id of what is seen in each pixel; [`Picture::NOTHING`] where nothing is.
    pub ids: Vec<u32>,
}

impl Channels {
    /// All channels.
    pub const ALL: Self = Self {
        colour: true,
        depth: true,
        ids: true,
    };
    /// Only colours.
    pub const COLOUR: Self = Self {
        colour: true,
        depth: false,
        ids: false,
    };
    /// Only depths.
    pub const DEPTH: Self = Self {
        colour: false,
        depth: true,
        ids: false,
    };
    /// Only ids.
    pub const IDS: Self = Self {
        colour: false,
        depth: false,
        ids: true,
    };
}

impl Picture {
    /// The id where nothing is.
    pub const NOTHING: u32 = u32::MAX;

    /// Makes room for a picture.
    pub(crate) fn resize(&mut self, resolution: [u32; 2], channels: Channels) {
        let pixels = numbers::place(resolution[0]) * numbers::place(resolution[1]);
        let size = |wanted: bool| if wanted { pixels } else { 0 };
        self.resolution = resolution;
        self.colour.resize(3 * size(channels.colour), 0);
        self.depth.resize(size(channels.depth), 1.0);
        self.ids.resize(size(channels.ids), Self::NOTHING);
    }

    /// Shows nothing but the background.
    pub(crate) fn fill(&mut self, background: &Background) {
        let [width, height] = self.resolution.map(numbers::place);
        self.depth.fill(1.0);
        self.ids.fill(Self::NOTHING);
        for (y, row) in self.colour.chunks_mut(3 * width).enumerate() {
            let colour = background
                .row(y, height)
                .map(|part| numbers::level((part * 255.0 + 0.5).into()));
            row.chunks_exact_mut(3)
                .for_each(|pixel| pixel.copy_from_slice(&colour));
        }
    }
}
