//! Models of an SDF file, collected with all that is inside of them.

use std::collections::BTreeSet;

use bounded_xml::Node;

use super::Model;
use super::assembly::Draft;
use super::frames::{Frame, Frames, MODEL, WORLD};
use super::include::Reader;
use super::joint::read_joint;
use super::link::{read_link, read_sensors};
use super::value::{PoseText, is_true, pose, text};
use crate::model::Pose;
use crate::xml::{self, Source, elements, named, short};

/// Levels of models within models.
const MAX_DEPTH: usize = 32;
/// Bytes of the joined names of models within models: each of their parts has them before its own.
const MAX_SCOPE_BYTES: usize = 1000;

/// Reads the models, and the files, inside of a world or a file.
pub fn read_models(
    reader: &mut Reader,
    source: &mut Source,
    node: Node,
    version: f64,
) -> Vec<Model> {
    let mut collection = Collection {
        reader,
        frames: Frames::default(),
        placements: Vec::new(),
    };
    for frame in named(node, "frame") {
        collection.add_frame(source, frame, "", WORLD);
    }
    let (mut drafts, mut names) = (Vec::<Draft>::new(), BTreeSet::new());
    for child in elements(node) {
        let mut draft = Draft::default();
        let read = collection.add_any_model(
            source,
            child,
            Place {
                scope: "",
                folder: "",
                depth: 0,
                version,
            },
            &mut draft,
        );
        if read && !names.insert(draft.name.clone()) {
            source.warn(
                child,
                format!(
                    "there is a model '{}' before it; this one is left out",
                    short(&draft.name)
                ),
            );
        } else if read {
            drafts.push(draft);
        }
    }
    let frames = collection.finish(source, node);
    drafts
        .into_iter()
        .map(|draft| draft.placed(&frames, source, node))
        .collect()
}

/// Where a model is read.
#[derive(Debug, Clone, Copy)]
struct Place<'a> {
    /// What is before the names of its parts: `outer::inner::`, or nothing.
    scope: &'a str,
    folder: &'a str,
    depth: usize,
    version: f64,
}

/// What an `<include>` says about the model of its file.
#[derive(Default)]
struct Overrides {
    name: Option<String>,
    pose: Option<PoseText>,
    is_static: bool,
    placement: Option<String>,
}

struct Collection<'r, 'i> {
    reader: &'r mut Reader<'i>,
    frames: Frames,
    /// Models, and the frames that they are placed by.
    placements: Vec<(String, String)>,
}

impl Collection<'_, '_> {
    /// Adds a `<model>` or an `<include>` to a draft. False if it is neither, or cannot be read.
    fn add_any_model(
        &mut self,
        source: &mut Source,
        node: Node,
        place: Place,
        draft: &mut Draft,
    ) -> bool {
        match node.tag_name().name() {
            "model" => self.add_model(source, node, place, draft, Overrides::default()),
            "include" => self.add_file(source, node, place, draft),
            _ => false,
        }
    }

    fn add_file(
        &mut self,
        source: &mut Source,
        node: Node,
        place: Place,
        draft: &mut Draft,
    ) -> bool {
        let Some(uri) = text(source, node, "uri") else {
            source.warn(node, "has no uri; it is left out");
            return false;
        };
        let overrides = Overrides {
            name: text(source, node, "name"),
            pose: pose(source, node),
            is_static: is_true(source, node, "static"),
            placement: text(source, node, "placement_frame"),
        };
        let file = match self.reader.open(&uri) {
            Ok(file) => file,
            Err(reason) => {
                source.leave_out(node, format!("'{}': {reason}", short(&uri)));
                return false;
            }
        };
        let place = Place {
            folder: &file.folder,
            ..place
        };
        let outcome = self.add_text(&file.bytes, place, draft, overrides);
        outcome.unwrap_or_else(|reason| {
            self.reader.close(Vec::new());
            source.leave_out(node, format!("'{}': {reason}", short(&uri)));
            false
        })
    }

    fn add_text(
        &mut self,
        bytes: &[u8],
        place: Place,
        draft: &mut Draft,
        overrides: Overrides,
    ) -> Result<bool, String> {
        let before = xml::lines_before(bytes);
        let text = xml::text_of(bytes).map_err(|error| error.to_string())?;
        let document = xml::document(&text, before).map_err(|error| error.to_string())?;
        let root = document.root_element();
        let mut source = Source::new(&text, before);
        let version = source.number(root, "version").unwrap_or(place.version);
        let model = named(root, "model").next().ok_or("it has no model")?;
        let read = self.add_model(
            &mut source,
            model,
            Place { version, ..place },
            draft,
            overrides,
        );
        self.reader.close(source.finish(()).warnings);
        Ok(read)
    }

