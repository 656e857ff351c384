//! Point clouds: made, read, copied, scaled, stored and destroyed.

use api_macro::api;
use nalgebra::Point3;

use super::structures::CloudStructure;
use super::{
    ApiError, ApiFn, Cx, Result, colour, factor, frame, functions, points, serialization,
    structures,
};
use scene::voxels::cloud_points::CloudPoints;
use scene::voxels::point_cloud::{CloudPoint, PointCloud};
use script::Bytes;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_ptcloud_from_points,
    create_ptcloud_from_color_points,
    get_ptcloud_points,
    copy_ptcloud,
    scale_ptcloud,
    destroy_ptcloud,
    get_ptcloud_serialization_data,
    create_ptcloud_from_serialization_data,
];

/// Makes a point cloud. It belongs to this script and ends with it.
///
/// @param points three coordinates each, in the world, metres
/// @param octreeOriginPos where the cloud has its frame
/// @param octreeOriginQuaternion how the frame is turned
/// @param maxCellSize without effect
/// @param maxPtsInCell without effect
/// @param pointColor red, green, blue, 0 to 255
/// @param proximityTolerance a point that is nearer to an earlier one is left out, metres
/// @return ptcloudHandle
#[api("simGeom.createPtcloudFromPoints")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn create_ptcloud_from_points(
    cx: &Cx,
    points: Vec<f64>,
    octree_origin_pos: Option<[f64; 3]>,
    octree_origin_quaternion: Option<[f64; 4]>,
    #[default(0.05)] max_cell_size: f64,
    #[default(20)] max_pts_in_cell: i64,
    #[default([0.0; 3])] point_color: [f64; 3],
    #[default(0.005)] proximity_tolerance: f64,
) -> Result<i64> {
    let cloud = empty(max_cell_size, max_pts_in_cell);
    let frame = (octree_origin_pos, octree_origin_quaternion);
    let colours = vec![colour(point_color); points.len() / 3];
    add(cx, cloud, &points, frame, colours, proximity_tolerance)
}

/// Makes a point cloud whose points have a colour each.
///
/// @param points three coordinates each, in the world, metres
/// @param octreeOriginPos where the cloud has its frame
/// @param octreeOriginQuaternion how the frame is turned
/// @param maxCellSize without effect
/// @param maxPtsInCell without effect
/// @param colors three channels per point, 0 to 255
/// @param proximityTolerance a point that is nearer to an earlier one is left out, metres
/// @return ptcloudHandle
#[api("simGeom.createPtcloudFromColorPoints")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn create_ptcloud_from_color_points(
    cx: &Cx,
    points: Vec<f64>,
    octree_origin_pos: Option<[f64; 3]>,
    octree_origin_quaternion: Option<[f64; 4]>,
    #[default(0.05)] max_cell_size: f64,
    #[default(20)] max_pts_in_cell: i64,
    colors: Option<Vec<f64>>,
    #[default(0.005)] proximity_tolerance: f64,
) -> Result<i64> {
    let cloud = empty(max_cell_size, max_pts_in_cell);
    let frame = (octree_origin_pos, octree_origin_quaternion);
    let colours = colours(colors.as_deref(), points.len() / 3)?;
    add(cx, cloud, &points, frame, colours, proximity_tolerance)
}

/// The points of a point cloud, in its frame.
///
/// @param ptcloudHandle the point cloud
/// @param subsetProportion which part of the points, 0 to 1; the others are left out evenly
/// @return points three coordinates each, metres
/// @return colors three channels each, 0 to 1
#[api("simGeom.getPtcloudPoints")]
fn get_ptcloud_points(
    cx: &Cx,
    ptcloud_handle: i64,
    #[default(1.0)] subset_proportion: f64,
) -> Result<(Vec<f64>, Vec<f64>)> {
    let cloud = structures(cx).point_clouds.get(ptcloud_handle)?;
    let proportion = subset_proportion.clamp(0.0, 1.0);
    let before = |i: usize| (i as f64 * proportion).floor();
    let chosen = cloud
        .cloud
        .points
        .iter()
        .enumerate()
        .filter(|(i, _)| before(i + 1) > before(*i));
    let (positions, colours): (Vec<_>, Vec<_>) = chosen
        .map(|(_, point)| {
            (
                point.position,
                point.colour.map(|channel| f64::from(channel) / 255.0),
            )
        })
        .unzip();
    Ok((positions.into_flattened(), colours.into_flattened()))
}

