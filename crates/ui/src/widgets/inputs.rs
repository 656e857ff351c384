//! Widgets with one value: buttons, sliders, texts.

/// A push button.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Button {
    /// The text on it.
    pub text: String,
    /// It stays down until it is pressed again.
    pub checkable: bool,
    /// Whether it is down.
    pub checked: bool,
    pub(crate) auto_exclusive: bool,
    /// Its icon, as the text of the window names it; empty for none.
    pub icon: String,
    /// Milliseconds before it repeats, and between repetitions, while it is held down.
    pub repeat: Option<[i64; 2]>,
}

/// A box with a tick.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Checkbox {
    /// The text beside it.
    pub text: String,
    /// 0, 1 for partially, 2.
    pub value: i64,
    /// Whether a person can change it.
    pub checkable: bool,
    pub(crate) auto_exclusive: bool,
}

/// One choice of several.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Radiobutton {
    /// The text beside it.
    pub text: String,
    /// Whether it is the chosen one.
    pub checked: bool,
    /// Whether a person can choose it.
    pub checkable: bool,
    pub(crate) auto_exclusive: bool,
}

/// A list of texts of which one is selected.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Combobox {
    /// The texts in order.
    pub items: Vec<String>,
    /// Which is selected, from 0.
    pub selected: Option<usize>,
}

/// A line of text that a person can edit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Edit {
    /// The text.
    pub value: String,
    /// The characters are hidden.
    pub password: bool,
    /// What a person enters is an expression in Lua.
    pub evaluates: bool,
    /// Its text is selected.
    pub selected: bool,
}

/// A slider of integers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Slider {
    /// From bottom to top instead of from left to right.
    pub vertical: bool,
    /// The value, within the limits.
    pub value: i64,
    /// Smallest value.
    pub minimum: i64,
    /// Largest value.
    pub maximum: i64,
    pub(crate) tick_interval: i64,
    pub(crate) tick_position: &'static str,
    /// The largest value is at the left or at the bottom.
    pub inverted: bool,
}

impl Slider {
    /// The value nearest to `value` it can have.
    pub(crate) fn clamped(&self, value: i64) -> i64 {
        value.min(self.maximum).max(self.minimum)
    }
}

/// A number with steps.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Spinbox {
    /// The value, within the limits.
    pub value: f64,
    /// Smallest value.
    pub minimum: f64,
    /// Largest value.
    pub maximum: f64,
    /// Change per click.
    pub step: f64,
    /// Digits after the point; None for integers.
    pub decimals: Option<i32>,
    /// Text before the number.
    pub prefix: String,
    /// Text after the number.
    pub suffix: String,
}

impl Spinbox {
    /// The value nearest to `value` it can have: within its limits, an integer, or rounded to its decimals.
    pub(crate) fn clamped(&self, value: f64) -> f64 {
        let value = if value.is_nan() { self.minimum } else { value };
        let rounded = match self.decimals {
            None => value.trunc(),
            Some(decimals) => {
                let scale = 10_f64.powi(decimals.clamp(0, 15));
                let scaled = value * scale;
                if scaled.is_finite() {
                    scaled.round() / scale
                } else {
                    value
                }
            }
        };
        rounded.min(self.maximum).max(self.minimum)
    }
}

/// A text that only scripts change.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Label {
    /// The text; may be HTML.
    pub text: String,
    pub(crate) word_wrap: bool,
}

/// A bar that shows progress.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProgressBar {
    /// The value, within the limits.
    pub value: i64,
    /// The value of an empty bar.
    pub minimum: i64,
    /// The value of a full bar.
    pub maximum: i64,
    /// From bottom to top instead of from left to right.
    pub vertical: bool,
    /// It grows in the opposite direction.
    pub inverted: bool,
    pub(crate) text_visible: bool,
}

/// The format of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TextType {
    /// Plain text.
    Plain,
    /// HTML.
    #[default]
    Html,
    /// Markdown.
    Markdown,
}

impl TextType {
    pub(crate) const NAMES: [&'static str; 3] = ["plain", "html", "markdown"];

    pub(crate) fn named(name: &str) -> Self {
        match name {
            "plain" => Self::Plain,
            "markdown" => Self::Markdown,
            _ => Self::Html,
        }
    }

    pub(crate) fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// A long text.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TextBrowser {
    /// The text, in its format.
    pub text: String,
    /// The format.
    pub text_type: TextType,
    pub(crate) read_only: bool,
    pub(crate) word_wrap: bool,
    /// Where its content comes from, if from elsewhere.
    pub url: String,
}
