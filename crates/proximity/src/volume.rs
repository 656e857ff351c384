//! The nearest point of a geometry inside a volume.

use geometry::Pose;

use crate::bounds::Bounds;
use crate::items::Items;
use crate::placed::{Geometry, Placed, Transform};
use crate::points::{ORIGIN, PointSet};
use crate::primitive::{Vector, clip, closest_on_segment};
use crate::ray::{Filter, Hit};
use crate::tree::STACK;

/// This near to a hole (m), a point is outside of it.
const TOUCHING: f64 = 1e-12;

/// A union of convex pieces in the sensor's frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Volume {
    /// They may overlap.
    pub pieces: Vec<Piece>,
}

/// A convex part of a volume, without its holes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Piece {
    /// The piece is where `n.p + d <= 0` for all of its planes `[nx, ny, nz, d]`. A piece without planes is everything.
    pub planes: Vec<[f64; 4]>,
    /// Convex holes: points inside of all planes of one are not in the piece.
    pub holes: Vec<Vec<[f64; 4]>>,
}

/// A piece without holes.
impl FromIterator<[f64; 4]> for Piece {
    fn from_iter<I: IntoIterator<Item = [f64; 4]>>(planes: I) -> Self {
        Self {
            planes: planes.into_iter().collect(),
            holes: Vec::new(),
        }
    }
}

/// The point of a geometry inside the volume that is nearest to the sensor's origin, where it is nearer than `below` (m, may be infinite).
///
/// Triangles and the faces of voxels are cut by the planes of the volume, so that the point need not be the nearest one of a triangle.
/// A triangle whose nearest point is outside of the angle limit of `filter` is not seen. `None` without such a point, and for poses, planes
/// and limits that are not numbers.
pub fn closest_in_volume(
    on: Placed,
    sensor: &Pose,
    volume: &Volume,
    below: f64,
    filter: &Filter,
) -> Option<Hit> {
    let place = on.relative(sensor)?;
    let limit = if below > 0.0 {
        below * below
    } else {
        return None;
    };
    let mut search = Search::new(&place, limit, filter);
    for piece in &volume.pieces {
        search.enter(piece, &place)?;
        match on.geometry {
            Geometry::Mesh(mesh) => {
                search.descend(mesh, |search, i| search.face(&mesh.triangles[i]));
            }
            Geometry::Voxels(grid) => {
                search.descend(grid, |search, i| search.cell(&grid.cells[i], grid.half));
            }
            Geometry::Points(points) => search.points(points),
            Geometry::Point => search.points(&ORIGIN),
        }
        if search.is_done() {
            break;
        }
    }
    let (point, normal) = search.found?;
    let back = place.inverse();
    let (point, distance) = (back.point(&point), search.limit.sqrt());
    Some(Hit {
        point: point.into(),
        normal: (back.rotation * normal).into(),
        distance,
    })
}

/// A plane in the frame of the geometry: inside is where the height is not positive.
#[derive(Debug, Clone, Copy)]
struct Plane {
    normal: Vector,
    offset: f64,
}

impl Plane {
    #[inline]
    fn height(&self, p: &Vector) -> f64 {
        self.normal.dot(p) + self.offset
    }

    /// The heights of the lowest and of the highest point of a box.
    #[inline]
    fn span(&self, bounds: &Bounds) -> [f64; 2] {
        let middle = self.height(&Vector::from(bounds.centre()));
        let half = self.normal.abs().dot(&Vector::from(bounds.half_size()));
        [middle - half, middle + half]
    }
}

/// The search in one piece after the other, in the frame of the geometry.
struct Search<'a> {
    origin: Vector,
    filter: &'a Filter,
    /// Cosine of the angle limit.
    least: f64,
    piece: Vec<Plane>,
    holes: Vec<Vec<Plane>>,
    /// Square of the distance that a point must be nearer than.
    limit: f64,
    found: Option<(Vector, Vector)>,
    /// A polygon before and after a cut.
    polygons: [Vec<Vector>; 2],
}

