//! The lines of path objects of V-REP, as drawing objects whose identifiers are the negative handles of the paths.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde_json::json;

use scene::path_object::PathAttributes;
use scene::{Handle, Kind, Scene};

/// The lines that pages have, by identifier.
#[derive(Default)]
pub(super) struct PathLines(BTreeMap<i64, Arc<str>>);

impl PathLines {
    /// Looks at objects that changed, all of them if `all`; adds lines that are new or different to `drawn`, and those that are gone to `removed`.
    pub(super) fn observe(
        &mut self,
        scene: &Scene,
        (objects, all): (&BTreeSet<Handle>, bool),
        drawn: &mut Vec<(i64, Arc<str>)>,
        removed: &mut Vec<i64>,
    ) {
        if all {
            self.0.clear();
        }
        for &handle in objects {
            let id = -handle.raw();
            match describe(scene, handle) {
                Some(text) if self.0.get(&id).is_none_or(|known| **known != *text) => {
                    let text: Arc<str> = text.into();
                    self.0.insert(id, Arc::clone(&text));
                    drawn.push((id, text));
                }
                Some(_) => {}
                None => removed.extend(self.0.remove(&id).map(|_| id)),
            }
        }
        let is_gone = |id: &i64| Handle::from_raw(-id).is_none_or(|handle| !scene.exists(handle));
        let gone: Vec<i64> = self.0.keys().copied().filter(is_gone).collect();
        gone.iter().for_each(|id| drop(self.0.remove(id)));
        removed.extend(gone);
    }
}

/// None for what is no path, or shows no line.
fn describe(scene: &Scene, handle: Handle) -> Option<String> {
    let object = scene.object(handle).ok()?;
    let Kind::Path(path) = &object.kind else {
        return None;
    };
    let is_shown = path.attributes().contains(PathAttributes::SHOW_LINE)
        && scene.is_visible(handle).unwrap_or(false);
    let places: Vec<f32> = path
        .outline()
        .flat_map(|place| [place.x as f32, place.y as f32, place.z as f32])
        .collect();
    let is_line = places.len() >= 6 && places.iter().all(|number| number.is_finite());
    (is_shown && is_line).then(|| {
        let value = json!({
            "id": -handle.raw(), "itemType": "lineStrip", "size": path.line_size, "parent": handle.raw(), "overlay": false,
            "transparency": 0.0, "color": object.colour.ambient_diffuse, "items": places, "stride": 3,
        });
        value.to_string()
    })
}
