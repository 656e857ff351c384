//! Scenes and models of CoppeliaSim and V-REP: `.ttt` and `.ttm`.
//!
//! [`container`] is the header and the compression, [`chunks`] the streams of chunks as types, [`tree`] what a file holds. Nothing
//! here knows what a scene is; that is `crate::scene_file`.

pub(crate) mod chunks;
pub(crate) mod container;
mod error;
mod huffman;
pub(crate) mod mesh_arrays;
pub(crate) mod node;
mod read;
mod stream;
pub(crate) mod tree;
mod value;
mod write;

use std::cell::RefCell;

pub use container::Header;
pub(crate) use container::{FileKind, is_binary};
pub use error::{FileError, FileResult};
pub use read::Skipped;
pub(crate) use value::{
    Counted, EngineBlock, Heights, Indices, Normals, OriginalReference, PositionFirst, Rest,
    ScriptText, Text, decode, unit_quaternion,
};

pub(crate) use node::{Node, NodeResult};
use read::{Reader, Real};
use stream::Stream;
use tree::Contents;
use value::Value;
use write::Writer;

/// The content of a scene or model file.
#[derive(Debug, Clone, PartialEq)]
pub struct File {
    /// Format and program that wrote it.
    pub header: Header,
    pub(crate) contents: Contents,
    /// Unknown chunks; they are not written again.
    pub skipped: Vec<Skipped>,
}

impl File {
    /// Reads the bytes of a binary file.
    ///
    /// # Errors
    ///
    /// Describes the fault, with the offset in the uncompressed body and the path of chunks. Memory stays in
    /// proportion to the size of the file, whatever its numbers announce.
    pub fn read(bytes: &[u8]) -> FileResult<Self> {
        let (header, body) = container::unpack(bytes)?;
        let skipped = RefCell::default();
        let contents = contents(&mut Reader::new(&body, &skipped))?;
        Ok(Self {
            header,
            contents,
            skipped: skipped.into_inner(),
        })
    }

    /// The bytes of a file of serialization 25, compressed.
    pub fn write(&self) -> Vec<u8> {
        let mut body = Writer::default();
        self.contents.write_stream(&mut body);
        container::pack(&self.header, &body.bytes)
    }
}

impl File {
    /// The file as a tree of names and values.
    pub(crate) fn to_node(&self) -> Node {
        let header = &self.header;
        let header = Node::table([
            ("serialization", Node::Int(header.serialization.into())),
            ("version", Node::Int(header.version.into())),
            ("revision", Node::Int(header.revision.into())),
            ("kind", Node::Int(header.kind.into())),
        ]);
        Node::table([("header", header), ("contents", self.contents.to_node())])
    }

    /// # Errors
    /// When the tree is not that of a file; in words, with the names that lead there.
    pub(crate) fn from_node(node: &Node) -> NodeResult<Self> {
        let header = node.need("header")?;
        let range = |_| "header: a number is out of range".to_owned();
        let number = |name| header.need(name)?.int();
        let header = Header {
            serialization: number("serialization")?.try_into().map_err(range)?,
            version: number("version")?.try_into().map_err(range)?,
            revision: number("revision")?.try_into().map_err(range)?,
            kind: number("kind")?.try_into().map_err(range)?,
        };
        Ok(Self {
            header,
            contents: Value::from_node(node.need("contents")?)?,
            skipped: Vec::new(),
        })
    }
}

/// One object as a tree.
pub(crate) fn object_node(object: &tree::Object) -> Node {
    object.to_node()
}

/// # Errors
/// When the tree is not that of an object; in words.
pub(crate) fn object_of_node(node: &Node) -> NodeResult<tree::Object> {
    Value::from_node(node)
}

fn contents(body: &mut Reader<'_>) -> FileResult<Contents> {
    let mut contents = Contents::default();
    while let Some(mut chunk) = body.chunk(Contents::END)? {
        if contents.take(&mut chunk)? {
            chunk.finish()?;
        } else if chunk.is_object() {
            contents
                .objects
                .push(Value::read(&mut chunk, Real::Double)?);
        } else {
            chunk.skip();
        }
    }
    Ok(contents)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::tests::{own_files, real_files};

    #[test]
    fn real_files_come_back_as_they_were() {
        for path in own_files().into_iter().chain(real_files()) {
            let read = |bytes: &[u8]| {
                File::read(bytes).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
            };
            let file = read(&std::fs::read(&path).unwrap());
            assert_eq!(file.skipped, [], "{}", path.display());
            let written = file.write();
            // Bytes, since numbers that are none differ from themselves.
            assert!(read(&written).write() == written, "{}", path.display());
            assert_eq!(
                read(&written).contents.objects.len(),
                file.contents.objects.len()
            );
            let tree = Node::parse(&file.to_node().print()).and_then(|node| File::from_node(&node));
            assert!(
                tree.unwrap_or_else(|what| panic!("{}: {what}", path.display()))
                    .write()
                    == written
            );
        }
    }
}