impl<'a> Search<'a> {
    fn new(place: &Transform, limit: f64, filter: &'a Filter) -> Self {
        let least = filter.max_angle.map_or(0.0, libm::cos);
        let polygons = [Vec::new(), Vec::new()];
        Self {
            origin: place.translation,
            filter,
            least,
            piece: Vec::new(),
            holes: Vec::new(),
            limit,
            found: None,
            polygons,
        }
    }

    /// Brings the planes of a piece to the frame of the geometry; `None` if one is not finite.
    fn enter(&mut self, piece: &Piece, place: &Transform) -> Option<()> {
        placed(&piece.planes, place, &mut self.piece)?;
        self.holes.resize_with(piece.holes.len(), Vec::new);
        let holes = piece.holes.iter().zip(&mut self.holes);
        holes
            .map(|(hole, planes)| placed(hole, place, planes))
            .collect()
    }

    fn is_inside(&self, point: &Vector) -> bool {
        self.piece.iter().all(|plane| plane.height(point) <= 0.0)
    }

    /// Whether a point is in one of the holes from number `first` on.
    fn is_in_hole(&self, first: usize, point: &Vector) -> bool {
        self.holes[first..]
            .iter()
            .any(|hole| hole.iter().all(|plane| plane.height(point) < -TOUCHING))
    }

    /// Whether all of a box is outside of the piece, or in one hole.
    fn misses(&self, bounds: &Bounds) -> bool {
        self.piece.iter().any(|plane| plane.span(bounds)[0] > 0.0)
            || self
                .holes
                .iter()
                .any(|hole| hole.iter().all(|plane| plane.span(bounds)[1] < -TOUCHING))
    }

    fn is_done(&self) -> bool {
        self.filter.any && self.found.is_some()
    }

    /// A lower bound of the square of the distance of what is in a node; infinity where that is outside of the piece.
    #[inline]
    fn bound(&self, things: &impl Items, node: u32) -> f64 {
        let bounds = &things.tree().nodes[node as usize].bounds;
        let upright = bounds.distance_squared_to_point(&self.origin.into());
        if upright >= self.limit || self.misses(bounds) {
            return f64::INFINITY;
        }
        upright.max(
            things
                .oriented_box(node)
                .distance_squared_to_point(&self.origin),
        )
    }

    /// Visits the leaves that reach into the piece, near ones first.
    fn descend(&mut self, things: &impl Items, mut visit: impl FnMut(&mut Self, usize)) {
        let mut waiting = [(0.0, 0); STACK];
        let mut depth = 1;
        let tree = things.tree();
        waiting[0] = (self.bound(things, 0), 0);
        while depth > 0 && !self.is_done() {
            depth -= 1;
            let (bound, node) = waiting[depth];
            if bound >= self.limit {
                continue;
            }
            let node = &tree.nodes[node as usize];
            if node.is_leaf() {
                node.items().for_each(|i| visit(self, i));
                continue;
            }
            let [a, b] = tree
                .children(node)
                .map(|child| (self.bound(things, child), child));
            // The nearer one is on top.
            (waiting[depth], waiting[depth + 1]) = if a.0 <= b.0 { (b, a) } else { (a, b) };
            depth += 2;
        }
    }

    /// Looks at a flat convex polygon.
    fn face(&mut self, corners: &[Vector]) {
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
        let side = (self.origin - corners[0]).dot(&normal);
        if !(side >= 0.0 && self.filter.front || side <= 0.0 && self.filter.back) {
            return;
        }
        let nearest = closest_on_polygon(&self.origin, corners, &normal);
        if (nearest - self.origin).norm_squared() >= self.limit {
            return;
        }
        if self.is_inside(&nearest) && !self.is_in_hole(0, &nearest) {
            return self.offer(nearest, &normal);
        }
        let [mut polygon, mut cut] = std::mem::take(&mut self.polygons);
        polygon.clear();
        polygon.extend_from_slice(corners);
        for plane in &self.piece {
            clip(&polygon, |p| plane.height(p), &mut cut);
            std::mem::swap(&mut polygon, &mut cut);
        }
        self.polygon(&polygon, &normal, 0);
        self.polygons = [polygon, cut];
    }

