//! `sim.*`: content of octrees and point clouds.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::voxels::octree::Voxel;
use scene::voxels::options::{PointOptions, StorageOptions};
use scene::voxels::point_cloud::{CloudPoint, PointCloud};
use scene::{Data, Field, Handle, Pose, Scene};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    insert_voxels,
    remove_voxels,
    octree_voxels,
    check_occupancy,
    insert_points,
    remove_points,
    intersect_points,
    cloud_points,
    cloud_options,
    set_cloud_options,
];

/// Distance below which points are duplicates, metres.
const DUPLICATE_TOLERANCE: f64 = 0.0;

type Point = [f64; 3];

fn point_options(bits: Number) -> PointOptions {
    PointOptions::from_bits_retain(bits.0)
}

/// Points in the frame of an object.
fn points_in(scene: &Scene, handle: Handle, options: Number, points: &[f64]) -> Result<Vec<Point>> {
    if points.len() < 3 {
        return Err(ApiError::TableSize);
    }
    let frame = if point_options(options).contains(PointOptions::RELATIVE) {
        Pose::identity()
    } else {
        scene.world_pose(handle)?.inverse()
    };
    let local = |point: &Point| (frame * nalgebra::Point3::from(*point)).into();
    Ok(points.as_chunks().0.iter().map(local).collect())
}

/// A colour for each of `count` points: one for all, one for each, or that of the object.
fn colours(
    scene: &Scene,
    handle: Handle,
    options: Number,
    given: Option<&[f64]>,
    count: usize,
) -> Result<Vec<[u8; 3]>> {
    let Some(given) = given.filter(|given| !given.is_empty()) else {
        let own = scene
            .object(handle)?
            .colour
            .ambient_diffuse
            .map(|part| numbers::level((255.0 * part).into()));
        return Ok(vec![own; count]);
    };
    let colours: Vec<[u8; 3]> = given
        .as_chunks()
        .0
        .iter()
        .map(|c: &Point| c.map(numbers::level))
        .collect();
    let each = point_options(options).contains(PointOptions::EACH);
    match colours.as_slice() {
        all if each && all.len() >= count => Ok(colours),
        [one, ..] if !each => Ok(vec![*one; count]),
        _ => Err(ApiError::TableSize),
    }
}

pub(crate) fn count(len: usize) -> i64 {
    i64::try_from(len).unwrap_or(i64::MAX)
}

/// Occupies the cells that points are in.
///
/// @param octreeHandle the octree
/// @param options 1: points are relative to the octree, 2: color and tag hold one for each point
/// @param points x, y, z of each
/// @param color red, green, blue, 0 to 255; nothing for the colour of the octree
/// @param tag a number for the voxels; only with a color
/// @return totalVoxelCnt how many voxels there are now
#[api("sim.insertVoxelsIntoOctree")]
fn insert_voxels(
    cx: &mut Cx,
    octree_handle: Handle,
    options: Number,
    points: Vec<f64>,
    #[default(None)] color: Option<Vec<f64>>,
    #[default(None)] tag: Option<Data>,
) -> Result<i64> {
    let mut scene = cx.scene_mut();
    scene.object(octree_handle)?.octree()?;
    let points = points_in(&scene, octree_handle, options, &points)?;
    let colours = colours(
        &scene,
        octree_handle,
        options,
        color.as_deref(),
        points.len(),
    )?;
    let tags = tags(tag.filter(|_| color.is_some()), points.len())?;
    Ok(scene.try_modify(octree_handle, Field::Geometry, |object| {
        let tree = object.octree_mut()?;
        for ((point, colour), tag) in points.into_iter().zip(colours).zip(tags) {
            tree.insert(point, Voxel { colour, tag });
        }
        Ok(count(tree.len()))
    })?)
}

/// A number for all voxels, or a table with one for each.
fn tags(given: Option<Data>, count: usize) -> Result<Vec<u32>> {
    let number = |value: &Data| value.as_f64().map(numbers::truncated_u32);
    match given {
        None | Some(Data::Nil) => Ok(vec![0; count]),
        Some(Data::Array(items)) if items.len() == 1 => {
            Ok(vec![number(&items[0]).unwrap_or(0); count])
        }
        Some(Data::Array(items)) if items.len() >= count => {
            Ok(items.iter().filter_map(number).collect())
        }
        Some(Data::Array(_)) => Err(ApiError::TableSize),
        Some(value) => Ok(vec![number(&value).unwrap_or(0); count]),
    }
}

