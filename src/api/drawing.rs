//! `sim.*`: drawing objects, curves of graphs, floating views, particles: what only a display shows, or is not simulated.
//!
//! There is no display. Handles are given out and checked, so that scripts find their mistakes; what would be drawn is dropped.

use std::cell::RefCell;
use std::rc::Rc;

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Result, functions};
use crate::scene::{Data, Handle, SceneError, special};
use crate::script::{ByHandle, Number, Rest};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    add_drawing_object,
    add_drawing_object_item,
    remove_drawing_object,
    add_graph_stream,
    set_graph_stream_value,
    set_graph_stream_transformation,
    add_graph_curve,
    destroy_graph_curve,
    handle_graph,
    reset_graph,
    floating_view_add,
    floating_view_remove,
    adjust_view,
    add_particle_object,
    add_particle_object_item,
    remove_particle_object,
];

/// Bits above the handle of a drawing object: several items at once.
const HANDLE_BITS: i64 = 0x000f_ffff;

/// Something to draw points, lines or triangles with. Nothing is drawn here.
///
/// @param objectType sim.drawing_*
/// @param size of points and lines
/// @param duplicateTolerance items closer than this are one
/// @param parentObjectHandle -1 for the world
/// @param maxItemCount more are refused or replace old ones, as the type says
/// @return drawingObjectHandle its handle
#[api("sim.addDrawingObject")]
fn add_drawing_object(
    cx: &mut Cx,
    object_type: Number,
    size: f64,
    duplicate_tolerance: f64,
    parent_object_handle: Number,
    max_item_count: Number,
    colour: Rest,
) -> Result<i64> {
    let _ = (object_type, size, duplicate_tolerance, max_item_count, colour);
    if parent_object_handle.0 >= 0 {
        object(cx, parent_object_handle)?;
    }
    Ok(drawings(cx).borrow_mut().add(Drawing))
}

/// Adds items to a drawing object.
///
/// @param drawingObjectHandle from sim.addDrawingObject
/// @param itemData coordinates and more, as the type says; nil takes all items out
/// @return result 1
#[api("sim.addDrawingObjectItem")]
fn add_drawing_object_item(
    cx: &mut Cx,
    drawing_object_handle: Number,
    #[default(Data::Nil)] item_data: Data,
) -> Result<i64> {
    let handle = drawing_object_handle.0 & HANDLE_BITS;
    drawings(cx).borrow_mut().get_mut(handle).ok_or_else(no_drawing)?;
    match item_data {
        Data::Nil | Data::Array(_) => Ok(1),
        _ => Err(ApiError::ArgumentType),
    }
}

/// Removes a drawing object.
///
/// @param drawingObjectHandle from sim.addDrawingObject, or sim.handle_all
#[api("sim.removeDrawingObject")]
fn remove_drawing_object(cx: &mut Cx, drawing_object_handle: Number) -> Result<()> {
    let drawings = drawings(cx);
    if drawing_object_handle.0 == special::ALL {
        drawings.borrow_mut().clear();
        return Ok(());
    }
    drawings.borrow_mut().remove(drawing_object_handle.0).map(drop).ok_or_else(no_drawing)
}

/// Adds a stream of values to a graph. They are not kept here.
///
/// @param graphHandle the graph
/// @param streamName its name
/// @param unit its unit
/// @return streamId its number
#[api("sim.addGraphStream")]
fn add_graph_stream(
    cx: &mut Cx,
    graph_handle: Number,
    stream_name: String,
    unit: String,
    options: Rest,
) -> Result<i64> {
    let _ = (stream_name, unit, options);
    graph(cx, graph_handle)?;
    Ok(streams(cx).borrow_mut().add(Stream))
}

/// The value a stream records next.
///
/// @param graphHandle the graph
/// @param streamId from sim.addGraphStream
/// @param value number
#[api("sim.setGraphStreamValue")]
fn set_graph_stream_value(cx: &mut Cx, graph_handle: Number, stream_id: Number, value: f64) -> Result<()> {
    let _ = value;
    stream(cx, graph_handle, stream_id)
}

/// What a stream does to its values before it records them.
///
/// @param graphHandle the graph
/// @param streamId from sim.addGraphStream
/// @param trType sim.stream_transf_*
#[api("sim.setGraphStreamTransformation")]
fn set_graph_stream_transformation(
    cx: &mut Cx,
    graph_handle: Number,
    stream_id: Number,
    tr_type: Number,
    numbers: Rest,
) -> Result<()> {
    let _ = (tr_type, numbers);
    stream(cx, graph_handle, stream_id)
}

/// Draws streams over each other.
///
/// @param graphHandle the graph
/// @param curveName its name
/// @param dim 2 or 3
/// @return curveId its number
#[api("sim.addGraphCurve")]
fn add_graph_curve(cx: &mut Cx, graph_handle: Number, curve_name: String, dim: Number, streams_: Rest) -> Result<i64> {
    let _ = (curve_name, dim, streams_);
    graph(cx, graph_handle)?;
    Ok(streams(cx).borrow_mut().add(Stream))
}

/// Removes a curve.
///
/// @param graphHandle the graph
/// @param curveId from sim.addGraphCurve
#[api("sim.destroyGraphCurve")]
fn destroy_graph_curve(cx: &mut Cx, graph_handle: Number, curve_id: Number) -> Result<()> {
    graph(cx, graph_handle)?;
    streams(cx).borrow_mut().remove(curve_id.0).map(drop).ok_or_else(no_stream)
}

/// Records the values of the streams.
///
/// @param graphHandle the graph, sim.handle_all or sim.handle_all_except_explicit
/// @param time of the values
#[api("sim.handleGraph")]
fn handle_graph(cx: &Cx, graph_handle: Number, time: f64) -> Result<()> {
    let _ = time;
    graph_or_all(cx, graph_handle)
}

