//! Collisions of meshes and octrees with each other, with point clouds and with triangles, segments and points.

use api_macro::api;
use proximity::{Placed, intersection_segments, intersects};

use super::{ApiFn, Cx, Element, Result, functions, pair, pose, structures};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    get_mesh_mesh_collision,
    get_mesh_octree_collision,
    get_octree_octree_collision,
    get_octree_ptcloud_collision,
    get_mesh_triangle_collision,
    get_mesh_segment_collision,
    get_octree_triangle_collision,
    get_octree_segment_collision,
    get_octree_point_collision
];

fn collide(a: Option<Placed>, b: Option<Placed>) -> bool {
    a.zip(b).is_some_and(|(a, b)| intersects(a, b))
}

/// Whether they intersect, and the ends of the segments of the intersection if they are wanted.
fn collision_with_segments(
    a: Option<Placed>,
    b: Option<Placed>,
    wanted: bool,
) -> (bool, Option<Vec<f64>>) {
    let segments = wanted.then(|| {
        a.zip(b)
            .map_or_else(Vec::new, |(a, b)| intersection_segments(a, b))
    });
    (
        collide(a, b),
        segments.map(|segments| segments.into_flattened().into_flattened()),
    )
}

/// Whether two meshes intersect. Meshes are surfaces.
///
/// @param mesh1Handle the first mesh
/// @param mesh1Pos where it is
/// @param mesh1Quaternion how it is turned
/// @param mesh2Handle the second mesh
/// @param mesh2Pos where it is
/// @param mesh2Quaternion how it is turned
/// @param cache comes back as it is
/// @param returnIntersections whether the segments of the intersection are wanted
/// @return collision whether they have a point in common
/// @return cache
/// @return intersections six coordinates of the ends of each segment, in the world; only if asked for
#[api("simGeom.getMeshMeshCollision")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_mesh_mesh_collision(
    cx: &Cx,
    mesh1_handle: i64,
    mesh1_pos: [f64; 3],
    mesh1_quaternion: [f64; 4],
    mesh2_handle: i64,
    mesh2_pos: [f64; 3],
    mesh2_quaternion: [f64; 4],
    cache: Option<Vec<i64>>,
    #[default(false)] return_intersections: bool,
) -> Result<(bool, Vec<i64>, Option<Vec<f64>>)> {
    let structures = structures(cx);
    let (mesh1, mesh2) = (
        structures.meshes.get(mesh1_handle)?,
        structures.meshes.get(mesh2_handle)?,
    );
    let (first, second) = (
        mesh1.placed(pose(mesh1_pos, mesh1_quaternion)?),
        mesh2.placed(pose(mesh2_pos, mesh2_quaternion)?),
    );
    let (collide, segments) = collision_with_segments(first, second, return_intersections);
    Ok((collide, pair(cache), segments))
}

/// Whether a mesh and an octree intersect. Voxels are solid.
///
/// @param meshHandle the mesh
/// @param meshPos where it is
/// @param meshQuaternion how it is turned
/// @param octreeHandle the octree
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param cache comes back as it is
/// @return collision whether they have a point in common
/// @return cache
#[api("simGeom.getMeshOctreeCollision")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_mesh_octree_collision(
    cx: &Cx,
    mesh_handle: i64,
    mesh_pos: [f64; 3],
    mesh_quaternion: [f64; 4],
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    cache: Option<Vec<i64>>,
) -> Result<(bool, Vec<i64>)> {
    let structures = structures(cx);
    let (mesh, octree) = (
        structures.meshes.get(mesh_handle)?,
        structures.octrees.get(octree_handle)?,
    );
    let (first, second) = (
        mesh.placed(pose(mesh_pos, mesh_quaternion)?),
        octree.placed(pose(octree_pos, octree_quaternion)?),
    );
    Ok((collide(first, second), pair(cache)))
}

/// Whether two octrees intersect. Voxels are solid.
///
/// @param octree1Handle the first octree
/// @param octree1Pos where it is
/// @param octree1Quaternion how it is turned
/// @param octree2Handle the second octree
/// @param octree2Pos where it is
/// @param octree2Quaternion how it is turned
/// @param cache comes back as it is
/// @return collision whether they have a point in common
/// @return cache
#[api("simGeom.getOctreeOctreeCollision")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_octree_octree_collision(
    cx: &Cx,
    octree1_handle: i64,
    octree1_pos: [f64; 3],
    octree1_quaternion: [f64; 4],
    octree2_handle: i64,
    octree2_pos: [f64; 3],
    octree2_quaternion: [f64; 4],
    cache: Option<Vec<i64>>,
) -> Result<(bool, Vec<i64>)> {
    let structures = structures(cx);
    let (octree1, octree2) = (
        structures.octrees.get(octree1_handle)?,
        structures.octrees.get(octree2_handle)?,
    );
    let (first, second) = (
        octree1.placed(pose(octree1_pos, octree1_quaternion)?),
        octree2.placed(pose(octree2_pos, octree2_quaternion)?),
    );
    Ok((collide(first, second), pair(cache)))
}

