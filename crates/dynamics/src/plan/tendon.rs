//! Which tendons there are: dummies that say so, and, while MuJoCo is the selected engine, pairs of dummies.

use std::collections::BTreeMap;

use scene::joint::Actuators;
use scene::object::tendon::{Tendon, TendonLaw, TendonPart};
use scene::parameters::engine::Engine;
use scene::{Handle, Object, Scene, Uid};

/// A tendon: points with straight segments between them, and joints.
pub(crate) struct TendonPlan {
    pub uid: Uid,
    /// The dummy whose parameters count.
    pub dummy: Handle,
    pub law: TendonLaw,
    pub actuators: Actuators,
    pub points: Vec<TendonPoint>,
    pub segments: Vec<Segment>,
    pub joints: Vec<TendonJoint>,
}

/// A point of a body, in the frame of its shape, or of the world.
pub(crate) struct TendonPoint {
    pub body: Option<Handle>,
    pub place: [f64; 3],
}

/// A straight part of a tendon.
#[derive(Clone, Copy)]
pub(crate) struct Segment {
    /// Indices of points.
    pub ends: [usize; 2],
    /// What its length counts.
    pub weight: f64,
}

/// A joint of which the position, times a factor, is a part of the length.
pub(crate) struct TendonJoint {
    pub joint: Handle,
    pub factor: f64,
    /// Where the scene has it: a joint that the physics does not move stays there.
    pub position: f64,
}

/// The tendon of a dummy, if it is one. `roles`: the bodies.
pub(super) fn tendon(
    scene: &Scene,
    handle: Handle,
    roles: &BTreeMap<Handle, bool>,
) -> Option<TendonPlan> {
    let object = scene.object(handle).ok()?;
    let Tendon { law, path } = object.tendon().or_else(|| of_pair(scene, object))?;
    let has_motors = scene.settings().dynamics.surrounding().has_motors;
    let mut plan = TendonPlan {
        uid: object.uid(),
        dummy: handle,
        law: switched(law, scene),
        actuators: if has_motors {
            object.tendon_actuators()
        } else {
            Actuators::default()
        },
        points: Vec::new(),
        segments: Vec::new(),
        joints: Vec::new(),
    };
    let (mut weight, mut last) = (1.0, None);
    for part in path {
        match part {
            TendonPart::Site(site) => {
                plan.points.push(point(scene, site, roles)?);
                let here = plan.points.len() - 1;
                let ends = last.replace(here).map(|last| [last, here]);
                plan.segments
                    .extend(ends.map(|ends| Segment { ends, weight }));
            }
            TendonPart::Pulley(divisor) => (weight, last) = (1.0 / divisor, None),
            TendonPart::Joint(joint, factor) => {
                let position = scene.object(joint).ok()?.joint().ok()?.position;
                plan.joints.push(TendonJoint {
                    joint,
                    factor,
                    position,
                });
            }
        }
    }
    Some(plan)
}

/// A tendon from a dummy to its partner, while MuJoCo is the selected engine.
fn of_pair(scene: &Scene, object: &Object) -> Option<Tendon> {
    let dummy = object.dummy().ok()?;
    let partner = dummy.link.filter(|partner| object.handle() < *partner)?;
    let is_selected = scene.settings().dynamics.engine.engine == Engine::Mujoco;
    let law = dummy.tendon().filter(|_| is_selected)?;
    let path = [object.handle(), partner].map(TendonPart::Site).to_vec();
    Some(Tendon { law, path })
}

/// What of a tendon acts where MuJoCo's switches let it.
fn switched(mut law: TendonLaw, scene: &Scene) -> TendonLaw {
    let surrounding = scene.settings().dynamics.surrounding();
    if !surrounding.has_passive_forces {
        (law.stiffness, law.damping) = (0.0, 0.0);
    }
    if !surrounding.has_joint_friction {
        law.friction = 0.0;
    }
    law.range = law.range.filter(|_| surrounding.has_joint_limits);
    law
}

/// The place of a dummy on the body that it hangs on.
fn point(scene: &Scene, dummy: Handle, roles: &BTreeMap<Handle, bool>) -> Option<TendonPoint> {
    let above = |handle: &Handle| scene.object(*handle).ok()?.parent();
    let body = std::iter::successors(above(&dummy), above).find(|body| roles.contains_key(body));
    let mut place = scene.world_pose(dummy).ok()?;
    if let Some(body) = body {
        place = scene.world_pose(body).ok()?.inverse() * place;
    }
    let place: [f64; 3] = place.translation.vector.into();
    let is_somewhere = place.iter().all(|x| x.is_finite());
    is_somewhere.then_some(TendonPoint { body, place })
}
