//! What injections become, and how it goes again.

use nalgebra::{Point3, Vector3};

use super::describe::{Act, Described, Hold, describe};
use super::injections::{Injection, Injections, Made, State};
use super::{Cx, Result, acts, names};
use format::robot_file::{SoftShape, pin_nodes};
use robot_description::mjcf::Flex;
use scene::joint::{Joint, JointMode, JointType};
use scene::object::dummy::{Dummy, LinkType};
use scene::shape::Shape;
use scene::shape::soft::{Pin, Soft};
use scene::{Data, Field, Handle, Kind, Layers, Pose};
use script::log::verbosity;

/// Displayed size of what holds bodies together, metres.
pub(super) const DUMMY: f64 = 0.01;

/// Makes the objects of all injections that have none. Soft things are first, since constraints may name them.
pub(super) fn make_pending(cx: &mut Cx) -> Result<()> {
    let injections = cx.module_state::<Injections>();
    for ended in injections.take_ended() {
        unmake(cx, ended)?;
    }
    let mut all = Vec::new();
    for id in injections.pending() {
        injections.change(id, |one| one.state = State::Done);
        let Some(injection) = injections.get(id) else {
            continue;
        };
        let info = changed(&injection);
        injections.change(id, |one| one.info = info.clone());
        // The callback may have taken it out.
        if injections.get(id).is_none() {
            continue;
        }
        let made = describe(cx, injection.kind, &info, &injection.xml);
        match made.and_then(|described| make_softs(cx, id, described)) {
            Ok(described) => all.push((id, described)),
            Err(error) => log(cx, verbosity::ERRORS, &format!("injection {id}: {error}")),
        }
    }
    for (id, described) in all {
        act(cx, id, described)?;
    }
    Ok(())
}

/// What an injection says after its callback.
fn changed(injection: &Injection) -> Data {
    let answer = injection
        .callback
        .as_ref()
        .and_then(|callback| callback.call_logged(std::slice::from_ref(&injection.info)));
    let mut info = injection.info.clone();
    if let (Data::Map(entries), Some(Data::Map(answer))) = (
        &mut info,
        answer.and_then(|results| results.into_iter().next()),
    ) {
        for (key, value) in answer {
            entries.retain(|(own, _)| *own != key);
            entries.push((key, value));
        }
    }
    info
}

fn make_softs(cx: &mut Cx, id: i64, mut described: Described) -> Result<Described> {
    let injections = cx.module_state::<Injections>();
    for (flex, shape) in std::mem::take(&mut described.softs) {
        let handle = make_soft(cx, &flex, shape, described.holder)?;
        injections.change(id, |one| one.made.softs.push((flex, handle)));
    }
    Ok(described)
}

fn make_soft(cx: &mut Cx, flex: &Flex, made: SoftShape, holder: Option<Handle>) -> Result<Handle> {
    let frame = match holder {
        Some(holder) => cx.scene().world_pose(holder)?,
        None => Pose::identity(),
    };
    let alias = if flex.name.is_empty() {
        "flex"
    } else {
        &flex.name
    };
    let handle = cx.add_object(alias, Kind::Shape(Box::new(made.shape)))?;
    let mut scene = cx.scene_mut();
    scene.set_world_pose(handle, frame)?;
    scene.set_soft(handle, &made.soft)?;
    pin_nodes(&mut scene, handle, flex, holder, frame)?;
    Ok(handle)
}

/// Does what an injection does beside soft things.
fn act(cx: &mut Cx, id: i64, mut described: Described) -> Result<()> {
    // Sites and tendons are there when others name them.
    described.acts.sort_by_key(Act::rank);
    for act in described.acts {
        let made = match act {
            Act::Hold(hold) => {
                let made = hold_bodies(cx, &hold)?;
                if made.is_none() {
                    name_unknown(cx, id, &hold.name);
                }
                made
            }
            Act::Gravity(gravity) => Some(set_gravity(cx, gravity)),
            Act::Step(step) => Some(set_step(cx, step)),
            other => act_on_objects(cx, id, &other, described.holder)?,
        };
        let injections = cx.module_state::<Injections>();
        injections.change(id, |one| one.made.add(made.unwrap_or_default()));
    }
    for name in &described.unknown {
        name_unknown(cx, id, name);
    }
    Ok(())
}

