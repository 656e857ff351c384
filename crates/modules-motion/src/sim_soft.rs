//! `simSoft`: ropes, cables, cloths and soft volumes, where they are held, and what they bear.

mod body_options;
mod grids;
mod options;
mod rope_options;

use api_macro::api;
use geometry::{Mesh, Pose};
use nalgebra::Point3;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use body_options::Described;
use rope_options::{Kind, described};
use scene::shape::soft::body::Body;
use scene::shape::soft::{Pin, Soft, SoftForm};
use scene::shape::{Appearance, Material, Shape};
use scene::{Data, Field, Handle, SceneError};
use script::Table;

/// The module `simSoft`.
pub static MODULE: Module = Module {
    about: "Ropes, cables, cloths and soft volumes that hang, bend, stretch, touch things and break, pinned to objects.",
    functions: &[("Soft things", FUNCTIONS)],
    ..Module::new("simSoft")
};

const FUNCTIONS: &[ApiFn] = functions![
    create_rope,
    create_cable,
    create_cloth,
    create_volume,
    pin,
    unpin,
    get_points,
    get_triangles,
    get_volume,
    get_pressure,
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
    add(
        cx,
        kind.alias(),
        &Soft::Rope(made.rope),
        [made.mass, made.friction],
        made.colour,
    )
}

fn add(
    cx: &mut Cx,
    alias: &str,
    soft: &Soft,
    [mass, friction]: [f64; 2],
    colour: [f32; 3],
) -> Result<Handle> {
    let mut shape = Shape::of_soft(soft, Appearance::new(colour))?;
    shape.material = Material::of_friction(friction);
    shape.mass.mass = mass;
    let handle = cx.add_object(alias, scene::Kind::Shape(Box::new(shape)))?;
    cx.scene_mut().set_soft(handle, soft)?;
    Ok(handle)
}

/// A cloth or membrane: a shape that the physics stretches, shears and bends; closed ones may hold gas.
///
/// Options: `size` (x, y, metres) and `count` (cells along both, {10, 10}): a flat rectangle; or `vertices` (three coordinates each) and `triangles` (three indices
/// each, from 0); or `shape`: the mesh of that shape, where it is. `pose` (7 numbers, world) of the frame of `size` or `vertices`; `thickness` (0.001 m); `density` (300 kg/m3),
/// `areaDensity` (kg/m2) or `mass` (kg, of all); `young` (1e6 Pa), `poisson` (0.3), or `stretchStiffness` (N/m) and `bendStiffness` (N m); `damping` (0.01 s), `drag` (0.3 per second), `friction`
/// (0.7), `strength` (N/m at which a triangle tears; it does not), `flat` (at rest; true for `size`, else as the vertices say), `pressure` (Pa above the air outside, in the volume that it begins with: a closed cloth holds
/// gas), `selfContact` (false), `color` (red, green, blue).
///
/// @param options a table
/// @return clothHandle the shape
#[api("simSoft.createCloth")]
fn create_cloth(cx: &mut Cx, options: Table) -> Result<Handle> {
    let made = body_options::cloth(cx, &options.0)?;
    create_body(cx, "cloth", made)
}

/// A soft volume of tetrahedra, such as rubber, foam or fruit.
///
/// Options: `size` (x, y, z, metres) and `count` (cells along each, {4, 4, 4}): a box; or `shape`: the closed mesh of that shape is filled with cells of at most `cell` metres (an eighth of
/// its longest side); or `vertices` (three coordinates each) and `tetrahedra` (four indices each, from 0, in positive order). `pose` as in createCloth; `density` (1000 kg/m3) or `mass` (kg, of all); `young` (1e5
/// Pa), `poisson` (0.4); `thickness` (0.002 m: it touches things at half of that); `damping` (0.005 s), `drag` (0.1 per second), `friction` (0.7), `selfContact` (false), `color`.
///
/// @param options a table
/// @return volumeHandle the shape
#[api("simSoft.createVolume")]
fn create_volume(cx: &mut Cx, options: Table) -> Result<Handle> {
    let made = body_options::volume(cx, &options.0)?;
    create_body(cx, "volume", made)
}

