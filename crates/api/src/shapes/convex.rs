//! `sim.*`: hulls, convex decomposition, shapes along paths.

use api_macro::api;
use geometry::Extrusion;
use geometry::pose::pose_from_array;
use geometry::{Mesh, MeshError};
use mesh_processing::Target;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::shape::Shape;
use scene::shape::decimate::decimated_mesh;
use scene::shape::options::{DecompositionOptions, PathShapeOptions};
use scene::{Handle, Kind, SceneError};
use script::{Number, Rest};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_q_hull,
    get_decimated_mesh,
    convex_decompose,
    generate_shape_from_path
];

/// Convex hull of points.
///
/// @param verticesIn three coordinates each, metres
/// @return verticesOut those of the points that are corners of the hull
/// @return indicesOut three vertices per triangle, from 0
#[api("sim.getQHull")]
fn get_q_hull(_cx: &Cx, vertices_in: Vec<f64>) -> Result<(Vec<f64>, Vec<i64>)> {
    if !vertices_in.iter().all(|c| c.is_finite()) {
        return Err(SceneError::InvalidData.into());
    }
    let hull = Mesh::convex_hull(vertices_in.as_chunks().0)
        .ok_or_else(|| refused("the points do not span a volume."))?;
    Ok((hull.flat_vertices(), hull.flat_indices()))
}

/// A mesh with fewer triangles.
///
/// @param verticesIn three coordinates each, metres
/// @param indicesIn three vertices per triangle, from 0
/// @param decimationPercentage how many of the triangles remain, from 0.1 to 0.9
/// @return verticesOut those that remain
/// @return indicesOut three vertices per triangle, from 0
#[api("sim.getDecimatedMesh")]
fn get_decimated_mesh(
    _cx: &Cx,
    vertices_in: Vec<f64>,
    indices_in: Vec<i64>,
    decimation_percentage: f64,
) -> Result<(Vec<f64>, Vec<i64>)> {
    if !(0.1..=0.9).contains(&decimation_percentage) {
        return Err(refused(
            "the share of triangles that remain lies between 0.1 and 0.9.",
        ));
    }
    let mesh = Mesh::from_flat(&vertices_in, &indices_in, None)
        .map_err(|error| refused(&error.to_string()))?;
    let triangles = (mesh.triangles.len() as f64 * decimation_percentage).ceil() as usize;
    let target = Target {
        triangles,
        ..Target::default()
    };
    let mesh = decimated_mesh(mesh, target).ok_or_else(|| refused("the mesh has no area."))?;
    Ok((mesh.flat_vertices(), mesh.flat_indices()))
}

/// Divides a shape into convex pieces, which are one compound.
///
/// @param shapeHandle the shape
/// @param options 1: the shape itself changes, else a new one is made
/// @param ... intParams and floatParams: not used
/// @return shapeHandle the compound, or a simple shape when it is of one piece
#[api("sim.convexDecompose")]
fn convex_decompose(
    cx: &mut Cx,
    shape_handle: Handle,
    options: Number,
    #[name("...")] parameters: Rest,
) -> Result<Handle> {
    let _ = parameters;
    let (shape, pose) = cx.scene().convex_decomposition(shape_handle)?;
    if DecompositionOptions::from_bits_retain(options.0).contains(DecompositionOptions::MORPH) {
        cx.scene_mut().morph_shape(shape_handle, shape)?;
        return Ok(shape_handle);
    }
    let handle = cx.add_object("convex", Kind::Shape(Box::new(shape)))?;
    cx.scene_mut().set_world_pose(handle, pose)?;
    Ok(handle)
}

/// A new shape: a section moved along a path. Its frame is the world's, its ends are open.
///
/// @param path poses of 7 numbers, two at least
/// @param section points x and y, two at least; closed when the last is the first
/// @param options 4: the path is closed: its last pose stands for the first
/// @param upVector y axis of the section points towards it, z along the path; zeros: the poses of the path define the orientation
/// @return shapeHandle the shape
#[api("sim.generateShapeFromPath")]
fn generate_shape_from_path(
    cx: &mut Cx,
    path: Vec<f64>,
    section: Vec<f64>,
    #[default(0)] options: Number,
    #[default([0.0, 0.0, 1.0])] up_vector: [f64; 3],
) -> Result<Handle> {
    if path.len() < 14 || section.len() < 4 {
        return Err(ApiError::TableSize);
    }
    if !path
        .iter()
        .chain(&section)
        .chain(&up_vector)
        .all(|x| x.is_finite())
    {
        return Err(SceneError::InvalidData.into());
    }
    let mut poses: Vec<_> = path.as_chunks().0.iter().map(pose_from_array).collect();
    let up = Some(up_vector).filter(|up| up.iter().any(|c| *c != 0.0));
    let closed = PathShapeOptions::from_bits_retain(options.0).contains(PathShapeOptions::CLOSED);
    if closed {
        // Closed paths end where they begin.
        poses.pop();
    }
    let extrusion = Extrusion { closed, up };
    let mesh = extrusion
        .mesh(&poses, section.as_chunks().0)
        .map_err(|error| match error {
            MeshError::Empty => refused("the path or the section has no extent."),
            other => refused(&other.to_string()),
        })?;
    let shape = Shape::from_mesh(mesh, Shape::mesh_appearance())?;
    cx.add_object("shape", Kind::Shape(Box::new(shape)))
}

fn refused(why: &str) -> ApiError {
    SceneError::Refused(why.into()).into()
}
