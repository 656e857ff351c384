//! Distances of meshes, octrees and point clouds to triangles, segments and points.

use api_macro::api;

use super::{ApiFn, Cx, Element, Place, Result, functions, measure, pose, structures};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    get_mesh_triangle_distance,
    get_mesh_segment_distance,
    get_mesh_point_distance,
    get_octree_triangle_distance,
    get_octree_segment_distance,
    get_octree_point_distance,
    get_ptcloud_triangle_distance,
    get_ptcloud_segment_distance,
    get_ptcloud_point_distance
];

/// Distance between a mesh and a triangle.
///
/// @param meshHandle the mesh
/// @param meshPos where it is
/// @param meshQuaternion how it is turned
/// @param p a corner of the triangle
/// @param v the edge vector to the second corner
/// @param w the edge vector to the third corner
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the mesh
/// @return distSegPt2 on the triangle
/// @return cache
#[api("simGeom.getMeshTriangleDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_mesh_triangle_distance(
    cx: &Cx,
    mesh_handle: i64,
    mesh_pos: [f64; 3],
    mesh_quaternion: [f64; 4],
    p: [f64; 3],
    v: [f64; 3],
    w: [f64; 3],
    #[default(0.0)] distance_threshold: f64,
    #[default(-1)] cache: i64,
) -> Result<(f64, Place, Place, Option<i64>)> {
    let mesh = structures(cx).meshes.get(mesh_handle)?;
    let (first, triangle) = (
        mesh.placed(pose(mesh_pos, mesh_quaternion)?),
        Element::triangle(p, v, w)?,
    );
    Ok(measure(first, Some(triangle.placed()), distance_threshold).results(cache))
}

/// Distance between a mesh and a segment.
///
/// @param meshHandle the mesh
/// @param meshPos where it is
/// @param meshQuaternion how it is turned
/// @param segmentEndPoint an end of the segment
/// @param segmentVector from there to the other end
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the mesh
/// @return distSegPt2 on the segment
/// @return cache
#[api("simGeom.getMeshSegmentDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_mesh_segment_distance(
    cx: &Cx,
    mesh_handle: i64,
    mesh_pos: [f64; 3],
    mesh_quaternion: [f64; 4],
    segment_end_point: [f64; 3],
    segment_vector: [f64; 3],
    #[default(0.0)] distance_threshold: f64,
    #[default(-1)] cache: i64,
) -> Result<(f64, Place, Place, Option<i64>)> {
    let mesh = structures(cx).meshes.get(mesh_handle)?;
    let (first, segment) = (
        mesh.placed(pose(mesh_pos, mesh_quaternion)?),
        Element::segment(segment_end_point, segment_vector)?,
    );
    Ok(measure(first, Some(segment.placed()), distance_threshold).results(cache))
}

/// Distance between a mesh and a point.
///
/// @param meshHandle the mesh
/// @param meshPos where it is
/// @param meshQuaternion how it is turned
/// @param point the point
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt on the mesh
/// @return cache
#[api("simGeom.getMeshPointDistance")]
fn get_mesh_point_distance(
    cx: &Cx,
    mesh_handle: i64,
    mesh_pos: [f64; 3],
    mesh_quaternion: [f64; 4],
    point: [f64; 3],
    #[default(0.0)] distance_threshold: f64,
    #[default(-1)] cache: i64,
) -> Result<(f64, Place, Option<i64>)> {
    let mesh = structures(cx).meshes.get(mesh_handle)?;
    let first = mesh.placed(pose(mesh_pos, mesh_quaternion)?);
    Ok(measure(first, Some(super::point(point)?), distance_threshold).results_of_point(cache))
}

/// Distance between an octree and a triangle.
///
/// @param octreeHandle the octree
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param p a corner of the triangle
/// @param v the edge vector to the second corner
/// @param w the edge vector to the third corner
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the octree
/// @return distSegPt2 on the triangle
/// @return cache
#[api("simGeom.getOctreeTriangleDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_octree_triangle_distance(
    cx: &Cx,
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    p: [f64; 3],
    v: [f64; 3],
    w: [f64; 3],
    #[default(0.0)] distance_threshold: f64,
    #[default(-1)] cache: i64,
) -> Result<(f64, Place, Place, Option<i64>)> {
    let octree = structures(cx).octrees.get(octree_handle)?;
    let (first, triangle) = (
        octree.placed(pose(octree_pos, octree_quaternion)?),
        Element::triangle(p, v, w)?,
    );
    Ok(measure(first, Some(triangle.placed()), distance_threshold).results(cache))
}

