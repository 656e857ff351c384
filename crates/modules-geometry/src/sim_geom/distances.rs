//! Distances between meshes, octrees and point clouds.

use api_macro::api;

use super::{ApiFn, Cx, Place, Result, functions, measure, pair, pose, structures};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    get_mesh_mesh_distance,
    get_mesh_octree_distance,
    get_mesh_ptcloud_distance,
    get_octree_octree_distance,
    get_octree_ptcloud_distance,
    get_ptcloud_ptcloud_distance
];

/// Distance between two meshes.
///
/// @param mesh1Handle the first mesh
/// @param mesh1Pos where it is
/// @param mesh1Quaternion how it is turned
/// @param mesh2Handle the second mesh
/// @param mesh2Pos where it is
/// @param mesh2Quaternion how it is turned
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the first mesh
/// @return distSegPt2 on the second mesh
/// @return cache
#[api("simGeom.getMeshMeshDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_mesh_mesh_distance(
    cx: &Cx,
    mesh1_handle: i64,
    mesh1_pos: [f64; 3],
    mesh1_quaternion: [f64; 4],
    mesh2_handle: i64,
    mesh2_pos: [f64; 3],
    mesh2_quaternion: [f64; 4],
    #[default(0.0)] distance_threshold: f64,
    cache: Option<Vec<i64>>,
) -> Result<(f64, Place, Place, Option<Vec<i64>>)> {
    let structures = structures(cx);
    let (mesh1, mesh2) = (
        structures.meshes.get(mesh1_handle)?,
        structures.meshes.get(mesh2_handle)?,
    );
    let (first, second) = (
        mesh1.placed(pose(mesh1_pos, mesh1_quaternion)?),
        mesh2.placed(pose(mesh2_pos, mesh2_quaternion)?),
    );
    Ok(measure(first, second, distance_threshold).results(pair(cache)))
}

/// Distance between a mesh and an octree.
///
/// @param meshHandle the mesh
/// @param meshPos where it is
/// @param meshQuaternion how it is turned
/// @param octreeHandle the octree
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the mesh
/// @return distSegPt2 on the octree
/// @return cache
#[api("simGeom.getMeshOctreeDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_mesh_octree_distance(
    cx: &Cx,
    mesh_handle: i64,
    mesh_pos: [f64; 3],
    mesh_quaternion: [f64; 4],
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    #[default(0.0)] distance_threshold: f64,
    cache: Option<Vec<i64>>,
) -> Result<(f64, Place, Place, Option<Vec<i64>>)> {
    let structures = structures(cx);
    let (mesh, octree) = (
        structures.meshes.get(mesh_handle)?,
        structures.octrees.get(octree_handle)?,
    );
    let (first, second) = (
        mesh.placed(pose(mesh_pos, mesh_quaternion)?),
        octree.placed(pose(octree_pos, octree_quaternion)?),
    );
    Ok(measure(first, second, distance_threshold).results(pair(cache)))
}

/// Distance between a mesh and a point cloud.
///
/// @param meshHandle the mesh
/// @param meshPos where it is
/// @param meshQuaternion how it is turned
/// @param ptcloudHandle the point cloud
/// @param ptcloudPos where it is
/// @param ptcloudQuaternion how it is turned
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the mesh
/// @return distSegPt2 on the point cloud
/// @return cache
#[api("simGeom.getMeshPtcloudDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_mesh_ptcloud_distance(
    cx: &Cx,
    mesh_handle: i64,
    mesh_pos: [f64; 3],
    mesh_quaternion: [f64; 4],
    ptcloud_handle: i64,
    ptcloud_pos: [f64; 3],
    ptcloud_quaternion: [f64; 4],
    #[default(0.0)] distance_threshold: f64,
    cache: Option<Vec<i64>>,
) -> Result<(f64, Place, Place, Option<Vec<i64>>)> {
    let structures = structures(cx);
    let (mesh, ptcloud) = (
        structures.meshes.get(mesh_handle)?,
        structures.point_clouds.get(ptcloud_handle)?,
    );
    let (first, second) = (
        mesh.placed(pose(mesh_pos, mesh_quaternion)?),
        ptcloud.placed(pose(ptcloud_pos, ptcloud_quaternion)?),
    );
    Ok(measure(first, second, distance_threshold).results(pair(cache)))
}

