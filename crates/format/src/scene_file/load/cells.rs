//! Voxels and points, from the cell trees in files (spec: scene-files 7.4).

use crate::ttt::Counted;
use crate::ttt::chunks as file;
use scene::voxels::cloud_points::CloudPoints;
use scene::voxels::octree::{OcTree, Voxel};
use scene::voxels::point_cloud::{CloudPoint, PointCloud};

/// Levels of cells within cells; a tree of a metre with cells of a millimetre needs ten.
const MAX_DEPTH: usize = 60;
/// Since this version of a tree colours have a fourth byte.
const OPACITY_SINCE: u8 = 3;

type Result<T> = std::result::Result<T, String>;
type Point = [f64; 3];

/// # Errors
/// In words, when the tree is damaged.
pub(in crate::scene_file) fn octree(chunk: &file::OcTree) -> Result<OcTree> {
    let (voxel_size, point_size) = chunk.sizes.unwrap_or((0.05, 8));
    let flags = chunk.flags.unwrap_or(0);
    let mut tree = OcTree::new(voxel_size, point_size.into());
    (tree.random_colours, tree.shows_points) = (flags & 4 != 0, flags & 8 != 0);
    let blobs = [
        (&chunk.cells_v3, true),
        (&chunk.cells_v2, true),
        (&chunk.cells_v1, false),
    ];
    if let Some((blob, double)) = first(blobs) {
        let mut bytes = Blob {
            bytes: blob,
            double,
        };
        let (_, root) = bytes.head()?;
        bytes.cells(root, |bytes, cell| {
            let kind = bytes.byte()?;
            if kind != 0 {
                let colour = bytes.colour(kind)?;
                tree.insert(
                    cell.centre,
                    Voxel {
                        colour,
                        tag: bytes.int()?.cast_unsigned(),
                    },
                );
            }
            Ok(())
        })?;
        return Ok(tree);
    }
    for (point, colour) in plain_points(chunk.points.as_ref(), chunk.old_points.as_ref()) {
        tree.insert(point, Voxel { colour, tag: 0 });
    }
    Ok(tree)
}

/// # Errors
/// In words, when the tree is damaged.
pub(in crate::scene_file) fn point_cloud(chunk: &file::PointCloud) -> Result<PointCloud> {
    let (size, point_size) = chunk.sizes.unwrap_or((0.02, 2));
    let (max_points_in_cell, max_cell_size) = chunk.cells.unwrap_or((20, size));
    let flags = chunk.flags.unwrap_or(0);
    let mut cloud = PointCloud {
        max_cell_size,
        max_points_in_cell: max_points_in_cell.into(),
        point_size: point_size.into(),
        uses_octree: flags & 0x10 == 0,
        display_fraction: chunk.display_ratio.unwrap_or(1.0),
        random_colours: flags & 4 != 0,
        points: CloudPoints::default(),
    };
    let blobs = [
        (&chunk.cells_v3, true),
        (&chunk.cells_v2, true),
        (&chunk.cells_v1, false),
    ];
    let points = match first(blobs) {
        Some((blob, double)) => cloud_points(Blob {
            bytes: blob,
            double,
        })?,
        None => plain_points(chunk.points.as_ref(), None).collect(),
    };
    cloud.insert(
        points
            .into_iter()
            .map(|(position, colour)| CloudPoint { position, colour }),
        0.0,
    );
    Ok(cloud)
}

/// The newest tree a file has.
fn first(blobs: [(&Option<crate::ttt::Rest<u8>>, bool); 3]) -> Option<(&[u8], bool)> {
    blobs
        .into_iter()
        .find_map(|(blob, double)| Some((blob.as_ref()?.0.as_slice(), double)))
}

fn plain_points(
    points: Option<&Counted<(Point, [u8; 3])>>,
    old: Option<&Counted<([f32; 3], [u8; 3])>>,
) -> impl Iterator<Item = (Point, [u8; 3])> {
    let old = old
        .into_iter()
        .flat_map(|all| &all.0)
        .map(|(point, colour)| (point.map(f64::from), *colour));
    points
        .into_iter()
        .flat_map(|all| all.0.iter().copied())
        .chain(old)
}

