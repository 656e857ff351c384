//! Triangle meshes: validated, transformed, boxed. Lengths are in metres.
//!
//! Triangles wind counter-clockwise seen from outside. A [`Mesh`] made by this module is valid: finite
//! vertices, indices in range, three normals per triangle. Rules: SPEC-shapes sections 2 to 4.

use std::collections::{HashMap, HashSet};

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use parry3d_f64::{math::Vector, transformation::try_convex_hull};
use thiserror::Error;

use super::pose::Pose;

/// Most face normals that the search for the tightest box tries, and the points it may look at in all.
const BOX_DIRECTIONS: usize = 200;
const BOX_POINTS: usize = 400_000;

/// Points whose thickness is less than this part of their length count as flat.
const FLATTEST: f64 = 1e-7;

/// Most pairs of points and faces that the check of a hull looks at.
const CHECKED_PAIRS: usize = 20_000_000;

/// A triangle mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Points in the frame of the mesh (m).
    pub vertices: Vec<[f64; 3]>,
    /// Indices of the corners into `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals, one per corner: 3 per triangle. Zero for triangles without area.
    pub normals: Vec<[f64; 3]>,
}

/// A box around a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundingBox {
    /// Full extents along the axes of `pose` (m).
    pub size: [f64; 3],
    /// Centre and axes, in the frame of the mesh.
    pub pose: Pose,
}

/// Why lists of numbers are not a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum MeshError {
    /// No vertex or no triangle.
    #[error("invalid data: a mesh needs vertices and triangles.")]
    Empty,
    /// The vertex list does not hold three numbers per vertex.
    #[error("invalid data: {0} vertex coordinates are not a multiple of 3.")]
    VertexCount(usize),
    /// The index list does not hold three numbers per triangle.
    #[error("invalid data: {0} indices are not a multiple of 3.")]
    IndexCount(usize),
    /// A triangle refers to a vertex that is not there.
    #[error("invalid data: index {index} is not below the vertex count {vertices}.")]
    IndexOutOfRange {
        /// The offending index.
        index: i64,
        /// How many vertices there are.
        vertices: usize,
    },
    /// The normal list does not hold nine numbers per triangle.
    #[error("invalid data: {found} normal coordinates instead of {expected}.")]
    NormalCount {
        /// Numbers given.
        found: usize,
        /// Numbers needed.
        expected: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("invalid data.")]
    NotFinite,
}

impl Mesh {
    /// Mesh with flat normals.
    ///
    /// # Errors
    /// [`MeshError::Empty`], [`MeshError::IndexOutOfRange`] and [`MeshError::NotFinite`].
    pub fn new(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        let count = vertices.len();
        if count == 0 || triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        if !vertices.as_flattened().iter().all(|c| c.is_finite()) {
            return Err(MeshError::NotFinite);
        }
        if let Some(index) = triangles.as_flattened().iter().find(|i| **i as usize >= count) {
            return Err(MeshError::IndexOutOfRange { index: i64::from(*index), vertices: count });
        }
        let mut mesh = Self { vertices, triangles, normals: Vec::new() };
        mesh.compute_normals(0.0);
        Ok(mesh)
    }

    /// Mesh from flat lists as scripts give them: 3n coordinates, 3m indices from 0, 9m normal coordinates.
    /// Without normals they are flat.
    ///
    /// # Errors
    /// Every variant of [`MeshError`].
    pub fn from_flat(vertices: &[f64], indices: &[i64], normals: Option<&[f64]>) -> Result<Self, MeshError> {
        let points = vertices.as_chunks().0.to_vec();
        if !vertices.len().is_multiple_of(3) {
            return Err(MeshError::VertexCount(vertices.len()));
        }
        if !indices.len().is_multiple_of(3) {
            return Err(MeshError::IndexCount(indices.len()));
        }
        let error = |index| MeshError::IndexOutOfRange { index, vertices: points.len() };
        let corners = indices.iter().map(|i| u32::try_from(*i).map_err(|_| error(*i)));
        let corners = corners.collect::<Result<Vec<u32>, _>>()?;
        let mut mesh = Self::new(points, corners.as_chunks().0.to_vec())?;
        if let Some(normals) = normals {
            mesh.set_normals(normals)?;
        }
        Ok(mesh)
    }

