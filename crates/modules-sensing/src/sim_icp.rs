//! `simICP`: where points lie in relation to others (spec: import 6).

use api_macro::api;
use geometry::Pose;
use geometry::pose::pose_to_matrix;
use mesh_processing::{KdTree, register};
use proximity::{Geometry, Placed, TriangleMesh, distance};

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use scene::{Handle, SceneError};

/// The module `simICP`.
pub static MODULE: Module = Module {
    about: "Registration: moves points onto others, or onto a shape.",
    functions: &[("Registration", FUNCTIONS)],
    ..Module::new("simICP")
};

const FUNCTIONS: &[ApiFn] = functions![match_points, match_to_shape];

/// Where an object must be for its points to lie on those of another (iterative closest points).
///
/// The search begins where the objects are, and where their centres and principal axes are the same.
///
/// @param model_handle a point cloud, an octree or a shape, which stays where it is
/// @param template_handle the object that is to be moved: its points, corners or vertices
/// @param outlier_treshold points farther than that from the model do not count, metres; -1: all do
/// @return m matrix of the template, for sim.setObjectMatrix
#[api("simICP.match", snake_case)]
fn match_points(
    cx: &Cx,
    model_handle: Handle,
    template_handle: Handle,
    #[default(-1.0)] outlier_treshold: f64,
) -> Result<[f64; 12]> {
    let model = cx.scene().points_for_hull(model_handle)?;
    let tree = KdTree::new(&model);
    let nearest = |to: [f64; 3]| tree.nearest(to).map(|found| model[found.number as usize]);
    matrix(cx, &model, template_handle, &nearest, outlier_treshold)
}

/// Where an object must be for its points to lie on the surface of a shape.
///
/// @param model_handle the shape, which stays where it is
/// @param template_handle the object that is to be moved: a point cloud, an octree or a shape
/// @param outlier_treshold points farther than that from the shape do not count, metres; -1: all do
/// @return m matrix of the template, for sim.setObjectMatrix
#[api("simICP.matchToShape", snake_case)]
fn match_to_shape(
    cx: &Cx,
    model_handle: Handle,
    template_handle: Handle,
    #[default(-1.0)] outlier_treshold: f64,
) -> Result<[f64; 12]> {
    let mesh = {
        let scene = cx.scene();
        let mut mesh = scene.object(model_handle)?.shape()?.mesh();
        mesh.transform(&scene.world_pose(model_handle)?);
        mesh
    };
    let surface =
        TriangleMesh::new(&mesh.vertices, &mesh.triangles).ok_or(SceneError::InvalidData)?;
    let surface = Placed {
        geometry: Geometry::Mesh(&surface),
        pose: Pose::identity(),
    };
    let nearest = |to: [f64; 3]| {
        let point = Placed {
            geometry: Geometry::Point,
            pose: Pose::translation(to[0], to[1], to[2]),
        };
        Some(distance(surface, point, f64::INFINITY)?.points[0])
    };
    matrix(
        cx,
        &mesh.vertices,
        template_handle,
        &nearest,
        outlier_treshold,
    )
}

fn matrix(
    cx: &Cx,
    model: &[[f64; 3]],
    template: Handle,
    nearest: &dyn Fn([f64; 3]) -> Option<[f64; 3]>,
    outliers: f64,
) -> Result<[f64; 12]> {
    let points = cx.scene().points_for_hull(template)?;
    let outliers = (outliers > 0.0).then_some(outliers);
    let found = register(&points, model, nearest, outliers)
        .ok_or_else(|| ApiError::Other("there are no points.".into()))?;
    Ok(pose_to_matrix(
        &(found.pose * cx.scene().world_pose(template)?),
    ))
}
