//! Finds windows and widgets by what a person sees: titles, texts, labels.

use super::Ui;
use super::widgets::{Widget, WidgetKind};
use super::window::Window;

impl Ui {
    /// The handle of the window with that title, or that handle. Of several the newest visible one.
    ///
    /// # Errors
    /// Which windows there are.
    pub fn find_window(&self, title: &str) -> Result<String, String> {
        let named = |window: &&Window| window.title == title || window.handle() == title;
        let mut found: Vec<&Window> = self.windows().filter(named).collect();
        found.sort_by_key(|window| (window.is_visible(), window.id));
        let all: Vec<String> = self
            .windows()
            .map(|window| format!("'{}'", window.title))
            .collect();
        match found.last() {
            Some(window) => Ok(window.handle()),
            None if all.is_empty() => Err(format!(
                "there is no window '{title}': no script has opened one."
            )),
            None => Err(format!(
                "there is no window '{title}'; there are: {}.",
                all.join(", ")
            )),
        }
    }
}

impl Window {
    /// The id of a widget that a person or a script calls `name`: the name of its id in the text of the window (`id="${name}"`), its text, its title,
    /// the label before it, the function it calls, or its id.
    ///
    /// # Errors
    /// Which widgets there are.
    pub fn find_widget(&self, name: &str) -> Result<i64, String> {
        let order = self.in_reading_order();
        let by_name = self.names.get(name).copied();
        let by_id = || name.parse().ok().filter(|id| self.widgets.contains_key(id));
        let by_text = || {
            order
                .iter()
                .find(|widget| widget.text() == Some(name))
                .map(|widget| widget.id)
        };
        let by_label = || {
            let pairs = order.iter().zip(order.iter().skip(1));
            let labelled = |(label, _): &(&&Widget, &&Widget)| label.label() == Some(name);
            pairs
                .into_iter()
                .find(labelled)
                .map(|(_, widget)| widget.id)
        };
        let by_handler = || {
            let calls = |widget: &&&Widget| widget.handlers.values().any(|handler| handler == name);
            order.iter().find(calls).map(|widget| widget.id)
        };
        let found = by_name
            .or_else(by_id)
            .or_else(by_text)
            .or_else(by_label)
            .or_else(by_handler);
        found.ok_or_else(|| {
            let all: Vec<String> = order.iter().map(|widget| self.described(widget)).collect();
            format!(
                "window '{}' has no widget '{name}'; it has: {}.",
                self.title,
                all.join(", ")
            )
        })
    }

    /// A widget for people: its kind, and what it is called.
    fn described(&self, widget: &Widget) -> String {
        let name = self
            .names
            .iter()
            .find(|(_, id)| **id == widget.id)
            .map(|(name, _)| name.as_str());
        match name.or(widget.text()).or(widget.label()) {
            Some(name) => format!("{} '{name}'", widget.kind.tag()),
            None => format!("{} {}", widget.kind.tag(), widget.id),
        }
    }
}

impl Widget {
    /// The text on it.
    fn text(&self) -> Option<&str> {
        match &self.kind {
            WidgetKind::Button(button) => Some(&button.text),
            WidgetKind::Checkbox(checkbox) => Some(&checkbox.text),
            WidgetKind::Radiobutton(button) => Some(&button.text),
            WidgetKind::Tab(tab) => Some(&tab.title),
            _ => None,
        }
    }

    /// What a label says about the widget after it.
    fn label(&self) -> Option<&str> {
        match &self.kind {
            WidgetKind::Label(label) => Some(label.text.trim().trim_end_matches(':').trim_end()),
            _ => None,
        }
    }
}