/// Forgets what was recorded.
///
/// @param graphHandle the graph, sim.handle_all or sim.handle_all_except_explicit
#[api("sim.resetGraph")]
fn reset_graph(cx: &Cx, graph_handle: Number) -> Result<()> {
    graph_or_all(cx, graph_handle)
}

/// Adds a view to the page.
///
/// @param posX of its centre, 0 to 1
/// @param posY of its centre
/// @param sizeX part of the window
/// @param sizeY part of the window
/// @param options bits
/// @return floatingViewHandle its handle
#[api("sim.floatingViewAdd")]
fn floating_view_add(cx: &mut Cx, pos_x: f64, pos_y: f64, size_x: f64, size_y: f64, options: Number) -> Result<i64> {
    let _ = (pos_x, pos_y, size_x, size_y, options);
    Ok(views(cx).borrow_mut().add(View))
}

/// Removes a view.
///
/// @param floatingViewHandle from sim.floatingViewAdd
/// @return result 1, or 0 when there is no such view
#[api("sim.floatingViewRemove")]
fn floating_view_remove(cx: &mut Cx, floating_view_handle: Number) -> Result<i64> {
    Ok(views(cx).borrow_mut().remove(floating_view_handle.0).is_some().into())
}

/// Shows an object in a view.
///
/// @param viewHandleOrIndex from sim.floatingViewAdd, or the number of a view of the page
/// @param objectHandle a camera, vision sensor or graph, or -1
/// @param options bits
/// @return res 1
#[api("sim.adjustView")]
fn adjust_view(
    cx: &Cx,
    view_handle_or_index: Number,
    object_handle: Number,
    options: Number,
    label: Rest,
) -> Result<i64> {
    let _ = (view_handle_or_index, options, label);
    if object_handle.0 >= 0 {
        object(cx, object_handle)?;
    }
    Ok(1)
}

/// A source of particles. They are not simulated; a warning says so.
///
/// @param objectType sim.particle_*
/// @param size of a particle
/// @param density of a particle
/// @param params of the physics
/// @param lifeTime in seconds
/// @param maxItemCount more replace old ones
/// @return particleObjectHandle its handle
#[api("sim.addParticleObject")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn add_particle_object(
    cx: &mut Cx,
    object_type: Number,
    size: f64,
    density: f64,
    params: Data,
    life_time: f64,
    max_item_count: Number,
    colour: Rest,
) -> Result<i64> {
    let _ = (object_type, size, density, params, life_time, max_item_count, colour);
    cx.env().warn_once("sim.addParticleObject", "particles are not simulated.");
    Ok(particles(cx).borrow_mut().add(Particles))
}

/// Adds a particle. It is not simulated.
///
/// @param particleObjectHandle from sim.addParticleObject
/// @param itemData position and target position; nil removes all
/// @return result 1
#[api("sim.addParticleObjectItem")]
fn add_particle_object_item(
    cx: &mut Cx,
    particle_object_handle: Number,
    #[default(Data::Nil)] item_data: Data,
) -> Result<i64> {
    let _ = item_data;
    particles(cx).borrow_mut().get_mut(particle_object_handle.0).map(|_| 1).ok_or_else(no_particles)
}

/// Removes a source of particles.
///
/// @param particleObjectHandle from sim.addParticleObject, or sim.handle_all
#[api("sim.removeParticleObject")]
fn remove_particle_object(cx: &mut Cx, particle_object_handle: Number) -> Result<()> {
    let particles = particles(cx);
    if particle_object_handle.0 == special::ALL {
        particles.borrow_mut().clear();
        return Ok(());
    }
    particles.borrow_mut().remove(particle_object_handle.0).map(drop).ok_or_else(no_particles)
}

/// A source of particles.
struct Particles;
/// A drawing object.
struct Drawing;
/// A stream of a graph, or a curve.
struct Stream;
/// A floating view.
struct View;

fn drawings(cx: &Cx) -> Rc<RefCell<ByHandle<Drawing>>> {
    cx.library_data()
}

fn particles(cx: &Cx) -> Rc<RefCell<ByHandle<Particles>>> {
    cx.library_data()
}

fn streams(cx: &Cx) -> Rc<RefCell<ByHandle<Stream>>> {
    cx.library_data()
}

fn views(cx: &Cx) -> Rc<RefCell<ByHandle<View>>> {
    cx.library_data()
}

fn stream(cx: &Cx, graph_handle: Number, stream_id: Number) -> Result<()> {
    graph(cx, graph_handle)?;
    streams(cx).borrow_mut().get_mut(stream_id.0).map(drop).ok_or_else(no_stream)
}

fn object(cx: &Cx, handle: Number) -> Result<Handle> {
    let scene = cx.scene();
    let handle = Handle::from_raw(handle.0).ok_or(SceneError::NoSuchObject)?;
    Ok(scene.object(handle)?.handle())
}

fn graph(cx: &Cx, handle: Number) -> Result<()> {
    let handle = object(cx, handle)?;
    Ok(cx.scene().object(handle)?.graph().map(drop)?)
}

fn graph_or_all(cx: &Cx, handle: Number) -> Result<()> {
    if [special::ALL, special::ALL_EXCEPT_EXPLICIT].contains(&handle.0) { Ok(()) } else { graph(cx, handle) }
}

fn no_drawing() -> ApiError {
    ApiError::Other("drawing object does not exist.".into())
}

fn no_particles() -> ApiError {
    ApiError::Other("particle object does not exist.".into())
}

fn no_stream() -> ApiError {
    ApiError::Other("invalid graph data stream.".into())
}