    fn add_model(
        &mut self,
        source: &mut Source,
        node: Node,
        place: Place,
        draft: &mut Draft,
        overrides: Overrides,
    ) -> bool {
        if place.depth >= MAX_DEPTH {
            source.leave_out(
                node,
                format!("more than {MAX_DEPTH} models inside of each other are not read"),
            );
            return false;
        }
        let name = overrides
            .name
            .unwrap_or_else(|| source.required(node, "name"));
        let scope = format!("{}{name}::", place.scope);
        if scope.len() > MAX_SCOPE_BYTES {
            let problem = format!(
                "its name is too long: models whose names have more than {MAX_SCOPE_BYTES} bytes, together with those that they are in, are not read"
            );
            source.leave_out(node, problem);
            return false;
        }
        let frame = format!("{scope}{MODEL}");
        let outer = if place.scope.is_empty() {
            WORLD.to_owned()
        } else {
            format!("{}{MODEL}", place.scope)
        };
        let own_pose = overrides
            .pose
            .or_else(|| pose(source, node))
            .unwrap_or_else(no_pose);
        let is_new = self.add_placed(frame.clone(), place.scope, own_pose, outer, None);
        let placement = overrides
            .placement
            .or_else(|| node.attribute("placement_frame").map(str::to_owned));
        self.placements.extend(
            placement
                .filter(|name| !name.is_empty())
                .map(|name| (scope.clone(), name)),
        );
        if place.depth == 0 {
            draft.is_static = overrides.is_static || is_true(source, node, "static");
            draft.name = name;
        }
        let links_before = draft.links.len();
        self.add_parts(
            source,
            node,
            Place {
                scope: &scope,
                depth: place.depth + 1,
                ..place
            },
            draft,
        );
        let first = draft.links.get(links_before).map(|(full, _)| full.clone());
        let canonical = node
            .attribute("canonical_link")
            .map(|link| format!("{scope}{link}"));
        if let Some(link) = canonical.or(first).filter(|_| is_new) {
            self.frames.attach(&frame, link);
        }
        true
    }

    fn add_parts(&mut self, source: &mut Source, node: Node, place: Place, draft: &mut Draft) {
        let model = format!("{}{MODEL}", place.scope);
        for child in elements(node) {
            match child.tag_name().name() {
                "link" => {
                    let full = format!("{}{}", place.scope, source.required(child, "name"));
                    let pose = pose(source, child).unwrap_or_else(no_pose);
                    self.add_placed(
                        full.clone(),
                        place.scope,
                        pose,
                        model.clone(),
                        Some(full.clone()),
                    );
                    draft
                        .sensors
                        .extend(read_sensors(source, child, draft.links.len()));
                    draft
                        .links
                        .push((full.clone(), read_link(source, child, full, place.folder)));
                }
                "joint" => {
                    let joint = read_joint(source, child, place.version);
                    let inside = if joint.pose.relative_to.is_empty() {
                        joint.child.clone()
                    } else {
                        joint.pose.relative_to.clone()
                    };
                    let pose = PoseText {
                        pose: joint.pose.pose,
                        relative_to: inside,
                    };
                    self.add_placed(
                        format!("{}{}", place.scope, joint.name),
                        place.scope,
                        pose,
                        model.clone(),
                        None,
                    );
                    draft.joints.push((place.scope.to_owned(), joint));
                }
                "frame" => self.add_frame(source, child, place.scope, &model),
                "model" | "include" => drop(self.add_any_model(source, child, place, draft)),
                _ => {}
            }
        }
    }

    fn add_frame(&mut self, source: &mut Source, node: Node, scope: &str, model: &str) {
        let name = format!("{scope}{}", source.required(node, "name"));
        let attached = node
            .attribute("attached_to")
            .unwrap_or_default()
            .trim()
            .to_owned();
        let mut pose = pose(source, node).unwrap_or_else(no_pose);
        if pose.relative_to.is_empty() {
            pose.relative_to.clone_from(&attached);
        }
        let frame = Frame {
            inside: model.to_owned(),
            pose: pose.pose,
            attached_to: model.to_owned(),
            scope: scope.to_owned(),
            said_inside: pose.relative_to,
            said_attached_to: attached,
        };
        self.frames.add(name, frame);
    }

    /// Adds the frame of a part. `attached_to` is its own name, or what it is in. False if there is one of that name.
    fn add_placed(
        &mut self,
        name: String,
        scope: &str,
        pose: PoseText,
        inside: String,
        attached_to: Option<String>,
    ) -> bool {
        let attached_to = attached_to.unwrap_or_else(|| inside.clone());
        let frame = Frame {
            inside,
            pose: pose.pose,
            attached_to,
            scope: scope.to_owned(),
            said_inside: pose.relative_to,
            said_attached_to: String::new(),
        };
        self.frames.add(name, frame)
    }

    fn finish(mut self, source: &mut Source, node: Node) -> Frames {
        for unknown in self.frames.resolve_names() {
            source.warn(
                node,
                format!(
                    "there is no frame '{}': the default one is taken",
                    short(&unknown)
                ),
            );
        }
        for (scope, name) in self.placements.iter().rev() {
            let model = format!("{scope}{MODEL}");
            let frame = self.frames.full_name(scope, name);
            if !frame.is_some_and(|frame| self.frames.place_by(&model, &frame)) {
                source.warn(
                    node,
                    format!("the placement frame '{}' is not in its model", short(name)),
                );
            }
        }
        self.frames
    }
}

fn no_pose() -> PoseText {
    PoseText {
        pose: Pose::identity(),
        relative_to: String::new(),
    }
}
