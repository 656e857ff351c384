//! `simSoft`: ropes and cables, where they are held, and what they bear.

mod options;

use api_macro::api;
use geometry::Pose;
use nalgebra::Point3;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use options::{Kind, described};
use scene::shape::rope::{Pin, Rope, RopeForm};
use scene::shape::{Appearance, Material, Shape};
use scene::{Data, Field, Handle, SceneError};
use script::Table;

/// The module `simSoft`.
pub static MODULE: Module = Module {
    about: "Ropes and cables that hang, bend, twist, touch things and break, pinned to objects.",
    functions: &[("Ropes", FUNCTIONS)],
    ..Module::new("simSoft")
};

const FUNCTIONS: &[ApiFn] = functions![
    create_rope,
    create_cable,
    pin,
    unpin,
    get_points,
    set_points,
    get_tensions,
    get_pin_force,
    break_edge,
    get_broken_edges,
];

/// A rope: a shape that the physics bends. It resists bending a thousand times less than a solid rod.
///
/// Options: `points` (three coordinates each, world) or `from` and `to`; `count`: edges of equal length (without it the points are as given; 40 with `from` and `to`);
/// `length` at rest (that of the points); `radius` (0.005); `density` (1000 kg/m3) or `mass` (kg, of all); `young` (1e8 Pa), `poisson` (0.4), or `stretchStiffness` (N),
/// `bendStiffness`, `twistStiffness` (N m2); `damping` (0.001 s), `drag` (0.1 per second), `friction` (0.7, with its like; with others as the selected engine combines), `strength` (N; it does not break), `straight` (true: at rest, otherwise as
/// the points say), `selfContact` (false), `color` (red, green, blue).
///
/// @param options a table
/// @return ropeHandle the shape
#[api("simSoft.createRope")]
fn create_rope(cx: &mut Cx, options: Table) -> Result<Handle> {
    create(cx, &options.0, Kind::Rope)
}

/// A cable or hose: as createRope, but it resists bending as a solid rod does, with a `young` of 2e7 Pa.
///
/// @param options a table, see createRope
/// @return cableHandle the shape
#[api("simSoft.createCable")]
fn create_cable(cx: &mut Cx, options: Table) -> Result<Handle> {
    create(cx, &options.0, Kind::Cable)
}

fn create(cx: &mut Cx, options: &Data, kind: Kind) -> Result<Handle> {
    let made = described(options, kind)?;
    let mut shape = Shape::of_rope(&made.rope, Appearance::new(made.colour))?;
    shape.material = Material::of_friction(made.friction);
    shape.mass.mass = made.mass;
    let handle = cx.add_object(kind.alias(), scene::Kind::Shape(Box::new(shape)))?;
    cx.scene_mut().set_rope(handle, &made.rope)?;
    Ok(handle)
}

/// Holds a point of a rope where it is on an object: it goes along with it, and pulls at it.
///
/// Options: `position` (world): the point is held there instead of where it is; `clamp` (false): the edge that begins at the point (at the last point: ends) keeps its
/// direction in the object and does not turn about its axis.
///
/// @param ropeHandle the rope
/// @param point its index, from 0
/// @param objectHandle what holds it; -1: the world
/// @param options a table
#[api("simSoft.pin")]
fn pin(
    cx: &mut Cx,
    rope_handle: Handle,
    point: i64,
    #[default(-1)] object_handle: i64,
    #[default(Table(Data::Nil))] options: Table,
) -> Result<()> {
    let options = options.0;
    options::check_names(&options, &["position", "clamp"])?;
    let form = cx.scene().rope_form(rope_handle)?;
    let point = index(point, form.points.len())?;
    let here = form.points[point];
    let position = options::numbers::<3>(&options, "position")?.unwrap_or(here);
    let (holder, pose) = holder(cx, object_handle)?;
    let held = Pin {
        point,
        holder,
        place: (pose.inverse() * Point3::from(position)).into(),
        clamped: options::truth(&options, "clamp", false)?,
    };
    let mut pins = cx.scene().object(rope_handle)?.pins();
    pins.retain(|pin| pin.point != point);
    pins.push(held);
    Ok(cx.scene_mut().set_pins(rope_handle, &pins)?)
}

fn holder(cx: &Cx, raw: i64) -> Result<(Option<Handle>, Pose)> {
    if raw == -1 {
        return Ok((None, Pose::identity()));
    }
    let handle = Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?;
    Ok((Some(handle), cx.scene().world_pose(handle)?))
}

