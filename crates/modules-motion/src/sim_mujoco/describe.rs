//! What an injection means: soft things, constraints, settings, and what has no counterpart.

use robot_description::mjcf::{Element, Flex};

use super::info::{elements, flexcomp, text, whole};
use super::names;
use super::{Cx, Result, refused};
use format::robot_file::SoftShape;
use scene::{Data, Handle};

/// Settings of `<option>` that act.
const GRAVITY: &str = "gravity";
const STEP: &str = "timestep";

/// What an injection was added as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Flexcomp,
    Composite,
    Any,
}

/// What an injection becomes.
#[derive(Debug, Default)]
pub(super) struct Described {
    /// What it is on; None: the world.
    pub holder: Option<Handle>,
    /// The soft things, in the frame of the holder.
    pub softs: Vec<(Flex, SoftShape)>,
    pub acts: Vec<Act>,
    /// What has no counterpart, as it is named.
    pub unknown: Vec<String>,
}

/// What an injection does beside adding soft things.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Act {
    Hold(Hold),
    /// m/s2
    Gravity([f64; 3]),
    /// Seconds.
    Step(f64),
}

/// Two bodies that are held together.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Hold {
    /// None: the world.
    pub bodies: [Option<String>; 2],
    /// In the frame of the first one.
    pub anchor: [f64; 3],
    /// Whether they do not turn against each other.
    pub is_weld: bool,
    /// The element, as it is named.
    pub name: String,
}

/// Reads an injection.
///
/// # Errors
/// When it says nothing that could be read.
pub(super) fn describe(cx: &Cx, kind: Kind, info: &Data, xml: &str) -> Result<Described> {
    let mut described = Described {
        holder: holder(cx, info)?,
        ..Described::default()
    };
    let body = match described.holder {
        Some(holder) => cx.scene().object(holder)?.alias().to_owned(),
        None => String::new(),
    };
    let found = match kind {
        Kind::Flexcomp => vec![named_flexcomp(info)?],
        Kind::Composite => vec![composite(info, xml)?],
        Kind::Any => elements(xml, "xml")?,
    };
    if found.is_empty() {
        return Err(refused("xml: there is no element in it."));
    }
    let mask = whole(info, "respondableMask")?;
    for element in &found {
        described.add(element, &body, mask)?;
    }
    Ok(described)
}

fn named_flexcomp(info: &Data) -> Result<Element> {
    let element = flexcomp(info)?;
    match element.attribute("name") {
        Some(name) if !name.is_empty() => Ok(element),
        _ => Err(refused("a flexcomp needs a 'name'.")),
    }
}

/// The only element of a composite, with what the table says of it.
fn composite(info: &Data, xml: &str) -> Result<Element> {
    let mut found = elements(xml, "xml")?;
    let (Some(mut element), None) = (found.pop(), found.pop()) else {
        return Err(refused("xml: there is not one <composite> in it."));
    };
    if element.name != "composite" {
        return Err(refused("xml: there is not one <composite> in it."));
    }
    for name in ["prefix", "type"] {
        let own = text(info, name)?;
        if let (Some(own), None) = (own, element.attribute(name)) {
            element.attributes.push((name.to_owned(), own));
        }
    }
    match element.attribute("prefix") {
        Some(prefix) if !prefix.is_empty() => Ok(element),
        _ => Err(refused("a composite needs a 'prefix'.")),
    }
}

/// What an injection is on.
fn holder(cx: &Cx, info: &Data) -> Result<Option<Handle>> {
    let scene = cx.scene();
    match (whole(info, "shapeHandle")?, text(info, "element")?) {
        (Some(raw), None) => {
            let handle = Handle::from_raw(raw).ok_or(scene::SceneError::NoSuchObject)?;
            scene.object(handle)?.shape()?;
            Ok(Some(handle))
        }
        (None, Some(element)) => names::object(&scene, &element),
        _ => Err(refused(
            "an injection needs one of 'shapeHandle' and 'element'.",
        )),
    }
}

impl Described {
    fn add(&mut self, element: &Element, body: &str, mask: Option<i64>) -> Result<()> {
        match element.name.as_str() {
            "worldbody" | "equality" => {
                for child in &element.children {
                    self.add(child, body, mask)?;
                }
            }
            "flexcomp" | "composite" => self.add_soft(element, body, mask)?,
            "connect" | "weld" => self.add_hold(element),
            "option" => self.add_option(element)?,
            _ => self.unknown.push(format!("<{}>", element.name)),
        }
        Ok(())
    }

    fn add_soft(&mut self, element: &Element, body: &str, mask: Option<i64>) -> Result<()> {
        let of_element = |reason: String| refused(format!("<{}>: {reason}.", element.name));
        let (flex, warnings) = Flex::of_element(element, body).map_err(of_element)?;
        let told = warnings
            .iter()
            .map(|warning| format!("<{}> ({})", warning.element, warning.message));
        self.unknown.extend(told);
        let mut shape = SoftShape::new(&flex).map_err(of_element)?;
        if let Some(mask) = mask {
            shape = shape.with_mask(mask);
        }
        self.softs.push((flex, shape));
        Ok(())
    }

    fn add_hold(&mut self, element: &Element) {
        let name = |key: &str| element.attribute(key).map(str::to_owned);
        if name("body1").is_none() || element.attribute("active") == Some("false") {
            self.unknown.push(format!("<{}>", element.name));
            return;
        }
        let anchor = element.attribute("anchor").and_then(triple);
        self.acts.push(Act::Hold(Hold {
            bodies: [name("body1"), name("body2")],
            anchor: anchor.unwrap_or_default(),
            is_weld: element.name == "weld",
            name: format!("<{}>", element.name),
        }));
    }

    fn add_option(&mut self, element: &Element) -> Result<()> {
        for (name, value) in &element.attributes {
            let wrong = || refused(format!("<option>: {name} is '{value}'."));
            match name.as_str() {
                GRAVITY => self
                    .acts
                    .push(Act::Gravity(triple(value).ok_or_else(wrong)?)),
                STEP => {
                    let step = value.parse().ok();
                    let step = step.filter(|step: &f64| (1e-6..=1.0).contains(step));
                    self.acts.push(Act::Step(step.ok_or_else(wrong)?));
                }
                _ => self.unknown.push(format!("<option {name}>")),
            }
        }
        let children = element.children.iter();
        self.unknown
            .extend(children.map(|child| format!("<{}>", child.name)));
        Ok(())
    }
}

/// Three numbers of a text.
fn triple(text: &str) -> Option<[f64; 3]> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let [x, y, z] = words[..] else {
        return None;
    };
    let number = |word: &str| word.parse().ok().filter(|x: &f64| x.abs() < 1e6);
    Some([number(x)?, number(y)?, number(z)?])
}
