//! A ball rolls over points: where it rests on three of them there is a triangle (F. Bernardini and others: The Ball-Pivoting Algorithm for Surface
//! Reconstruction, 1999).

use std::collections::{HashMap, VecDeque};
use std::f64::consts::TAU;

use nalgebra::{Point3, Vector3};

use super::point;
use crate::kd_tree::KdTree;

/// As a part of the radius: points so near to the surface of a ball are not inside.
const TOLERANCE: f64 = 1e-7;

pub(super) struct Pivoting<'a> {
    points: &'a [[f64; 3]],
    normals: &'a [Vector3<f64>],
    radius: f64,
    tree: KdTree,
    triangles: Vec<[u32; 3]>,
    /// The triangle of each edge, by its direction, with the centre of the ball that rested there.
    edges: HashMap<(u32, u32), Point3<f64>>,
    /// How many edges of a vertex have one triangle only; None of a vertex without triangles.
    open: Vec<Option<i32>>,
    /// Edges over which the ball has not rolled yet.
    front: VecDeque<(u32, u32)>,
}

impl<'a> Pivoting<'a> {
    pub(super) fn new(points: &'a [[f64; 3]], normals: &'a [Vector3<f64>], radius: f64) -> Self {
        Self {
            points,
            normals,
            radius,
            tree: KdTree::new(points),
            triangles: Vec::new(),
            edges: HashMap::new(),
            open: vec![None; points.len()],
            front: VecDeque::new(),
        }
    }

    /// Rolls the ball from each point that nothing has reached, as far as it goes.
    pub(super) fn triangles(mut self) -> Vec<[u32; 3]> {
        for start in 0..numbers::count_u32(self.points.len()) {
            if self.open[numbers::place(start)].is_none() {
                self.seed(start);
                self.roll();
            }
        }
        self.triangles
    }

    fn at(&self, vertex: u32) -> Point3<f64> {
        point(&self.points[numbers::place(vertex)])
    }

    fn near(&self, to: Point3<f64>, distance: f64) -> Vec<u32> {
        self.tree
            .within(to.coords.into(), distance)
            .iter()
            .map(|found| found.number)
            .collect()
    }

    /// Adds the first triangle at a point on which the ball rests.
    fn seed(&mut self, a: u32) {
        let is_free = |vertex: &u32| *vertex != a && self.open[numbers::place(*vertex)].is_none();
        let near: Vec<u32> = self
            .near(self.at(a), 2.0 * self.radius)
            .into_iter()
            .filter(is_free)
            .collect();
        // Those that are far away are unlikely.
        let near = &near[..near.len().min(40)];
        for (k, b) in near.iter().enumerate() {
            for c in &near[k + 1..] {
                for triangle in [[a, *b, *c], [a, *c, *b]] {
                    if let Some(centre) = self.ball(triangle).filter(|centre| self.is_empty(centre))
                    {
                        return self.add(triangle, centre);
                    }
                }
            }
        }
    }

    /// The centre of the ball on the outer side of a triangle; None if it is too large for the ball, or looks to another side than its corners.
    fn ball(&self, triangle: [u32; 3]) -> Option<Point3<f64>> {
        let [a, b, c] = triangle.map(|vertex| self.at(vertex));
        let (u, v) = (b - a, c - a);
        let normal = u.cross(&v);
        let square = normal.norm_squared();
        if square <= 1e-12 * u.norm_squared() * v.norm_squared() {
            return None;
        }
        let outer = triangle
            .iter()
            .all(|vertex| self.normals[numbers::place(*vertex)].dot(&normal) > 0.0);
        let to_centre = (normal.cross(&u) * v.norm_squared() + v.cross(&normal) * u.norm_squared())
            / (2.0 * square);
        let height = self.radius * self.radius - to_centre.norm_squared();
        (outer && height >= 0.0).then(|| a + to_centre + normal * (height / square).sqrt())
    }

    fn is_empty(&self, centre: &Point3<f64>) -> bool {
        let inner = self.radius * (1.0 - TOLERANCE);
        self.tree
            .nearest(centre.coords.into())
            .is_none_or(|found| found.distance_squared >= inner * inner)
    }

    fn add(&mut self, triangle: [u32; 3], centre: Point3<f64>) {
        for k in 0..3 {
            let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
            self.edges.insert((from, to), centre);
            let is_closed = self.edges.contains_key(&(to, from));
            for vertex in [from, to] {
                let open = self.open[numbers::place(vertex)].get_or_insert(0);
                *open += if is_closed { -1 } else { 1 };
            }
            if !is_closed {
                self.front.push_back((from, to));
            }
        }
        self.triangles.push(triangle);
    }

    fn roll(&mut self) {
        while let Some((from, to)) = self.front.pop_front() {
            if self.edges.contains_key(&(to, from)) {
                continue;
            }
            if let Some((next, centre)) = self.pivot(from, to) {
                self.add([to, from, next], centre);
            }
        }
    }

    /// The point that the ball touches first as it rolls over an edge, and where its centre is then. None if that makes no triangle.
    fn pivot(&self, from: u32, to: u32) -> Option<(u32, Point3<f64>)> {
        let rests = self.edges[&(from, to)];
        let (a, b) = (self.at(from), self.at(to));
        let middle = nalgebra::center(&a, &b);
        let (axis, start) = ((b - a).normalize(), rests - middle);
        let angle = |centre: &Point3<f64>| {
            let end = centre - middle;
            let angle = libm::atan2(axis.dot(&start.cross(&end)), start.dot(&end));
            // Four points on one ball: rounding must not make a whole turn of nothing.
            if angle < -1e-7 {
                angle + TAU
            } else {
                angle.max(0.0)
            }
        };
        let others = self
            .near(middle, 2.0 * self.radius)
            .into_iter()
            .filter(|next| *next != from && *next != to);
        let rests_on = others.filter_map(|next| {
            let is_free = |edge: (u32, u32)| !self.edges.contains_key(&edge);
            let may_be_used = self.open[numbers::place(next)].is_none_or(|open| open > 0)
                && is_free((from, next))
                && is_free((next, to));
            let centre = self.ball([to, from, next]).filter(|_| may_be_used)?;
            Some((angle(&centre), next, centre))
        });
        let (_, next, centre) = rests_on.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        self.is_empty(&centre).then_some((next, centre))
    }
}
