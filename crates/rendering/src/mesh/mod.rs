//! Triangle meshes prepared for drawing.

pub mod edges;
pub mod tree;

use std::collections::{HashMap, HashSet};
use std::sync::OnceLock;

use nalgebra::Vector3;

use crate::mesh::edges::MeshEdge;
use crate::mesh::tree::LazyTree;

/// Triangles in one cluster.
const CLUSTER_TRIANGLES: usize = 512;

/// A triangle mesh, prepared once and drawn any number of times.
///
/// The triangles are ordered along a space-filling curve and cut into *clusters*: neighbours with vertices of their own and a bounding
/// ball, which are culled and transformed together.
#[derive(Debug, Clone)]
pub struct Mesh {
    pub(crate) vertices: Vec<[f64; 3]>,
    /// The corners of each triangle in its cluster: apart, since most triangles that are looked at are then not drawn.
    pub(crate) corners: Vec<[u16; 3]>,
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) clusters: Vec<Cluster>,
    pub(crate) ball: Ball,
    /// Whether the triangles enclose volumes, seen from outside counter-clockwise: back faces are always hidden by front faces.
    pub(crate) closed: bool,
    /// Found when they are drawn for the first time.
    edges: OnceLock<Vec<MeshEdge>>,
    tree: LazyTree,
}

/// What belongs to each corner of a triangle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Triangle {
    /// Whether the three normals are equal.
    pub is_flat: bool,
    pub normals: [[f32; 3]; 3],
    pub uv: [[f32; 2]; 3],
}

/// Triangles that are close to each other.
#[derive(Debug, Clone)]
pub(crate) struct Cluster {
    /// Ranges in the mesh's lists.
    pub vertices: std::ops::Range<usize>,
    pub triangles: std::ops::Range<usize>,
    pub ball: Ball,
}

/// A ball that encloses something.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Ball {
    pub centre: [f64; 3],
    pub radius: f64,
}

impl Mesh {
    /// From vertices (m), triangles wound counter-clockwise seen from outside, normals (one per corner: 3 per triangle) and texture
    /// coordinates (likewise). Without as many normals as corners, triangles are flat; without as many texture coordinates, these are
    /// zero. Triangles without area, with numbers that are not finite, or with vertices that do not exist, are left out; None where
    /// nothing remains.
    pub fn new(
        vertices: &[[f64; 3]],
        triangles: &[[u32; 3]],
        normals: &[[f64; 3]],
        uv: &[[f32; 2]],
    ) -> Option<Self> {
        let source = Source {
            vertices,
            triangles,
            normals,
            uv,
        };
        let mut order: Vec<usize> = (0..triangles.len())
            .filter(|at| source.has_area(*at))
            .collect();
        if order.is_empty() {
            return None;
        }
        if order.len() > CLUSTER_TRIANGLES {
            source.sort_along_curve(&mut order);
        }
        let ball = Ball::around(
            order
                .iter()
                .flat_map(|at| source.corners(*at).unwrap_or_default()),
        );
        let closed = source.is_closed(&order, ball.centre.into());
        let mut mesh = Self {
            vertices: Vec::new(),
            corners: Vec::new(),
            triangles: Vec::new(),
            clusters: Vec::new(),
            ball,
            closed,
            edges: OnceLock::new(),
            tree: OnceLock::new(),
        };
        order
            .chunks(CLUSTER_TRIANGLES)
            .for_each(|chunk| mesh.add_cluster(&source, chunk));
        Some(mesh)
    }

    pub(crate) fn edges(&self) -> &[MeshEdge] {
        self.edges.get_or_init(|| self.find_edges())
    }

    /// The cluster of a triangle.
    pub(crate) fn cluster_of(&self, triangle: usize) -> &Cluster {
        &self.clusters[triangle / CLUSTER_TRIANGLES]
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "a cluster has fewer than 2^16 corners"
    )]
    fn add_cluster(&mut self, source: &Source, triangles: &[usize]) {
        let (first_vertex, first_triangle) = (self.vertices.len(), self.triangles.len());
        let mut local = HashMap::new();
        for &at in triangles {
            let corners = source.triangles[at].map(|vertex| {
                *local.entry(vertex).or_insert_with(|| {
                    self.vertices.push(source.vertices[numbers::place(vertex)]);
                    (self.vertices.len() - 1 - first_vertex) as u16
                })
            });
            self.corners.push(corners);
            self.triangles.push(source.triangle(at));
        }
        let ball = Ball::around(self.vertices[first_vertex..].iter().copied());
        let (vertices, triangles) = (
            first_vertex..self.vertices.len(),
            first_triangle..self.triangles.len(),
        );
        self.clusters.push(Cluster {
            vertices,
            triangles,
            ball,
        });
    }
}

