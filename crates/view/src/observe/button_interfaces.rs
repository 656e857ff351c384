//! User interfaces of V-REP as windows of the same form as those of simUI (`crates/ui/src/lib.rs`), so that a page shows both alike.

use std::sync::Arc;

use serde_json::{Value, json};

use scene::Scene;
use scene::tree::button_interfaces::{
    Button, ButtonInterface, ButtonKind, button_property, ui_property,
};

/// Buttons are at least as high on a page, pixels.
const LEAST_HEIGHT: i32 = 24;
/// Cells of a user interface and their pixels: more is a mistake of the file.
const MAX_CELLS: i32 = 1000;
const PREFIX: &str = "2DElement-";

/// The user interfaces that pages were shown.
#[derive(Default)]
pub(crate) struct ButtonWindows {
    /// Scene, revision and selection of the last time.
    seen: Option<(i64, u64, Vec<i64>)>,
    /// Identifiers, JSON.
    shown: Vec<String>,
}

/// What changed: identifiers with windows, and identifiers of those that are gone; all JSON.
pub(crate) struct ChangedButtonWindows {
    pub windows: Vec<(String, Arc<str>)>,
    pub removed: Vec<String>,
}

impl ButtonWindows {
    /// All user interfaces, if any of them may look different now, or `all` are asked for.
    pub(crate) fn changes(
        &mut self,
        scene: &Scene,
        scene_uid: i64,
        all: bool,
    ) -> Option<ChangedButtonWindows> {
        let interfaces = scene.button_interfaces();
        let selection = scene
            .selection()
            .iter()
            .map(|handle| handle.raw())
            .collect();
        let now = Some((scene_uid, interfaces.revision(), selection));
        if !all
            && (self.seen == now || (self.shown.is_empty() && interfaces.iter().next().is_none()))
        {
            return None;
        }
        self.seen = now;
        let mut windows: Vec<(String, Arc<str>)> = interfaces
            .iter()
            .filter(|(_, interface)| scene.shows_button_interface(interface))
            .map(|(handle, interface)| {
                (
                    json!(window_id(handle)).to_string(),
                    window(handle, interface).to_string().into(),
                )
            })
            .collect();
        windows.sort();
        let ids: Vec<String> = windows.iter().map(|(id, _)| id.clone()).collect();
        let removed = std::mem::replace(&mut self.shown, ids);
        let removed = removed
            .into_iter()
            .filter(|id| self.shown.binary_search(id).is_err())
            .collect();
        Some(ChangedButtonWindows { windows, removed })
    }
}

fn window_id(handle: i64) -> String {
    format!("{PREFIX}{handle}")
}

/// The handle of the user interface that a page calls by the identifier of its window.
pub(crate) fn handle_of(window: &str) -> Option<i64> {
    window.strip_prefix(PREFIX)?.parse().ok()
}

fn window(handle: i64, interface: &ButtonInterface) -> Value {
    let scale = scale(interface);
    let buttons = interface
        .buttons
        .iter()
        .map(|button| widget(button, geometry(interface, button, scale)));
    json!({
        "id": window_id(handle), "source": "buttonInterface", "owner": interface.object.map_or(-1, scene::Handle::raw),
        "title": interface.name, "visible": true, "enabled": true, "modal": false, "resizable": false, "closeable": false,
        "activate": false, "placement": "center", "position": interface.position, "size": [-1, -1], "style": "",
        "folded": interface.attributes & ui_property::ROLLED_UP != 0,
        "content": {"layout": "none", "margins": [7, 7, 7, 7], "spacing": -1, "items": buttons.collect::<Vec<_>>()},
    })
}

/// Cells were small: the lowest button becomes as high as a finger or a text needs.
fn scale(interface: &ButtonInterface) -> f64 {
    let heights = interface
        .buttons
        .iter()
        .map(|button| cells(button.span[1]) * pixels(interface.cell_size[1]));
    let lowest = heights
        .filter(|height| *height > 0)
        .min()
        .unwrap_or(LEAST_HEIGHT);
    (f64::from(LEAST_HEIGHT) / f64::from(lowest)).clamp(1.0, 2.5)
}

fn cells(count: i32) -> i32 {
    count.clamp(0, MAX_CELLS)
}

fn pixels(size: i32) -> i32 {
    size.clamp(0, MAX_CELLS)
}

/// Left, top, width, height.
fn geometry(interface: &ButtonInterface, button: &Button, scale: f64) -> [i64; 4] {
    let length = |count: i32, axis: usize| {
        (f64::from(cells(count) * pixels(interface.cell_size[axis])) * scale).round() as i64
    };
    [
        length(button.cell[0], 0),
        length(button.cell[1], 1),
        length(button.span[0], 0),
        length(button.span[1], 1),
    ]
}

fn widget(button: &Button, geometry: [i64; 4]) -> Value {
    let down = button.has(button_property::IS_DOWN);
    let text = if down && !button.down_label.is_empty() {
        &button.down_label
    } else {
        &button.label
    };
    let mut widget = json!({
        "id": button.number, "geometry": geometry, "visible": true, "style": "", "stretch": -1, "handlers": [],
        "enabled": button.has(button_property::ENABLED) && !button.has(button_property::IGNORE_MOUSE),
        "look": look(button, down),
    });
    let special = match button.kind() {
        ButtonKind::Button => json!({
            "kind": "button", "text": text, "checkable": button.has(button_property::STAY_DOWN), "checked": down,
            "holds": true, "autoExclusive": false, "icon": "", "repeat": null,
        }),
        ButtonKind::Label => {
            json!({"kind": "label", "text": text, "wordWrap": false, "plain": true, "enabled": true})
        }
        ButtonKind::Slider => slider(button, geometry[3] > geometry[2]),
        ButtonKind::EditBox => {
            json!({"kind": "edit", "value": button.label, "password": false, "selected": false})
        }
    };
    if let (Value::Object(all), Value::Object(special)) = (&mut widget, special) {
        all.extend(special);
    }
    widget
}

fn slider(button: &Button, vertical: bool) -> Value {
    json!({
        "kind": if vertical { "vslider" } else { "hslider" }, "value": button.slider_position().unwrap_or(0),
        "minimum": 0, "maximum": 1000, "vertical": vertical, "tickInterval": 0, "tickPosition": "none", "inverted": false,
        "label": button.label,
    })
}

/// Colours: of the button as it is now, null without a background; and of its text.
fn look(button: &Button, down: bool) -> Value {
    let bare = button_property::TRANSPARENT | button_property::NO_BACKGROUND_COLOR;
    let at = if down { 3 } else { 0 };
    let background = (button.attributes & bare == 0).then_some(&button.colours[at..at + 3]);
    let bordered = button.kind() != ButtonKind::Label && !button.has(button_property::BORDERLESS);
    json!({"background": background, "color": &button.colours[6..9], "bordered": bordered})
}
