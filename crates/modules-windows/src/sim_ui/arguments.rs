//! Arguments of `simUI`: handles, lists of texts, options of curves.

use crate::{ApiError, Args, FromScript, Result};
use scene::numbers;
use scene::{Data, Key};
use script::{Source, Table};
use ui::CurveOptions;

/// The handle of a window: a text, not a number, as old scripts may have it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct WindowHandle(pub String);

impl FromScript for WindowHandle {
    const TYPE: &'static str = "string";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        match Data::from_script(args)? {
            Data::Text(bytes) | Data::Buffer(bytes) => {
                Ok(Self(String::from_utf8_lossy(&bytes).into_owned()))
            }
            _ => Err(args.not_a("string")),
        }
    }
}

/// A list of texts; numbers become texts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Texts(pub Vec<String>);

impl FromScript for Texts {
    const TYPE: &'static str = "string[]";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        match Table::from_script(args)? {
            Table(Data::Array(items)) => items.iter().map(text_of).collect::<Result<_>>().map(Self),
            Table(_) => Ok(Self(Vec::new())),
        }
    }
}

fn text_of(data: &Data) -> Result<String> {
    match data {
        Data::Text(bytes) | Data::Buffer(bytes) => Ok(String::from_utf8_lossy(bytes).into_owned()),
        Data::Int(number) => Ok(number.to_string()),
        Data::Float(number) => Ok(number.to_string()),
        _ => Err(ApiError::NotA {
            position: -1,
            expected: "string",
        }),
    }
}

/// How a curve is drawn: a map of names and values.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Options(pub CurveOptions);

impl FromScript for Options {
    const TYPE: &'static str = "table";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        let mut options = CurveOptions::default();
        if let Table(Data::Map(entries)) = Table::from_script(args)? {
            for (key, value) in &entries {
                set_option(&mut options, key, value, args.position())?;
            }
        }
        Ok(Self(options))
    }
}

fn set_option(options: &mut CurveOptions, key: &Key, value: &Data, position: i32) -> Result<()> {
    let name = match key {
        Key::Text(name) => String::from_utf8_lossy(name).into_owned(),
        other => format!("{other:?}"),
    };
    let refused = |what: &str| {
        ApiError::Other(format!(
            "read in arg {position} (options): readFromStack(curve_options): {what}"
        ))
    };
    let number = || {
        value
            .as_f64()
            .map(numbers::truncated)
            .ok_or_else(|| refused(&format!("field '{name}': expected int")))
    };
    match name.as_str() {
        "scatter_shape" => options.scatter_shape = number()?,
        "scatter_size" => options.scatter_size = number()?,
        "line_size" => options.line_size = number()?,
        "line_style" => options.line_style = number()?,
        "add_to_legend" => options.add_to_legend = value.truthy(),
        "selectable" => options.selectable = value.truthy(),
        "track" => options.track = value.truthy(),
        _ => return Err(refused(&format!("unexpected key: {name}"))),
    }
    Ok(())
}
