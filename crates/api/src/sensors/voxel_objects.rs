//! `sim.*`: inserting whole objects into octrees and point clouds.

use api_macro::api;

use super::voxels::{change_cloud, count};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::voxels::octree::{Voxel, cell_size};
use scene::voxels::point_cloud::CloudPoint;
use scene::{Field, Handle, Scene};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    insert_object_into_octree,
    subtract_object_from_octree,
    insert_object_into_cloud,
    subtract_object_from_cloud,
];

/// The colour passed by the script, or that of the octree or point cloud.
fn colour(scene: &Scene, handle: Handle, given: Option<&[f64]>) -> Result<[u8; 3]> {
    match given {
        None | Some([]) => Ok(scene
            .object(handle)?
            .colour
            .ambient_diffuse
            .map(|part| numbers::level((255.0 * part).into()))),
        Some(&[red, green, blue, ..]) => Ok([red, green, blue].map(numbers::level)),
        Some(_) => Err(ApiError::TableSize),
    }
}

/// Occupies the cells of an object: cells touched by triangles of a shape, overlapped by voxels, or containing points or a dummy.
///
/// @param octreeHandle the octree
/// @param objectHandle a shape, octree, point cloud or dummy
/// @param options not used
/// @param color red, green, blue, 0 to 255; nothing for the colour of the octree
/// @param tag a number for the voxels
/// @return totalVoxelCnt how many voxels there are now
#[api("sim.insertObjectIntoOctree")]
fn insert_object_into_octree(
    cx: &mut Cx,
    octree_handle: Handle,
    object_handle: Handle,
    options: Number,
    #[default(None)] color: Option<Vec<f64>>,
    #[default(0)] tag: Number,
) -> Result<i64> {
    let _ = options;
    let mut scene = cx.scene_mut();
    let edge = scene.object(octree_handle)?.octree()?.voxel_size();
    let voxel = Voxel {
        colour: colour(&scene, octree_handle, color.as_deref())?,
        tag: numbers::low_u32(tag.0),
    };
    let cells = scene.cells_of(object_handle, octree_handle, edge)?;
    Ok(scene.try_modify(octree_handle, Field::Geometry, |object| {
        let tree = object.octree_mut()?;
        cells.into_iter().for_each(|cell| tree.insert(cell, voxel));
        Ok(count(tree.len()))
    })?)
}

/// Empties the cells that `sim.insertObjectIntoOctree` would occupy.
///
/// @param octreeHandle the octree
/// @param objectHandle a shape, octree, point cloud or dummy
/// @param options not used
/// @return totalVoxelCnt how many voxels are left
#[api("sim.subtractObjectFromOctree")]
fn subtract_object_from_octree(
    cx: &mut Cx,
    octree_handle: Handle,
    object_handle: Handle,
    options: Number,
) -> Result<i64> {
    let _ = options;
    let mut scene = cx.scene_mut();
    let edge = scene.object(octree_handle)?.octree()?.voxel_size();
    let cells = scene.cells_of(object_handle, octree_handle, edge)?;
    Ok(scene.try_modify(octree_handle, Field::Geometry, |object| {
        let tree = object.octree_mut()?;
        cells.into_iter().for_each(|cell| tree.remove(cell));
        Ok(count(tree.len()))
    })?)
}

/// Adds points of an object: the centres of the cells of a grid that the triangles of a shape touch, of voxels, points, or where a dummy is.
///
/// @param pointCloudHandle the point cloud
/// @param objectHandle a shape, octree, point cloud or dummy
/// @param options not used
/// @param gridSize edge of the cells for shapes, 0.001 to 1 m
/// @param color red, green, blue, 0 to 255; nothing for the colour of the point cloud
/// @param duplicateTolerance points this near to another are left out, metres
/// @return totalPointCnt how many points there are now
#[api("sim.insertObjectIntoPointCloud")]
fn insert_object_into_cloud(
    cx: &mut Cx,
    point_cloud_handle: Handle,
    object_handle: Handle,
    options: Number,
    grid_size: f64,
    #[default(None)] color: Option<Vec<f64>>,
    #[default(None)] duplicate_tolerance: Option<f64>,
) -> Result<i64> {
    let _ = options;
    let mut scene = cx.scene_mut();
    scene.object(point_cloud_handle)?.point_cloud()?;
    let colour = colour(&scene, point_cloud_handle, color.as_deref())?;
    let points = scene.points_of(object_handle, point_cloud_handle, cell_size(grid_size))?;
    let points = points
        .into_iter()
        .map(|position| CloudPoint { position, colour });
    change_cloud(&mut scene, point_cloud_handle, |cloud| {
        cloud.insert(points, duplicate_tolerance.unwrap_or(0.0));
    })
}

/// Removes the points that lie near an object: near the triangles of a shape, near voxels, points or a dummy.
///
/// @param pointCloudHandle the point cloud
/// @param objectHandle a shape, octree, point cloud or dummy
/// @param options not used
/// @param tolerance how near, metres
/// @return totalPointCnt how many points are left
#[api("sim.subtractObjectFromPointCloud")]
fn subtract_object_from_cloud(
    cx: &mut Cx,
    point_cloud_handle: Handle,
    object_handle: Handle,
    options: Number,
    tolerance: f64,
) -> Result<i64> {
    let _ = options;
    let mut scene = cx.scene_mut();
    let rest = scene.cloud_without(point_cloud_handle, object_handle, tolerance)?;
    change_cloud(&mut scene, point_cloud_handle, |cloud| *cloud = rest)
}
