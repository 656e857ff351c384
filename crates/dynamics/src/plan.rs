//! Which shapes are bodies, and which constraints connect them (spec: dynamics 3).
//!
//! A function of the scene alone, without rapier. A plan is recomputed when its inputs change, and compared with the bodies and
//! constraints that exist.

mod pairs;
mod tendon;

use std::collections::BTreeMap;
use std::rc::Rc;

use articulation::JointKind;
use geometry::{Finite, MassProperties, Mesh};

use super::frozen::Frozen;
pub(super) use pairs::PairRule;
use scene::joint::{Joint, JointMode, JointSolver, JointType};
use scene::object::dummy::LinkType;
use scene::parameters::engine::Engine;
use scene::shape::soft::{Pin, Soft};
use scene::shape::{Fluid, MovingSurface, Primitive, Shape};
use scene::{Handle, Kind, ModelFlags, Object, Pose, Scene, Uid};
pub(super) use tendon::TendonPlan;
use tendon::tendon;

/// `sim.physics_mujoco`.
/// Root shapes further from the origin than this are out of service with their trees, metres.
const ACTIVITY_RANGE: f64 = 1000.0;

/// Bodies and constraints that the engine should contain.
#[derive(Default)]
pub(super) struct Plan {
    /// Base-to-tip.
    pub bodies: Vec<(Handle, BodyPlan)>,
    /// Handle of the joint, force sensor or (smaller) dummy of the link.
    pub links: BTreeMap<Handle, LinkPlan>,
    /// What is soft, base-to-tip.
    pub soft: Vec<(Handle, SoftPlan)>,
    pub tendons: Vec<TendonPlan>,
    /// What shapes say of pairs.
    pub pairs: Vec<PairRule>,
    /// Roots out of the range of the physics.
    pub far: Vec<Handle>,
}

/// What a text says of a soft shape, if that is known.
pub(super) type KnownSoft<'a> = dyn Fn(Handle, &str) -> Option<Rc<Soft>> + 'a;

/// A rope, cloth or volume.
pub(super) struct SoftPlan {
    uid: Uid,
    pub soft: Rc<Soft>,
    /// What says so.
    text: String,
    pub pins: Vec<Pin>,
    pub surface: Surface,
}

impl SoftPlan {
    /// Whether this is the same thing, perhaps held elsewhere.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        self.uid == other.uid && self.text == other.text
    }

    /// What a text says, if this is known from it.
    pub(super) fn known(&self, text: &str) -> Option<Rc<Soft>> {
        (self.text == text).then(|| Rc::clone(&self.soft))
    }
}

/// A rigid body.
pub(super) struct BodyPlan {
    pub build: BodyBuild,
    pub surface: Surface,
    /// It begins at rest, and stays so until something touches or pushes it.
    pub asleep: bool,
}

/// The ingredients of a body: when one changes, the body is rebuilt and loses its velocity.
#[derive(PartialEq)]
pub(super) struct BodyBuild {
    pub uid: Uid,
    pub dynamic: bool,
    pub respondable: bool,
    pub mass: MassProperties,
    pub parts: Vec<PartForm>,
}

/// The form of one part of a shape.
pub(super) struct PartForm {
    pub mesh: Rc<Mesh>,
    pub pose: Pose,
    pub primitive: Option<Primitive>,
    pub convex: bool,
}

impl PartialEq for PartForm {
    /// Meshes are shared and never changed in place: the same allocation is the same mesh.
    fn eq(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.mesh, &other.mesh)
            && self.pose == other.pose
            && self.primitive == other.primitive
            && self.convex == other.convex
    }
}

/// Properties of a body that may change without making it anew.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Surface {
    pub root: Handle,
    /// Low byte: local mask, high byte: global mask.
    pub mask: u16,
    /// Further bits of the local mask.
    pub further_bits: u64,
    pub friction: f64,
    pub friction_rule: FrictionRule,
    pub restitution: f64,
    pub linear_damping: f64,
    pub angular_damping: f64,
    pub fluid: Option<Fluid>,
    /// Part of its weight by which it is lifted.
    pub gravity_compensation: f64,
    /// Force with which it adheres to what it touches, N.
    pub adhesion: f64,
    /// How the surface of a static body moves, in the frame of its shape.
    pub motion: Option<MovingSurface>,
}

