//! The surface that is decimated: which triangles are around a vertex, and whether an edge may become one.

use nalgebra::Vector3;

use super::Triangles;
use super::quadric::Quadric;

/// How much more a border counts than the triangle beside it: it stays where it is, nearly.
const BORDER_WEIGHT: f64 = 100.0;
/// The cosine of the largest angle by which a collapse may turn a triangle.
const MIN_TURN_COSINE: f64 = 0.2;

pub(super) struct Surface {
    points: Vec<Vector3<f64>>,
    quadrics: Vec<Quadric>,
    /// How often a vertex has changed; None once it is gone or was never used.
    versions: Vec<Option<u32>>,
    triangles: Vec<[u32; 3]>,
    is_alive: Vec<bool>,
    /// The triangles of each vertex, with some that are gone.
    around: Vec<Vec<u32>>,
    alive_triangles: usize,
    alive_vertices: usize,
}

impl Surface {
    pub(super) fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Self {
        let is_alive: Vec<bool> = triangles
            .iter()
            .map(|[a, b, c]| a != b && b != c && c != a)
            .collect();
        let mut around = vec![Vec::new(); vertices.len()];
        for (number, triangle) in triangles
            .iter()
            .enumerate()
            .filter(|(number, _)| is_alive[*number])
        {
            triangle.iter().for_each(|vertex| {
                around[numbers::place(*vertex)].push(numbers::count_u32(number));
            });
        }
        let versions: Vec<Option<u32>> = around
            .iter()
            .map(|triangles| (!triangles.is_empty()).then_some(0))
            .collect();
        let mut surface = Self {
            points: vertices
                .iter()
                .map(|vertex| Vector3::from(*vertex))
                .collect(),
            quadrics: vec![Quadric::default(); vertices.len()],
            alive_triangles: is_alive.iter().filter(|is_alive| **is_alive).count(),
            alive_vertices: versions.iter().flatten().count(),
            triangles: triangles.to_vec(),
            versions,
            is_alive,
            around,
        };
        surface.add_quadrics();
        surface
    }

    pub(super) fn triangle_count(&self) -> usize {
        self.alive_triangles
    }

    pub(super) fn vertex_count(&self) -> usize {
        self.alive_vertices
    }

    pub(super) fn version(&self, vertex: u32) -> Option<u32> {
        self.versions[numbers::place(vertex)]
    }

    /// All edges, each with the smaller number first.
    pub(super) fn edges(&self) -> Vec<[u32; 2]> {
        let mut edges: Vec<[u32; 2]> = self
            .edge_users()
            .into_iter()
            .map(|(edge, _)| edge)
            .collect();
        edges.dedup();
        edges
    }

    /// The edges of all triangles, in order, with the triangle.
    fn edge_users(&self) -> Vec<([u32; 2], u32)> {
        let mut users = Vec::with_capacity(3 * self.alive_triangles);
        for (number, triangle) in self
            .triangles
            .iter()
            .enumerate()
            .filter(|(number, _)| self.is_alive[*number])
        {
            for k in 0..3 {
                let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                users.push(([a.min(b), a.max(b)], numbers::count_u32(number)));
            }
        }
        users.sort_unstable();
        users
    }

    /// The plane of each triangle counts for its corners; at borders a plane that stands on it, too.
    fn add_quadrics(&mut self) {
        for number in 0..self.triangles.len() {
            let triangle = self.triangles[number];
            let area = self.area_vector(&triangle);
            let Some(normal) = area.try_normalize(0.0).filter(|_| self.is_alive[number]) else {
                continue;
            };
            let plane = Quadric::plane(
                &normal,
                &self.points[numbers::place(triangle[0])],
                area.norm(),
            );
            triangle
                .iter()
                .for_each(|vertex| self.quadrics[numbers::place(*vertex)].add(&plane));
        }
        for same in self.edge_users().chunk_by(|a, b| a.0 == b.0) {
            let &[(edge, triangle)] = same else { continue };
            let [a, b] = edge.map(|vertex| self.points[numbers::place(vertex)]);
            let area = self.area_vector(&self.triangles[numbers::place(triangle)]);
            let Some(normal) = (b - a).cross(&area).try_normalize(0.0) else {
                continue;
            };
            let plane = Quadric::plane(&normal, &a, BORDER_WEIGHT * (b - a).norm_squared());
            edge.iter()
                .for_each(|vertex| self.quadrics[numbers::place(*vertex)].add(&plane));
        }
    }

    fn area_vector(&self, triangle: &[u32; 3]) -> Vector3<f64> {
        let [a, b, c] = triangle.map(|vertex| self.points[numbers::place(vertex)]);
        (b - a).cross(&(c - a))
    }

    fn triangles_of(&self, vertex: u32) -> impl Iterator<Item = &[u32; 3]> {
        let alive = self.around[numbers::place(vertex)]
            .iter()
            .filter(|number| self.is_alive[numbers::place(**number)]);
        alive.map(|number| &self.triangles[numbers::place(*number)])
    }

    /// The vertices that share an edge with a vertex, some of them twice.
    fn neighbours(&self, vertex: u32) -> impl Iterator<Item = u32> {
        self.triangles_of(vertex)
            .flat_map(|triangle| *triangle)
            .filter(move |other| *other != vertex)
    }

    /// The same, in order.
    pub(super) fn distinct_neighbours(&self, vertex: u32) -> Vec<u32> {
        let mut neighbours: Vec<u32> = self.neighbours(vertex).collect();
        neighbours.sort_unstable();
        neighbours.dedup();
        neighbours
    }

