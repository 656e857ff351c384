//! Windows and inputs as JSON: what a page gets and sends. The head of [`super`] has the schema.

mod input;
mod kinds;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Map, Value, json};

use super::widgets::{Container, Item, Widget};
use super::window::Window;

pub(super) use input::{Action, action};

impl Window {
    pub(super) fn json(&self) -> Value {
        json!({
            "id": self.handle(),
            "revision": self.revision,
            "source": self.source.name(),
            "owner": self.owner,
            "title": self.title,
            "visible": self.is_visible(),
            "enabled": self.enabled,
            "modal": self.modal,
            "resizable": self.resizable,
            "closeable": self.closeable,
            "activate": self.activate,
            "placement": self.placement.name(),
            "position": self.position,
            "size": self.size,
            "style": self.style,
            "content": self.container_json(&self.root),
        })
    }

    fn container_json(&self, container: &Container) -> Value {
        let item = |item: &Item| match item {
            Item::Widget(id) => self
                .widgets
                .get(id)
                .map_or(Value::Null, |widget| self.widget_json(widget)),
            Item::Break => json!({"kind": "br"}),
            Item::Stretch(factor) => json!({"kind": "stretch", "factor": factor}),
        };
        json!({
            "layout": container.layout.name(),
            "margins": container.margins,
            "spacing": container.spacing,
            "items": container.items.iter().map(item).collect::<Vec<_>>(),
        })
    }

    /// What all widgets have, and what is special about this one.
    fn widget_json(&self, widget: &Widget) -> Value {
        let mut all = Map::new();
        all.insert("id".into(), widget.id.into());
        all.insert("kind".into(), widget.kind.tag().into());
        all.insert("enabled".into(), widget.enabled.into());
        all.insert("visible".into(), widget.visible.into());
        all.insert("style".into(), widget.style.as_str().into());
        all.insert("stretch".into(), widget.stretch.into());
        all.insert("geometry".into(), json!(widget.geometry));
        let handlers: Vec<&str> = widget.handlers.keys().copied().collect();
        all.insert("handlers".into(), json!(handlers));
        if let Value::Object(special) = self.kind_json(&widget.kind) {
            all.extend(special);
        }
        Value::Object(all)
    }
}

/// Bytes as text.
fn base64(bytes: &[u8]) -> String {
    STANDARD.encode(bytes)
}
