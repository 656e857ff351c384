//! Robots that fall over since nothing holds their bases: a mistake that many descriptions lead to.

use scene::{Handle, Pose, Scene};
use simulator::Simulator;

/// Leaning that no robot comes back from: a third of a right angle.
const LEAN: f64 = std::f64::consts::FRAC_PI_6;

/// Says once when the base of a robot has fallen over. None is watched where there is nothing to say.
#[derive(Clone, Default)]
pub(in crate::cli) struct Fallen {
    bases: Vec<Base>,
}

#[derive(Clone)]
struct Base {
    handle: Handle,
    /// Where it is when it stands.
    standing: Pose,
}

impl Fallen {
    /// Watches the robots of a scene that was filled from a description.
    pub(in crate::cli) fn watch(sim: &Simulator) -> Self {
        let scene = sim.scene();
        let free = scene.objects().filter(|object| {
            let is_free = object.shape().is_ok_and(|shape| !shape.dynamics.is_static);
            is_free && object.parent().is_none() && carries_joints(&scene, object.handle())
        });
        let bases = free.filter_map(|object| {
            let handle = object.handle();
            let standing = scene.world_pose(handle).ok()?;
            Some(Base { handle, standing })
        });
        Self {
            bases: bases.collect(),
        }
    }

    /// What to say after a step, if one has fallen; nothing more is said after that.
    pub(in crate::cli) fn observe(&mut self, sim: &Simulator) -> Option<String> {
        let scene = sim.scene();
        let leans = |base: &&Base| {
            let pose = scene.world_pose(base.handle);
            pose.is_ok_and(|pose| leaning(&base.standing, &pose) > LEAN)
        };
        let base = self.bases.iter().find(leans)?.handle;
        let name = scene.short_path(base).unwrap_or_default();
        drop(scene);
        self.bases.clear();
        Some(format!(
            "{name} has fallen over: the base of this robot is free. --fix-base holds it in place."
        ))
    }
}

/// The angle by which what pointed up is off.
fn leaning(standing: &Pose, now: &Pose) -> f64 {
    let turn = now.rotation * standing.rotation.inverse();
    libm::acos(1.0 - 2.0 * (turn.i * turn.i + turn.j * turn.j))
}

fn carries_joints(scene: &Scene, base: Handle) -> bool {
    let is_joint = |handle: &Handle| {
        let object = scene.object(*handle);
        object.is_ok_and(|object| object.joint().is_ok())
    };
    scene.subtree(base).iter().any(is_joint)
}
