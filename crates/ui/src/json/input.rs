//! Inputs from JSON.

use serde_json::Value;

use super::super::canvas::{CanvasInput, Pointer, PointerAction};
use super::super::input::{Input, InputValue, Modifiers, MouseAction};

/// What a page asks for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Action {
    /// With a widget of a window.
    Widget {
        window: String,
        widget: i64,
        input: Input,
    },
    /// The close button of a window, or Escape.
    Close {
        window: String,
        escape: bool,
    },
    Move {
        window: String,
        position: [i64; 2],
    },
    Resize {
        window: String,
        size: [i64; 2],
    },
    /// A button of a banner.
    Banner {
        banner: i64,
        key: String,
    },
}

/// What a page has sent.
///
/// # Errors
/// What is wrong with it, for the author of a page.
pub(crate) fn action(json: &Value) -> Result<Action, String> {
    let fields = Fields(json);
    let kind = fields.text("type")?;
    if kind == "banner" {
        return Ok(Action::Banner {
            banner: fields.int("banner")?,
            key: fields.text("key")?,
        });
    }
    let window = fields.text("window")?;
    Ok(match kind.as_str() {
        "close" => Action::Close {
            window,
            escape: fields.flag("escape"),
        },
        "move" => Action::Move {
            window,
            position: fields.ints("position")?,
        },
        "resize" => Action::Resize {
            window,
            size: fields.ints("size")?,
        },
        _ => Action::Widget {
            window,
            widget: fields.int("widget")?,
            input: input(&fields, &kind)?,
        },
    })
}

fn input(fields: &Fields<'_>, kind: &str) -> Result<Input, String> {
    let place = || Ok::<_, String>([fields.int("row")?, fields.int("column")?]);
    Ok(match kind {
        "click" => Input::Click,
        "value" => Input::Value(value(fields.get("value")?)?),
        "finish" => Input::Finish,
        "select" if fields.has("column") => Input::SelectCell(place()?),
        "select" => Input::Select(fields.int("item").or_else(|_| fields.int("row"))?),
        "cell" => Input::Cell(
            place()?,
            fields
                .has("text")
                .then(|| fields.text("text"))
                .transpose()?,
        ),
        "expand" => Input::Expand(fields.int("item")?, fields.flag("expanded")),
        "key" => Input::Key {
            key: fields.int("key")?,
            text: fields.text("text").unwrap_or_default(),
            modifiers: fields.modifiers(),
        },
        "mouse" => {
            let at = [fields.int("x")?, fields.int("y")?];
            Input::Mouse {
                mouse: mouse(&fields.text("event")?)?,
                at,
                modifiers: fields.modifiers(),
            }
        }
        "pointer" => Input::Canvas(CanvasInput::Pointer(pointer(fields)?)),
        "stroke" => Input::Canvas(CanvasInput::Key {
            down: fields.flag("down"),
            key: fields.int("key")?,
            text: fields.text("text").unwrap_or_default(),
            modifiers: fields.modifiers(),
        }),
        "link" => Input::Link(fields.text("href")?),
        "point" => {
            let at = [fields.number("x")?, fields.number("y")?];
            Input::Point {
                curve: fields.text("curve")?,
                index: fields.int("index")?,
                at,
            }
        }
        "legend" => Input::Legend(fields.text("curve")?),
        "node" => Input::Node(fields.int("node")?),
        "menu" => Input::Menu(fields.text("key")?),
        "doubleClick" => Input::DoubleClick(place()?),
        "property" => Input::Property {
            name: fields.text("name")?,
            text: fields.text("text")?,
        },
        _ => return Err(format!("there is no input of type '{kind}'")),
    })
}

fn pointer(fields: &Fields<'_>) -> Result<Pointer, String> {
    let action = PointerAction::named(&fields.text("event")?)
        .ok_or("the field 'event' is 'down', 'up', 'move' or 'wheel'")?;
    let or_zero = |name| fields.number(name).unwrap_or(0.0);
    Ok(Pointer {
        action,
        at: [fields.number("x")?, fields.number("y")?],
        button: fields.int("button").unwrap_or(0),
        buttons: fields.int("buttons").unwrap_or(0),
        delta: ["dx", "dy"].map(or_zero),
        modifiers: fields.modifiers(),
    })
}

fn value(json: &Value) -> Result<InputValue, String> {
    match json {
        Value::Bool(on) => Ok(InputValue::Bool(*on)),
        Value::String(text) => Ok(InputValue::Text(text.clone())),
        Value::Number(number) => Ok(InputValue::Number(number.as_f64().unwrap_or(f64::NAN))),
        _ => Err("the field 'value' is a bool, a number or a text".into()),
    }
}

fn mouse(event: &str) -> Result<MouseAction, String> {
    match event {
        "down" => Ok(MouseAction::Down),
        "up" => Ok(MouseAction::Up),
        "move" => Ok(MouseAction::Move),
        _ => Err("the field 'event' is 'down', 'up' or 'move'".into()),
    }
}

/// The fields of an object.
struct Fields<'a>(&'a Value);

impl<'a> Fields<'a> {
    fn has(&self, name: &str) -> bool {
        self.0.get(name).is_some_and(|value| !value.is_null())
    }

    fn get(&self, name: &str) -> Result<&'a Value, String> {
        self.0
            .get(name)
            .ok_or_else(|| format!("the field '{name}' is missing"))
    }

    fn text(&self, name: &str) -> Result<String, String> {
        let text = self.get(name)?.as_str();
        text.map(str::to_owned)
            .ok_or_else(|| format!("the field '{name}' is no text"))
    }

    fn number(&self, name: &str) -> Result<f64, String> {
        self.get(name)?
            .as_f64()
            .ok_or_else(|| format!("the field '{name}' is no number"))
    }

    fn int(&self, name: &str) -> Result<i64, String> {
        self.number(name).map(|number| number as i64)
    }

    fn ints(&self, name: &str) -> Result<[i64; 2], String> {
        let list = self.get(name)?.as_array().map(Vec::as_slice);
        let numbers = list.and_then(|list| match list {
            [first, second] => Some([first.as_f64()? as i64, second.as_f64()? as i64]),
            _ => None,
        });
        numbers.ok_or_else(|| format!("the field '{name}' is no list of two numbers"))
    }

    fn flag(&self, name: &str) -> bool {
        self.0.get(name).and_then(Value::as_bool).unwrap_or(false)
    }

    fn modifiers(&self) -> Modifiers {
        let held = |name: &str| {
            self.0
                .get("modifiers")
                .and_then(|all| all.get(name))
                .and_then(Value::as_bool)
        };
        let held = |name| held(name).unwrap_or(false);
        Modifiers {
            shift: held("shift"),
            control: held("control"),
            alt: held("alt"),
        }
    }
}
