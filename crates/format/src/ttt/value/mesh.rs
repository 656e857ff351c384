//! The large arrays of shapes: heights, triangle corners, normals, also as files before 4.5 pack them.

use super::list::{list, of_list};
use super::{Plain, Rest, Value};
use crate::ttt::error::FileResult;
use crate::ttt::node::{Node, NodeResult};
use crate::ttt::read::{Reader, Real};
use crate::ttt::write::Writer;

/// The heights of a terrain, row by row. Both counts are zero where a mesh is none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Heights {
    pub columns: usize,
    pub rows: usize,
    pub heights: Vec<f64>,
}

impl Value for Heights {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        let (columns, rows) = (input.count(0)?, input.count(0)?);
        let Rest(heights) = Rest::read(input, real)?;
        if columns.checked_mul(rows) != Some(heights.len()) {
            return Err(input.error(format!(
                "{columns} times {rows} heights are announced, {} are there",
                heights.len()
            )));
        }
        Ok(Self {
            columns,
            rows,
            heights,
        })
    }

    fn write(&self, out: &mut Writer) {
        out.int(numbers::count_i32(self.columns));
        out.int(numbers::count_i32(self.rows));
        self.heights.iter().for_each(|height| height.write(out));
    }

    fn to_node(&self) -> Node {
        let count = |n: usize| Node::Int(numbers::count(n));
        Node::table([
            ("columns", count(self.columns)),
            ("rows", count(self.rows)),
            ("heights", list(&self.heights)),
        ])
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        let count = |name| {
            usize::try_from(node.need(name)?.int()?)
                .map_err(|_| "a number is out of range".to_owned())
        };
        let (columns, rows, heights) = (
            count("columns")?,
            count("rows")?,
            of_list::<f64>(node.need("heights")?)?,
        );
        if columns.checked_mul(rows) != Some(heights.len()) {
            return Err(format!(
                "{} heights are not {columns} times {rows}",
                heights.len()
            ));
        }
        Ok(Self {
            columns,
            rows,
            heights,
        })
    }
}

/// Triangle corners: plain numbers, or the packed differences of files before 4.5.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Indices(pub Vec<i32>);

impl Value for Indices {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        if input.tag() == *b"In2" {
            return unpack_indices(input).map(Self);
        }
        Rest::read(input, real).map(|Rest(indices)| Self(indices))
    }

    fn write(&self, out: &mut Writer) {
        self.0.iter().for_each(|index| out.int(*index));
    }

    fn to_node(&self) -> Node {
        list(&self.0)
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        of_list(node).map(Self)
    }
}

/// Differences in one to four bytes: the high bits of the first byte are the number of further bytes.
fn unpack_indices(input: &mut Reader<'_>) -> FileResult<Vec<i32>> {
    const MIDDLE: [i32; 4] = [31, 8191, 2_097_151, 536_870_911];
    let count = input.count(1)?;
    let mut previous = 0i32;
    let mut next = || {
        let first = input.take(1)?[0];
        let more = usize::from(first >> 6);
        let low = i32::from(first & 63);
        let high = input
            .take(more)?
            .iter()
            .enumerate()
            .map(|(i, byte)| i32::from(*byte) << (6 + 8 * i));
        previous = previous.wrapping_add(low + high.sum::<i32>() - MIDDLE[more]);
        Ok(previous)
    };
    (0..count).map(|_| next()).collect()
}

/// Normals, x y z per triangle corner: plain, or in five bits each, of files before 4.5.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Normals(pub Vec<f32>);

impl Value for Normals {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        if input.tag() != *b"No2" {
            return Rest::read(input, real).map(|Rest(normals)| Self(normals));
        }
        let Rest(packed) = Rest::<u16>::read(input, real)?;
        Ok(Self(packed.into_iter().flat_map(unpack_normal).collect()))
    }

    fn write(&self, out: &mut Writer) {
        self.0.iter().for_each(|number| number.put(&mut out.bytes));
    }

    fn to_node(&self) -> Node {
        list(&self.0)
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        of_list(node).map(Self)
    }
}

fn unpack_normal(packed: u16) -> [f32; 3] {
    let parts = [0, 5, 10].map(|shift| f32::from(packed >> shift & 31) - 15.0);
    let length = parts.iter().map(|c| c * c).sum::<f32>().sqrt();
    if length > 0.0 {
        parts.map(|c| c / length)
    } else {
        parts
    }
}
