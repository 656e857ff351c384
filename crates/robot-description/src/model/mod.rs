//! What a robot consists of, whatever file it comes from.

mod joint;
mod link;
mod names;

pub use joint::{Dynamics, Joint, JointKind, Limits, Mimic};
pub use link::{Collision, Geometry, Inertial, Link, Material, Sensor, SensorKind, Visual};
pub(crate) use names::Names;

/// A frame in another frame, metres.
pub type Pose = nalgebra::Isometry3<f64>;

/// Links and the joints between them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Robot {
    /// Its name.
    pub name: String,
    /// The bodies.
    pub links: Vec<Link>,
    /// They refer to links by index. [`Robot::parent_joints`] says which of them make the tree.
    pub joints: Vec<Joint>,
    /// Materials that visuals name without saying how they look.
    pub materials: Vec<Material>,
    /// What measures, on any of the links.
    pub sensors: Vec<Sensor>,
}

impl Robot {
    /// The index of a link.
    pub fn link(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|link| link.name == name)
    }

    /// The index of a joint.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// The appearance of a visual: what it says itself, else what the robot's material of that name says.
    pub fn material_of<'a>(&'a self, visual: &'a Visual) -> Option<&'a Material> {
        let own = visual.material.as_ref()?;
        if own.color.is_some() || own.texture.is_some() {
            return Some(own);
        }
        Some(
            self.materials
                .iter()
                .find(|material| material.name == own.name)
                .unwrap_or(own),
        )
    }

    /// The sum of what the links weigh, kilograms.
    pub fn mass(&self) -> f64 {
        self.links
            .iter()
            .filter_map(|link| link.inertial.as_ref())
            .map(|inertial| inertial.mass)
            .sum()
    }
}