/// Whether an octree and a point cloud intersect. Voxels are solid.
///
/// @param octreeHandle the octree
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param ptcloudHandle the point cloud
/// @param ptcloudPos where it is
/// @param ptcloudQuaternion how it is turned
/// @param cache comes back as it is
/// @return collision whether they have a point in common
/// @return cache
#[api("simGeom.getOctreePtcloudCollision")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_octree_ptcloud_collision(
    cx: &Cx,
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    ptcloud_handle: i64,
    ptcloud_pos: [f64; 3],
    ptcloud_quaternion: [f64; 4],
    cache: Option<Vec<i64>>,
) -> Result<(bool, Vec<i64>)> {
    let structures = structures(cx);
    let (octree, ptcloud) = (
        structures.octrees.get(octree_handle)?,
        structures.point_clouds.get(ptcloud_handle)?,
    );
    let (first, second) = (
        octree.placed(pose(octree_pos, octree_quaternion)?),
        ptcloud.placed(pose(ptcloud_pos, ptcloud_quaternion)?),
    );
    Ok((collide(first, second), pair(cache)))
}

/// Whether a mesh and a triangle intersect. Meshes are surfaces.
///
/// @param meshHandle the mesh
/// @param meshPos where it is
/// @param meshQuaternion how it is turned
/// @param p a corner of the triangle
/// @param v the edge vector to the second corner
/// @param w the edge vector to the third corner
/// @param cache comes back as it is
/// @param returnIntersections whether the segments of the intersection are wanted
/// @return collision whether they have a point in common
/// @return cache
/// @return intersections six coordinates of the ends of each segment, in the world; only if asked for
#[api("simGeom.getMeshTriangleCollision")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_mesh_triangle_collision(
    cx: &Cx,
    mesh_handle: i64,
    mesh_pos: [f64; 3],
    mesh_quaternion: [f64; 4],
    p: [f64; 3],
    v: [f64; 3],
    w: [f64; 3],
    #[default(-1)] cache: i64,
    #[default(false)] return_intersections: bool,
) -> Result<(bool, i64, Option<Vec<f64>>)> {
    let mesh = structures(cx).meshes.get(mesh_handle)?;
    let (first, triangle) = (
        mesh.placed(pose(mesh_pos, mesh_quaternion)?),
        Element::triangle(p, v, w)?,
    );
    let (collide, segments) =
        collision_with_segments(first, Some(triangle.placed()), return_intersections);
    Ok((collide, cache, segments))
}

/// Whether a mesh and a segment intersect. Meshes are surfaces.
///
/// @param meshHandle the mesh
/// @param meshPos where it is
/// @param meshQuaternion how it is turned
/// @param segmentEndPoint an end of the segment
/// @param segmentVector from there to the other end
/// @param cache comes back as it is
/// @param returnIntersections whether the segments of the intersection are wanted
/// @return collision whether they have a point in common
/// @return cache
/// @return intersections six coordinates of the ends of each segment, which has no length, in the world; only if asked for
#[api("simGeom.getMeshSegmentCollision")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_mesh_segment_collision(
    cx: &Cx,
    mesh_handle: i64,
    mesh_pos: [f64; 3],
    mesh_quaternion: [f64; 4],
    segment_end_point: [f64; 3],
    segment_vector: [f64; 3],
    #[default(-1)] cache: i64,
    #[default(false)] return_intersections: bool,
) -> Result<(bool, i64, Option<Vec<f64>>)> {
    let mesh = structures(cx).meshes.get(mesh_handle)?;
    let (first, segment) = (
        mesh.placed(pose(mesh_pos, mesh_quaternion)?),
        Element::segment(segment_end_point, segment_vector)?,
    );
    let (collide, segments) =
        collision_with_segments(first, Some(segment.placed()), return_intersections);
    Ok((collide, cache, segments))
}

/// Whether an octree and a triangle intersect. Voxels are solid.
///
/// @param octreeHandle the octree
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param p a corner of the triangle
/// @param v the edge vector to the second corner
/// @param w the edge vector to the third corner
/// @param cache comes back as it is
/// @return collision whether they have a point in common
/// @return cache
#[api("simGeom.getOctreeTriangleCollision")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_octree_triangle_collision(
    cx: &Cx,
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    p: [f64; 3],
    v: [f64; 3],
    w: [f64; 3],
    #[default(-1)] cache: i64,
) -> Result<(bool, i64)> {
    let octree = structures(cx).octrees.get(octree_handle)?;
    let (first, triangle) = (
        octree.placed(pose(octree_pos, octree_quaternion)?),
        Element::triangle(p, v, w)?,
    );
    Ok((collide(first, Some(triangle.placed())), cache))
}

/// Whether an octree and a segment intersect. Voxels are solid.
///
/// @param octreeHandle the octree
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param segmentEndPoint an end of the segment
/// @param segmentVector from there to the other end
/// @param cache comes back as it is
/// @return collision whether they have a point in common
/// @return cache
#[api("simGeom.getOctreeSegmentCollision")]
fn get_octree_segment_collision(
    cx: &Cx,
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    segment_end_point: [f64; 3],
    segment_vector: [f64; 3],
    #[default(-1)] cache: i64,
) -> Result<(bool, i64)> {
    let octree = structures(cx).octrees.get(octree_handle)?;
    let (first, segment) = (
        octree.placed(pose(octree_pos, octree_quaternion)?),
        Element::segment(segment_end_point, segment_vector)?,
    );
    Ok((collide(first, Some(segment.placed())), cache))
}

/// Whether an octree and a point intersect. Voxels are solid.
///
/// @param octreeHandle the octree
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param point the point
/// @param cache comes back as it is
/// @return collision whether they have a point in common
/// @return cache
#[api("simGeom.getOctreePointCollision")]
fn get_octree_point_collision(
    cx: &Cx,
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    point: [f64; 3],
    #[default(-1)] cache: i64,
) -> Result<(bool, i64)> {
    let octree = structures(cx).octrees.get(octree_handle)?;
    let first = octree.placed(pose(octree_pos, octree_quaternion)?);
    Ok((collide(first, Some(super::point(point)?)), cache))
}
