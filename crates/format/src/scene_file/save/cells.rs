//! Voxels and points as cell trees: version 2, readable since 4.5.1.

use super::sensors::bits;
use crate::ttt::chunks as file;
use crate::ttt::{Counted, Rest};
use scene::voxels::octree::{OcTree, Voxel};
use scene::voxels::point_cloud::{CloudPoint, PointCloud};

const VERSION: u8 = 2;

type Point = [f64; 3];

pub(super) fn octree(tree: &OcTree, colour: Option<file::Colour>) -> file::OcTree {
    let voxels: Vec<(Point, Voxel)> = tree.voxels().collect();
    let blob = (!voxels.is_empty()).then(|| {
        let mut out = Blob {
            bytes: vec![VERSION],
            smallest: tree.voxel_size(),
        };
        let root = out.root(voxels.iter().map(|(centre, _)| *centre));
        out.children(root, voxels, &mut |out, _, voxels, is_leaf| {
            let voxel = voxels.first().filter(|_| is_leaf);
            out.bytes.push(voxel.is_some().into());
            if let Some((_, voxel)) = voxel {
                out.bytes.extend(voxel.colour);
                out.bytes.extend(voxel.tag.to_le_bytes());
            }
            !is_leaf
        });
        Rest(out.bytes)
    });
    file::OcTree {
        sizes: Some((tree.voxel_size(), numbers::truncated_i32(tree.point_size))),
        flags: Some(bits(&[
            (tree.random_colours, 2),
            (tree.shows_points, 3),
            (true, 4),
        ])),
        colour,
        cells_v2: blob,
        ..file::OcTree::default()
    }
}

pub(super) fn point_cloud(cloud: &PointCloud, colour: Option<file::Colour>) -> file::PointCloud {
    let points: Vec<(Point, CloudPoint)> = cloud
        .points
        .iter()
        .map(|point| (point.position, *point))
        .collect();
    let limit = numbers::place_of(cloud.max_points_in_cell.max(1));
    let blob = (cloud.uses_octree && !points.is_empty()).then(|| {
        let mut out = Blob {
            bytes: vec![VERSION],
            smallest: cloud.max_cell_size,
        };
        let root = out.root(cloud.points.iter().map(|point| point.position));
        out.int(numbers::low_i32(cloud.max_points_in_cell));
        out.children(root, points, &mut |out, cell, points, is_leaf| {
            let divided = !is_leaf && points.len() > limit;
            out.points(cell, if divided { &[] } else { points });
            divided
        });
        Rest(out.bytes)
    });
    let plain = || {
        Counted(
            cloud
                .points
                .iter()
                .map(|point| (point.position, point.colour))
                .collect(),
        )
    };
    file::PointCloud {
        sizes: Some((cloud.max_cell_size, numbers::low_i32(cloud.point_size))),
        display_ratio: Some(cloud.display_fraction),
        cells: Some((
            numbers::low_i32(cloud.max_points_in_cell),
            cloud.max_cell_size,
        )),
        flags: Some(bits(&[
            (cloud.random_colours, 2),
            (true, 3),
            (!cloud.uses_octree, 4),
        ])),
        colour,
        points: (!cloud.uses_octree && !cloud.points.is_empty()).then(plain),
        cells_v2: blob,
        ..file::PointCloud::default()
    }
}

#[derive(Clone, Copy)]
struct Cell {
    centre: Point,
    edge: f64,
    /// How often it can be halved before it is as small as cells get.
    halvings: u32,
}

struct Blob {
    bytes: Vec<u8>,
    /// Edge of the smallest cells.
    smallest: f64,
}

impl Blob {
    /// A cell around the origin that holds all points; its edge is the smallest one, doubled as often as needed.
    fn root(&mut self, points: impl Iterator<Item = Point>) -> Cell {
        let reach = points
            .flatten()
            .fold(0.0, |reach: f64, c| reach.max(c.abs()));
        let mut cell = Cell {
            centre: [0.0; 3],
            edge: 2.0 * self.smallest,
            halvings: 1,
        };
        while 0.5 * cell.edge <= reach && cell.halvings < 50 {
            (cell.edge, cell.halvings) = (2.0 * cell.edge, cell.halvings + 1);
        }
        [cell.edge, self.smallest]
            .into_iter()
            .chain(cell.centre)
            .for_each(|number| self.real(number));
        cell
    }

