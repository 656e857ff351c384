//! Drawing objects: points, lines, triangles and small bodies that scripts draw. Views show all of them, vision sensors those that are
//! tagged as paint.

mod bodies;

use std::collections::BTreeMap;

use nalgebra::Vector3;
use rendering::Picture;

use super::models::{Model, ModelLines, ModelPoints};
use super::{Shot, Subjects};
use bodies::Bodies;
use scene::drawing::options::{DrawingFlags, DrawingKind};
use scene::drawing::{DrawingItem, DrawingObject};
use scene::{Pose, Scene};

/// A drawing object as it is drawn.
pub(super) struct Drawing {
    pub model: Model,
    /// Frame of its items in the world.
    pub pose: Pose,
    /// Drawing objects are no objects of the scene.
    pub id: u32,
}

/// The drawing objects that a picture shows.
pub(super) fn visible(scene: &Scene, shot: &Shot) -> Vec<Drawing> {
    let is_shown = |drawing: &DrawingObject| match shot.subjects {
        Subjects::Visible => true,
        Subjects::Renderable => drawing.style.flags.contains(DrawingFlags::PAINT_TAG),
        Subjects::Object(_) | Subjects::Collection(_) => false,
    };
    let shown = scene
        .drawings()
        .iter()
        .map(|(_, drawing)| drawing)
        .filter(|drawing| is_shown(drawing));
    shown
        .filter_map(|drawing| placed(scene, shot, drawing))
        .collect()
}

fn placed(scene: &Scene, shot: &Shot, drawing: &DrawingObject) -> Option<Drawing> {
    let pose = match drawing.style.parent {
        None => Pose::identity(),
        Some(parent) => {
            let hidden = drawing
                .style
                .flags
                .contains(DrawingFlags::WITH_PARENT_VISIBILITY)
                && !scene.is_visible(parent).unwrap_or(false);
            scene.world_pose(parent).ok().filter(|_| !hidden)?
        }
    };
    let towards_camera = pose
        .rotation
        .inverse_transform_vector(&(shot.pose.rotation * -Vector3::z()));
    Some(Drawing {
        model: model(drawing, towards_camera),
        pose,
        id: Picture::NOTHING,
    })
}

fn model(drawing: &DrawingObject, towards_camera: Vector3<f64>) -> Model {
    let style = &drawing.style;
    let overlay = style.flags.contains(DrawingFlags::OVERLAY);
    let auxiliary = vec![style.colour.auxiliary];
    let colours = || {
        drawing
            .items()
            .map(|item| item_colour(drawing, item))
            .collect()
    };
    let lines = |segments: Vec<[[f64; 3]; 2]>, colours| ModelLines {
        segments,
        colours,
        auxiliary: auxiliary.clone(),
        width: style.size as f32,
        overlay,
    };
    match style.kind {
        DrawingKind::Points => {
            let positions = drawing.items().map(|item| item.points()[0]).collect();
            let points = ModelPoints {
                positions,
                colours: colours(),
                auxiliary,
                size: style.size as f32,
                overlay,
            };
            Model {
                points: Some(points),
                ..Model::default()
            }
        }
        DrawingKind::Lines => {
            let segments = drawing
                .items()
                .map(|item| [item.points()[0], item.points()[1]])
                .collect();
            Model {
                lines: Some(lines(segments, colours())),
                ..Model::default()
            }
        }
        DrawingKind::LineStrip => {
            let points: Vec<[f64; 3]> = drawing.items().map(|item| item.points()[0]).collect();
            let segments = points.windows(2).map(|ends| [ends[0], ends[1]]).collect();
            let colours = drawing
                .items()
                .skip(1)
                .map(|item| item_colour(drawing, item))
                .collect();
            Model {
                lines: Some(lines(segments, colours)),
                ..Model::default()
            }
        }
        _ => Model {
            parts: solids(drawing, towards_camera),
            ..Model::default()
        },
    }
}

/// Triangles and small bodies: those that let as much light through together.
fn solids(drawing: &DrawingObject, towards_camera: Vector3<f64>) -> Vec<super::models::ModelPart> {
    let mut by_opacity: BTreeMap<u32, Bodies> = BTreeMap::new();
    for item in drawing.items() {
        let transparency = item
            .transparency()
            .map_or(drawing.style.flags.transparency(), |part| part as f32);
        let opacity = (1.0 - transparency).clamp(0.0, 1.0);
        let facing = item.normal().map_or(towards_camera, Vector3::from);
        let size = item.size().unwrap_or(drawing.style.size);
        by_opacity.entry(opacity.to_bits()).or_default().add(
            drawing.style.kind,
            item,
            size,
            facing,
            item_colour(drawing, item),
        );
    }
    let parts = by_opacity.into_iter();
    parts
        .filter_map(|(opacity, bodies)| bodies.part(&drawing.style, f32::from_bits(opacity)))
        .collect()
}

/// The colour of an item: its own, the mean of those of its points, or that of the drawing object.
pub fn item_colour(drawing: &DrawingObject, item: DrawingItem) -> [f32; 3] {
    let style = &drawing.style;
    let own = item.colours();
    if own.is_empty() {
        let emits = style.colour.emission.iter().any(|part| *part > 0.0);
        return if emits {
            style.colour.emission
        } else {
            style.colour.ambient_diffuse
        };
    }
    [0, 1, 2].map(|i| (own.iter().map(|colour| colour[i]).sum::<f64>() / own.len() as f64) as f32)
}