impl Ball {
    /// Around the middle of the bounding box.
    fn around(points: impl Iterator<Item = [f64; 3]> + Clone) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for point in points.clone() {
            for axis in 0..3 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        let centre = Vector3::from(low) + (Vector3::from(high) - Vector3::from(low)) / 2.0;
        let radius = points
            .map(|point| (Vector3::from(point) - centre).norm())
            .fold(0.0, f64::max);
        Self {
            centre: centre.into(),
            radius: radius * (1.0 + 1e-9),
        }
    }
}

/// The lists that a mesh is made from.
struct Source<'a> {
    vertices: &'a [[f64; 3]],
    triangles: &'a [[u32; 3]],
    normals: &'a [[f64; 3]],
    uv: &'a [[f32; 2]],
}

impl Source<'_> {
    fn corners(&self, at: usize) -> Option<[[f64; 3]; 3]> {
        let vertex = |index: u32| self.vertices.get(numbers::place(index)).copied();
        let [a, b, c] = self.triangles[at].map(vertex);
        Some([a?, b?, c?])
    }

    /// Perpendicular to a triangle, as long as twice its area.
    fn cross(&self, at: usize) -> Option<Vector3<f64>> {
        let [a, b, c] = self.corners(at)?.map(Vector3::from);
        Some((b - a).cross(&(c - a)))
    }

    fn has_area(&self, at: usize) -> bool {
        self.cross(at)
            .is_some_and(|cross| cross.norm_squared() > 0.0 && cross.norm_squared().is_finite())
    }

    fn triangle(&self, at: usize) -> Triangle {
        let face = self.cross(at).unwrap_or_default().normalize();
        let normals =
            [0, 1, 2].map(|corner| self.normal(3 * at + corner, face).map(numbers::single));
        let uv = |corner: usize| {
            let has_uv = self.uv.len() == 3 * self.triangles.len();
            has_uv
                .then(|| self.uv[3 * at + corner])
                .filter(|uv| uv.iter().all(|number| number.is_finite()))
        };
        let is_flat = normals[0] == normals[1] && normals[1] == normals[2];
        Triangle {
            is_flat,
            normals,
            uv: [0, 1, 2].map(|corner| uv(corner).unwrap_or_default()),
        }
    }

    /// The unit normal of a corner; the face's where there is none.
    fn normal(&self, corner: usize, face: Vector3<f64>) -> [f64; 3] {
        let own = (self.normals.len() == 3 * self.triangles.len())
            .then(|| Vector3::from(self.normals[corner]));
        own.and_then(|normal| normal.try_normalize(1e-12))
            .filter(|n| n.iter().all(|x| x.is_finite()))
            .unwrap_or(face)
            .into()
    }

    /// Sorts triangles along the Z-order curve (G. Morton, 1966) of their centres, so that neighbours in the list are neighbours in space.
    fn sort_along_curve(&self, order: &mut [usize]) {
        let ball = Ball::around(
            order
                .iter()
                .flat_map(|at| self.corners(*at).unwrap_or_default()),
        );
        order.sort_by_cached_key(|at| {
            let [a, b, c] = self.corners(*at).unwrap_or_default().map(Vector3::from);
            let centre = (a + b + c) / 3.0 - Vector3::from(ball.centre);
            let cell = |offset: f64| numbers::truncated_u32((offset / ball.radius + 1.0) * 512.0);
            spread_bits(cell(centre.x))
                | spread_bits(cell(centre.y)) << 1
                | spread_bits(cell(centre.z)) << 2
        });
    }

    /// Whether each edge belongs to two triangles that run along it in opposite directions, and each connected part has a positive volume.
    fn is_closed(&self, order: &[usize], origin: Vector3<f64>) -> bool {
        let corners = self.welded(order);
        let mut edges = HashSet::new();
        let sides = corners
            .iter()
            .flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]);
        if !sides.clone().all(|side| edges.insert(side))
            || !sides.clone().all(|(a, b)| edges.contains(&(b, a)))
        {
            return false;
        }
        let parts = geometry::partition(corners.iter().copied());
        let mut volumes = vec![0.0; parts.iter().max().map_or(0, |last| last + 1)];
        for (&at, part) in order.iter().zip(parts) {
            let [a, b, c] = self
                .corners(at)
                .unwrap_or_default()
                .map(|corner| Vector3::from(corner) - origin);
            volumes[part] += a.dot(&b.cross(&c));
        }
        volumes.iter().all(|volume| *volume >= 0.0)
    }

    /// The triangles by numbers of places instead of vertices.
    fn welded(&self, order: &[usize]) -> Vec<[usize; 3]> {
        let mut places = HashMap::new();
        let mut place = |point: [f64; 3]| {
            let next = places.len();
            // Adding zero makes the two zeros one.
            *places
                .entry(point.map(|x| (x + 0.0).to_bits()))
                .or_insert(next)
        };
        order
            .iter()
            .map(|at| self.corners(*at).unwrap_or_default().map(&mut place))
            .collect()
    }
}

/// Moves bit i of the lowest ten bits to bit 3i.
fn spread_bits(number: u32) -> u32 {
    (0..10).map(|bit| (number >> bit & 1) << (3 * bit)).sum()
}
