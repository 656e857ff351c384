//! Octrees: made, read, copied, scaled, stored and destroyed.

use api_macro::api;
use geometry::Pose;
use nalgebra::Point3;

use super::structures::OctreeStructure;
use super::{
    ApiError, ApiFn, Cx, Result, colour, factor, frame, functions, points, pose, serialization,
    structures,
};
use scene::voxels::octree::{OcTree, Voxel};
use scene::voxels::{cells_of_mesh, cells_of_octree};
use script::Bytes;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_octree_from_points,
    create_octree_from_color_points,
    create_octree_from_mesh,
    create_octree_from_octree,
    get_octree_voxels,
    copy_octree,
    scale_octree,
    destroy_octree,
    get_octree_serialization_data,
    create_octree_from_serialization_data,
];

/// Makes an octree of the cells that points are in. It belongs to this script and ends with it.
///
/// @param points three coordinates each, in the world, metres
/// @param octreeOriginPos where the octree has its frame, along whose axes the cells are
/// @param octreeOriginQuaternion how the frame is turned
/// @param maxCellSize edge of the cells, 0.001 to 1 m
/// @param pointColor red, green, blue, 0 to 255
/// @param userData a number that the voxels keep
/// @return octreeHandle
#[api("simGeom.createOctreeFromPoints")]
fn create_octree_from_points(
    cx: &Cx,
    points: Vec<f64>,
    octree_origin_pos: Option<[f64; 3]>,
    octree_origin_quaternion: Option<[f64; 4]>,
    #[default(0.05)] max_cell_size: f64,
    #[default([0.0; 3])] point_color: [f64; 3],
    #[default(0)] user_data: i64,
) -> Result<i64> {
    let frame = frame(octree_origin_pos, octree_origin_quaternion)?;
    let voxel = voxel(point_color, user_data);
    let voxels = local(&points, &frame)?.map(|point| (point, voxel));
    add(cx, max_cell_size, voxels)
}

/// Makes an octree of the cells that points are in, each with a colour of its own.
///
/// @param points three coordinates each, in the world, metres
/// @param octreeOriginPos where the octree has its frame
/// @param octreeOriginQuaternion how the frame is turned
/// @param maxCellSize edge of the cells, 0.001 to 1 m
/// @param colors three channels per point, 0 to 255
/// @param userData a number per point
/// @return octreeHandle
#[api("simGeom.createOctreeFromColorPoints")]
fn create_octree_from_color_points(
    cx: &Cx,
    points: Vec<f64>,
    octree_origin_pos: Option<[f64; 3]>,
    octree_origin_quaternion: Option<[f64; 4]>,
    #[default(0.05)] max_cell_size: f64,
    colors: Option<Vec<f64>>,
    user_data: Option<Vec<i64>>,
) -> Result<i64> {
    let frame = frame(octree_origin_pos, octree_origin_quaternion)?;
    let colours = super::point_clouds::colours(colors.as_deref(), points.len() / 3)?;
    let numbers = user_data.unwrap_or_else(|| vec![0; points.len() / 3]);
    if numbers.len() < points.len() / 3 {
        return Err(ApiError::TableSize);
    }
    let voxels = colours
        .into_iter()
        .zip(numbers)
        .map(|(colour, number)| Voxel {
            colour,
            tag: number as u32,
        });
    add(cx, max_cell_size, local(&points, &frame)?.zip(voxels))
}

/// Makes an octree of the cells that the triangles of a mesh touch.
///
/// @param meshHandle the mesh
/// @param meshPos where the mesh is
/// @param meshQuaternion how it is turned
/// @param octreeOriginPos where the octree has its frame
/// @param octreeOriginQuaternion how the frame is turned
/// @param maxCellSize edge of the cells, 0.001 to 1 m
/// @param pointColor red, green, blue, 0 to 255
/// @param userData a number that the voxels keep
/// @return octreeHandle
#[api("simGeom.createOctreeFromMesh")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn create_octree_from_mesh(
    cx: &Cx,
    mesh_handle: i64,
    mesh_pos: [f64; 3],
    mesh_quaternion: [f64; 4],
    octree_origin_pos: Option<[f64; 3]>,
    octree_origin_quaternion: Option<[f64; 4]>,
    #[default(0.05)] max_cell_size: f64,
    #[default([0.0; 3])] point_color: [f64; 3],
    #[default(0)] user_data: i64,
) -> Result<i64> {
    let mut mesh = structures(cx).meshes.get(mesh_handle)?.mesh.clone();
    let frame = frame(octree_origin_pos, octree_origin_quaternion)?;
    mesh.transform(&(frame.inverse() * pose(mesh_pos, mesh_quaternion)?));
    let voxel = voxel(point_color, user_data);
    let cells = cells_of_mesh(&mesh, OcTree::new(max_cell_size, 1.0).voxel_size())?;
    add(
        cx,
        max_cell_size,
        cells.into_iter().map(|centre| (centre, voxel)),
    )
}