    /// Normals, 9 numbers per triangle.
    ///
    /// # Errors
    /// [`MeshError::NormalCount`] when there are too few, [`MeshError::NotFinite`].
    pub fn set_normals(&mut self, normals: &[f64]) -> Result<(), MeshError> {
        let (found, expected) = (normals.len(), 9 * self.triangles.len());
        let used = normals.get(..expected).ok_or(MeshError::NormalCount { found, expected })?;
        if !used.iter().all(|c| c.is_finite()) {
            return Err(MeshError::NotFinite);
        }
        self.normals = used.as_chunks().0.to_vec();
        Ok(())
    }

    /// 3n coordinates.
    pub fn flat_vertices(&self) -> Vec<f64> {
        self.vertices.as_flattened().to_vec()
    }

    /// 3m indices.
    pub fn flat_indices(&self) -> Vec<i64> {
        self.triangles.as_flattened().iter().map(|i| i64::from(*i)).collect()
    }

    /// 9m normal coordinates.
    pub fn flat_normals(&self) -> Vec<f64> {
        self.normals.as_flattened().to_vec()
    }

    /// Makes one vertex of those closer than about `tolerance` (m; 0: equal ones), drops triangles that
    /// collapse and repeated triangles of the same winding. Vertices keep the order of their first use.
    pub fn merge_duplicates(&mut self, tolerance: f64) {
        let cell = |c: f64| Some((c / tolerance).round()).filter(|k| tolerance > 0.0 && k.is_finite()).unwrap_or(c);
        let mut kept = Vec::new();
        let mut seen = HashMap::new();
        let mut place = |v: &[f64; 3]| {
            *seen.entry(v.map(|c| (cell(c) + 0.0).to_bits())).or_insert_with(|| {
                kept.push(*v);
                kept.len() as u32 - 1
            })
        };
        let map: Vec<u32> = self.vertices.iter().map(&mut place).collect();
        self.vertices = kept;
        self.keep_distinct_triangles(&map);
    }

    /// Recomputes the normals. Corners of triangles that share a vertex and differ by less than
    /// `shading_angle` (rad) get the mean of their face normals, weighted by area; 0 gives flat normals.
    pub fn compute_normals(&mut self, shading_angle: f64) {
        let areas: Vec<_> = self.triangles.iter().map(|t| self.area_vector(t)).collect();
        let faces: Vec<_> = areas.iter().map(|a| a.try_normalize(0.0).unwrap_or_default()).collect();
        let mut users = vec![Vec::new(); if shading_angle > 0.0 { self.vertices.len() } else { 0 }];
        if shading_angle > 0.0 {
            let corners = self.triangles.iter().enumerate().flat_map(|(t, c)| c.map(|v| (t, v)));
            corners.for_each(|(t, v)| users[v as usize].push(t));
        }
        let smooth = |face: usize, vertex: u32| {
            let near = |other: &&usize| faces[face].dot(&faces[**other]) > shading_angle.cos();
            let sum: Vector3<f64> = users[vertex as usize].iter().filter(near).map(|o| areas[*o]).sum();
            sum.try_normalize(0.0).unwrap_or(faces[face])
        };
        let corner = |face, vertex| if shading_angle > 0.0 { smooth(face, vertex) } else { faces[face] };
        let corners = self.triangles.iter().enumerate().flat_map(|(f, t)| t.map(|v| corner(f, v).into()));
        self.normals = corners.collect();
    }

    /// Moves the mesh: `pose` is where its frame goes.
    pub fn transform(&mut self, pose: &Pose) {
        self.vertices.iter_mut().for_each(|v| *v = moved(pose, v));
        self.normals.iter_mut().for_each(|n| *n = (pose.rotation * Vector3::from(*n)).into());
    }

