//! SDF, the Simulation Description Format (<http://sdformat.org/spec>): models and worlds.
//!
//! Models inside of models become one robot, with names of the form `inner::link`. Poses may refer to each other ([`frames`]); what is read is resolved.

mod assembly;
mod frames;
mod include;
mod joint;
mod link;
mod model;
mod value;

pub use include::Included;

use bounded_xml::Node;

use crate::model::{Pose, Robot};
use crate::report::{Parsed, ReadError, Warning};
use crate::xml::{self, Source, named, short};
use include::Reader;

/// What an SDF file contains.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct World {
    /// Empty if the file has no world, but models only.
    pub name: String,
    /// m/s², if the file says it.
    pub gravity: Option<[f64; 3]>,
    /// The models, those without a world as well.
    pub models: Vec<Model>,
}

/// A model of a world.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Its links and joints.
    pub robot: Robot,
    /// In the world.
    pub pose: Pose,
    /// Whether it does not move.
    pub is_static: bool,
}

/// Reads an SDF file. `include` looks up what an `<include>` names.
///
/// # Errors
///
/// If it is no XML, has no `<sdf>`, or exceeds a limit.
pub fn read(bytes: &[u8], include: Include) -> Result<Parsed<World>, ReadError> {
    let before = xml::lines_before(bytes);
    let text = xml::text_of(bytes)?;
    let document = xml::document(&text, before)?;
    let mut source = Source::new(&text, before);
    let root = document.root_element();
    if root.tag_name().name() != "sdf" && root.tag_name().name() != "gazebo" {
        let found = short(root.tag_name().name());
        return Err(ReadError::WrongRoot {
            line: source.line(root),
            found,
            expected: "sdf",
        });
    }
    let mut reader = Reader::new(include);
    let world = read_world(&mut reader, &mut source, root);
    if world.models.is_empty() {
        source.warn(root, "has no model");
    }
    let mut parsed = source.finish(world);
    let inner: Vec<Warning> = reader.into_warnings();
    parsed.warnings.extend(inner);
    Ok(parsed)
}

/// Looks up the file of an `<include>` or why it cannot be had.
pub type Include<'a> = &'a mut dyn FnMut(&str) -> Result<Included, String>;

const KNOWN: &[&str] = &["world", "model", "light", "include", "actor"];

fn read_world(reader: &mut Reader, source: &mut Source, root: Node) -> World {
    source.expect_children(root, KNOWN);
    let version = source.number(root, "version").unwrap_or(1.4);
    let Some(node) = source.child(root, "world") else {
        let models = model::read_models(reader, source, root, version);
        return World {
            models,
            ..World::default()
        };
    };
    let name = source.required(node, "name");
    let gravity = source
        .child(node, "gravity")
        .map(|gravity| value::numbers(source, gravity, [0.0, 0.0, -9.8]));
    for actor in named(node, "actor") {
        source.leave_out(actor, "actors are not read");
    }
    World {
        name,
        gravity,
        models: model::read_models(reader, source, node, version),
    }
}