    /// Where the vertex of a collapsed edge belongs, and what that costs.
    pub(super) fn best_place(&self, [a, b]: [u32; 2]) -> (Vector3<f64>, f64) {
        let mut quadric = self.quadrics[numbers::place(a)];
        quadric.add(&self.quadrics[numbers::place(b)]);
        let (from, to) = (
            self.points[numbers::place(a)],
            self.points[numbers::place(b)],
        );
        let middle = (from + to) / 2.0;
        // The planes of flat surroundings meet anywhere.
        let is_near = |place: &Vector3<f64>| (place - middle).norm() <= 2.0 * (to - from).norm();
        if let Some(place) = quadric.minimum().filter(is_near) {
            return (place, quadric.error(&place));
        }
        let places = [middle, from, to].map(|place| (place, quadric.error(&place)));
        places.into_iter().fold(
            places[0],
            |best, next| if next.1 < best.1 { next } else { best },
        )
    }

    /// Whether the collapse leaves the topology as it is (T. K. Dey and others: Topology preserving edge contraction, 1999), and turns no triangle over.
    pub(super) fn allows(&self, [a, b]: [u32; 2], place: &Vector3<f64>) -> bool {
        let shared = self
            .triangles_of(a)
            .filter(|triangle| triangle.contains(&b))
            .count();
        let (of_a, of_b) = (self.distinct_neighbours(a), self.distinct_neighbours(b));
        let common = of_a
            .iter()
            .filter(|vertex| of_b.binary_search(vertex).is_ok())
            .count();
        let is_bridge = shared == 2 && self.is_border(a) && self.is_border(b);
        // The last triangles of a part stay: a tetrahedron, or one triangle.
        let is_least = of_a.len() + of_b.len() - common <= 4
            && shared == 2
            && !self.is_border(a)
            && !self.is_border(b);
        let is_last = shared == 1 && of_a.len() == 2 && of_b.len() == 2;
        (shared == 1 || shared == 2)
            && common == shared
            && !(is_bridge || is_least || is_last)
            && self.stays_turned(a, b, place)
            && self.stays_turned(b, a, place)
    }

    /// Whether one of its edges has one triangle only.
    fn is_border(&self, vertex: u32) -> bool {
        let mut neighbours: Vec<u32> = self.neighbours(vertex).collect();
        neighbours.sort_unstable();
        neighbours
            .chunk_by(|a, b| a == b)
            .any(|same| same.len() == 1)
    }

    /// Whether the triangles of `vertex` without `other` look to nearly the same side with the vertex at `place`.
    fn stays_turned(&self, vertex: u32, other: u32, place: &Vector3<f64>) -> bool {
        self.triangles_of(vertex)
            .filter(|triangle| !triangle.contains(&other))
            .all(|triangle| {
                let before = self.area_vector(triangle);
                let [a, b, c] = triangle.map(|corner| {
                    if corner == vertex {
                        *place
                    } else {
                        self.points[numbers::place(corner)]
                    }
                });
                let after = (b - a).cross(&(c - a));
                before.norm() == 0.0
                    || after.dot(&before) > MIN_TURN_COSINE * after.norm() * before.norm()
            })
    }

    /// Makes one vertex of two: the first.
    pub(super) fn collapse(&mut self, [kept, gone]: [u32; 2], place: Vector3<f64>) {
        let moved = std::mem::take(&mut self.around[numbers::place(gone)]);
        for number in moved {
            let triangle = &mut self.triangles[numbers::place(number)];
            if !self.is_alive[numbers::place(number)] {
                continue;
            }
            if triangle.contains(&kept) {
                self.is_alive[numbers::place(number)] = false;
                self.alive_triangles -= 1;
            } else {
                triangle
                    .iter_mut()
                    .filter(|vertex| **vertex == gone)
                    .for_each(|vertex| *vertex = kept);
                self.around[numbers::place(kept)].push(number);
            }
        }
        let is_alive = &self.is_alive;
        self.around[numbers::place(kept)].retain(|number| is_alive[numbers::place(*number)]);
        let quadric = self.quadrics[numbers::place(gone)];
        self.quadrics[numbers::place(kept)].add(&quadric);
        self.points[numbers::place(kept)] = place;
        self.versions[numbers::place(gone)] = None;
        self.versions[numbers::place(kept)] =
            self.versions[numbers::place(kept)].map(|version| version + 1);
        self.alive_vertices -= 1;
    }

    /// The vertices in use and the triangles, in their old order.
    pub(super) fn into_triangles(self) -> Triangles {
        let alive = self
            .triangles
            .iter()
            .zip(&self.is_alive)
            .filter(|(_, is_alive)| **is_alive)
            .map(|(triangle, _)| *triangle);
        let triangles: Vec<[u32; 3]> = alive.collect();
        let mut numbers = vec![None; self.points.len()];
        triangles
            .as_flattened()
            .iter()
            .for_each(|vertex| numbers[numbers::place(*vertex)] = Some(0));
        let mut vertices = Vec::new();
        for (number, point) in numbers
            .iter_mut()
            .zip(&self.points)
            .filter(|(number, _)| number.is_some())
        {
            *number = Some(numbers::count_u32(vertices.len()));
            vertices.push((*point).into());
        }
        let renumbered = triangles
            .iter()
            .map(|triangle| triangle.map(|vertex| numbers[numbers::place(vertex)].unwrap_or(0)));
        (vertices, renumbered.collect())
    }
}