/// Adds dummies, and changes objects that there are; None where that has no counterpart.
fn act_on_objects(cx: &mut Cx, id: i64, act: &Act, holder: Option<Handle>) -> Result<Option<Made>> {
    let (outcome, name) = match act {
        Act::Site(site) => (acts::add_site(cx, site, holder)?, "<site>"),
        Act::Tendon(tendon) => (acts::add_tendon(cx, tendon)?, "<tendon>"),
        Act::Joint(change) => (acts::change_joint(cx, change)?, "<joint>"),
        Act::Actuator(actuator, moved) => (acts::add_actuator(cx, actuator, moved)?, "<actuator>"),
        Act::Adhesion(adhesion, body) => (acts::add_adhesion(cx, adhesion, body)?, "<adhesion>"),
        Act::Pair(pair) => (acts::add_pair(cx, pair)?, pair.element.as_str()),
        Act::Hold(_) | Act::Gravity(_) | Act::Step(_) => return Ok(None),
    };
    if let Err(reason) = &outcome {
        name_unknown(cx, id, &format!("{name} ({reason})"));
    }
    Ok(outcome.ok())
}

impl Made {
    fn add(&mut self, more: Self) {
        self.objects.extend(more.objects);
        self.pins.extend(more.pins);
        self.undo.extend(more.undo);
        self.gravity = self.gravity.or(more.gravity);
        self.step = self.step.or(more.step);
    }
}

fn name_unknown(cx: &Cx, id: i64, name: &str) {
    let text = format!("{name} of injection {id} has no counterpart, and is ignored");
    if cx.module_state::<Injections>().is_new(&text) {
        log(cx, verbosity::WARNINGS, &text);
    }
}

fn log(cx: &Cx, level: i64, text: &str) {
    cx.env().log(level, &format!("simMujoco: {text}"));
}

fn set_gravity(cx: &mut Cx, gravity: [f64; 3]) -> Made {
    let mut scene = cx.scene_mut();
    let before = scene.settings().dynamics.gravity;
    scene.modify_settings(|settings| settings.dynamics.gravity = gravity.map(|x| x as f32));
    Made {
        gravity: Some(before),
        ..Made::default()
    }
}

fn set_step(cx: &mut Cx, step: f64) -> Made {
    let mut scene = cx.scene_mut();
    let before = scene.settings().dynamics.step;
    scene.modify_settings(|settings| settings.set_physics_step(step));
    Made {
        step: Some(before),
        ..Made::default()
    }
}

/// What a constraint holds.
#[derive(Clone, Copy)]
enum Held {
    World,
    Body(Handle),
    Node(Handle, usize),
}

/// Holds two bodies together; None where that has no counterpart.
fn hold_bodies(cx: &mut Cx, hold: &Hold) -> Result<Option<Made>> {
    let [Some(one), Some(other)] = [0, 1].map(|side| held(cx, hold, side)) else {
        return Ok(None);
    };
    match (one, other) {
        (Held::Node(soft, node), Held::Body(body)) | (Held::Body(body), Held::Node(soft, node)) => {
            pin(cx, (soft, node), Some(body), hold).map(Some)
        }
        (Held::Node(soft, node), Held::World) => pin(cx, (soft, node), None, hold).map(Some),
        (Held::Body(body), Held::World) => close(cx, body, None, hold).map(Some),
        (Held::Body(body), Held::Body(other)) => close(cx, body, Some(other), hold).map(Some),
        (Held::Node(..), Held::Node(..)) | (Held::World, _) => Ok(None),
    }
}

fn held(cx: &Cx, hold: &Hold, side: usize) -> Option<Held> {
    let Some(name) = &hold.bodies[side] else {
        return Some(Held::World);
    };
    let anchor = if side == 0 { hold.anchor } else { [0.0; 3] };
    let softs = cx.module_state::<Injections>().softs();
    let node = softs.iter().find_map(|(flex, handle)| {
        let node = names::node(flex, name, anchor)?;
        Some(Held::Node(*handle, node))
    });
    match name.as_str() {
        "world" | "worldbody" => Some(Held::World),
        _ => node.or_else(|| names::body(&cx.scene(), name).map(Held::Body)),
    }
}

