//! Records of several numbers: parameters of physics engines, references to objects.

use super::list::{list, of_list};
use super::{Plain, Text, Value};
use crate::ttt::error::FileResult;
use crate::ttt::node::{Node, NodeResult};
use crate::ttt::read::{Reader, Real};
use crate::ttt::write::Writer;

/// Parameters of one physics engine, in the order of its tables (spec: scene-files 8).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EngineBlock {
    pub reals: Vec<f64>,
    pub ints: Vec<i32>,
}

impl Value for EngineBlock {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        let reals = input.count(f64::size(real))?;
        let ints = input.count(4)?;
        let reals = (0..reals)
            .map(|_| f64::read(input, real))
            .collect::<FileResult<_>>()?;
        let ints = (0..ints).map(|_| input.int()).collect::<FileResult<_>>()?;
        Ok(Self { reals, ints })
    }

    fn write(&self, out: &mut Writer) {
        out.int(numbers::count_i32(self.reals.len()));
        out.int(numbers::count_i32(self.ints.len()));
        self.reals.iter().for_each(|real| real.write(out));
        self.ints.iter().for_each(|int| out.int(*int));
    }

    fn to_node(&self) -> Node {
        Node::table([("reals", list(&self.reals)), ("ints", list(&self.ints))])
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        Ok(Self {
            reals: of_list(node.need("reals")?)?,
            ints: of_list(node.need("ints")?)?,
        })
    }
}

/// A reference to an object by the identity it was saved with; the identity is missing where the handle is negative.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OriginalReference {
    pub kind: i32,
    pub handle: i32,
    pub persistent_id: Option<Text>,
}

impl Value for OriginalReference {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        let [kind, handle] = Value::read(input, real)?;
        let persistent_id = if handle < 0 {
            None
        } else {
            Some(Text::read(input, real)?)
        };
        Ok(Self {
            kind,
            handle,
            persistent_id,
        })
    }

    fn write(&self, out: &mut Writer) {
        [self.kind, self.handle].write(out);
        if let Some(id) = &self.persistent_id {
            id.write(out);
        }
    }

    fn to_node(&self) -> Node {
        let id = self
            .persistent_id
            .as_ref()
            .map(|id| ("persistent_id", id.to_node()));
        Node::table(
            [("kind", self.kind.node()), ("handle", self.handle.node())]
                .into_iter()
                .chain(id),
        )
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        let (kind, handle) = (
            i32::of_node(node.need("kind")?)?,
            i32::of_node(node.need("handle")?)?,
        );
        Ok(Self {
            kind,
            handle,
            persistent_id: node.get("persistent_id").map(Text::from_node).transpose()?,
        })
    }
}
