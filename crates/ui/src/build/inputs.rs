//! Elements of widgets with one value.

use super::super::widgets::{
    Button, Checkbox, Combobox, Edit, Label, ProgressBar, Radiobutton, Slider, Spinbox,
    TextBrowser, TextType, WidgetKind,
};
use super::super::xml::Element;
use super::attributes::{Attributes, Result, bool_of};

/// A spin box is one of floats if its numbers have fractions above this.
const FRACTION: f64 = 1e-6;
/// Decimals of floats unless the text says another number.
const DECIMALS: i64 = 6;

pub(super) fn button(_: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let repeats = attributes.bool("auto-repeat", false)?;
    let times = [
        attributes.int("auto-repeat-delay", 0)?,
        attributes.int("auto-repeat-interval", 200)?,
    ];
    attributes.bool("default", false)?;
    let checkable = attributes.bool("checkable", false)?;
    Ok(WidgetKind::Button(Button {
        text: attributes.text("text", "???"),
        checkable,
        checked: attributes.bool("checked", false)? && checkable,
        auto_exclusive: attributes.bool("auto-exclusive", false)?,
        icon: attributes.text("icon", ""),
        repeat: repeats.then_some(times),
    }))
}

pub(super) fn checkbox(_: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    Ok(WidgetKind::Checkbox(Checkbox {
        text: attributes.text("text", "???"),
        value: if attributes.bool("checked", false)? {
            2
        } else {
            0
        },
        checkable: attributes.bool("checkable", true)?,
        auto_exclusive: attributes.bool("auto-exclusive", false)?,
    }))
}

pub(super) fn radiobutton(_: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    Ok(WidgetKind::Radiobutton(Radiobutton {
        text: attributes.text("text", "???"),
        checked: attributes.bool("checked", false)?,
        checkable: attributes.bool("checkable", true)?,
        auto_exclusive: attributes.bool("auto-exclusive", true)?,
    }))
}

pub(super) fn combobox(element: &Element, _: &Attributes<'_>) -> Result<WidgetKind> {
    let items = element.children.iter().filter(|child| child.name == "item");
    let items: Vec<String> = items.map(|item| item.text.clone()).collect();
    let selected = (!items.is_empty()).then_some(0);
    Ok(WidgetKind::Combobox(Combobox { items, selected }))
}

pub(super) fn edit(_: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    Ok(WidgetKind::Edit(Edit {
        value: attributes.text("value", ""),
        password: attributes.bool("password", false)?,
        evaluates: attributes.bool("evaluate-expressions", false)?,
        selected: false,
    }))
}

pub(super) fn slider(element: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let positions = ["none", "both-sides", "above", "below", "left", "right"];
    let mut slider = Slider {
        vertical: element.name == "vslider",
        value: 0,
        minimum: attributes.int("minimum", 0)?,
        maximum: attributes.int("maximum", 100)?,
        tick_interval: attributes.int("tick-interval", 0)?,
        tick_position: attributes.choice("tick-position", &positions, "none")?,
        inverted: attributes.bool("inverted", false)?,
    };
    slider.value = slider.clamped(attributes.int("value", 0)?);
    Ok(WidgetKind::Slider(slider))
}

pub(super) fn spinbox(_: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let minimum = attributes.float("minimum")?.unwrap_or(0.0);
    let maximum = attributes.float("maximum")?.unwrap_or(100.0);
    let step = attributes.float("step")?.unwrap_or(1.0);
    let decimals = attributes.int("decimals", -1)?;
    let has_fraction = [minimum, maximum, step]
        .iter()
        .any(|number| number - number.floor() > FRACTION);
    let is_float = match attributes.get("float").filter(|value| *value != "auto") {
        Some(value) => bool_of(value, "float")?,
        None => has_fraction || decimals >= 0,
    };
    let decimals = is_float.then_some(if decimals < 0 {
        DECIMALS
    } else {
        decimals.min(15)
    } as i32);
    let whole = |number: f64| if is_float { number } else { number.trunc() };
    let mut spinbox = Spinbox {
        value: 0.0,
        minimum: whole(minimum),
        maximum: whole(maximum),
        step: whole(step),
        decimals,
        prefix: attributes.text("prefix", ""),
        suffix: attributes.text("suffix", ""),
    };
    spinbox.value = spinbox.clamped(attributes.float("value")?.unwrap_or(0.0));
    Ok(WidgetKind::Spinbox(spinbox))
}

pub(super) fn label(_: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    Ok(WidgetKind::Label(Label {
        text: attributes.text("text", ""),
        word_wrap: attributes.bool("word-wrap", false)?,
    }))
}

pub(super) fn progress_bar(_: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let orientation =
        attributes.choice("orientation", &["horizontal", "vertical"], "horizontal")?;
    Ok(WidgetKind::ProgressBar(ProgressBar {
        minimum: attributes.int("minimum", 0)?,
        maximum: attributes.int("maximum", 100)?,
        value: attributes.int("value", 0)?,
        vertical: orientation == "vertical",
        inverted: attributes.bool("inverted", false)?,
        text_visible: attributes.bool("text-visible", true)?,
    }))
}

pub(super) fn text_browser(_: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let is_html = attributes
        .replaced("html", "type")
        .map(|value| bool_of(value, "html"))
        .transpose()?;
    let default = if is_html == Some(false) {
        "plain"
    } else {
        "html"
    };
    Ok(WidgetKind::TextBrowser(TextBrowser {
        text: attributes.text("text", ""),
        text_type: TextType::named(attributes.choice("type", &TextType::NAMES, default)?),
        read_only: attributes.bool("read-only", true)?,
        word_wrap: attributes.bool("word-wrap", true)?,
        url: String::new(),
    }))
}