fn pin(
    cx: &mut Cx,
    (soft, node): (Handle, usize),
    holder: Option<Handle>,
    hold: &Hold,
) -> Result<Made> {
    let mut scene = cx.scene_mut();
    let frame = match holder {
        Some(holder) => scene.world_pose(holder)?,
        None => Pose::identity(),
    };
    let point = scene.soft_form(soft)?.points[node];
    let is_rope = matches!(scene.object(soft)?.soft(), Some(Soft::Rope(_)));
    let mut pins = scene.object(soft)?.pins();
    pins.retain(|pin| pin.point != node);
    pins.push(Pin {
        point: node,
        holder,
        place: (frame.inverse() * Point3::from(point)).into(),
        clamped: is_rope && hold.is_weld,
    });
    scene.set_pins(soft, &pins)?;
    Ok(Made {
        pins: vec![(soft, node)],
        ..Made::default()
    })
}

/// Closes a loop between two bodies as they are, or lets a ball joint be between them.
fn close(cx: &mut Cx, body: Handle, other: Option<Handle>, hold: &Hold) -> Result<Made> {
    let frame = cx.scene().world_pose(body)?
        * Pose::from(nalgebra::Translation3::from(Vector3::from(hold.anchor)));
    let mut objects = Vec::new();
    let mut parent = body;
    if !hold.is_weld {
        let joint = Joint::new(JointType::Spherical, JointMode::Dynamic);
        parent = add(
            cx,
            "connect",
            Kind::Joint(Box::new(joint)),
            frame,
            Some(body),
        )?;
        objects.push(parent);
    }
    let dummy = || Kind::Dummy(Dummy::new(DUMMY));
    let tip = add(cx, "tip", dummy(), frame, Some(parent))?;
    let other = match other {
        Some(other) => other,
        None => {
            let base = add(cx, "base", anchor()?, frame, None)?;
            objects.push(base);
            base
        }
    };
    let target = add(cx, "target", dummy(), frame, Some(other))?;
    objects.extend([tip, target]);
    let mut scene = cx.scene_mut();
    scene.set_link_type(tip, LinkType::LoopClosure)?;
    scene.link_dummies(tip, Some(target))?;
    Ok(Made {
        objects,
        ..Made::default()
    })
}

/// A shape that stands for the world: loops are closed between shapes.
fn anchor() -> Result<Kind> {
    let cuboid = geometry::PrimitiveKind::Cuboid;
    let mut shape = Shape::primitive(cuboid, [DUMMY; 3], Default::default())?;
    shape.dynamics.respondable = false;
    shape.dynamics.is_static = true;
    Ok(Kind::Shape(Box::new(shape)))
}

/// Adds an object that is not shown.
pub(super) fn add(
    cx: &mut Cx,
    alias: &str,
    kind: Kind,
    pose: Pose,
    parent: Option<Handle>,
) -> Result<Handle> {
    let handle = cx.add_object(alias, kind)?;
    let mut scene = cx.scene_mut();
    scene.set_world_pose(handle, pose)?;
    scene.set_parent(handle, parent, true)?;
    scene.modify(handle, Field::Layer, |object| {
        object.layer = Layers::JOINTS.hidden();
    })?;
    Ok(handle)
}

/// Removes what an injection has become, and sets what it has set back.
pub(super) fn unmake(cx: &mut Cx, injection: Injection) -> Result<()> {
    let made = injection.made;
    acts::undo(cx, made.undo)?;
    for (soft, node) in made.pins {
        let pins = cx.scene().object(soft).map(|object| object.pins());
        if let Ok(mut pins) = pins {
            pins.retain(|pin| pin.point != node);
            cx.scene_mut().set_pins(soft, &pins)?;
        }
    }
    let softs = made.softs.into_iter().map(|(_, handle)| handle);
    let mut objects: Vec<Handle> = softs.chain(made.objects).collect();
    objects.retain(|handle| cx.scene().object(*handle).is_ok());
    if !objects.is_empty() {
        cx.remove_objects(&objects)?;
    }
    let mut scene = cx.scene_mut();
    if let Some(gravity) = made.gravity {
        scene.modify_settings(|settings| settings.dynamics.gravity = gravity);
    }
    if let Some(step) = made.step {
        scene.modify_settings(|settings| settings.dynamics.step = step);
    }
    Ok(())
}