/// Copies a point cloud.
///
/// @param ptcloudHandle the point cloud
/// @return ptcloudCopyHandle
#[api("simGeom.copyPtcloud")]
fn copy_ptcloud(cx: &Cx, ptcloud_handle: i64) -> Result<i64> {
    let clouds = &structures(cx).point_clouds;
    let cloud = clouds.get(ptcloud_handle)?.cloud.clone();
    Ok(clouds.add(CloudStructure::new(cloud)))
}

/// Scales a point cloud about the origin of its frame.
///
/// @param ptcloudHandle the point cloud
/// @param scaleFactor positive
#[api("simGeom.scalePtcloud")]
fn scale_ptcloud(cx: &Cx, ptcloud_handle: i64, scale_factor: f64) -> Result<()> {
    let clouds = &structures(cx).point_clouds;
    let mut cloud = clouds.get(ptcloud_handle)?.cloud.clone();
    cloud.scale(factor(scale_factor)?);
    clouds.replace(ptcloud_handle, CloudStructure::new(cloud));
    Ok(())
}

/// Destroys a point cloud.
///
/// @param ptcloudHandle the point cloud
#[api("simGeom.destroyPtcloud")]
fn destroy_ptcloud(cx: &Cx, ptcloud_handle: i64) -> Result<()> {
    structures(cx).point_clouds.remove(ptcloud_handle)
}

/// A point cloud as bytes. The format is Swanilda's own.
///
/// @param ptcloudHandle the point cloud
/// @return data
#[api("simGeom.getPtcloudSerializationData")]
fn get_ptcloud_serialization_data(cx: &Cx, ptcloud_handle: i64) -> Result<Bytes> {
    serialization::of_point_cloud(&structures(cx).point_clouds.get(ptcloud_handle)?.cloud)
        .map(Bytes)
}

/// The point cloud that simGeom.getPtcloudSerializationData stored.
///
/// @param data the bytes
/// @return ptcloudHandle
#[api("simGeom.createPtcloudFromSerializationData")]
fn create_ptcloud_from_serialization_data(cx: &Cx, data: Bytes) -> Result<i64> {
    Ok(structures(cx)
        .point_clouds
        .add(CloudStructure::new(serialization::to_point_cloud(&data.0)?)))
}

/// A point cloud without points.
pub(super) fn empty(max_cell_size: f64, max_points_in_cell: i64) -> PointCloud {
    PointCloud {
        max_cell_size,
        max_points_in_cell,
        point_size: 1,
        uses_octree: true,
        display_fraction: 1.0,
        random_colours: false,
        points: CloudPoints::default(),
    }
}

/// A colour for each of `count` points, from three channels each; black where there are none.
pub(super) fn colours(channels: Option<&[f64]>, count: usize) -> Result<Vec<[u8; 3]>> {
    let Some(channels) = channels else {
        return Ok(vec![[0; 3]; count]);
    };
    let (colours, _) = channels.as_chunks::<3>();
    if colours.len() < count {
        return Err(ApiError::TableSize);
    }
    Ok(colours[..count]
        .iter()
        .map(|channels| colour(*channels))
        .collect())
}

fn add(
    cx: &Cx,
    mut cloud: PointCloud,
    flat: &[f64],
    (position, quaternion): (Option<[f64; 3]>, Option<[f64; 4]>),
    colours: Vec<[u8; 3]>,
    tolerance: f64,
) -> Result<i64> {
    let frame = frame(position, quaternion)?;
    let local = |point: &[f64; 3]| frame.inverse_transform_point(&Point3::from(*point)).into();
    let new = points(flat)?
        .iter()
        .zip(colours)
        .map(|(point, colour)| CloudPoint {
            position: local(point),
            colour,
        });
    cloud.insert(new, tolerance);
    Ok(structures(cx).point_clouds.add(CloudStructure::new(cloud)))
}
