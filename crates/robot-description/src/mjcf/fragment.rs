//! Pieces of MJCF without a file around them, as scripts put them into a model.

use super::attributes::MAIN;
use super::document::Document;
use super::element::{Element, Report, read_any};
use super::flex::Reader;
use super::{Files, Flex, Triangles};
use crate::model::Pose;
use crate::report::{ReadError, Warning};
use crate::xml::short;

/// Elements that stand side by side.
#[derive(Debug, Clone, Default)]
pub struct Fragment {
    /// In their order.
    pub elements: Vec<Element>,
    /// What was wrong with them.
    pub warnings: Vec<Warning>,
}

/// A piece names no files.
struct NoFiles;

impl Files for NoFiles {
    fn include(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Err("a piece of a model includes no files".into())
    }

    fn triangles(&mut self, _: &str) -> Result<Triangles, String> {
        Err("a piece of a model has no meshes".into())
    }
}

impl Fragment {
    /// The elements of a text.
    ///
    /// # Errors
    /// If it is no XML, or exceeds a limit.
    pub fn read(text: &str) -> Result<Self, ReadError> {
        let text = without_declaration(text);
        let whole = format!("<fragment>{text}</fragment>");
        let mut report = Report::default();
        let root = read_any(whole.as_bytes(), &mut NoFiles, &mut report)?;
        Ok(Self {
            elements: root.children,
            warnings: report.finish(()).warnings,
        })
    }

    /// An element of that name with attributes as a text, as they stand in its tag.
    ///
    /// # Errors
    /// If they are no attributes.
    pub fn element(name: &str, attributes: &str) -> Result<Element, ReadError> {
        let read = Self::read(&format!("<{name} {attributes}/>"))?;
        match <[Element; 1]>::try_from(read.elements) {
            Ok([element]) if element.name == name && element.children.is_empty() => Ok(element),
            _ => Err(ReadError::Xml(format!(
                "'{}' is not only attributes",
                short(attributes)
            ))),
        }
    }
}

/// The pose that an element outside of a file says, with angles in radians, and what was wrong with it.
pub fn pose_of_element(element: &Element) -> (Pose, Vec<Warning>) {
    let mut report = Report::default();
    let mut document = Document::new(&Element::default(), &mut report);
    document.settings.use_radians();
    let attributes = document.defaults.of(element, MAIN, &mut report);
    let pose = document.pose(&attributes, &mut report);
    (pose, report.finish(()).warnings)
}

impl Flex {
    /// A soft thing that a `<flexcomp>` or `<composite>` outside of a file describes, with angles in radians, and what was wrong with it. `body` is the name of what it is on.
    ///
    /// # Errors
    /// When it describes none; in words.
    pub fn of_element(element: &Element, body: &str) -> Result<(Self, Vec<Warning>), String> {
        let mut report = Report::default();
        let mut document = Document::new(&Element::default(), &mut report);
        document.settings.use_radians();
        let mut reader = Reader {
            document: &document,
            report: &mut report,
            files: &mut NoFiles,
            link_name: body,
        };
        let flex = reader.read(element)?;
        Ok((flex, report.finish(()).warnings))
    }
}

/// The text without `<?xml ...?>` before it.
fn without_declaration(text: &str) -> &str {
    let text = text.trim_start();
    let rest = text
        .strip_prefix("<?xml")
        .and_then(|rest| rest.split_once("?>"));
    rest.map_or(text, |(_, rest)| rest)
}
