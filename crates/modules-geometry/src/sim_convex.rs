//! `simConvex`: hulls of objects and points, and convex pieces of shapes.
//!
//! There is one algorithm to divide shapes, V-HACD by parry; `hacd` uses it as well.

use api_macro::api;
use geometry::DecompositionParameters;
use geometry::Mesh;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use scene::shape::Shape;
use scene::{Data, Handle, Kind, SceneError};
use script::{Handles, Table};

/// The module `simConvex`.
pub static MODULE: Module = Module {
    about: "Convex hulls and convex decomposition of shapes.",
    functions: &[("Convex shapes", FUNCTIONS)],
    ..Module::new("simConvex")
};

const FUNCTIONS: &[ApiFn] = functions![hull, qhull, vhacd, hacd];

/// The convex hull of shapes, dummies, point clouds and octrees, as a new shape with the frame of the world.
///
/// @param objectHandles the objects
/// @param growth moves the faces outwards, metres
/// @return shapeHandle
#[api("simConvex.hull")]
fn hull(cx: &mut Cx, object_handles: Handles, #[default(0.0)] growth: f64) -> Result<Handle> {
    let mut points = Vec::new();
    for raw in object_handles.0 {
        let handle = Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?;
        points.extend(cx.scene().points_for_hull(handle)?);
    }
    if points.is_empty() {
        return Err(refused("empty input"));
    }
    let mut shape = Shape::from_mesh(grown(&points, growth)?, Shape::mesh_appearance())?;
    shape.parts.iter_mut().for_each(|part| part.convex = true);
    cx.add_object("shape", Kind::Shape(Box::new(shape)))
}

/// The convex hull of points.
///
/// @param points three coordinates each
/// @param growth moves the faces outwards, metres
/// @return vertices three coordinates each
/// @return indices three of each triangle, from 0
#[api("simConvex.qhull")]
fn qhull(_cx: &Cx, points: Vec<f64>, #[default(0.0)] growth: f64) -> Result<(Vec<f64>, Vec<i64>)> {
    if points.is_empty() {
        return Err(refused("empty input"));
    }
    let (points, rest) = points.as_chunks();
    if !rest.is_empty() {
        return Err(ApiError::TableSize);
    }
    let hull = grown(points, growth)?;
    Ok((hull.flat_vertices(), hull.flat_indices()))
}

/// Convex decomposition of a shape into new shapes; the original stays.
///
/// @param shapeHandle the shape
/// @param params resolution (100000: voxels in all, at most 16 million), concavity (0.1), plane_downsampling (4), hull_downsampling (4), alpha (0.05), beta (0.05); other fields have no effect
/// @return shapeHandles
#[api("simConvex.vhacd")]
fn vhacd(
    cx: &mut Cx,
    shape_handle: Handle,
    #[default(Table(Data::Nil))] params: Table,
) -> Result<Vec<Handle>> {
    divide(cx, shape_handle, fineness(&params.0)?)
}

/// Convex decomposition by the same algorithm as vhacd.
///
/// @param shapeHandle the shape
/// @param params without effect
/// @return shapeHandles
#[api("simConvex.hacd")]
fn hacd(
    cx: &mut Cx,
    shape_handle: Handle,
    #[default(Table(Data::Nil))] params: Table,
) -> Result<Vec<Handle>> {
    let _ = params;
    divide(cx, shape_handle, DecompositionParameters::default())
}

fn divide(cx: &mut Cx, original: Handle, fineness: DecompositionParameters) -> Result<Vec<Handle>> {
    let (shapes, pose) = cx.scene().convex_shapes(original, fineness)?;
    let mut handles = Vec::new();
    for shape in shapes {
        let handle = cx.add_object("convex", Kind::Shape(Box::new(shape)))?;
        cx.scene_mut().set_world_pose(handle, pose)?;
        handles.push(handle);
    }
    Ok(handles)
}

/// `resolution` counts voxels in all, `alpha` and `beta` prefer cuts along symmetries.
fn fineness(params: &Data) -> Result<DecompositionParameters> {
    let number = |name: &str, default: f64| match params.field(name) {
        None | Some(Data::Nil) => Ok(default),
        Some(value) => value
            .as_f64()
            .filter(|x| x.is_finite() && *x >= 0.0)
            .ok_or_else(|| invalid(name)),
    };
    Ok(DecompositionParameters {
        voxels: number("resolution", 1e5)?,
        concavity: number("concavity", 0.1)?,
        plane_downsampling: number("plane_downsampling", 4.0)? as u32,
        hull_downsampling: number("hull_downsampling", 4.0)? as u32,
        alpha: number("alpha", 0.05)?,
        beta: number("beta", 0.05)?,
    })
}

fn grown(points: &[[f64; 3]], growth: f64) -> Result<Mesh> {
    if !points
        .as_flattened()
        .iter()
        .chain([&growth])
        .all(|x| x.is_finite())
    {
        return Err(SceneError::InvalidData.into());
    }
    Mesh::grown_hull(points, growth).ok_or_else(|| refused("the points do not span a volume."))
}

fn invalid(field: &str) -> ApiError {
    refused(&format!("invalid '{field}' field."))
}

fn refused(why: &str) -> ApiError {
    SceneError::Refused(why.into()).into()
}