    /// The eight cells within a cell. `write` writes what a cell holds itself, and says whether it is divided; it is told whether the
    /// cell is among the smallest.
    fn children<T>(
        &mut self,
        cell: Cell,
        items: Vec<(Point, T)>,
        write: &mut impl FnMut(&mut Self, &Cell, &[(Point, T)], bool) -> bool,
    ) {
        let mut sorted: [Vec<(Point, T)>; 8] = Default::default();
        for (point, item) in items {
            let number = (0..3).fold(0, |number, axis| {
                number | usize::from(point[axis] >= cell.centre[axis]) << axis
            });
            sorted[number].push((point, item));
        }
        for (number, items) in sorted.into_iter().enumerate() {
            let side = |axis: usize| if number >> axis & 1 == 1 { 0.25 } else { -0.25 };
            let centre = std::array::from_fn(|axis| cell.centre[axis] + side(axis) * cell.edge);
            let child = Cell {
                centre,
                edge: 0.5 * cell.edge,
                halvings: cell.halvings - 1,
            };
            let is_leaf = items.is_empty() || child.halvings == 0;
            let divided = write(self, &child, &items, is_leaf);
            self.bytes.push(divided.into());
            if divided {
                self.children(child, items, write);
            }
        }
    }

    /// Coordinates from the centre of the cell, then colours.
    fn points(&mut self, cell: &Cell, points: &[(Point, CloudPoint)]) {
        self.int(3 * numbers::count_i32(points.len()));
        for (position, _) in points {
            (0..3).for_each(|axis| self.real(position[axis] - cell.centre[axis]));
        }
        points
            .iter()
            .for_each(|(_, point)| self.bytes.extend(point.colour));
    }

    fn int(&mut self, number: i32) {
        self.bytes.extend(number.to_le_bytes());
    }

    fn real(&mut self, number: f64) {
        self.bytes.extend(number.to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::load::cells as load;
    use super::*;

    #[test]
    fn voxels_come_back() {
        let mut tree = OcTree::new(0.05, 1.0);
        for i in 0..200u32 {
            let far = f64::from(i * i % 97) * 0.11 - 4.0;
            let point = [far, f64::from(i) * 0.03, -far * far];
            tree.insert(
                point,
                Voxel {
                    colour: [i as u8, 2, 3],
                    tag: i,
                },
            );
        }
        assert_eq!(load::octree(&octree(&tree, None)).unwrap(), tree);
    }

    #[test]
    fn points_come_back_cell_by_cell() {
        let point = |i: u32| CloudPoint {
            position: [f64::from(i * 7 % 31) * 0.1, f64::from(i) * -0.01, 1.0],
            colour: [i as u8, 0, 1],
        };
        for uses_octree in [true, false] {
            let mut cloud = load::point_cloud(&file::PointCloud::default()).unwrap();
            cloud.uses_octree = uses_octree;
            cloud.insert((0..300).map(point), 0.0);
            let again = load::point_cloud(&point_cloud(&cloud, None)).unwrap();
            let order = |a: &CloudPoint, b: &CloudPoint| {
                a.colour
                    .cmp(&b.colour)
                    .then(a.position[1].total_cmp(&b.position[1]))
            };
            let sorted = |cloud: &PointCloud| {
                let mut points = cloud.points.to_vec();
                points.sort_by(order);
                points
            };
            assert_eq!(again.points.len(), 300);
            let near = |(a, b): (&CloudPoint, &CloudPoint)| {
                (0..3).all(|i| (a.position[i] - b.position[i]).abs() < 1e-9)
            };
            assert!(sorted(&again).iter().zip(&sorted(&cloud)).all(near));
        }
    }
}