/// Makes an octree of the cells that the voxels of another one overlap.
///
/// @param octreeHandle the other one
/// @param octreePos where it is
/// @param octreeQuaternion how it is turned
/// @param newOctreeOriginPos where the new octree has its frame
/// @param newOctreeOriginQuaternion how the frame is turned
/// @param maxCellSize edge of the cells, 0.001 to 1 m
/// @param pointColor red, green, blue, 0 to 255
/// @param userData a number that the voxels keep
/// @return newOctreeHandle
#[api("simGeom.createOctreeFromOctree")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn create_octree_from_octree(
    cx: &Cx,
    octree_handle: i64,
    octree_pos: [f64; 3],
    octree_quaternion: [f64; 4],
    new_octree_origin_pos: Option<[f64; 3]>,
    new_octree_origin_quaternion: Option<[f64; 4]>,
    #[default(0.05)] max_cell_size: f64,
    #[default([0.0; 3])] point_color: [f64; 3],
    #[default(0)] user_data: i64,
) -> Result<i64> {
    let other = structures(cx).octrees.get(octree_handle)?;
    let frame = frame(new_octree_origin_pos, new_octree_origin_quaternion)?;
    let place = frame.inverse() * pose(octree_pos, octree_quaternion)?;
    let voxel = voxel(point_color, user_data);
    let cells = cells_of_octree(
        &other.tree,
        &place,
        OcTree::new(max_cell_size, 1.0).voxel_size(),
    )?;
    add(
        cx,
        max_cell_size,
        cells.into_iter().map(|centre| (centre, voxel)),
    )
}

/// The voxels of an octree, in its frame.
///
/// @param octreeHandle the octree
/// @return positions three coordinates of each centre, metres
/// @return colors three channels each, 0 to 1
/// @return userData a number each
#[api("simGeom.getOctreeVoxels")]
fn get_octree_voxels(cx: &Cx, octree_handle: i64) -> Result<(Vec<f64>, Vec<f64>, Vec<i64>)> {
    let octree = structures(cx).octrees.get(octree_handle)?;
    let colours = octree
        .tree
        .voxels()
        .flat_map(|(_, voxel)| voxel.colour.map(|channel| f64::from(channel) / 255.0));
    let centres = octree
        .tree
        .voxels()
        .flat_map(|(centre, _)| centre)
        .collect();
    Ok((
        centres,
        colours.collect(),
        octree
            .tree
            .voxels()
            .map(|(_, voxel)| voxel.tag.into())
            .collect(),
    ))
}

/// Copies an octree.
///
/// @param octreeHandle the octree
/// @return octreeCopyHandle
#[api("simGeom.copyOctree")]
fn copy_octree(cx: &Cx, octree_handle: i64) -> Result<i64> {
    let octrees = &structures(cx).octrees;
    let tree = octrees.get(octree_handle)?.tree.clone();
    Ok(octrees.add(OctreeStructure::new(tree)))
}

/// Scales an octree, its cells too, about the origin of its frame.
///
/// @param octreeHandle the octree
/// @param scaleFactor positive
#[api("simGeom.scaleOctree")]
fn scale_octree(cx: &Cx, octree_handle: i64, scale_factor: f64) -> Result<()> {
    let octrees = &structures(cx).octrees;
    let mut tree = octrees.get(octree_handle)?.tree.clone();
    tree.scale(factor(scale_factor)?);
    octrees.replace(octree_handle, OctreeStructure::new(tree));
    Ok(())
}

/// Destroys an octree.
///
/// @param octreeHandle the octree
#[api("simGeom.destroyOctree")]
fn destroy_octree(cx: &Cx, octree_handle: i64) -> Result<()> {
    structures(cx).octrees.remove(octree_handle)
}

/// An octree as bytes. The format is Swanilda's own.
///
/// @param octreeHandle the octree
/// @return data
#[api("simGeom.getOctreeSerializationData")]
fn get_octree_serialization_data(cx: &Cx, octree_handle: i64) -> Result<Bytes> {
    serialization::of_octree(&structures(cx).octrees.get(octree_handle)?.tree).map(Bytes)
}

/// The octree that simGeom.getOctreeSerializationData stored.
///
/// @param data the bytes
/// @return octreeHandle
#[api("simGeom.createOctreeFromSerializationData")]
fn create_octree_from_serialization_data(cx: &Cx, data: Bytes) -> Result<i64> {
    Ok(structures(cx)
        .octrees
        .add(OctreeStructure::new(serialization::to_octree(&data.0)?)))
}

fn voxel(channels: [f64; 3], number: i64) -> Voxel {
    Voxel {
        colour: colour(channels),
        tag: number as u32,
    }
}

/// Points of the world in a frame.
fn local<'a>(flat: &'a [f64], frame: &Pose) -> Result<impl Iterator<Item = [f64; 3]> + use<'a>> {
    let frame = *frame;
    Ok(points(flat)?
        .iter()
        .map(move |point| frame.inverse_transform_point(&Point3::from(*point)).into()))
}

fn add(cx: &Cx, cell_size: f64, voxels: impl Iterator<Item = ([f64; 3], Voxel)>) -> Result<i64> {
    let mut tree = OcTree::new(cell_size, 1.0);
    voxels.for_each(|(point, voxel)| tree.insert(point, voxel));
    Ok(structures(cx).octrees.add(OctreeStructure::new(tree)))
}
