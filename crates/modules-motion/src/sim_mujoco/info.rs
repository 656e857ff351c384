//! What a table of an injection says.

use std::fmt::Write as _;

use robot_description::mjcf::{Element, Fragment};

use super::{ApiError, Result, refused};
use scene::Data;

/// Numbers of a list, as MJCF writes them.
fn written(numbers: &[f64]) -> String {
    let mut text = String::new();
    for number in numbers {
        let _ = write!(text, "{number} ");
    }
    text
}

fn wrong(name: &str) -> ApiError {
    refused(format!("invalid value of '{name}'."))
}

fn given<'a>(info: &'a Data, name: &str) -> Option<&'a Data> {
    info.field(name).filter(|value| **value != Data::Nil)
}

/// A text; None where it is not given.
pub(super) fn text(info: &Data, name: &str) -> Result<Option<String>> {
    match given(info, name) {
        None => Ok(None),
        Some(Data::Text(bytes)) => match String::from_utf8(bytes.clone()) {
            Ok(text) => Ok(Some(text)),
            Err(_) => Err(wrong(name)),
        },
        Some(_) => Err(wrong(name)),
    }
}

/// A number; None where it is not given.
pub(super) fn number(info: &Data, name: &str) -> Result<Option<f64>> {
    let Some(value) = given(info, name) else {
        return Ok(None);
    };
    let value = value.as_f64().filter(|number| number.is_finite());
    value.map(Some).ok_or_else(|| wrong(name))
}

/// A whole number; None where it is not given.
pub(super) fn whole(info: &Data, name: &str) -> Result<Option<i64>> {
    match given(info, name) {
        None => Ok(None),
        Some(Data::Int(number)) => Ok(Some(*number)),
        Some(Data::Float(number)) if number.fract() == 0.0 => Ok(Some(*number as i64)),
        Some(_) => Err(wrong(name)),
    }
}

/// Numbers of a list; None where it is not given.
fn list(info: &Data, name: &str) -> Result<Option<Vec<f64>>> {
    match given(info, name) {
        None => Ok(None),
        Some(Data::Array(items)) => {
            let number = |item: &Data| item.as_f64().filter(|number| number.is_finite());
            let numbers: Option<Vec<f64>> = items.iter().map(number).collect();
            numbers.map(Some).ok_or_else(|| wrong(name))
        }
        Some(_) => Err(wrong(name)),
    }
}

/// The `<flexcomp>` that a table describes.
pub(super) fn flexcomp(info: &Data) -> Result<Element> {
    let extra = text(info, "extraFlexcompXml")?.unwrap_or_default();
    let extra = Fragment::element("flexcomp", &extra)
        .map_err(|error| refused(format!("extraFlexcompXml: {error}.")))?;
    let mut element = Element::new("flexcomp");
    for name in ["name", "type"] {
        set(&mut element, name, text(info, name)?);
    }
    for (name, size) in [("count", 3), ("spacing", 3)] {
        let numbers = list(info, name)?;
        if numbers
            .as_ref()
            .is_some_and(|numbers| numbers.len() != size)
        {
            return Err(wrong(name));
        }
        set(&mut element, name, numbers.map(|numbers| written(&numbers)));
    }
    for name in ["radius", "mass"] {
        set(
            &mut element,
            name,
            number(info, name)?.map(|x| x.to_string()),
        );
    }
    set_pose(&mut element, info)?;
    for (name, value) in extra.attributes {
        if element.attribute(&name).is_none() {
            element.attributes.push((name, value));
        }
    }
    let inside = text(info, "extraXml")?.unwrap_or_default();
    element.children = elements(&inside, "extraXml")?;
    element.children.extend(pins(info)?);
    Ok(element)
}

fn set(element: &mut Element, name: &str, value: Option<String>) {
    element
        .attributes
        .extend(value.map(|value| (name.to_owned(), value)));
}

fn set_pose(element: &mut Element, info: &Data) -> Result<()> {
    let Some(pose) = list(info, "pose")? else {
        return Ok(());
    };
    let [x, y, z, i, j, k, w] = pose[..] else {
        return Err(wrong("pose"));
    };
    if [i, j, k, w].iter().map(|x| x * x).sum::<f64>() < 1e-12 {
        return Err(wrong("pose"));
    }
    set(element, "pos", Some(written(&[x, y, z])));
    set(element, "quat", Some(written(&[w, i, j, k])));
    Ok(())
}

/// The pinned nodes as an element.
fn pins(info: &Data) -> Result<Option<Element>> {
    let Some(nodes) = list(info, "pin")? else {
        return Ok(None);
    };
    let mut pins = Element::new("pin");
    set(&mut pins, "id", Some(written(&nodes)));
    Ok(Some(pins))
}

/// The elements of a text that is called `what`.
pub(super) fn elements(text: &str, what: &str) -> Result<Vec<Element>> {
    let read = Fragment::read(text).map_err(|error| refused(format!("{what}: {error}.")))?;
    match read.warnings.first() {
        Some(warning) => Err(refused(format!("{what}: {warning}."))),
        None => Ok(read.elements),
    }
}