/// Distance between two octrees.
///
/// @param octree1Handle the first octree
/// @param octree1Pos where it is
/// @param octree1Quaternion how it is turned
/// @param octree2Handle the second octree
/// @param octree2Pos where it is
/// @param octree2Quaternion how it is turned
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the first octree
/// @return distSegPt2 on the second octree
/// @return cache
#[api("simGeom.getOctreeOctreeDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_octree_octree_distance(
    cx: &Cx,
    octree1_handle: i64,
    octree1_pos: [f64; 3],
    octree1_quaternion: [f64; 4],
    octree2_handle: i64,
    octree2_pos: [f64; 3],
    octree2_quaternion: [f64; 4],
    #[default(0.0)] distance_threshold: f64,
    cache: Option<Vec<i64>>,
) -> Result<(f64, Place, Place, Option<Vec<i64>>)> {
    let structures = structures(cx);
    let (octree1, octree2) = (
        structures.octrees.get(octree1_handle)?,
        structures.octrees.get(octree2_handle)?,
    );
    let (first, second) = (
        octree1.placed(pose(octree1_pos, octree1_quaternion)?),
        octree2.placed(pose(octree2_pos, octree2_quaternion)?),
    );
    Ok(measure(first, second, distance_threshold).results(pair(cache)))
}

/// Distance between an octree and a point cloud.
///
/// @param octreeHandle the octree
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param ptcloudHandle the point cloud
/// @param ptcloudPos where it is
/// @param ptcloudQuaternion how it is turned
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the octree
/// @return distSegPt2 on the point cloud
/// @return cache
#[api("simGeom.getOctreePtcloudDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_octree_ptcloud_distance(
    cx: &Cx,
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    ptcloud_handle: i64,
    ptcloud_pos: [f64; 3],
    ptcloud_quaternion: [f64; 4],
    #[default(0.0)] distance_threshold: f64,
    cache: Option<Vec<i64>>,
) -> Result<(f64, Place, Place, Option<Vec<i64>>)> {
    let structures = structures(cx);
    let (octree, ptcloud) = (
        structures.octrees.get(octree_handle)?,
        structures.point_clouds.get(ptcloud_handle)?,
    );
    let (first, second) = (
        octree.placed(pose(octree_pos, octree_quaternion)?),
        ptcloud.placed(pose(ptcloud_pos, ptcloud_quaternion)?),
    );
    Ok(measure(first, second, distance_threshold).results(pair(cache)))
}

/// Distance between two point clouds.
///
/// @param ptcloud1Handle the first point cloud
/// @param ptcloud1Pos where it is
/// @param ptcloud1Quaternion how it is turned
/// @param ptcloud2Handle the second point cloud
/// @param ptcloud2Pos where it is
/// @param ptcloud2Quaternion how it is turned
/// @param distanceThreshold only a smaller distance counts, metres; 0 or less: any
/// @param cache comes back as it is
/// @return dist metres; the threshold where nothing is nearer, and no other results then
/// @return distSegPt1 on the first point cloud
/// @return distSegPt2 on the second point cloud
/// @return cache
#[api("simGeom.getPtcloudPtcloudDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_ptcloud_ptcloud_distance(
    cx: &Cx,
    ptcloud1_handle: i64,
    ptcloud1_pos: [f64; 3],
    ptcloud1_quaternion: [f64; 4],
    ptcloud2_handle: i64,
    ptcloud2_pos: [f64; 3],
    ptcloud2_quaternion: [f64; 4],
    #[default(0.0)] distance_threshold: f64,
    cache: Option<Vec<i64>>,
) -> Result<(f64, Place, Place, Option<Vec<i64>>)> {
    let structures = structures(cx);
    let (ptcloud1, ptcloud2) = (
        structures.point_clouds.get(ptcloud1_handle)?,
        structures.point_clouds.get(ptcloud2_handle)?,
    );
    let (first, second) = (
        ptcloud1.placed(pose(ptcloud1_pos, ptcloud1_quaternion)?),
        ptcloud2.placed(pose(ptcloud2_pos, ptcloud2_quaternion)?),
    );
    Ok(measure(first, second, distance_threshold).results(pair(cache)))
}
