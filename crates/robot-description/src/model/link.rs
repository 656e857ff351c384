//! Bodies and what they look like.

use super::Pose;

/// A rigid body.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Link {
    pub name: String,
    /// A link without has no mass of its own.
    pub inertial: Option<Inertial>,
    pub visuals: Vec<Visual>,
    pub collisions: Vec<Collision>,
    /// The frame in the robot's frame, if the link is no joint's child.
    pub pose: Pose,
    /// Where it stands in its file; 0 if in none.
    pub line: u32,
}

/// Mass, centre of mass, and inertia.
#[derive(Debug, Clone, PartialEq)]
pub struct Inertial {
    /// The centre of mass, and the axes of the inertia, in the link's frame.
    pub pose: Pose,
    /// Kilograms.
    pub mass: f64,
    /// xx, xy, xz, yy, yz, zz about the centre of mass, kg m².
    pub inertia: [f64; 6],
}

/// A geometry that is seen.
#[derive(Debug, Clone, PartialEq)]
pub struct Visual {
    pub name: String,
    /// In the link's frame.
    pub pose: Pose,
    pub geometry: Geometry,
    pub material: Option<Material>,
    pub line: u32,
}

/// A geometry that others touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Collision {
    pub name: String,
    /// In the link's frame.
    pub pose: Pose,
    pub geometry: Geometry,
    pub line: u32,
}

/// A form in its own frame, metres.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// Whole lengths along x, y, z; centred.
    Box {
        size: [f64; 3],
    },
    /// Along z; centred.
    Cylinder {
        radius: f64,
        length: f64,
    },
    /// Along z; centred. The length is that of the cylinder, without the ends.
    Capsule {
        radius: f64,
        length: f64,
    },
    Sphere {
        radius: f64,
    },
    /// Centred.
    Ellipsoid {
        radii: [f64; 3],
    },
    /// Without end, through the origin.
    Plane {
        normal: [f64; 3],
    },
    /// As the file names it, with a factor for each axis.
    Mesh {
        file: String,
        scale: [f64; 3],
    },
}

/// What a surface looks like.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Material {
    pub name: String,
    /// Red, green, blue, opacity, 0 to 1.
    pub color: Option<[f64; 4]>,
    /// The file of a picture.
    pub texture: Option<String>,
}

/// Something that measures, on a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    pub name: String,
    /// The index of its link.
    pub link: usize,
    /// In the link's frame.
    pub pose: Pose,
    pub kind: SensorKind,
    pub line: u32,
}

/// What a sensor measures.
#[derive(Debug, Clone, PartialEq)]
pub enum SensorKind {
    /// Resolution in pixels, horizontal angle of view in radians, near and far plane in metres.
    Camera { resolution: [u32; 2], angle: f64, clip: [f64; 2] },
    /// A scanner or a single ray.
    Ray,
    /// What its file calls it.
    Other(String),
}