    /// Scales about the origin; a mirroring keeps the outside outside. The normals become flat when the
    /// factors differ.
    pub fn scale(&mut self, factors: [f64; 3]) {
        self.vertices.iter_mut().for_each(|v| *v = [0, 1, 2].map(|i| v[i] * factors[i]));
        if factors.iter().product::<f64>() < 0.0 {
            self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        if factors[0] != factors[1] || factors[0] != factors[2] || factors[0] < 0.0 {
            self.compute_normals(0.0);
        }
    }

    /// Adds `other`, whose frame lies at `pose`.
    pub fn append(&mut self, other: &Mesh, pose: &Pose) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(other.vertices.iter().map(|v| moved(pose, v)));
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + first)));
        let rotated = |n: &[f64; 3]| <[f64; 3]>::from(pose.rotation * Vector3::from(*n));
        self.normals.extend(other.normals.iter().map(rotated));
    }

    /// Smallest and largest corner along the axes of the mesh frame; `None` without vertices.
    pub fn aabb(&self) -> Option<([f64; 3], [f64; 3])> {
        let first = *self.vertices.first()?;
        let grow = |(low, high): ([f64; 3], [f64; 3]), v: &[f64; 3]| {
            ([0, 1, 2].map(|i| low[i].min(v[i])), [0, 1, 2].map(|i| high[i].max(v[i])))
        };
        Some(self.vertices.iter().fold((first, first), grow))
    }

    /// The box with the given axes (relative to the mesh frame); `None` without vertices.
    pub fn bounding_box(&self, orientation: &UnitQuaternion<f64>) -> Option<BoundingBox> {
        box_around(&self.points(), orientation)
    }

    /// The tightest box found, its size in the order x <= y <= z; `None` without vertices.
    ///
    /// Tries the axes of the frame, then boxes with one side flush with a face of the convex hull and
    /// another flush with an edge of the outline seen along it.
    pub fn oriented_box(&self) -> Option<BoundingBox> {
        let hull = Self::convex_hull(&self.vertices);
        let source = hull.as_ref().unwrap_or(self);
        let points = source.points();
        let identity = box_around(&points, &UnitQuaternion::identity())?;
        let frames = source.face_directions().into_iter().filter_map(|d| flush_frame(&points, &d));
        let boxes = frames.filter_map(|f| box_around(&points, &UnitQuaternion::from_rotation_matrix(&f)));
        let tightest = boxes.fold(identity, |best, b| if tighter(&b, &best) { b } else { best });
        let ordered = sorted_axes(&tightest);
        self.bounding_box(&ordered)
    }

    /// Enclosed volume (m3): positive for a closed mesh that winds outward.
    pub fn volume(&self) -> f64 {
        let origin = self.vertices.first().map_or(Vector3::zeros(), |v| Vector3::from(*v));
        let corners = self.triangles.iter().map(|t| self.corners(t).map(|c| c - origin));
        corners.map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0).sum()
    }

    /// Whether the mesh is closed, in one piece without holes, and nowhere dented.
    pub fn is_convex(&self) -> bool {
        let edges = self.triangles.iter().flat_map(|t| (0..3).map(|i| ((t[i], t[(i + 1) % 3]), t[(i + 2) % 3])));
        let opposite: HashMap<(u32, u32), u32> = edges.collect();
        let used: HashSet<u32> = self.triangles.as_flattened().iter().copied().collect();
        let (half_edges, faces) = (3 * self.triangles.len(), self.triangles.len());
        let closed = opposite.len() == half_edges && used.len() + faces == half_edges / 2 + 2;
        closed && self.volume() > 0.0 && self.triangles.iter().all(|t| self.is_ridge(t, &opposite))
    }

    /// Convex hull of points; `None` for fewer than 4 points, points in a plane or not finite ones.
    ///
    /// parry's hull sometimes cuts off points that crowd near a plane, so its answer is checked and asked for
    /// again with points merged more and more coarsely, up to 0.1 % of the size of the cloud.
    pub fn convex_hull(points: &[[f64; 3]]) -> Option<Mesh> {
        if !points.as_flattened().iter().all(|c| c.is_finite()) {
            return None;
        }
        let cloud = spread(points)?;
        let hulls = [0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3].into_iter().filter_map(|grid| {
            let (source, hull) = hull_of_cloud(&cloud, grid)?;
            let vertices = source.iter().map(|i| points[*i]).collect();
            let mesh = Mesh::new(vertices, hull.triangles.clone()).ok()?;
            (hull.encloses(&cloud, 1e-9 + 4.0 * grid) && mesh.volume() > 0.0).then_some(mesh)
        });
        hulls.into_iter().next()
    }

    /// Whether the mesh is closed and has the points inside, to within `tolerance` (m). Of many points a part
    /// is looked at.
    fn encloses(&self, points: &[[f64; 3]], tolerance: f64) -> bool {
        let edges: HashSet<_> = self.triangles.iter().flat_map(|t| (0..3).map(|i| (t[i], t[(i + 1) % 3]))).collect();
        let closed = edges.len() == 3 * self.triangles.len() && edges.iter().all(|(a, b)| edges.contains(&(*b, *a)));
        let stride = 1 + points.len() * self.triangles.len() / CHECKED_PAIRS;
        let outside = |t: &[u32; 3]| {
            let [a, ..] = self.corners(t);
            let normal = self.area_vector(t).try_normalize(0.0).unwrap_or_default();
            points.iter().step_by(stride).any(|p| normal.dot(&(Vector3::from(*p) - a)) > tolerance)
        };
        closed && !self.triangles.iter().any(outside)
    }

    fn keep_distinct_triangles(&mut self, map: &[u32]) {
        let mut seen = HashSet::new();
        let (mut triangles, mut normals) = (Vec::new(), Vec::new());
        for (t, n) in self.triangles.iter().zip(self.normals.as_chunks::<3>().0) {
            let mut turned = t.map(|i| map[i as usize]);
            let kept = turned;
            let lowest = (0..3).min_by_key(|i| turned[*i]).unwrap_or(0);
            turned.rotate_left(lowest);
            if kept[0] != kept[1] && kept[1] != kept[2] && kept[2] != kept[0] && seen.insert(turned) {
                triangles.push(kept);
                normals.extend(n);
            }
        }
        (self.triangles, self.normals) = (triangles, normals);
    }

    fn points(&self) -> Vec<Vector3<f64>> {
        self.vertices.iter().map(|v| Vector3::from(*v)).collect()
    }

    fn corners(&self, triangle: &[u32; 3]) -> [Vector3<f64>; 3] {
        triangle.map(|i| Vector3::from(self.vertices[i as usize]))
    }

    fn area_vector(&self, triangle: &[u32; 3]) -> Vector3<f64> {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(&(c - a))
    }

    /// Whether the neighbours of a triangle bend away from its outside.
    fn is_ridge(&self, t: &[u32; 3], opposite: &HashMap<(u32, u32), u32>) -> bool {
        let Some(normal) = self.area_vector(t).try_normalize(0.0) else { return false };
        let [a, ..] = self.corners(t);
        (0..3).all(|i| {
            let Some(far) = opposite.get(&(t[(i + 1) % 3], t[i])) else { return false };
            let offset = Vector3::from(self.vertices[*far as usize]) - a;
            normal.dot(&offset) <= 1e-6 * offset.norm()
        })
    }

    /// Distinct face normals, those of large faces first.
    fn face_directions(&self) -> Vec<Vector3<f64>> {
        let mut areas: Vec<_> = self.triangles.iter().map(|t| self.area_vector(t)).collect();
        areas.sort_by(|a, b| b.norm_squared().total_cmp(&a.norm_squared()));
        let most = (BOX_POINTS / self.vertices.len().max(1)).clamp(10, BOX_DIRECTIONS);
        let mut found: Vec<Vector3<f64>> = Vec::new();
        for direction in areas.iter().filter_map(|a| a.try_normalize(0.0)) {
            if found.len() < most && found.iter().all(|f| f.dot(&direction).abs() < 1.0 - 1e-9) {
                found.push(direction);
            }
        }
        found
    }
}

