//! COLLADA 1.4 and 1.5: the geometry of the visual scene, placed by its nodes. Animations, lights, cameras and physics are left out; a skin is
//! read in its bind pose.

mod geometries;
mod material;
mod scene;
mod source;
mod write;

use std::collections::HashMap;
use std::rc::Rc;

use bounded_xml::{Document, DocumentType, Error, Node};
pub(crate) use write::write;

use crate::Resolve;
use crate::error::{Location, ReadError, Result};
use crate::limits::Limits;
use crate::mesh_file::{MeshFile, UpAxis};
use crate::text::number;
use geometries::Primitive;
use source::Source;

/// What was read already, and the file so far.
struct Reader<'a, 'r> {
    document: &'a Document<'a>,
    /// Elements by their `id`. Only looked up, never iterated.
    ids: HashMap<&'a str, Node<'a, 'a>>,
    sources: HashMap<bounded_xml::NodeId, Rc<Source>>,
    geometries: HashMap<bounded_xml::NodeId, Rc<Vec<Primitive>>>,
    materials: material::Materials,
    limits: Limits,
    file: MeshFile,
    resolve: Resolve<'r>,
}

pub(crate) fn read(bytes: &[u8], limits: Limits, resolve: Resolve) -> Result<MeshFile> {
    let text = String::from_utf8_lossy(bytes);
    let document = bounded_xml::parse(&text, u32::MAX, DocumentType::Refused).map_err(refused)?;
    let root = document.root_element();
    if !root.has_tag_name_of("COLLADA") {
        return Err(at(&document, root, "the first element is not COLLADA"));
    }
    let ids = root
        .descendants()
        .filter_map(|node| Some((node.attribute("id")?, node)))
        .collect();
    let mut reader = Reader {
        document: &document,
        ids,
        sources: HashMap::new(),
        geometries: HashMap::new(),
        materials: material::Materials::default(),
        limits,
        file: MeshFile {
            up: Some(UpAxis::Y),
            ..MeshFile::default()
        },
        resolve,
    };
    reader.asset(root)?;
    reader.scene(root)?;
    Ok(reader.file)
}

/// Elements count by their name whatever the namespace: files have that of 1.4, of 1.5, or none.
trait Elements<'a> {
    fn has_tag_name_of(&self, name: &str) -> bool;
    /// The children of a name.
    fn all(&self, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>>;
    /// The first child of a name.
    fn first(&self, name: &'static str) -> Option<Node<'a, 'a>>;
    /// The text inside, without spaces around it.
    fn content(&self) -> &'a str;
}

impl<'a> Elements<'a> for Node<'a, 'a> {
    fn has_tag_name_of(&self, name: &str) -> bool {
        self.is_element() && self.tag_name().name() == name
    }

    fn all(&self, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
        self.children()
            .filter(move |node| node.has_tag_name_of(name))
    }

    fn first(&self, name: &'static str) -> Option<Node<'a, 'a>> {
        self.all(name).next()
    }

    fn content(&self) -> &'a str {
        self.text().unwrap_or("").trim()
    }
}

/// A damaged text.
fn refused(error: Error) -> ReadError {
    let place = error
        .line()
        .map_or(Location::File, |line| Location::Line(numbers::place(line)));
    ReadError::new(place, "XML", error.to_string())
}

fn at(document: &Document, node: Node, problem: impl Into<String>) -> ReadError {
    let line = numbers::place(document.text_pos_at(node.range().start).row);
    ReadError::new(Location::Line(line), node.tag_name().name(), problem)
}

impl<'a> Reader<'a, '_> {
    fn refused(&self, node: Node, problem: impl Into<String>) -> ReadError {
        at(self.document, node, problem)
    }

    /// Unit and up axis.
    fn asset(&mut self, root: Node<'a, 'a>) -> Result<()> {
        let Some(asset) = root.first("asset") else {
            return Ok(());
        };
        if let Some((unit, metres)) = asset
            .first("unit")
            .and_then(|unit| Some((unit, unit.attribute("meter")?)))
        {
            let metres = number(metres.trim().as_bytes()).filter(|metres| *metres > 0.0);
            self.file.unit =
                Some(metres.ok_or_else(|| self.refused(unit, "meter is not a positive number"))?);
        }
        self.file.up = Some(match asset.first("up_axis").map(|axis| axis.content()) {
            Some("X_UP") => UpAxis::X,
            Some("Z_UP") => UpAxis::Z,
            _ => UpAxis::Y,
        });
        Ok(())
    }

    /// The element that a reference such as `#box` names, if it is in this file.
    fn target(&self, reference: &str) -> Option<Node<'a, 'a>> {
        self.ids.get(reference.strip_prefix('#')?).copied()
    }

    /// The element that an attribute refers to.
    fn referred(&self, node: Node<'a, 'a>, attribute: &str) -> Result<Node<'a, 'a>> {
        let reference = node.attribute(attribute).unwrap_or("");
        self.target(reference).ok_or_else(|| {
            self.refused(
                node,
                format!("{attribute} {reference:?} names nothing in this file"),
            )
        })
    }

    /// The numbers inside an element: exactly `N`.
    fn numbers<const N: usize>(&self, node: Node) -> Result<[f64; N]> {
        let numbers: Option<Vec<f64>> = node
            .text()
            .unwrap_or("")
            .split_ascii_whitespace()
            .map(|word| number(word.as_bytes()))
            .collect();
        let numbers = numbers.ok_or_else(|| self.refused(node, "what is not a finite number"))?;
        let found = numbers.len();
        numbers
            .try_into()
            .map_err(|_| self.refused(node, format!("{found} numbers instead of {N}")))
    }
}