/// How the selected engine combines the frictions of two shapes.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum FrictionRule {
    Product,
    Largest,
}

/// A constraint between two bodies: `first` carries the base of the link, `second` its moving side.
#[derive(Clone, PartialEq)]
pub(super) struct LinkPlan {
    pub uid: Uid,
    pub kind: LinkKind,
    pub first: Handle,
    pub second: Handle,
    /// Base of the link in the first body's shape frame.
    pub base: Pose,
    /// Moving side of the link in the second body's shape frame.
    pub tip: Pose,
    /// Metres per radian: a screw moves along its axis while it turns.
    pub pitch: f64,
    /// Solver requested by the joint; one joint decides for its chain.
    pub solver: JointSolver,
    /// Whether `second` is the child of the link in the scene, whose pose follows from the link.
    pub second_is_child: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum LinkKind {
    Revolute,
    Prismatic,
    Spherical,
    Sensor,
    Weld,
}

impl LinkKind {
    /// The joint that holds such a link.
    pub(super) fn joint(self) -> JointKind {
        match self {
            Self::Revolute => JointKind::Revolute,
            Self::Prismatic => JointKind::Prismatic,
            Self::Spherical => JointKind::Spherical,
            Self::Sensor | Self::Weld => JointKind::Fixed,
        }
    }
}

impl Plan {
    /// `known`: what is soft and known already.
    pub(super) fn new(scene: &Scene, frozen: &Frozen, known: &KnownSoft) -> Self {
        let order = scene.all_breadth_first();
        let far: Vec<_> = order
            .iter()
            .copied()
            .filter(|&handle| is_far(scene, handle))
            .collect();
        let here = order
            .iter()
            .filter(|&&handle| far.is_empty() || !far.contains(&scene.root_of(handle)));
        let bodies = here
            .filter_map(|&handle| Some((handle, body(scene, handle, frozen)?)))
            .collect();
        let soft = order
            .iter()
            .filter_map(|&handle| Some((handle, soft(scene, handle, known)?)));
        let mut plan = Self {
            bodies,
            soft: soft.collect(),
            tendons: Vec::new(),
            pairs: Vec::new(),
            links: BTreeMap::new(),
            far,
        };
        let roles: BTreeMap<Handle, bool> = plan
            .bodies
            .iter()
            .map(|(h, body)| (*h, body.build.dynamic))
            .collect();
        let tendons = order.iter().map(|&handle| tendon(scene, handle, &roles));
        plan.tendons = tendons.flatten().collect();
        plan.pairs = pairs::rules(scene, &roles);
        for handle in order {
            if let Some(link) = link(scene, handle, &roles) {
                plan.links.insert(handle, link);
            }
        }
        plan
    }
}

fn body(scene: &Scene, handle: Handle, frozen: &Frozen) -> Option<BodyPlan> {
    let object = scene.object(handle).ok()?;
    let shape = object.shape().ok()?;
    let dynamics = &shape.dynamics;
    if !dynamics.respondable && dynamics.is_static && !carries_links(scene, object) {
        return None;
    }
    if !dynamics.is_static && object.soft_text().is_some() {
        return None;
    }
    let flags = scene.calculated_model_property(handle);
    let (dynamic_tree, respondable_tree) = (
        !flags.contains(ModelFlags::NOT_DYNAMIC),
        !flags.contains(ModelFlags::NOT_RESPONDABLE),
    );
    let is_somewhere = || scene.world_pose(handle).is_ok_and(|pose| pose.is_finite());
    if !(dynamic_tree || respondable_tree) || !is_somewhere() {
        return None;
    }
    let build = BodyBuild {
        uid: object.uid(),
        dynamic: dynamic_tree && !dynamics.is_static && !frozen.contains(handle),
        respondable: respondable_tree && dynamics.respondable,
        mass: bounded(scene, &shape.mass).with_positive_moments(),
        parts: shape.parts.iter().map(PartForm::of).collect(),
    };
    Some(BodyPlan {
        build,
        surface: among(scene, object, surface(scene, handle, shape)),
        asleep: dynamics.start_asleep,
    })
}

/// The mass of a body as MuJoCo's parameters of the scene bound it.
fn bounded(scene: &Scene, mass: &MassProperties) -> MassProperties {
    let surrounding = scene.settings().dynamics.surrounding();
    let [least_mass, least_moment] = surrounding.least;
    mass.bounded(least_mass, least_moment, surrounding.balances_inertia)
}

/// The surface of a body with what surrounds it, and with what MuJoCo's parameters say of it.
fn among(scene: &Scene, object: &Object, mut surface: Surface) -> Surface {
    let dynamics = &scene.settings().dynamics;
    let surrounding = dynamics.surrounding();
    surface.fluid = object.fluid().or(surrounding.fluid);
    surface.motion = object.moving_surface();
    let counts = dynamics.engine.engine == Engine::Mujoco || object.is_of_mujoco();
    let Some(material) = object.shape().ok().map(|shape| &shape.material) else {
        return surface;
    };
    if counts {
        surface.adhesion = material.adhesion();
        if surrounding.has_passive_forces {
            surface.gravity_compensation = material.gravity_compensation();
        }
    }
    surface
}

/// A shape that bends: one that is not static, and says what it is.
fn soft(scene: &Scene, handle: Handle, known: &KnownSoft) -> Option<SoftPlan> {
    let object = scene.object(handle).ok()?;
    let shape = object.shape().ok()?;
    let flags = scene.calculated_model_property(handle);
    if shape.dynamics.is_static || flags.contains(ModelFlags::NOT_DYNAMIC) {
        return None;
    }
    let text = object.soft_text()?;
    let soft = known(handle, &text).or_else(|| object.soft().map(Rc::new))?;
    let mut surface = surface(scene, handle, shape);
    if !shape.dynamics.respondable || flags.contains(ModelFlags::NOT_RESPONDABLE) {
        (surface.mask, surface.further_bits) = (0, 0);
    }
    Some(SoftPlan {
        uid: object.uid(),
        soft,
        text,
        pins: object.pins(),
        surface,
    })
}

impl PartForm {
    fn of(part: &scene::shape::Part) -> Self {
        Self {
            mesh: part.mesh.clone(),
            pose: part.pose,
            primitive: part.primitive.clone(),
            convex: part.convex,
        }
    }
}

fn surface(scene: &Scene, handle: Handle, shape: &Shape) -> Surface {
    let selected = scene.settings().dynamics.engine;
    let (friction, restitution) = shape.material.contact_values(selected);
    let has_contacts = scene.settings().dynamics.surrounding().has_contacts;
    let suspended = shape.dynamics.respondable_suspend_count > 0 || !has_contacts;
    Surface {
        root: scene.collision_root_of(handle),
        mask: if suspended {
            0
        } else {
            shape.dynamics.respondable_mask.bits()
        },
        further_bits: if suspended {
            0
        } else {
            scene.collision_bits_of(handle)
        },
        friction,
        friction_rule: if selected.engine == Engine::Mujoco {
            FrictionRule::Largest
        } else {
            FrictionRule::Product
        },
        restitution,
        linear_damping: shape.material.linear_damping,
        angular_damping: shape.material.angular_damping,
        fluid: None,
        gravity_compensation: 0.0,
        adhesion: 0.0,
        motion: None,
    }
}

/// Whether this is a shape without parent out of the range of the physics; what hangs on it is out of service as well.
pub(super) fn is_far(scene: &Scene, handle: Handle) -> bool {
    scene.object(handle).is_ok_and(|object| {
        object.parent().is_none()
            && matches!(object.kind, Kind::Shape(_))
            && object.pose().translation.vector.norm() > ACTIVITY_RANGE
    })
}

/// Whether a static shape that collides with nothing is needed as the base of a joint, force sensor or weld.
fn carries_links(scene: &Scene, shape: &Object) -> bool {
    children(scene, shape).any(|child| match &child.kind {
        Kind::Joint(joint) => {
            is_dynamic_mode(scene, joint) && !closing_children(scene, child).is_empty()
        }
        Kind::ForceSensor(_) => !closing_children(scene, child).is_empty(),
        Kind::Dummy(_) => welded_to(scene, child).is_some(),
        _ => false,
    })
}

fn children<'a>(scene: &'a Scene, object: &'a Object) -> impl Iterator<Item = &'a Object> {
    object
        .children()
        .iter()
        .filter_map(|&child| scene.object(child).ok())
}

/// Also a joint that follows a dynamic one counts as dynamic, directly or by way of others. Masters never form a circle.
fn is_dynamic_mode(scene: &Scene, joint: &Joint) -> bool {
    let mut joint = joint;
    loop {
        let master = match joint.mode {
            JointMode::Dynamic => return true,
            JointMode::Dependent => joint.dependency.map(|law| law.master),
            _ if joint.hybrid => return true,
            JointMode::Kinematic | JointMode::Motion | JointMode::InverseKinematics => None,
        };
        match master.and_then(|master| scene.object(master).ok()?.joint().ok()) {
            Some(master) => joint = master,
            None => return false,
        }
    }
}

/// Children that can be the moving side of a link: non-static shapes and dummies that close a loop.
fn closing_children<'a>(scene: &'a Scene, link: &'a Object) -> Vec<&'a Object> {
    children(scene, link)
        .filter(|child| match &child.kind {
            Kind::Shape(shape) => !shape.dynamics.is_static,
            Kind::Dummy(_) => welded_to(scene, child).is_some(),
            _ => false,
        })
        .collect()
}

/// The partner of a childless dummy in a loop closure, childless as well.
fn welded_to<'a>(scene: &'a Scene, dummy: &Object) -> Option<&'a Object> {
    let data = dummy.dummy().ok()?;
    let partner = scene.object(data.link?).ok()?;
    let closes = scene.settings().dynamics.surrounding().has_equalities
        && data.link_type == LinkType::LoopClosure
        && dummy.children().is_empty()
        && partner.children().is_empty();
    closes.then_some(partner)
}

