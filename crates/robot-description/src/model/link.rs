//! Bodies and what they look like.

use super::Pose;

/// A rigid body.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Link {
    /// Its name, unique in the robot.
    pub name: String,
    /// A link without has no mass of its own.
    pub inertial: Option<Inertial>,
    /// What is seen of it.
    pub visuals: Vec<Visual>,
    /// What others touch.
    pub collisions: Vec<Collision>,
    /// Coulomb's friction of what is touched, if the file says it.
    pub friction: Option<f64>,
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
    /// Its name; may be empty.
    pub name: String,
    /// In the link's frame.
    pub pose: Pose,
    /// Its form.
    pub geometry: Geometry,
    /// Its appearance, if the file says it.
    pub material: Option<Material>,
    /// Its line in the file, from 1; 0 if it is in none.
    pub line: u32,
}

/// A geometry that others touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Collision {
    /// Its name; may be empty.
    pub name: String,
    /// In the link's frame.
    pub pose: Pose,
    /// Its form.
    pub geometry: Geometry,
    /// Its line in the file, from 1; 0 if it is in none.
    pub line: u32,
}

/// A form in its own frame, metres.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// Whole lengths along x, y, z; centred.
    Box {
        /// Length along each axis.
        size: [f64; 3],
    },
    /// Along z; centred.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Length along the axis.
        length: f64,
    },
    /// Along z; centred. The length is that of the cylinder, without the ends.
    Capsule {
        /// Radius of the cylinder and the ends.
        radius: f64,
        /// Length of the cylinder.
        length: f64,
    },
    /// Centred.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// Centred.
    Ellipsoid {
        /// Half the length along each axis.
        radii: [f64; 3],
    },
    /// Without end, through the origin.
    Plane {
        /// Points to the side that is outside.
        normal: [f64; 3],
    },
    /// As the file names it, with a factor for each axis.
    Mesh {
        /// The name in the description.
        file: String,
        /// Factor along each axis.
        scale: [f64; 3],
    },
}

/// What a surface looks like.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Material {
    /// Its name, by which visuals find it.
    pub name: String,
    /// Red, green, blue, opacity, 0 to 1.
    pub color: Option<[f64; 4]>,
    /// The file of a picture.
    pub texture: Option<String>,
}

/// Something that measures, on a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Its name.
    pub name: String,
    /// The index of its link.
    pub link: usize,
    /// In the link's frame.
    pub pose: Pose,
    /// What it measures.
    pub kind: SensorKind,
    /// Its line in the file, from 1.
    pub line: u32,
}

/// What a sensor measures.
#[derive(Debug, Clone, PartialEq)]
pub enum SensorKind {
    /// Resolution in pixels, horizontal angle of view in radians, near and far plane in metres.
    Camera {
        /// Columns and rows.
        resolution: [u32; 2],
        /// Horizontal angle of view.
        angle: f64,
        /// Near and far plane.
        clip: [f64; 2],
    },
    /// A scanner or a single ray.
    Ray,
    /// What its file calls it.
    Other(String),
}