fn moved(pose: &Pose, v: &[f64; 3]) -> [f64; 3] {
    (pose.rotation * Vector3::from(*v) + pose.translation.vector).into()
}

fn box_around(points: &[Vector3<f64>], orientation: &UnitQuaternion<f64>) -> Option<BoundingBox> {
    let back = orientation.inverse().to_rotation_matrix();
    let turned = points.iter().map(|p| back * p);
    let (low, high) = turned.fold(None, |range: Option<(Vector3<f64>, Vector3<f64>)>, p| {
        Some(range.map_or((p, p), |(low, high)| (low.inf(&p), high.sup(&p))))
    })?;
    let centre = orientation * (low + (high - low) * 0.5);
    Some(BoundingBox { size: (high - low).into(), pose: Pose::from_parts(centre.into(), *orientation) })
}

/// Smaller volume by more than rounding, or among flat boxes the smaller surface.
fn tighter(a: &BoundingBox, b: &BoundingBox) -> bool {
    let volume = |s: &[f64; 3]| s[0] * s[1] * s[2];
    let surface = |s: &[f64; 3]| s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
    let largest = b.size.iter().fold(0.0_f64, |m, s| m.max(*s));
    let gain = volume(&b.size) - volume(&a.size);
    let flat = gain.abs() <= 1e-9 * largest.powi(3);
    gain > 1e-9 * largest.powi(3) || flat && surface(&a.size) < surface(&b.size) * (1.0 - 1e-9)
}

