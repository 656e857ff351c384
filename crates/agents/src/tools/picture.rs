//! Pictures of the scene, with what is where in them.

use std::collections::BTreeMap;

use format::picture::{self, Layout};
use mcp::Answer;
use perception::vision::{Viewpoint, first_camera};
use scene::{Data, Handle};
use serde_json::{Value, json};
use simulator::{Channels, Picture};

use super::{Group, flag, happened, number, object, point, reading, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;
use crate::values::{self, data};

pub(crate) const GROUP: Group = Group { tools, call };

/// Width and height, unless others are asked for.
const SIZE: [u32; 2] = [512, 384];
/// Objects that are named.
const MAX_LABELS: usize = 40;

fn tools() -> Vec<mcp::Tool> {
    let side = |what: &str| json!({"type": "integer", "minimum": 16, "maximum": 2048, "description": what});
    vec![reading(tool(
        "picture",
        "Picture",
        "Draws the scene: as a camera or vision sensor sees it, from `eye` towards `target`, or, without arguments, from where all can be seen. Lists the visible objects with their places in the picture (pixels from the upper left corner) and distances.",
        &[
            (
                "camera",
                object(
                    "Path or handle of a camera or vision sensor; \"first\": the first camera of the scene",
                ),
            ),
            ("eye", point("Where to look from, metres")),
            (
                "target",
                point("What to look at, metres [default: the origin]"),
            ),
            (
                "width",
                side("Pixels [default: 512, or that of the vision sensor]"),
            ),
            (
                "height",
                side("Pixels [default: 384, or that of the vision sensor]"),
            ),
            (
                "labels",
                json!({"type": "boolean", "description": "List the visible objects [default: true]"}),
            ),
            (
                "depth",
                flag("Answer a picture of the distances too: near is bright"),
            ),
            (
                "range",
                number(
                    "Distance that is black in the picture of distances, metres [default: the farthest object]",
                ),
            ),
        ],
        &[],
    ))]
}

fn call(agent: &mut Agent, _: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    let (viewpoint, own) = viewpoint(agent, arguments)?;
    let usual = own.unwrap_or(SIZE);
    let side = |name, usual| arguments.count(name).map_or(usual, |side| side as u32);
    let size = [side("width", usual[0]), side("height", usual[1])];
    let seen = agent.sim.picture_from(&viewpoint, size, Channels::ALL);
    let (picture, view) = seen.map_err(|error| error.to_string())?;
    let distances = distances(&picture, view.clipping);
    let mut answer = Answer::text(format!("{} x {} pixels.", size[0], size[1]));
    if arguments
        .get("labels")
        .is_none_or(|value| value != &Value::Bool(false))
    {
        let labels = labels(agent, &picture, &distances);
        answer = Answer::text(text(size, &labels))
            .with(json!({"labels": labels.iter().map(Label::json).collect::<Vec<_>>()}));
    }
    answer = answer.and_png(colour_file(&picture)?);
    if arguments.flag("depth") {
        let (file, farthest) = depth_file(&picture, &distances, arguments.number("range"))?;
        answer = answer
            .and_text(&format!(
                "Distances along the axis of the camera: white 0 m, black {} m and more.",
                values::number(farthest)
            ))
            .and_png(file);
    }
    Ok(answer.and_text(&happened(agent)))
}

/// From where, and the size of the pictures of a vision sensor.
fn viewpoint(
    agent: &mut Agent,
    arguments: Arguments<'_>,
) -> Result<(Viewpoint, Option<[u32; 2]>), String> {
    if let Some(eye) = arguments.numbers::<3>("eye") {
        let target = arguments.numbers::<3>("target").unwrap_or_default();
        if eye == target {
            return Err("eye and target are the same point".into());
        }
        return Ok((Viewpoint::looking(eye, target), None));
    }
    let from = match arguments.get("camera") {
        None => None,
        Some(Value::String(word)) if word == "first" => first_camera(&agent.sim.scene()),
        Some(camera) => match agent.helper("find", &[data(camera)])? {
            Data::Int(handle) => Handle::from_raw(handle),
            _ => None,
        },
    };
    let scene = agent.sim.scene();
    let found = Viewpoint::new(&scene, from).map_err(|_| {
        "that is neither a camera nor a vision sensor: find_objects with type \"camera\" or \"vision sensor\" lists them; `eye` and `target` look from anywhere".to_owned()
    })?;
    let own = found.resolution(&scene);
    Ok((found, own))
}

/// Metres along the axis of the camera; none where nothing is.
fn distances(picture: &Picture, [near, far]: [f64; 2]) -> Vec<Option<f64>> {
    let distance = |depth: &f32| (*depth < 1.0).then(|| near + f64::from(*depth) * (far - near));
    picture.depth.iter().map(distance).collect()
}

/// An object that can be seen.
struct Label {
    path: String,
    handle: u32,
    /// Its middle, pixels from the upper left corner.
    at: [usize; 2],
    /// Left, top, right and bottom.
    bounds: [usize; 4],
    pixels: usize,
    /// Of the nearest point, metres.
    distance: f64,
}

impl Label {
    fn json(&self) -> Value {
        json!({"path": self.path, "handle": self.handle, "at": self.at, "box": self.bounds, "pixels": self.pixels, "distance": self.distance})
    }
}

fn text(size: [u32; 2], labels: &[Label]) -> String {
    let mut out = format!(
        "{} x {} pixels. Visible objects: middle (x, y), box, distance\n",
        size[0], size[1]
    );
    for label in labels {
        let [left, top, right, bottom] = label.bounds;
        out += &format!(
            "{} #{}: ({}, {}), {left}..{right} x {top}..{bottom}, {} m\n",
            label.path,
            label.handle,
            label.at[0],
            label.at[1],
            values::number(label.distance)
        );
    }
    if labels.is_empty() {
        out += "none: look from elsewhere with `eye` and `target`\n";
    }
    out
}

/// The visible objects, those of most pixels first.
fn labels(agent: &Agent, picture: &Picture, distances: &[Option<f64>]) -> Vec<Label> {
    let [width, height] = picture.resolution.map(|side| side as usize);
    let mut found: BTreeMap<u32, (Label, [usize; 2])> = BTreeMap::new();
    for (at, id) in picture
        .ids
        .iter()
        .enumerate()
        .filter(|(_, id)| **id != Picture::NOTHING)
    {
        let (x, y) = (at % width, height - 1 - at / width);
        let (label, sums) = found
            .entry(*id)
            .or_insert_with(|| (Label::new(agent, *id, x, y), [0; 2]));
        label.pixels += 1;
        (sums[0], sums[1]) = (sums[0] + x, sums[1] + y);
        let [left, top, right, bottom] = label.bounds;
        label.bounds = [left.min(x), top.min(y), right.max(x), bottom.max(y)];
        if let Some(distance) = distances.get(at).copied().flatten() {
            label.distance = label.distance.min(distance);
        }
    }
    let placed = |(label, sums): (Label, [usize; 2])| Label {
        at: sums.map(|sum| sum / label.pixels),
        ..label
    };
    let mut labels: Vec<Label> = found.into_values().map(placed).collect();
    labels.sort_by_key(|label| std::cmp::Reverse(label.pixels));
    labels.truncate(MAX_LABELS);
    labels
}

impl Label {
    fn new(agent: &Agent, id: u32, x: usize, y: usize) -> Self {
        Self {
            path: agent.sim.scene().short_path(Handle(id)).unwrap_or_default(),
            handle: id,
            at: [x, y],
            bounds: [x, y, x, y],
            pixels: 0,
            distance: f64::INFINITY,
        }
    }
}

fn colour_file(picture: &Picture) -> Result<Vec<u8>, String> {
    let resolution = picture.resolution.map(i64::from);
    let upright = picture::Picture::new(picture.colour.clone(), resolution, Layout::Rgb);
    let file = upright.and_then(|picture| picture.flipped(false, true).encode("png", 100));
    file.map_err(|error| error.to_string())
}

/// A picture of distances, and what is black in it.
fn depth_file(
    picture: &Picture,
    distances: &[Option<f64>],
    range: Option<f64>,
) -> Result<(Vec<u8>, f64), String> {
    let farthest = distances.iter().flatten().copied().fold(0.0, f64::max);
    let farthest = range
        .filter(|range| *range > 0.0)
        .unwrap_or(farthest)
        .max(1e-3);
    let level = |distance: &Option<f64>| {
        let share = distance.map_or(0.0, |distance| 1.0 - distance / farthest);
        [(255.0 * share.clamp(0.0, 1.0)) as u8; 3]
    };
    let grey = Picture {
        colour: distances.iter().flat_map(level).collect(),
        ..picture.clone()
    };
    Ok((colour_file(&grey)?, farthest))
}
