//! Which tendons there are between dummies, while MuJoCo is the selected engine.

use std::collections::BTreeMap;

use scene::parameters::engine::Engine;
use scene::parameters::mujoco::Tendon;
use scene::{Handle, Scene, Uid};

/// A tendon between two dummies.
pub(crate) struct TendonPlan {
    /// Of the dummy whose parameters count.
    pub uid: Uid,
    pub tendon: Tendon,
    pub ends: [TendonEnd; 2],
}

/// A point of a body, in the frame of its shape, or of the world.
pub(crate) struct TendonEnd {
    pub body: Option<Handle>,
    pub place: [f64; 3],
}

/// A tendon from a dummy to its partner, while MuJoCo is the selected engine. `roles`: the bodies.
pub(super) fn tendon(
    scene: &Scene,
    handle: Handle,
    roles: &BTreeMap<Handle, bool>,
) -> Option<TendonPlan> {
    let dynamics = &scene.settings().dynamics;
    let object = scene.object(handle).ok()?;
    let dummy = object.dummy().ok()?;
    let partner = dummy.link.filter(|partner| handle < *partner)?;
    let mut tendon = dummy.tendon()?;
    if dynamics.engine.engine != Engine::Mujoco {
        return None;
    }
    if !dynamics.surrounding().has_passive_forces {
        (tendon.stiffness, tendon.damping) = (0.0, 0.0);
    }
    Some(TendonPlan {
        uid: object.uid(),
        tendon,
        ends: [
            tendon_end(scene, handle, roles)?,
            tendon_end(scene, partner, roles)?,
        ],
    })
}

/// The place of a dummy on the body that it hangs on.
fn tendon_end(scene: &Scene, dummy: Handle, roles: &BTreeMap<Handle, bool>) -> Option<TendonEnd> {
    let above = |handle: &Handle| scene.object(*handle).ok()?.parent();
    let body = std::iter::successors(above(&dummy), above).find(|body| roles.contains_key(body));
    let mut place = scene.world_pose(dummy).ok()?;
    if let Some(body) = body {
        place = scene.world_pose(body).ok()?.inverse() * place;
    }
    let place: [f64; 3] = place.translation.vector.into();
    let is_somewhere = place.iter().all(|x| x.is_finite());
    is_somewhere.then_some(TendonEnd { body, place })
}