/// The orientation of a box with its axes reordered to size x <= y <= z.
fn sorted_axes(b: &BoundingBox) -> UnitQuaternion<f64> {
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| b.size[*i].total_cmp(&b.size[*j]));
    if order == [0, 1, 2] {
        return b.pose.rotation;
    }
    let axes = b.pose.rotation.to_rotation_matrix();
    let (x, y) = (axes.matrix().column(order[0]).into_owned(), axes.matrix().column(order[1]).into_owned());
    let sorted = Matrix3::from_columns(&[x, y, x.cross(&y)]);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(sorted))
}

/// Axes of the tightest box with one axis along `direction`.
fn flush_frame(points: &[Vector3<f64>], direction: &Vector3<f64>) -> Option<Rotation3<f64>> {
    let u = direction.cross(&Vector3::ith(direction.iamin(), 1.0)).try_normalize(0.0)?;
    let v = direction.cross(&u);
    let outline = outline(points.iter().map(|p| [p.dot(&u), p.dot(&v)]).collect());
    let area = |s: &[f64; 2]| {
        let extent = |x: f64, y: f64| {
            let along = outline.iter().map(|p| p[0] * x + p[1] * y);
            let (low, high) = along.fold((f64::MAX, f64::MIN), |(l, h), d| (l.min(d), h.max(d)));
            high - low
        };
        extent(s[0], s[1]) * extent(-s[1], s[0])
    };
    let side = |(a, b): (&[f64; 2], &[f64; 2])| {
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let length = x.hypot(y);
        (length > 0.0).then(|| [x / length, y / length])
    };
    let sides = outline.iter().zip(outline.iter().cycle().skip(1)).filter_map(side);
    let best = sides.map(|s| (area(&s), s)).min_by(|a, b| a.0.total_cmp(&b.0))?.1;
    let x = u * best[0] + v * best[1];
    Some(Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, direction.cross(&x), *direction])))
}

