//! Meshes: made, copied, scaled, stored and destroyed.

use api_macro::api;
use geometry::{Mesh, MeshError};

use super::structures::MeshStructure;
use super::{
    ApiFn, Cx, Result, factor, frame, functions, invalid_data, refused, serialization, structures,
};
use script::Bytes;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_mesh,
    copy_mesh,
    scale_mesh,
    destroy_mesh,
    get_mesh_serialization_data,
    create_mesh_from_serialization_data,
];

/// Makes a mesh. It belongs to this script and ends with it.
///
/// @param vertices three coordinates each, in the world, metres
/// @param indices three of each triangle, from 0
/// @param meshOriginPos where the mesh has its frame; queries place that frame
/// @param meshOriginQuaternion how the frame is turned
/// @param maxTriangleEdgeLength without effect
/// @param maxTriangleCountInLeafObb without effect
/// @return meshHandle
#[api("simGeom.createMesh")]
fn create_mesh(
    cx: &Cx,
    vertices: Vec<f64>,
    indices: Vec<i64>,
    mesh_origin_pos: Option<[f64; 3]>,
    mesh_origin_quaternion: Option<[f64; 4]>,
    #[default(0.3)] max_triangle_edge_length: f64,
    #[default(8)] max_triangle_count_in_leaf_obb: i64,
) -> Result<i64> {
    let _ = (max_triangle_edge_length, max_triangle_count_in_leaf_obb);
    let frame = frame(mesh_origin_pos, mesh_origin_quaternion)?;
    let mut mesh = Mesh::from_flat(&vertices, &indices, None).map_err(|error| match error {
        MeshError::NotFinite => invalid_data(),
        other => refused(&other.to_string()),
    })?;
    mesh.transform(&frame.inverse());
    Ok(structures(cx).meshes.add(MeshStructure::new(mesh)))
}

/// Copies a mesh.
///
/// @param meshHandle the mesh
/// @return meshCopyHandle
#[api("simGeom.copyMesh")]
fn copy_mesh(cx: &Cx, mesh_handle: i64) -> Result<i64> {
    let meshes = &structures(cx).meshes;
    let mesh = meshes.get(mesh_handle)?.mesh.clone();
    Ok(meshes.add(MeshStructure::new(mesh)))
}

/// Scales a mesh about the origin of its frame.
///
/// @param meshHandle the mesh
/// @param scaleFactor positive
#[api("simGeom.scaleMesh")]
fn scale_mesh(cx: &Cx, mesh_handle: i64, scale_factor: f64) -> Result<()> {
    let meshes = &structures(cx).meshes;
    let mut mesh = meshes.get(mesh_handle)?.mesh.clone();
    mesh.scale([factor(scale_factor)?; 3]);
    meshes.replace(mesh_handle, MeshStructure::new(mesh));
    Ok(())
}

/// Destroys a mesh.
///
/// @param meshHandle the mesh
#[api("simGeom.destroyMesh")]
fn destroy_mesh(cx: &Cx, mesh_handle: i64) -> Result<()> {
    structures(cx).meshes.remove(mesh_handle)
}

/// A mesh as bytes. The format is Swanilda's own.
///
/// @param meshHandle the mesh
/// @return data
#[api("simGeom.getMeshSerializationData")]
fn get_mesh_serialization_data(cx: &Cx, mesh_handle: i64) -> Result<Bytes> {
    serialization::of_mesh(&structures(cx).meshes.get(mesh_handle)?.mesh).map(Bytes)
}

/// The mesh that simGeom.getMeshSerializationData stored.
///
/// @param data the bytes
/// @return meshHandle
#[api("simGeom.createMeshFromSerializationData")]
fn create_mesh_from_serialization_data(cx: &Cx, data: Bytes) -> Result<i64> {
    Ok(structures(cx)
        .meshes
        .add(MeshStructure::new(serialization::to_mesh(&data.0)?)))
}