/// Empties the cells that points are in.
///
/// @param octreeHandle the octree
/// @param options 1: points are relative to the octree
/// @param points x, y, z of each; nothing for all voxels
/// @return totalVoxelCnt how many voxels are left
#[api("sim.removeVoxelsFromOctree")]
fn remove_voxels(
    cx: &mut Cx,
    octree_handle: Handle,
    options: Number,
    #[default(None)] points: Option<Vec<f64>>,
) -> Result<i64> {
    let mut scene = cx.scene_mut();
    let points = points
        .map(|points| points_in(&scene, octree_handle, options, &points))
        .transpose()?;
    Ok(scene.try_modify(octree_handle, Field::Geometry, |object| {
        let tree = object.octree_mut()?;
        match points {
            Some(points) => points.into_iter().for_each(|point| tree.remove(point)),
            None => tree.clear(),
        }
        Ok(count(tree.len()))
    })?)
}

/// The centres of the voxels, in the frame of the octree.
///
/// @param octreeHandle the octree
/// @return voxels x, y, z of each
#[api("sim.getOctreeVoxels")]
fn octree_voxels(cx: &Cx, octree_handle: Handle) -> Result<Vec<f64>> {
    Ok(cx
        .scene()
        .object(octree_handle)?
        .octree()?
        .voxels()
        .flat_map(|(centre, _)| centre)
        .collect())
}

/// Whether points are in voxels.
///
/// @param octreeHandle the octree
/// @param options 1: points are relative to the octree
/// @param points x, y, z of each
/// @return result 1 when all are
/// @return tag the number of the voxel, for a single point
/// @return locationLow 0
/// @return locationHigh 0
#[api("sim.checkOctreePointOccupancy")]
fn check_occupancy(
    cx: &Cx,
    octree_handle: Handle,
    options: Number,
    points: Vec<f64>,
) -> Result<(i64, i64, i64, i64)> {
    let scene = cx.scene();
    let tree = scene.object(octree_handle)?.octree()?;
    let points = points_in(&scene, octree_handle, options, &points)?;
    let found: Vec<Option<&Voxel>> = points
        .into_iter()
        .map(|point| tree.voxel_at(point))
        .collect();
    let tag = match found.as_slice() {
        [Some(voxel)] => voxel.tag.into(),
        _ => 0,
    };
    Ok((found.iter().all(Option::is_some).into(), tag, 0, 0))
}

/// Adds points.
///
/// @param pointCloudHandle the point cloud
/// @param options 1: points are relative to the point cloud, 2: color holds one for each point
/// @param points x, y, z of each
/// @param color red, green, blue, 0 to 255; nothing for the colour of the point cloud
/// @param duplicateTolerance points this near to another are left out, metres
/// @return totalPointCnt how many points there are now
#[api("sim.insertPointsIntoPointCloud")]
fn insert_points(
    cx: &mut Cx,
    point_cloud_handle: Handle,
    options: Number,
    points: Vec<f64>,
    #[default(None)] color: Option<Vec<f64>>,
    #[default(None)] duplicate_tolerance: Option<f64>,
) -> Result<i64> {
    let mut scene = cx.scene_mut();
    scene.object(point_cloud_handle)?.point_cloud()?;
    let points = points_in(&scene, point_cloud_handle, options, &points)?;
    let colours = colours(
        &scene,
        point_cloud_handle,
        options,
        color.as_deref(),
        points.len(),
    )?;
    let points = points
        .into_iter()
        .zip(colours)
        .map(|(position, colour)| CloudPoint { position, colour });
    change_cloud(&mut scene, point_cloud_handle, |cloud| {
        cloud.insert(points, duplicate_tolerance.unwrap_or(DUPLICATE_TOLERANCE));
    })
}

pub(crate) fn change_cloud(
    scene: &mut Scene,
    handle: Handle,
    change: impl FnOnce(&mut PointCloud),
) -> Result<i64> {
    Ok(scene.try_modify(handle, Field::Geometry, |object| {
        let cloud = object.point_cloud_mut()?;
        change(cloud);
        Ok(count(cloud.points.len()))
    })?)
}

