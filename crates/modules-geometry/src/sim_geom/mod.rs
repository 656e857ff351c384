//! `simGeom`: distances and collisions between meshes, octrees, point clouds and primitives that belong to no scene.
//!
//! The queries are those of `proximity`. Structures belong to the script that made them.

mod collisions;
mod distances;
mod element_distances;
mod meshes;
mod octrees;
mod point_clouds;
mod primitives;
mod serialization;
mod structures;

use std::rc::Rc;

use geometry::pose::quaternion_from_array;
use geometry::{Finite, Pose};
use proximity::{Closest, Geometry, Placed, TriangleMesh};

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use scene::SceneError;
use structures::Structures;

/// The module `simGeom`.
pub static MODULE: Module = Module {
    about: "Distances and collisions between meshes, octrees, point clouds and primitives that belong to no scene.",
    functions: &[
        ("Meshes", meshes::FUNCTIONS),
        ("Octrees", octrees::FUNCTIONS),
        ("Point clouds", point_clouds::FUNCTIONS),
        ("Collisions", collisions::FUNCTIONS),
        ("Distances", distances::FUNCTIONS),
        ("Distances to elements", element_distances::FUNCTIONS),
        ("Primitives", primitives::FUNCTIONS),
    ],
    ..Module::new("simGeom")
};

fn structures(cx: &Cx) -> Rc<Structures> {
    cx.script_state()
}

fn invalid_data() -> ApiError {
    SceneError::InvalidData.into()
}

fn refused(why: &str) -> ApiError {
    SceneError::Refused(why.into()).into()
}

/// The points of a flat list of coordinates.
fn points(flat: &[f64]) -> Result<&[[f64; 3]]> {
    let (points, rest) = flat.as_chunks();
    if rest.is_empty() {
        Ok(points)
    } else {
        Err(ApiError::TableSize)
    }
}

fn pose(position: [f64; 3], quaternion: [f64; 4]) -> Result<Pose> {
    let position = position.finite().ok_or_else(invalid_data)?;
    Ok(Pose::from_parts(
        position.into(),
        quaternion_from_array(&quaternion.finite().ok_or_else(invalid_data)?),
    ))
}

/// The frame of a structure; that of the world where nothing else is said.
fn frame(position: Option<[f64; 3]>, quaternion: Option<[f64; 4]>) -> Result<Pose> {
    pose(
        position.unwrap_or_default(),
        quaternion.unwrap_or([0.0, 0.0, 0.0, 1.0]),
    )
}

/// A scale factor.
fn factor(factor: f64) -> Result<f64> {
    if factor.is_finite() && factor > 0.0 {
        Ok(factor)
    } else {
        Err(refused("the factor must be positive."))
    }
}

/// A colour with channels from 0 to 255.
fn colour(channels: [f64; 3]) -> [u8; 3] {
    channels.map(|channel| channel as u8)
}

/// A triangle or a segment in the world.
struct Element(TriangleMesh);

impl Element {
    /// From a corner and the edge vectors to the two others.
    fn triangle(p: [f64; 3], v: [f64; 3], w: [f64; 3]) -> Result<Self> {
        let [a, b, c] = [p, sum(p, v), sum(p, w)];
        let triangle = TriangleMesh::new(&[a, b, c], &[[0, 1, 2]]);
        let edges = || TriangleMesh::of_segments(&[[a, b], [b, c], [c, a]]);
        triangle.or_else(edges).map(Self).ok_or_else(invalid_data)
    }

    /// From an end and the vector to the other one.
    fn segment(end: [f64; 3], vector: [f64; 3]) -> Result<Self> {
        TriangleMesh::of_segments(&[[end, sum(end, vector)]])
            .map(Self)
            .ok_or_else(invalid_data)
    }

    fn placed(&self) -> Placed<'_> {
        Placed {
            geometry: Geometry::Mesh(&self.0),
            pose: Pose::identity(),
        }
    }
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// A point in the world.
fn point(at: [f64; 3]) -> Result<Placed<'static>> {
    Ok(Placed {
        geometry: Geometry::Point,
        pose: pose(at, [0.0, 0.0, 0.0, 1.0])?,
    })
}

/// A point on a thing; nothing where the distance is not smaller than the threshold.
type Place = Option<[f64; 3]>;

/// The closest points, or how far a query looked without a result.
struct Measured {
    distance: f64,
    points: Option<[[f64; 3]; 2]>,
}

/// A distance that is smaller than `threshold`, which counts where it is positive. A structure without content has an infinite distance to anything.
fn measure(a: Option<Placed>, b: Option<Placed>, threshold: f64) -> Measured {
    let limit = if threshold > 0.0 {
        threshold
    } else {
        f64::INFINITY
    };
    match a.zip(b).and_then(|(a, b)| proximity::distance(a, b, limit)) {
        Some(Closest { points, distance }) => Measured {
            distance,
            points: Some(points),
        },
        None => Measured {
            distance: limit,
            points: None,
        },
    }
}

impl Measured {
    /// With both points, and what scripts pass to speed up the next query: it comes back as it is, since queries keep nothing.
    fn results<T>(self, cache: T) -> (f64, Place, Place, Option<T>) {
        let [first, second] = [0, 1].map(|i| self.points.map(|points| points[i]));
        (self.distance, first, second, self.points.map(|_| cache))
    }

    /// With the first point.
    fn results_of_point(self, cache: i64) -> (f64, Place, Option<i64>) {
        let (distance, first, _, cache) = self.results(cache);
        (distance, first, cache)
    }
}

/// The cache of two structures.
fn pair(cache: Option<Vec<i64>>) -> Vec<i64> {
    cache.unwrap_or_else(|| vec![-1, -1])
}