/// Convex outline of points in a plane, counter-clockwise.
fn outline(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turn = |a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && turn(&a, &b, &p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = chain(&mut points.iter().copied());
    lower.extend(chain(&mut points.iter().rev().copied()));
    lower
}

/// The points in skewed axes in which the cloud is about as wide in all directions, which leaves hulls as
/// they are; `None` when they do not span space.
fn spread(points: &[[f64; 3]]) -> Option<Vec<[f64; 3]>> {
    let offset = |p: &[f64; 3]| Vector3::from(*p) - Vector3::from(points[0]);
    let farthest = |part: &dyn Fn(Vector3<f64>) -> Vector3<f64>| {
        let parts = points.iter().map(|p| part(offset(p)));
        let widest = parts.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        Some((widest.try_normalize(0.0)?, widest.norm()))
    };
    let (x, length) = farthest(&|d| d)?;
    let (y, width) = farthest(&|d| d - x * x.dot(&d))?;
    let z = x.cross(&y);
    let thickness = points.iter().map(|p| z.dot(&offset(p)).abs()).fold(0.0, f64::max);
    let spatial = length.is_finite() && width.min(thickness) > FLATTEST * length;
    let scaled = |d: Vector3<f64>| [x.dot(&d) / length, y.dot(&d) / width, z.dot(&d) / thickness];
    spatial.then(|| points.iter().map(|p| scaled(offset(p))).collect())
}

/// Hull of the points of a cloud that differ on a grid, and which points its vertices are.
fn hull_of_cloud(cloud: &[[f64; 3]], grid: f64) -> Option<(Vec<usize>, Mesh)> {
    let mut seen = HashSet::new();
    let cells = cloud.iter().map(|p| p.map(|c| (c / grid.max(1e-9)).round() as i64)).enumerate();
    let kept: Vec<usize> = cells.filter(|(_, cell)| seen.insert(*cell)).map(|(i, _)| i).collect();
    let distinct: Vec<Vector> = kept.iter().map(|i| shaken(cloud[*i], grid)).collect();
    let (vertices, triangles) = try_convex_hull(&distinct).ok()?;
    let key = |v: &Vector| v.to_array().map(f64::to_bits);
    let index: HashMap<_, _> = distinct.iter().map(key).zip(kept).collect();
    let source = vertices.iter().map(|v| index.get(&key(v)).copied()).collect::<Option<_>>()?;
    let mesh = Mesh::new(vertices.iter().map(Vector::to_array).collect(), triangles).ok()?;
    Some((source, mesh))
}

/// A point moved by up to `size`, always in the same way, so that few points share a plane.
fn shaken(p: [f64; 3], size: f64) -> Vector {
    let phase = 1e3 * (1.3 * p[0] + 1.7 * p[1] + 2.3 * p[2]);
    Vector::from_array([0, 1, 2].map(|i| p[i] + size * (phase * (1.0 + i as f64)).sin()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNER: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];

    fn tetrahedron() -> Mesh {
        Mesh::new(CORNER.to_vec(), vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).expect("valid")
    }

    fn block(size: [f64; 3]) -> Mesh {
        let corner = |i: u32| [0, 1, 2].map(|a| size[a] * (f64::from(i >> a & 1) - 0.5));
        Mesh::convex_hull(&(0..8).map(corner).collect::<Vec<_>>()).expect("spans space")
    }

    #[track_caller]
    fn close(a: &[f64], b: &[f64]) {
        assert!(a.len() == b.len() && a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-9), "{a:?} is not {b:?}");
    }

    #[test]
    fn flat_lists_are_checked() {
        let new = |v: &[f64], i: &[i64]| Mesh::from_flat(v, i, None).map(|m| m.triangles.len());
        let v = [0., 0., 0., 1., 0., 0., 0., 1., 0.];
        assert_eq!(new(&v, &[0, 1, 2]), Ok(1));
        assert_eq!(new(&v[..8], &[0, 1, 2]), Err(MeshError::VertexCount(8)));
        assert_eq!(new(&v, &[0, 1]), Err(MeshError::IndexCount(2)));
        assert_eq!(new(&v, &[0, 1, 3]), Err(MeshError::IndexOutOfRange { index: 3, vertices: 3 }));
        assert_eq!(new(&v, &[0, 1, -1]), Err(MeshError::IndexOutOfRange { index: -1, vertices: 3 }));
        assert_eq!(new(&[], &[]), Err(MeshError::Empty));
        assert_eq!(new(&[f64::NAN, 0., 0.], &[0, 0, 0]), Err(MeshError::NotFinite));
        let normals = Mesh::from_flat(&v, &[0, 1, 2], Some(&[1.0; 8])).err();
        assert_eq!(normals, Some(MeshError::NormalCount { found: 8, expected: 9 }));
    }

    #[test]
    fn duplicates_merge() {
        let mut soup = tetrahedron();
        soup.append(&tetrahedron(), &Pose::translation(1e-9, 0.0, 0.0));
        soup.merge_duplicates(1e-6);
        assert_eq!((soup.vertices.len(), soup.triangles.len(), soup.normals.len()), (4, 4, 12));
        soup.vertices[0] = [-0.0, 0.0, 0.0];
        soup.append(&tetrahedron(), &Pose::identity());
        soup.merge_duplicates(0.0);
        assert_eq!(soup.vertices.len(), 4);
        soup.merge_duplicates(1e9);
        assert!(soup.triangles.is_empty());
    }

    #[test]
    fn convexity_and_volume() {
        close(&[tetrahedron().volume(), block([1., 2., 4.]).volume()], &[1.0 / 6.0, 8.0]);
        assert!(tetrahedron().is_convex() && block([1., 2., 4.]).is_convex());
        let mut two = tetrahedron();
        two.append(&tetrahedron(), &Pose::translation(3., 0., 0.));
        assert!(!two.is_convex());
        let mut dented = block([1., 1., 1.]);
        dented.vertices[0] = [0.1, 0.1, 0.1];
        assert!(!dented.is_convex());
        let mut mirrored = tetrahedron();
        mirrored.scale([-1., 2., 3.]);
        close(&[mirrored.volume()], &[1.0]);
    }

    #[test]
    fn tightest_box_is_ordered_and_found_when_rotated() {
        let frame = Pose::new(Vector3::new(2., 1.5, 3.), Vector3::new(0.3, -0.7, 1.1));
        let mut mesh = block([2., 1., 4.]);
        close(&mesh.oriented_box().expect("not empty").size, &[1., 2., 4.]);
        mesh.transform(&frame);
        let found = mesh.oriented_box().expect("not empty");
        close(&found.size, &[1., 2., 4.]);
        close(&<[f64; 3]>::from(found.pose.translation.vector), &[2., 1.5, 3.]);
        close(&mesh.bounding_box(&frame.rotation).expect("not empty").size, &[2., 1., 4.]);
    }

    #[test]
    fn flat_and_empty_meshes_have_boxes_too() {
        let corners = vec![[0., 0., 0.], [3., 0., 0.], [3., 1., 0.], [0., 1., 0.]];
        let mut flat = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("valid");
        flat.transform(&Pose::new(Vector3::zeros(), Vector3::new(1., 2., 3.)));
        close(&flat.oriented_box().expect("not empty").size, &[0., 1., 3.]);
        let point = Mesh::new(vec![[1., 2., 3.]], vec![[0, 0, 0]]).expect("valid");
        close(&point.oriented_box().expect("not empty").size, &[0.; 3]);
        assert_eq!(Mesh::default().oriented_box(), None);
    }

    #[test]
    fn hulls_need_volume() {
        let hull = Mesh::convex_hull(&[&CORNER[..], &[[0.1, 0.1, 0.1], [1., 0., 0.]]].concat()).expect("spans space");
        assert_eq!((hull.vertices.len(), hull.triangles.len()), (4, 4));
        let bad = [[f64::NAN, 0., 0.], [f64::INFINITY, 0., 0.], [0.5, 0.5, 0.0]];
        for fourth in bad {
            assert_eq!(Mesh::convex_hull(&[CORNER[0], CORNER[1], CORNER[2], fourth]), None);
        }
        assert_eq!(Mesh::convex_hull(&[]), None);
    }

    #[test]
    fn shading_smooths_below_the_angle() {
        let mut cube = block([1., 1., 1.]);
        cube.compute_normals(0.5);
        assert!(cube.normals.iter().all(|n| n.iter().any(|c| c.abs() > 0.999)));
        cube.compute_normals(2.0);
        assert!(cube.normals.iter().all(|n| n.iter().all(|c| c.abs() < 0.95)));
    }
}