/// Removes the points that lie near others.
///
/// @param pointCloudHandle the point cloud
/// @param options 1: points are relative to the point cloud
/// @param points x, y, z of each; nothing for all points
/// @param tolerance how near, metres
/// @return totalPointCnt how many points are left
#[api("sim.removePointsFromPointCloud")]
fn remove_points(
    cx: &mut Cx,
    point_cloud_handle: Handle,
    options: Number,
    #[default(None)] points: Option<Vec<f64>>,
    #[default(0.0)] tolerance: f64,
) -> Result<i64> {
    let mut scene = cx.scene_mut();
    let points = points
        .map(|points| points_in(&scene, point_cloud_handle, options, &points))
        .transpose()?;
    change_cloud(&mut scene, point_cloud_handle, |cloud| match points {
        Some(points) => cloud.remove(&points, tolerance),
        None => cloud.points.clear(),
    })
}

/// Keeps only the points that lie near others.
///
/// @param pointCloudHandle the point cloud
/// @param options 1: points are relative to the point cloud
/// @param points x, y, z of each
/// @param tolerance how near, metres
/// @return totalPointCnt how many points are left
#[api("sim.intersectPointsWithPointCloud")]
fn intersect_points(
    cx: &mut Cx,
    point_cloud_handle: Handle,
    options: Number,
    points: Vec<f64>,
    tolerance: f64,
) -> Result<i64> {
    let mut scene = cx.scene_mut();
    let points = points_in(&scene, point_cloud_handle, options, &points)?;
    change_cloud(&mut scene, point_cloud_handle, |cloud| {
        cloud.intersect(&points, tolerance);
    })
}

/// The points, in the frame of the point cloud, in the order they came.
///
/// @param pointCloudHandle the point cloud
/// @return points x, y, z of each
#[api("sim.getPointCloudPoints")]
fn cloud_points(cx: &Cx, point_cloud_handle: Handle) -> Result<Vec<f64>> {
    let scene = cx.scene();
    Ok(scene
        .object(point_cloud_handle)?
        .point_cloud()?
        .points
        .iter()
        .flat_map(|point| point.position)
        .collect())
}

/// Options of a point cloud.
///
/// @param pointCloudHandle the point cloud
/// @return maxVoxelSize largest cell, metres
/// @return maxPtCntPerVoxel most points in a cell
/// @return options 2: random colours, 8: points are not kept in an octree
/// @return pointSize pixels
#[api("sim.getPointCloudOptions")]
fn cloud_options(cx: &Cx, point_cloud_handle: Handle) -> Result<(f64, i64, i64, f64)> {
    let scene = cx.scene();
    let cloud = scene.object(point_cloud_handle)?.point_cloud()?;
    let mut options = StorageOptions::empty();
    options.set(StorageOptions::RANDOM_COLOURS, cloud.random_colours);
    options.set(StorageOptions::WITHOUT_OCTREE, !cloud.uses_octree);
    Ok((
        cloud.max_cell_size,
        cloud.max_points_in_cell,
        options.bits(),
        cloud.point_size as f64,
    ))
}

/// Changes how a point cloud keeps and shows its points.
///
/// @param pointCloudHandle the point cloud
/// @param maxVoxelSize largest cell, metres
/// @param maxPtCntPerVoxel most points in a cell
/// @param options 2: random colours, 8: points are not kept in an octree; others for display
/// @param pointSize pixels
#[api("sim.setPointCloudOptions")]
fn set_cloud_options(
    cx: &mut Cx,
    point_cloud_handle: Handle,
    max_voxel_size: f64,
    max_pt_cnt_per_voxel: Number,
    options: Number,
    point_size: f64,
) -> Result<()> {
    let options = StorageOptions::from_bits_retain(options.0);
    let mut scene = cx.scene_mut();
    change_cloud(&mut scene, point_cloud_handle, |cloud| {
        cloud.max_cell_size = scene::voxels::octree::cell_size(max_voxel_size);
        cloud.max_points_in_cell = max_pt_cnt_per_voxel.0.max(1);
        cloud.random_colours = options.contains(StorageOptions::RANDOM_COLOURS);
        cloud.uses_octree = !options.contains(StorageOptions::WITHOUT_OCTREE);
        cloud.point_size = numbers::truncated(point_size);
    })?;
    Ok(())
}
