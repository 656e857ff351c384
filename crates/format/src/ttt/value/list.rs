//! Lists: with a count, or until the end of their chunk.

use super::{Plain, Value};
use crate::ttt::error::FileResult;
use crate::ttt::node::{Node, NodeResult, at};
use crate::ttt::read::{Reader, Real};
use crate::ttt::write::Writer;

/// Things behind their number.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Counted<T>(pub Vec<T>);

impl<T: Value> Value for Counted<T> {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        // Every value takes a byte at least, so a number that lies ends in an error before it costs memory.
        let count = input.count(1)?;
        (0..count)
            .map(|_| T::read(input, real))
            .collect::<FileResult<_>>()
            .map(Self)
    }

    fn write(&self, out: &mut Writer) {
        out.int(numbers::count_i32(self.0.len()));
        self.0.iter().for_each(|one| one.write(out));
    }

    fn to_node(&self) -> Node {
        Node::List(self.0.iter().map(Value::to_node).collect())
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        let items = node.list()?.iter().enumerate();
        items
            .map(|(i, item)| at(&i.to_string(), T::from_node(item)))
            .collect::<NodeResult<_>>()
            .map(Self)
    }
}

/// Things until the chunk ends.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rest<T>(pub Vec<T>);

impl<T: Plain> Value for Rest<T> {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        let size = T::size(real);
        if !input.left().is_multiple_of(size) {
            return Err(input.error(format!(
                "{} bytes are not a multiple of {size}",
                input.left()
            )));
        }
        Ok(Self(
            input
                .take_rest()
                .chunks_exact(size)
                .map(|bytes| T::get(bytes, real))
                .collect(),
        ))
    }

    fn write(&self, out: &mut Writer) {
        self.0.iter().for_each(|one| one.put(&mut out.bytes));
    }

    /// Single bytes as bytes, numbers as a list.
    fn to_node(&self) -> Node {
        if T::size(Real::Double) > 1 {
            return Node::List(self.0.iter().map(|one| one.node()).collect());
        }
        let mut bytes = Vec::new();
        self.0.iter().for_each(|one| one.put(&mut bytes));
        Node::Bytes(bytes)
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        if T::size(Real::Double) > 1 {
            return node
                .list()?
                .iter()
                .map(T::of_node)
                .collect::<NodeResult<_>>()
                .map(Self);
        }
        Ok(Self(
            node.bytes()?
                .chunks_exact(1)
                .map(|byte| T::get(byte, Real::Double))
                .collect(),
        ))
    }
}

/// Numbers as a list of nodes.
pub(super) fn list<T: Plain>(numbers: &[T]) -> Node {
    Node::List(numbers.iter().map(|number| number.node()).collect())
}

/// Numbers of a list of nodes.
pub(super) fn of_list<T: Plain>(node: &Node) -> NodeResult<Vec<T>> {
    node.list()?.iter().map(T::of_node).collect()
}
