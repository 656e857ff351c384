//! Widgets with one value: buttons, sliders, texts.

/// A push button.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Button {
    pub text: String,
    /// It stays down.
    pub checkable: bool,
    pub checked: bool,
    pub auto_exclusive: bool,
    pub icon: String,
    /// Milliseconds before it repeats, and between repetitions, while it is held down.
    pub repeat: Option<[i64; 2]>,
}

/// A box with a tick.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Checkbox {
    pub text: String,
    /// 0, 1 for partially, 2.
    pub value: i64,
    pub checkable: bool,
    pub auto_exclusive: bool,
}

/// One choice of several.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Radiobutton {
    pub text: String,
    pub checked: bool,
    pub checkable: bool,
    pub auto_exclusive: bool,
}

/// A list of texts of which one is selected.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Combobox {
    pub items: Vec<String>,
    pub selected: Option<usize>,
}

/// A line of text to change.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Edit {
    pub value: String,
    pub password: bool,
    /// What a person enters is an expression in Lua.
    pub evaluates: bool,
    /// Its text is selected.
    pub selected: bool,
}

/// A slider of integers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Slider {
    pub vertical: bool,
    pub value: i64,
    pub minimum: i64,
    pub maximum: i64,
    pub tick_interval: i64,
    pub tick_position: &'static str,
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
    pub value: f64,
    pub minimum: f64,
    pub maximum: f64,
    pub step: f64,
    /// Digits after the point; None for integers.
    pub decimals: Option<i32>,
    pub prefix: String,
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
                if scaled.is_finite() { scaled.round() / scale } else { value }
            }
        };
        rounded.min(self.maximum).max(self.minimum)
    }
}

/// A text that only scripts change.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Label {
    pub text: String,
    pub word_wrap: bool,
}

/// How far something has come.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProgressBar {
    pub value: i64,
    pub minimum: i64,
    pub maximum: i64,
    pub vertical: bool,
    pub inverted: bool,
    pub text_visible: bool,
}

/// What the text of a browser is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TextType {
    Plain,
    #[default]
    Html,
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
    pub text: String,
    pub text_type: TextType,
    pub read_only: bool,
    pub word_wrap: bool,
    /// Where its content comes from, if from elsewhere.
    pub url: String,
}
