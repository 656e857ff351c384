//! Dummies: frames, and the ends of loop closures.

use super::Handle;

/// What the link of two dummies means (`sim.dummytype_*`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkType {
    LoopClosure = 0,
    Tendon = 7,
    Default = 8,
    Assembly = 9,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Dummy {
    /// Diameter, for display.
    pub size: f64,
    /// The partner; a link is always mutual.
    pub link: Option<Handle>,
    pub link_type: LinkType,
    pub colour: [f32; 3],
}

impl Dummy {
    pub fn new(size: f64) -> Self {
        Self { size, link: None, link_type: LinkType::Default, colour: [0.0; 3] }
    }
}
