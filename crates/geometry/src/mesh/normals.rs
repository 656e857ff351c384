//! Normals of corners: those of faces, or the mean over faces that differ little.

use nalgebra::Vector3;

use super::Mesh;

/// Normals of vertices with more triangles than this are found with a tree.
const MAX_LINEAR_SEARCH: usize = 32;
/// Largest number of normals in a leaf of the tree.
const MAX_LEAF_SIZE: usize = 8;

impl Mesh {
    /// Recomputes the normals. Corners of triangles that share a vertex and differ by less than
    /// `shading_angle` (rad) get the mean of their face normals, weighted by area; 0 means flat normals.
    pub fn compute_normals(&mut self, shading_angle: f64) {
        let areas: Vec<_> = self.triangles.iter().map(|t| self.area_vector(t)).collect();
        let faces: Vec<_> = areas
            .iter()
            .map(|a| a.try_normalize(0.0).unwrap_or_default())
            .collect();
        self.normals = faces.iter().flat_map(|face| [(*face).into(); 3]).collect();
        if shading_angle > 0.0 {
            self.smooth(&areas, &faces, libm::cos(shading_angle));
        }
    }

    fn smooth(&mut self, areas: &[Vector3<f64>], faces: &[Vector3<f64>], least: f64) {
        let (starts, corners) = self.corners_of_vertices();
        for range in starts.windows(2) {
            let around = &corners[range[0] as usize..range[1] as usize];
            let tree =
                (around.len() > MAX_LINEAR_SEARCH).then(|| NormalTree::new(around, areas, faces));
            for corner in around {
                let own = faces[*corner as usize / 3];
                let near = |other: &&u32| own.dot(&faces[**other as usize / 3]) > least;
                let sum = match &tree {
                    Some(tree) => tree.sum(&own, least),
                    None => around
                        .iter()
                        .filter(near)
                        .map(|other| areas[*other as usize / 3])
                        .sum(),
                };
                self.normals[*corner as usize] = sum.try_normalize(0.0).unwrap_or(own).into();
            }
        }
    }

    /// The corners at each vertex, in order: where they begin, and their numbers, three of each triangle.
    fn corners_of_vertices(&self) -> (Vec<u32>, Vec<u32>) {
        let flat = self.triangles.as_flattened();
        let mut starts = vec![0_u32; self.vertices.len() + 1];
        flat.iter()
            .for_each(|vertex| starts[*vertex as usize + 1] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut next = starts.clone();
        let mut corners = vec![0; flat.len()];
        for (corner, vertex) in flat.iter().enumerate() {
            let slot = &mut next[*vertex as usize];
            corners[*slot as usize] = corner as u32;
            *slot += 1;
        }
        (starts, corners)
    }
}

/// The normals of faces around one vertex, in boxes within boxes, with the sums of their areas: a cone around a normal holds most of them as whole
/// boxes or not at all.
struct NormalTree {
    /// Normals and areas; the children of a box are the halves of its part.
    faces: Vec<(Vector3<f64>, Vector3<f64>)>,
    nodes: Vec<Node>,
}

struct Node {
    low: Vector3<f64>,
    high: Vector3<f64>,
    sum: Vector3<f64>,
    part: std::ops::Range<usize>,
    /// The number of the second child; the first one is the next node. 0 for leaves.
    second: usize,
}

impl NormalTree {
    fn new(corners: &[u32], areas: &[Vector3<f64>], faces: &[Vector3<f64>]) -> Self {
        let of = |corner: &u32| (faces[*corner as usize / 3], areas[*corner as usize / 3]);
        let mut tree = Self {
            faces: corners.iter().map(of).collect(),
            nodes: Vec::new(),
        };
        tree.add(0..corners.len());
        tree
    }