/// The link of an object, if all its conditions hold. `roles`: the bodies, and whether they are dynamic.
fn link(scene: &Scene, handle: Handle, roles: &BTreeMap<Handle, bool>) -> Option<LinkPlan> {
    let object = scene.object(handle).ok()?;
    let first = object
        .parent()
        .filter(|parent| roles.contains_key(parent))?;
    if scene
        .calculated_model_property(handle)
        .contains(ModelFlags::NOT_DYNAMIC)
    {
        return None;
    }
    let kind = match &object.kind {
        Kind::Joint(joint) if is_dynamic_mode(scene, joint) => match joint.joint_type {
            JointType::Revolute => LinkKind::Revolute,
            JointType::Prismatic => LinkKind::Prismatic,
            JointType::Spherical => LinkKind::Spherical,
        },
        Kind::ForceSensor(_) => LinkKind::Sensor,
        Kind::Dummy(_) => return weld(scene, object, first, roles),
        _ => return None,
    };
    let [child] = closing_children(scene, object)[..] else {
        return None;
    };
    let (second, tip) = match &child.kind {
        Kind::Shape(_) => (child.handle(), child.pose().inverse()),
        _ => {
            let partner = welded_to(scene, child)?;
            (partner.parent()?, partner.pose() * child.pose().inverse())
        }
    };
    let second_is_child = second == child.handle();
    let moves = |body: Handle| roles.get(&body).copied();
    let linked = if second_is_child {
        moves(second)?
    } else {
        moves(first)? || moves(second)?
    };
    (linked && first != second).then(|| LinkPlan {
        uid: object.uid(),
        kind,
        first,
        second,
        base: object.pose(),
        tip,
        pitch: object.joint().map_or(0.0, pitch),
        solver: object
            .joint()
            .map_or(JointSolver::Exact, |joint| joint.solver),
        second_is_child,
    })
}

/// Two dummies directly below shapes; the link is identified by the first.
fn weld(
    scene: &Scene,
    dummy: &Object,
    first: Handle,
    roles: &BTreeMap<Handle, bool>,
) -> Option<LinkPlan> {
    let partner = welded_to(scene, dummy)?;
    let second = partner.parent()?;
    let moves = *roles.get(&first)? || *roles.get(&second)?;
    (moves && first != second && dummy.handle() < partner.handle()).then(|| LinkPlan {
        uid: dummy.uid(),
        kind: LinkKind::Weld,
        first,
        second,
        base: dummy.pose(),
        tip: partner.pose(),
        pitch: 0.0,
        solver: JointSolver::Exact,
        second_is_child: false,
    })
}

fn pitch(joint: &Joint) -> f64 {
    if joint.is_revolute() {
        joint.screw_lead / std::f64::consts::TAU
    } else {
        0.0
    }
}