/// Distance between an octree and a segment.
///
/// @param octreeHandle the octree
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param segmentEndPoint an end of the segment
/// @param segmentVector from there to the other end
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the octree
/// @return distSegPt2 on the segment
/// @return cache
#[api("simGeom.getOctreeSegmentDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_octree_segment_distance(
    cx: &Cx,
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    segment_end_point: [f64; 3],
    segment_vector: [f64; 3],
    #[default(0.0)] distance_threshold: f64,
    #[default(-1)] cache: i64,
) -> Result<(f64, Place, Place, Option<i64>)> {
    let octree = structures(cx).octrees.get(octree_handle)?;
    let (first, segment) = (
        octree.placed(pose(octree_pos, octree_quaternion)?),
        Element::segment(segment_end_point, segment_vector)?,
    );
    Ok(measure(first, Some(segment.placed()), distance_threshold).results(cache))
}

/// Distance between an octree and a point.
///
/// @param octreeHandle the octree
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param point the point
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt on the octree
/// @return cache
#[api("simGeom.getOctreePointDistance")]
fn get_octree_point_distance(
    cx: &Cx,
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    point: [f64; 3],
    #[default(0.0)] distance_threshold: f64,
    #[default(-1)] cache: i64,
) -> Result<(f64, Place, Option<i64>)> {
    let octree = structures(cx).octrees.get(octree_handle)?;
    let first = octree.placed(pose(octree_pos, octree_quaternion)?);
    Ok(measure(first, Some(super::point(point)?), distance_threshold).results_of_point(cache))
}

/// Distance between a point cloud and a triangle.
///
/// @param ptcloudHandle the point cloud
/// @param ptcloudPos where it is
/// @param ptcloudQuaternion how it is turned
/// @param p a corner of the triangle
/// @param v the edge vector to the second corner
/// @param w the edge vector to the third corner
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the point cloud
/// @return distSegPt2 on the triangle
/// @return cache
#[api("simGeom.getPtcloudTriangleDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_ptcloud_triangle_distance(
    cx: &Cx,
    ptcloud_handle: i64,
    ptcloud_pos: [f64; 3],
    ptcloud_quaternion: [f64; 4],
    p: [f64; 3],
    v: [f64; 3],
    w: [f64; 3],
    #[default(0.0)] distance_threshold: f64,
    #[default(-1)] cache: i64,
) -> Result<(f64, Place, Place, Option<i64>)> {
    let ptcloud = structures(cx).point_clouds.get(ptcloud_handle)?;
    let (first, triangle) = (
        ptcloud.placed(pose(ptcloud_pos, ptcloud_quaternion)?),
        Element::triangle(p, v, w)?,
    );
    Ok(measure(first, Some(triangle.placed()), distance_threshold).results(cache))
}

/// Distance between a point cloud and a segment.
///
/// @param ptcloudHandle the point cloud
/// @param ptcloudPos where it is
/// @param ptcloudQuaternion how it is turned
/// @param segmentEndPoint an end of the segment
/// @param segmentVector from there to the other end
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the point cloud
/// @return distSegPt2 on the segment
/// @return cache
#[api("simGeom.getPtcloudSegmentDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_ptcloud_segment_distance(
    cx: &Cx,
    ptcloud_handle: i64,
    ptcloud_pos: [f64; 3],
    ptcloud_quaternion: [f64; 4],
    segment_end_point: [f64; 3],
    segment_vector: [f64; 3],
    #[default(0.0)] distance_threshold: f64,
    #[default(-1)] cache: i64,
) -> Result<(f64, Place, Place, Option<i64>)> {
    let ptcloud = structures(cx).point_clouds.get(ptcloud_handle)?;
    let (first, segment) = (
        ptcloud.placed(pose(ptcloud_pos, ptcloud_quaternion)?),
        Element::segment(segment_end_point, segment_vector)?,
    );
    Ok(measure(first, Some(segment.placed()), distance_threshold).results(cache))
}

/// Distance between a point cloud and a point.
///
/// @param ptcloudHandle the point cloud
/// @param ptcloudPos where it is
/// @param ptcloudQuaternion how it is turned
/// @param point the point
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt on the point cloud
/// @return cache
#[api("simGeom.getPtcloudPointDistance")]
fn get_ptcloud_point_distance(
    cx: &Cx,
    ptcloud_handle: i64,
    ptcloud_pos: [f64; 3],
    ptcloud_quaternion: [f64; 4],
    point: [f64; 3],
    #[default(0.0)] distance_threshold: f64,
    #[default(-1)] cache: i64,
) -> Result<(f64, Place, Option<i64>)> {
    let ptcloud = structures(cx).point_clouds.get(ptcloud_handle)?;
    let first = ptcloud.placed(pose(ptcloud_pos, ptcloud_quaternion)?);
    Ok(measure(first, Some(super::point(point)?), distance_threshold).results_of_point(cache))
}