fn cloud_points(mut bytes: Blob<'_>) -> Result<Vec<(Point, [u8; 3])>> {
    let (version, root) = bytes.head()?;
    bytes.int()?;
    let mut points = Vec::new();
    bytes.cells(root, |bytes, cell| {
        let count = usize::try_from(bytes.int()?)
            .map_err(|_| "a cell has a negative number of points")?
            / 3;
        if count * 3 > bytes.bytes.len() {
            return Err("a cell has more points than there are".into());
        }
        let first = points.len();
        for _ in 0..count {
            let offset = bytes.point()?;
            points.push((std::array::from_fn(|i| cell.centre[i] + offset[i]), [0; 3]));
        }
        for (_, colour) in &mut points[first..] {
            *colour = bytes.colour(version)?;
        }
        Ok(())
    })?;
    Ok(points)
}

/// A cube of space.
#[derive(Clone, Copy)]
struct Cell {
    centre: Point,
    edge: f64,
    depth: usize,
}

impl Cell {
    /// The bits of the number say on which side of the centre a child is, x first.
    fn child(&self, number: usize) -> Self {
        let side = |axis: usize| if number >> axis & 1 == 1 { 0.25 } else { -0.25 };
        let centre = std::array::from_fn(|axis| self.centre[axis] + side(axis) * self.edge);
        Self {
            centre,
            edge: 0.5 * self.edge,
            depth: self.depth + 1,
        }
    }

    /// The last one first, as they lie on a stack.
    fn children(self) -> impl Iterator<Item = Self> {
        (0..8).rev().map(move |number| self.child(number))
    }
}

/// Unread rest of a tree of cells.
struct Blob<'a> {
    bytes: &'a [u8],
    /// Real numbers are 64 bits wide.
    double: bool,
}

impl<'a> Blob<'a> {
    /// The version, and the cell that holds all others.
    fn head(&mut self) -> Result<(u8, Cell)> {
        let (version, edge, _) = (self.byte()?, self.real()?, self.real()?);
        Ok((
            version,
            Cell {
                centre: self.point()?,
                edge,
                depth: 0,
            },
        ))
    }

    /// Reads the cells within `root`, depth first; `visit` reads what a cell holds.
    fn cells(
        &mut self,
        root: Cell,
        mut visit: impl FnMut(&mut Self, &Cell) -> Result<()>,
    ) -> Result<()> {
        let mut pending: Vec<Cell> = root.children().collect();
        while let Some(cell) = pending.pop() {
            visit(self, &cell)?;
            if self.byte()? != 0 {
                if cell.depth == MAX_DEPTH {
                    return Err("cells are nested too deeply".into());
                }
                pending.extend(cell.children());
            }
        }
        Ok(())
    }

    fn take<const N: usize>(&mut self) -> Result<&'a [u8; N]> {
        let (head, tail) = self
            .bytes
            .split_first_chunk()
            .ok_or("a tree of cells ends too early")?;
        self.bytes = tail;
        Ok(head)
    }

    fn byte(&mut self) -> Result<u8> {
        self.take().map(|[byte]| *byte)
    }

    fn int(&mut self) -> Result<i32> {
        self.take().map(|bytes| i32::from_le_bytes(*bytes))
    }

    fn real(&mut self) -> Result<f64> {
        if self.double {
            self.take().map(|bytes| f64::from_le_bytes(*bytes))
        } else {
            self.take().map(|bytes| f32::from_le_bytes(*bytes).into())
        }
    }

    fn point(&mut self) -> Result<Point> {
        Ok([self.real()?, self.real()?, self.real()?])
    }

    fn colour(&mut self, version: u8) -> Result<[u8; 3]> {
        let colour = *self.take()?;
        if version >= OPACITY_SINCE {
            self.byte()?;
        }
        Ok(colour)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ttt::Rest;

    #[test]
    fn damaged_trees_are_errors() {
        let cloud = |bytes: &[u8]| {
            point_cloud(&file::PointCloud {
                cells_v2: Some(Rest(bytes.to_vec())),
                ..Default::default()
            })
        };
        let head = [&[2][..], &[0; 40], &20i32.to_le_bytes()].concat();
        let with = |rest: &[u8]| cloud(&[&head[..], rest].concat());
        assert!(with(&[0; 40]).is_ok(), "eight empty cells");
        assert!(with(&[0; 39]).is_err());
        assert!(with(&i32::MAX.to_le_bytes()).is_err());
        assert!(with(&(-1i32).to_le_bytes()).is_err());
        let deep = [0, 0, 0, 0, 1].repeat(100);
        assert_eq!(with(&deep).err().unwrap(), "cells are nested too deeply");
    }
}