    /// Looks at a polygon inside of the piece, which may reach into the holes from number `hole` on.
    fn polygon(&mut self, corners: &[Vector], normal: &Vector, hole: usize) {
        if corners.is_empty() {
            return;
        }
        let nearest = closest_on_polygon(&self.origin, corners, normal);
        if (nearest - self.origin).norm_squared() >= self.limit {
            return;
        }
        if !self.is_in_hole(hole, &nearest) {
            return self.offer(nearest, normal);
        }
        self.around_hole(corners, normal, hole);
    }

    /// Looks at the parts of a polygon that are outside of a hole: one behind each of its planes.
    fn around_hole(&mut self, corners: &[Vector], normal: &Vector, hole: usize) {
        let (mut inner, mut cut) = (corners.to_vec(), Vec::new());
        for i in 0..self.holes[hole].len() {
            let plane = self.holes[hole][i];
            if inner.iter().all(|corner| plane.height(corner) <= 0.0) {
                continue;
            }
            clip(&inner, |p| -plane.height(p), &mut cut);
            self.polygon(&cut, normal, hole + 1);
            clip(&inner, |p| plane.height(p), &mut cut);
            std::mem::swap(&mut inner, &mut cut);
            if inner.is_empty() {
                return;
            }
        }
    }

    /// Looks at the six faces of a cell.
    fn cell(&mut self, centre: &Vector, half: f64) {
        for axis in 0..3 {
            for side in [half, -half] {
                let (out, u) = (Vector::ith(axis, side), Vector::ith((axis + 1) % 3, half));
                let v = Vector::ith((axis + 2) % 3, side);
                let middle = centre + out;
                self.face(&[
                    middle - u - v,
                    middle + u - v,
                    middle + u + v,
                    middle - u + v,
                ]);
            }
        }
    }

    fn points(&mut self, points: &PointSet) {
        self.descend(points, |search, i| {
            let point = points.points[i];
            if search.is_inside(&point) && !search.is_in_hole(0, &point) {
                let normal = point - search.origin;
                search.offer(point, &normal);
            }
        });
    }

    /// Keeps a point if it is the nearest one so far and seen at an angle that is allowed.
    fn offer(&mut self, point: Vector, normal: &Vector) {
        let sight = point - self.origin;
        let (squared, normal) = (
            sight.norm_squared(),
            normal.try_normalize(0.0).unwrap_or_default(),
        );
        if squared < self.limit
            && (self.least == 0.0 || normal.dot(&sight).abs() >= self.least * squared.sqrt())
        {
            (self.limit, self.found) = (squared, Some((point, normal)));
        }
    }
}

/// Brings planes to the frame of the geometry; `None` if one is not finite.
fn placed(planes: &[[f64; 4]], place: &Transform, all: &mut Vec<Plane>) -> Option<()> {
    all.clear();
    for plane @ [x, y, z, d] in planes {
        let normal = place.rotation * Vector::new(*x, *y, *z);
        all.push(Plane {
            normal,
            offset: d - normal.dot(&place.translation),
        });
        plane.iter().all(|x| x.is_finite()).then_some(())?;
    }
    Some(())
}

/// The point of a flat convex polygon that is closest to `p`.
fn closest_on_polygon(p: &Vector, corners: &[Vector], normal: &Vector) -> Vector {
    let edges = || corners.iter().zip(corners[1..].iter().chain(corners));
    let is_over = edges().all(|(from, to)| (to - from).cross(&(p - from)).dot(normal) >= 0.0);
    if is_over {
        return p - normal * ((p - corners[0]).dot(normal) / normal.norm_squared());
    }
    let mut best = (f64::INFINITY, corners[0]);
    for (from, to) in edges() {
        let point = closest_on_segment(p, from, to);
        let squared = (point - p).norm_squared();
        if squared < best.0 {
            best = (squared, point);
        }
    }
    best.1
}