fn create_body(cx: &mut Cx, alias: &str, made: Described) -> Result<Handle> {
    let soft = Soft::Body(made.body);
    let handle = add(cx, alias, &soft, [made.mass, made.friction], made.colour)?;
    cx.scene_mut().set_world_pose(handle, made.pose)?;
    Ok(handle)
}

/// Holds a point of a rope, cloth or volume where it is on an object: it goes along with it, and pulls at it.
///
/// Options: `position` (world): the point is held there instead of where it is; `clamp` (false; of ropes): the edge that begins at the point (at the last point: ends) keeps its
/// direction in the object and does not turn about its axis.
///
/// @param handle the rope, cloth or volume
/// @param point its index, from 0
/// @param objectHandle what holds it; -1: the world
/// @param options a table
#[api("simSoft.pin")]
fn pin(
    cx: &mut Cx,
    handle: Handle,
    point: i64,
    #[default(-1)] object_handle: i64,
    #[default(Table(Data::Nil))] options: Table,
) -> Result<()> {
    let options = options.0;
    options::check_names(&options, &["position", "clamp"])?;
    let form = cx.scene().soft_form(handle)?;
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
    if held.clamped && body(cx, handle).is_ok() {
        return Err(ApiError::Other(
            "only ropes and cables are clamped; a cloth or volume is pinned at several points."
                .into(),
        ));
    }
    let mut pins = cx.scene().object(handle)?.pins();
    pins.retain(|pin| pin.point != point);
    pins.push(held);
    Ok(cx.scene_mut().set_pins(handle, &pins)?)
}

fn holder(cx: &Cx, raw: i64) -> Result<(Option<Handle>, Pose)> {
    if raw == -1 {
        return Ok((None, Pose::identity()));
    }
    let handle = Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?;
    Ok((Some(handle), cx.scene().world_pose(handle)?))
}

/// Lets a point of a rope, cloth or volume go.
///
/// @param handle the rope, cloth or volume
/// @param point its index, from 0; -1: all that are held
#[api("simSoft.unpin")]
fn unpin(cx: &mut Cx, handle: Handle, #[default(-1)] point: i64) -> Result<()> {
    cx.scene().soft_form(handle)?;
    let mut pins = cx.scene().object(handle)?.pins();
    pins.retain(|pin| point >= 0 && pin.point as i64 != point);
    Ok(cx.scene_mut().set_pins(handle, &pins)?)
}

/// Where the points of a rope, cloth or volume are.
///
/// @param handle the rope, cloth or volume
/// @return points three coordinates each, world
#[api("simSoft.getPoints")]
fn get_points(cx: &Cx, handle: Handle) -> Result<Vec<f64>> {
    let form = cx.scene().soft_form(handle)?;
    Ok(form.points.into_flattened())
}

/// The triangles of a cloth, or of the surface of a volume, without those that are torn.
///
/// @param handle the cloth or volume
/// @return triangles three indices of points each, from 0
#[api("simSoft.getTriangles")]
fn get_triangles(cx: &Cx, handle: Handle) -> Result<Vec<i64>> {
    let broken = cx.scene().soft_form(handle)?.broken;
    let body = body(cx, handle)?;
    let is_whole = |(number, _): &(usize, [u32; 3])| !broken.get(*number).copied().unwrap_or(false);
    let whole = body.triangles.into_iter().enumerate().filter(is_whole);
    Ok(whole
        .flat_map(|(_, triangle)| triangle.map(i64::from))
        .collect())
}

/// The volume within a closed cloth, or of a soft volume.
///
/// @param handle the cloth or volume
/// @return volume m3; without a meaning where a cloth is open
#[api("simSoft.getVolume")]
fn get_volume(cx: &Cx, handle: Handle) -> Result<f64> {
    let mesh = Mesh {
        vertices: cx.scene().soft_form(handle)?.points,
        triangles: body(cx, handle)?.triangles,
        ..Mesh::default()
    };
    Ok(mesh.volume())
}

/// The pressure of the gas in a closed cloth.
///
/// @param handle the cloth
/// @return pressure Pa, above that of the air outside; 0 without gas or where it is torn
#[api("simSoft.getPressure")]
fn get_pressure(cx: &Cx, handle: Handle) -> Result<f64> {
    Ok(cx.scene().soft_form(handle)?.pressure)
}

