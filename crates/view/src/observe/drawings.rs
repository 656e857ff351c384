//! Drawing objects as JSON.

use std::sync::Arc;

use serde_json::json;

use super::Observer;
use perception::vision::item_colour;
use scene::Scene;
use scene::drawing::options::{DrawingFlags, DrawingKind};
use scene::drawing::{DrawingItem, DrawingObject};

impl Observer {
    /// Drawing objects that changed, or all; and the identifiers of those that are gone.
    pub(super) fn observe_drawings(
        &mut self,
        scene: &Scene,
        all: bool,
    ) -> (Vec<(i64, Arc<str>)>, Vec<i64>) {
        let drawings = scene.drawings();
        let seen = std::mem::replace(&mut self.drawings_seen, drawings.last_change());
        if seen == drawings.last_change() && !all {
            return (Vec::new(), Vec::new());
        }
        // What goes back has drawing objects that were as they are now before they were seen.
        let all = all || self.reread.is_some();
        let changed = drawings
            .iter()
            .filter(|(_, drawing)| all || drawing.changed_at() > seen);
        let described = changed
            .map(|(id, drawing)| (id, describe(id, drawing).into()))
            .collect();
        let present = drawings.iter().map(|(id, _)| id).collect();
        let before = std::mem::replace(&mut self.known_drawings, present);
        (
            described,
            before.difference(&self.known_drawings).copied().collect(),
        )
    }
}

fn describe(id: i64, drawing: &DrawingObject) -> String {
    let style = &drawing.style;
    let has_colours = drawing
        .items()
        .next()
        .is_some_and(|item| !item.colours().is_empty());
    let has_sizes = style.flags.contains(DrawingFlags::ITEM_SIZES);
    let base = style.colour;
    let emits = base.emission.iter().any(|part| *part > 0.0);
    let mut value = json!({
        "id": id,
        "itemType": name(style.kind),
        "size": style.size,
        "parent": style.parent.map_or(-1, scene::Handle::raw),
        "overlay": style.flags.contains(DrawingFlags::OVERLAY),
        "transparency": style.flags.transparency(),
        "color": if emits { base.emission } else { base.ambient_diffuse },
        "items": drawing.items().flat_map(numbers).collect::<Vec<f32>>(),
        "stride": stride(drawing),
    });
    if has_colours {
        value["colors"] = drawing
            .items()
            .flat_map(|item| item_colour(drawing, item))
            .collect();
    }
    if has_sizes {
        value["sizes"] = drawing
            .items()
            .map(|item| item.size().unwrap_or(style.size))
            .collect();
    }
    value.to_string()
}

fn name(kind: DrawingKind) -> &'static str {
    match kind {
        DrawingKind::Points => "point",
        DrawingKind::Lines => "line",
        DrawingKind::Triangles => "triangle",
        DrawingKind::TrianglePoints => "trianglePoint",
        DrawingKind::QuadPoints => "quadPoint",
        DrawingKind::DiscPoints => "discPoint",
        DrawingKind::CubePoints => "cubePoint",
        DrawingKind::SpherePoints => "spherePoint",
        DrawingKind::LineStrip => "lineStrip",
    }
}

/// Coordinates of the points, then a quaternion where the item has a direction.
fn numbers(item: DrawingItem<'_>) -> Vec<f32> {
    let coordinates = item.points().iter().flatten().map(|number| *number as f32);
    let turn = item.normal().into_iter().flat_map(towards);
    coordinates.chain(turn).collect()
}

fn stride(drawing: &DrawingObject) -> usize {
    let normal = drawing
        .items()
        .next()
        .is_some_and(|item| item.normal().is_some());
    3 * drawing.style.kind.points() + if normal { 4 } else { 0 }
}

/// The rotation (x, y, z, w) that turns the z axis into a direction.
fn towards(direction: [f64; 3]) -> [f32; 4] {
    use nalgebra::{UnitQuaternion, Vector3};
    let half_turn = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(0.0, 1.0, 0.0, 0.0));
    let direction = Vector3::from(direction);
    let turn = match direction.try_normalize(1e-12) {
        Some(direction) => {
            UnitQuaternion::rotation_between(&Vector3::z(), &direction).unwrap_or(half_turn)
        }
        None => UnitQuaternion::identity(),
    };
    let [x, y, z, w]: [f64; 4] = turn.coords.into();
    [x as f32, y as f32, z as f32, w as f32]
}
