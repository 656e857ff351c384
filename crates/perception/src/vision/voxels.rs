//! Octrees as cubes, or as points; point clouds.

use std::rc::Rc;

use rendering::{Material, Mesh};

use super::models::{Model, ModelPart, ModelPoints};
use super::palette::Palette;
use super::surfaces::of_colour;
use scene::Pose;
use scene::appearance::colour::Colour;
use scene::voxels::octree::OcTree;
use scene::voxels::point_cloud::PointCloud;

/// Directions of the faces of a cube, and of the two edges around each, so that their cross product points outwards.
const FACES: [[[f64; 3]; 3]; 6] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
];
/// Corners of a face, as factors of the two edges.
const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// Prepared octree.
pub(super) fn octree(octree: &OcTree, colour: &Colour) -> Model {
    if octree.shows_points {
        let points = octree
            .voxels()
            .map(|(centre, voxel)| (centre, voxel.colour));
        return of_points(points.unzip(), octree.point_size as f32, colour);
    }
    Model {
        parts: cubes(octree, colour).into_iter().collect(),
        ..Model::default()
    }
}

/// Prepared point cloud.
pub(super) fn point_cloud(cloud: &PointCloud, colour: &Colour) -> Model {
    let fraction = cloud.display_fraction.clamp(0.0, 1.0);
    // Evenly spread: as many as the fraction of those so far requires.
    let is_shown =
        |at: usize| (fraction * (at + 1) as f64).floor() > (fraction * at as f64).floor();
    let shown = cloud
        .points
        .iter()
        .enumerate()
        .filter(|(at, _)| is_shown(*at));
    let points = shown
        .map(|(_, point)| (point.position, point.colour))
        .unzip();
    of_points(points, cloud.point_size as f32, colour)
}

fn of_points(
    (positions, colours): (Vec<[f64; 3]>, Vec<[u8; 3]>),
    size: f32,
    colour: &Colour,
) -> Model {
    let colours = colours
        .into_iter()
        .map(|colour| colour.map(|part| f32::from(part) / 255.0))
        .collect();
    let points = ModelPoints {
        positions,
        colours,
        auxiliary: vec![colour.auxiliary],
        size,
        overlay: false,
    };
    Model {
        points: Some(points),
        ..Model::default()
    }
}

/// The faces of the voxels that have no neighbour in front. An image holds their colours, a pixel for each.
fn cubes(octree: &OcTree, colour: &Colour) -> Option<ModelPart> {
    let mut palette = Palette::default();
    let (mut vertices, mut triangles, mut coordinates) = (Vec::new(), Vec::new(), Vec::new());
    for (centre, voxel) in octree.voxels() {
        let at = palette.number(voxel.colour);
        for [direction, u, v] in FACES {
            let offset =
                |factors: [f64; 3], length: f64| [0, 1, 2].map(|i| centre[i] + factors[i] * length);
            if octree
                .voxel_at(offset(direction, octree.voxel_size()))
                .is_some()
            {
                continue;
            }
            let first = vertices.len() as u32;
            let corner = |[a, b]: [f64; 2]| [0, 1, 2].map(|i| direction[i] + a * u[i] + b * v[i]);
            vertices
                .extend(CORNERS.map(|factors| offset(corner(factors), octree.voxel_size() / 2.0)));
            triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
            coordinates.extend([at; 6]);
        }
    }
    let uv: Vec<[f32; 2]> = coordinates
        .into_iter()
        .map(|at| palette.place(at))
        .collect();
    let mesh = Rc::new(Mesh::new(&vertices, &triangles, &[], &uv)?);
    let material = Material {
        texture: Some(palette.texture()?),
        ..of_colour(&Colour {
            ambient_diffuse: [1.0; 3],
            ..*colour
        })
    };
    Some(ModelPart {
        mesh,
        material,
        auxiliary: Material::unlit(colour.auxiliary),
        pose: Pose::identity(),
    })
}
