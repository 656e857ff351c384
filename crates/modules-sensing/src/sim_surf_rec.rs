//! `simSurfRec`: shapes of point clouds (spec: import 6).

use api_macro::api;
use geometry::Mesh;
use mesh_processing::{SurfaceOptions, surface};

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use scene::shape::Shape;
use scene::{Handle, Kind, SceneError};

/// The module `simSurfRec`.
pub static MODULE: Module = Module {
    about: "Shapes of point clouds.",
    functions: &[("Reconstruction", FUNCTIONS)],
    ..Module::new("simSurfRec")
};

const FUNCTIONS: &[ApiFn] = functions![reconstruct_scale_space];

/// The surface of a point cloud as a new shape: points are moved onto the planes of their neighbours some times, a ball rolls over the smooth points, and
/// the triangles where it rests are those of the shape, with the points as they were.
///
/// Surfaces look up at their highest point. Gaps larger than the ball stay open.
///
/// @param pointCloudHandle the point cloud
/// @param iterations how often the points are made smoother, 0 to 100
/// @param neighbors how many neighbours a point has, 3 to 100
/// @param samples of how many points the distances to their neighbours are measured, for the radius of the ball
/// @param squared_radius square of the radius of the ball, square metres; -1: as measured
/// @return shapeHandle
#[api("simSurfRec.reconstruct_scale_space")]
fn reconstruct_scale_space(
    cx: &mut Cx,
    point_cloud_handle: Handle,
    #[default(4)] iterations: i64,
    #[default(12)] neighbors: i64,
    #[default(300)] samples: i64,
    #[default(-1.0)]
    #[name("squared_radius")]
    squared_radius: f64,
) -> Result<Handle> {
    let options = SurfaceOptions {
        iterations: within("iterations", iterations, [0, 100])?,
        neighbors: within("neighbors", neighbors, [3, 100])?,
        samples: within("samples", samples, [1, 1_000_000])?,
        squared_radius: (squared_radius > 0.0).then_some(squared_radius),
    };
    let (points, pose) = {
        let scene = cx.scene();
        let cloud = scene.object(point_cloud_handle)?.point_cloud()?;
        let points: Vec<[f64; 3]> = cloud.points.iter().map(|point| point.position).collect();
        (points, scene.world_pose(point_cloud_handle)?)
    };
    let (vertices, triangles) = surface(&points, options);
    let mut mesh = Mesh::new(vertices, triangles).map_err(|_| refused("there is no surface."))?;
    let appearance = Shape::mesh_appearance();
    mesh.compute_normals(appearance.shading_angle);
    let shape = Shape::from_mesh(mesh, appearance)?;
    let handle = cx.add_object("surface", Kind::Shape(Box::new(shape)))?;
    cx.scene_mut().set_world_pose(handle, pose)?;
    Ok(handle)
}

fn within(name: &str, number: i64, [least, most]: [i64; 2]) -> Result<usize> {
    if (least..=most).contains(&number) {
        Ok(number as usize)
    } else {
        Err(refused(&format!(
            "'{name}' lies between {least} and {most}."
        )))
    }
}

fn refused(why: &str) -> ApiError {
    SceneError::Refused(why.into()).into()
}