fn body(cx: &Cx, handle: Handle) -> Result<Body> {
    match cx.scene().object(handle)?.soft() {
        Some(Soft::Body(body)) => Ok(body),
        _ => Err(ApiError::Other("the shape is no cloth or volume.".into())),
    }
}

/// Puts the points of a rope, cloth or volume elsewhere, at rest. What was stretched by that is pulled together again.
///
/// @param handle the rope, cloth or volume
/// @param points three coordinates each, world; as many as there are
#[api("simSoft.setPoints")]
fn set_points(cx: &mut Cx, handle: Handle, points: Vec<f64>) -> Result<()> {
    let mut form = cx.scene().soft_form(handle)?;
    let (points, rest) = points.as_chunks::<3>();
    if !rest.is_empty() || points.len() != form.points.len() {
        return Err(ApiError::TableSize);
    }
    let known = cx.scene().object(handle)?.soft();
    if !known.is_some_and(|soft| soft.can_be_at(points)) {
        return Err(SceneError::InvalidArgument.into());
    }
    form.points = points.to_vec();
    put(cx, handle, form)
}

/// Lets the physics take over a form.
fn put(cx: &mut Cx, rope: Handle, form: SoftForm) -> Result<()> {
    let mut scene = cx.scene_mut();
    let soft = scene.object(rope)?.soft().ok_or(SceneError::InvalidData)?;
    scene.report_soft_form(rope, &soft, Some(form))?;
    Ok(scene.modify(rope, Field::Dynamics, |object| object.dynamics_reset = true)?)
}

/// Tensions of the edges between the points of a rope, or largest ones of the triangles of a cloth, in the last sub-step.
///
/// @param handle the rope, cloth or volume
/// @return tensions newtons, or newtons per metre; negative where it is pressed; none for a volume
#[api("simSoft.getTensions")]
fn get_tensions(cx: &Cx, handle: Handle) -> Result<Vec<f64>> {
    Ok(cx.scene().soft_form(handle)?.tensions)
}

/// The force by which a rope, cloth or volume is held at a point, in the last sub-step.
///
/// @param handle the rope, cloth or volume
/// @param point its index, from 0
/// @return force on it, newtons, world axes; 0 where nothing holds it
#[api("simSoft.getPinForce")]
fn get_pin_force(cx: &Cx, handle: Handle, point: i64) -> Result<[f64; 3]> {
    let SoftForm {
        points, pin_forces, ..
    } = cx.scene().soft_form(handle)?;
    let point = index(point, points.len())?;
    let pins = cx.scene().object(handle)?.pins();
    let place = pins.iter().position(|pin| pin.point == point);
    let force = place.and_then(|place| pin_forces.get(place).copied());
    Ok(force.unwrap_or_default())
}

/// Breaks a rope between two points, or tears a triangle of a cloth.
///
/// @param handle the rope, cloth or volume
/// @param edge index of the first of the two points, or of the triangle as it was made, from 0
#[api("simSoft.breakEdge")]
fn break_edge(cx: &mut Cx, handle: Handle, edge: i64) -> Result<()> {
    let mut form = cx.scene().soft_form(handle)?;
    let edge = breakable(edge, form.broken.len())?;
    form.broken[edge] = true;
    put(cx, handle, form)
}

/// Where a rope is broken or a cloth torn.
///
/// @param handle the rope, cloth or volume
/// @return edges index of the first of the two points, or of the triangle, from 0, for each
#[api("simSoft.getBrokenEdges")]
fn get_broken_edges(cx: &Cx, handle: Handle) -> Result<Vec<i64>> {
    let broken = cx.scene().soft_form(handle)?.broken;
    let edges = (0..).zip(broken).filter(|(_, is_broken)| *is_broken);
    Ok(edges.map(|(edge, _)| edge).collect())
}

/// The index of a point, from 0.
fn index(index: i64, count: usize) -> Result<usize> {
    let place = usize::try_from(index).ok().filter(|place| *place < count);
    place.ok_or_else(|| ApiError::Other(format!("the shape has no point {index}.")))
}

fn breakable(index: i64, count: usize) -> Result<usize> {
    let place = usize::try_from(index).ok().filter(|place| *place < count);
    place.ok_or_else(|| ApiError::Other(format!("the shape has no edge or triangle {index}.")))
}