/// Lets a point of a rope go.
///
/// @param ropeHandle the rope
/// @param point its index, from 0; -1: all that are held
#[api("simSoft.unpin")]
fn unpin(cx: &mut Cx, rope_handle: Handle, #[default(-1)] point: i64) -> Result<()> {
    cx.scene().rope_form(rope_handle)?;
    let mut pins = cx.scene().object(rope_handle)?.pins();
    pins.retain(|pin| point >= 0 && pin.point as i64 != point);
    Ok(cx.scene_mut().set_pins(rope_handle, &pins)?)
}

/// Where the points of a rope are.
///
/// @param ropeHandle the rope
/// @return points three coordinates each, world
#[api("simSoft.getPoints")]
fn get_points(cx: &Cx, rope_handle: Handle) -> Result<Vec<f64>> {
    let form = cx.scene().rope_form(rope_handle)?;
    Ok(form.points.into_flattened())
}

/// Puts the points of a rope elsewhere, at rest. What was stretched by that is pulled together again.
///
/// @param ropeHandle the rope
/// @param points three coordinates each, world; as many as there are
#[api("simSoft.setPoints")]
fn set_points(cx: &mut Cx, rope_handle: Handle, points: Vec<f64>) -> Result<()> {
    let mut form = cx.scene().rope_form(rope_handle)?;
    let (points, rest) = points.as_chunks::<3>();
    if !rest.is_empty() || points.len() != form.points.len() {
        return Err(ApiError::TableSize);
    }
    let moved = Rope {
        points: points.to_vec(),
        ..cx.scene()
            .object(rope_handle)?
            .rope()
            .ok_or(SceneError::InvalidData)?
    };
    if !moved.is_valid() {
        return Err(SceneError::InvalidArgument.into());
    }
    form.points = moved.points;
    put(cx, rope_handle, form)
}

/// Lets the physics take over a form.
fn put(cx: &mut Cx, rope: Handle, form: RopeForm) -> Result<()> {
    let mut scene = cx.scene_mut();
    scene.report_rope(rope, Some(form))?;
    Ok(scene.modify(rope, Field::Dynamics, |object| object.dynamics_reset = true)?)
}

/// Tensions of the edges between the points, in the last sub-step.
///
/// @param ropeHandle the rope
/// @return tensions newtons; negative where it is pressed
#[api("simSoft.getTensions")]
fn get_tensions(cx: &Cx, rope_handle: Handle) -> Result<Vec<f64>> {
    Ok(cx.scene().rope_form(rope_handle)?.tensions)
}

/// The force by which a rope is held at a point, in the last sub-step.
///
/// @param ropeHandle the rope
/// @param point its index, from 0
/// @return force on the rope, newtons, world axes; 0 where nothing holds it
#[api("simSoft.getPinForce")]
fn get_pin_force(cx: &Cx, rope_handle: Handle, point: i64) -> Result<[f64; 3]> {
    let RopeForm {
        points, pin_forces, ..
    } = cx.scene().rope_form(rope_handle)?;
    let point = index(point, points.len())?;
    let pins = cx.scene().object(rope_handle)?.pins();
    let place = pins.iter().position(|pin| pin.point == point);
    let force = place.and_then(|place| pin_forces.get(place).copied());
    Ok(force.unwrap_or_default())
}

/// Breaks a rope between two points.
///
/// @param ropeHandle the rope
/// @param edge index of the first of the two points, from 0
#[api("simSoft.breakEdge")]
fn break_edge(cx: &mut Cx, rope_handle: Handle, edge: i64) -> Result<()> {
    let mut form = cx.scene().rope_form(rope_handle)?;
    let edge = index(edge, form.broken.len())?;
    form.broken[edge] = true;
    put(cx, rope_handle, form)
}

/// Where a rope is broken.
///
/// @param ropeHandle the rope
/// @return edges index of the first of the two points, from 0, for each
#[api("simSoft.getBrokenEdges")]
fn get_broken_edges(cx: &Cx, rope_handle: Handle) -> Result<Vec<i64>> {
    let broken = cx.scene().rope_form(rope_handle)?.broken;
    let edges = (0..).zip(broken).filter(|(_, is_broken)| *is_broken);
    Ok(edges.map(|(edge, _)| edge).collect())
}

/// An index from 0 into so many.
fn index(index: i64, count: usize) -> Result<usize> {
    let place = usize::try_from(index).ok().filter(|place| *place < count);
    place.ok_or_else(|| ApiError::Other(format!("the rope has no point {index}.")))
}