    /// Adds the node of a part, and those below it.
    fn add(&mut self, part: std::ops::Range<usize>) {
        let faces = &mut self.faces[part.clone()];
        let low = faces
            .iter()
            .fold(Vector3::repeat(f64::MAX), |low, (normal, _)| {
                low.inf(normal)
            });
        let high = faces
            .iter()
            .fold(Vector3::repeat(f64::MIN), |high, (normal, _)| {
                high.sup(normal)
            });
        let sum = faces.iter().map(|(_, area)| area).sum();
        let number = self.nodes.len();
        let axis = (high - low).imax();
        let is_leaf = faces.len() <= MAX_LEAF_SIZE || low == high;
        let middle = faces.len() / 2;
        if !is_leaf {
            faces.select_nth_unstable_by(middle, |a, b| {
                let along = a.0[axis].total_cmp(&b.0[axis]);
                // All of a face decides, so that the sums do not depend on the order of equals.
                along.then_with(|| {
                    (0..3).fold(std::cmp::Ordering::Equal, |order, k| {
                        order.then(a.1[k].total_cmp(&b.1[k]))
                    })
                })
            });
        }
        self.nodes.push(Node {
            low,
            high,
            sum,
            part: part.clone(),
            second: 0,
        });
        if !is_leaf {
            self.add(part.start..part.start + middle);
            self.nodes[number].second = self.nodes.len();
            self.add(part.start + middle..part.end);
        }
    }

    /// The sum of the areas of faces whose normals have a product with `own` above `least`.
    fn sum(&self, own: &Vector3<f64>, least: f64) -> Vector3<f64> {
        let mut sum = Vector3::zeros();
        let mut pending = vec![0];
        while let Some(number) = pending.pop() {
            let node = &self.nodes[number];
            let bound = |pick: fn(f64, f64) -> f64| -> f64 {
                (0..3)
                    .map(|k| pick(own[k] * node.low[k], own[k] * node.high[k]))
                    .sum()
            };
            if bound(f64::max) <= least {
                continue;
            }
            if bound(f64::min) > least {
                sum += node.sum;
            } else if node.second == 0 {
                let near = self.faces[node.part.clone()]
                    .iter()
                    .filter(|(normal, _)| own.dot(normal) > least);
                sum += near.map(|(_, area)| area).sum::<Vector3<f64>>();
            } else {
                pending.extend([node.second, number + 1]);
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{block, close};
    use super::*;

    #[test]
    fn shading_smooths_below_the_angle() {
        let mut cube = block([1., 1., 1.]);
        cube.compute_normals(0.5);
        assert!(
            cube.normals
                .iter()
                .all(|n| n.iter().any(|c| c.abs() > 0.999))
        );
        cube.compute_normals(2.0);
        assert!(
            cube.normals
                .iter()
                .all(|n| n.iter().all(|c| c.abs() < 0.95))
        );
    }

    /// A cone of `n` triangles, whose tip has all of them, with a wave in its rim.
    fn cone(n: u32) -> Mesh {
        let rim = (0..n).map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(n);
            [angle.cos(), angle.sin(), 0.2 * (5.0 * angle).sin()]
        });
        let vertices = std::iter::once([0.0, 0.0, 0.4]).chain(rim).collect();
        Mesh::new(
            vertices,
            (0..n).map(|k| [0, k + 1, (k + 1) % n + 1]).collect(),
        )
        .expect("valid")
    }

    #[test]
    fn many_triangles_at_a_vertex_are_smoothed_as_few_are() {
        let mut mesh = cone(300);
        for angle in [0.05_f64, 0.3, 1.0, 3.0] {
            mesh.compute_normals(angle);
            let areas: Vec<_> = mesh.triangles.iter().map(|t| mesh.area_vector(t)).collect();
            for (face, area) in areas.iter().enumerate() {
                let near = areas
                    .iter()
                    .filter(|other| other.normalize().dot(&area.normalize()) > angle.cos());
                let expected = near.sum::<Vector3<f64>>().normalize();
                close(&mesh.normals[3 * face], expected.as_slice());
            }
        }
    }

    #[test]
    fn a_hundred_thousand_triangles_at_a_vertex_are_no_obstacle() {
        let mut mesh = cone(100_000);
        mesh.compute_normals(0.5);
        assert!(
            mesh.normals
                .iter()
                .all(|n| (Vector3::from(*n).norm() - 1.0).abs() < 1e-9)
        );
    }
}
