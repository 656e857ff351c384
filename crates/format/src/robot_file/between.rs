//! Bodies that files do not have and physics needs: between two joints, and below a joint that hangs on nothing.

use geometry::MassProperties;
use robot_description::{Inertial, JointKind};

use super::{Import, RobotFormat};
use scene::shape::Shape;
use scene::{Pose, SceneResult};

/// Diameter of what carries a joint and has no geometry, metres.
const CARRIER: f64 = 0.05;
/// Mass and inertia of a body between two joints, as a fraction of those of the next body; in MJCF, where there is none, so little that it does not count.
const MASS_RATIO: f64 = 0.01;
const MASS_RATIO_MJCF: f64 = 1e-3;
/// Smallest mass (kg) and moment of inertia (kg m²) of a body between two joints.
const MIN_MASS_AND_INERTIA: (f64, f64) = (1e-4, 1e-7);
/// What a link of SDF has that says nothing of mass: kg, kg m².
const UNIT: (f64, f64) = (1.0, 1.0);

impl Import<'_> {
    pub(super) fn is_fixed(&self, link: usize) -> bool {
        self.model.fixed.binary_search(&link).is_ok()
    }

    /// Whether a link carries joints that move.
    fn carries_motion(&self, link: usize) -> bool {
        let moves = |kind: JointKind| {
            !matches!(
                kind,
                JointKind::Fixed | JointKind::Floating | JointKind::Planar
            )
        };
        self.robot
            .joints
            .iter()
            .any(|joint| joint.parent == link && moves(joint.kind))
    }

    /// A body for a link that has nothing to touch and no mass, where joints need one. URDF's links stay as they are: scripts know them so.
    pub(super) fn body_between(&mut self, index: usize) -> SceneResult<Option<(Pose, Shape)>> {
        if self.format == RobotFormat::Urdf || !self.carries_motion(index) {
            return Ok(None);
        }
        let mut shape = super::shapes::ball(CARRIER)?;
        shape.dynamics.is_static = self.is_fixed(index);
        if !shape.dynamics.is_static {
            shape.mass = self.small_mass(self.next_inertial(index));
            let name = &self.robot.links[index].name;
            self.message(format!(
                "link '{name}' is between two joints: it gets a mass of {:.3e} kg",
                shape.mass.mass
            ));
        }
        Ok(Some((Pose::identity(), shape)))
    }

    /// The mass of a body that only holds others together, beside one that has some.
    pub(super) fn small_mass(&self, next: Option<Inertial>) -> MassProperties {
        let ratio = match self.format {
            RobotFormat::Mjcf => MASS_RATIO_MJCF,
            RobotFormat::Urdf | RobotFormat::Sdf => MASS_RATIO,
        };
        light(next, ratio)
    }

    /// The mass and inertia of the nearest link above that has some, where only fixed joints lead there.
    pub(super) fn inertial_above(&self, index: usize) -> Option<Inertial> {
        let mut link = index;
        for _ in 0..=self.robot.joints.len() {
            let mut joints = self.robot.joints.iter();
            let joint =
                joints.find(|joint| joint.child == link && joint.kind == JointKind::Fixed)?;
            link = joint.parent;
            if let Some(inertial) = &self.robot.links[link].inertial {
                return Some(inertial.clone());
            }
        }
        None
    }

    /// The mass and inertia of the next link below that has some.
    fn next_inertial(&self, index: usize) -> Option<Inertial> {
        let mut link = index;
        // A chain is no longer than there are joints.
        for _ in 0..=self.robot.joints.len() {
            let joint = self
                .robot
                .joints
                .iter()
                .find(|joint| joint.parent == link && joint.child != link)?;
            link = joint.child;
            let inertial = self.robot.links[link]
                .inertial
                .clone()
                .or_else(|| self.default_inertial(link));
            if inertial.is_some() {
                return inertial;
            }
        }
        None
    }

    /// The mass of a link that says none, and moves.
    pub(super) fn default_inertial(&self, index: usize) -> Option<Inertial> {
        let is_written = self.robot.links[index].line > 0;
        let (mass, moment) = UNIT;
        (self.format == RobotFormat::Sdf && is_written && !self.is_fixed(index)).then(|| Inertial {
            pose: Pose::identity(),
            mass,
            inertia: [moment, 0.0, 0.0, moment, 0.0, moment],
        })
    }
}

fn light(next: Option<Inertial>, ratio: f64) -> MassProperties {
    let (mass, moment) = next.map_or((0.0, 0.0), |next| {
        let [xx, _, _, yy, _, zz] = next.inertia;
        (next.mass * ratio, (xx + yy + zz) / 3.0 * ratio)
    });
    let (mass, moment) = (
        mass.max(MIN_MASS_AND_INERTIA.0),
        moment.max(MIN_MASS_AND_INERTIA.1),
    );
    MassProperties::diagonal(mass, [moment / mass; 3])
}
