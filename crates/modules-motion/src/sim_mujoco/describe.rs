//! What an injection means: soft things, constraints, settings, and what has no counterpart.

use robot_description::Warning;
use robot_description::mjcf::{Actuator, Adhesion, Element, Flex, Tendon, pose_of_element};

use super::info::{elements, flexcomp, text, whole};
use super::names;
use super::{ApiError, Cx, Result, refused};
use format::robot_file::SoftShape;
use scene::{Data, Handle, Pose};

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
    Tendon(Tendon),
    Site(Site),
    Joint(JointChange),
    Actuator(Actuator, [String; 2]),
    Adhesion(Adhesion, String),
    Pair(Pair),
}

impl Act {
    /// The order in which they are done: what others name comes first.
    pub(super) fn rank(&self) -> u8 {
        match self {
            Self::Site(_) => 0,
            Self::Tendon(_) => 1,
            _ => 2,
        }
    }
}

/// A dummy below what the injection is on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Site {
    pub name: String,
    pub pose: Pose,
}

/// What is said of a joint that there is, by the names of the attributes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct JointChange {
    pub name: String,
    pub values: Vec<(&'static str, f64)>,
}

/// Two shapes, and how they touch.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pair {
    pub names: [String; 2],
    pub touches: bool,
    pub friction: Option<f64>,
    /// The element, as it is named.
    pub element: String,
}

/// Attributes of `<joint>` that act.
const OF_JOINT: [&str; 5] = [
    "armature",
    "damping",
    "frictionloss",
    "stiffness",
    "springref",
];

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
            "worldbody" | "equality" | "tendon" | "contact" | "actuator" => {
                for child in &element.children {
                    self.add(child, body, mask)?;
                }
            }
            "flexcomp" | "composite" => self.add_soft(element, body, mask)?,
            "connect" | "weld" => self.add_hold(element),
            "option" => self.add_option(element)?,
            "spatial" | "fixed" => {
                let (tendon, warnings) = Tendon::of_element(element).map_err(of(element))?;
                self.name_all(&warnings);
                self.acts.push(Act::Tendon(tendon));
            }
            "motor" | "position" | "velocity" | "general" => {
                let read = Actuator::of_element(element).map_err(of(element))?;
                let (actuator, moved, warnings) = read;
                self.name_all(&warnings);
                self.acts.push(Act::Actuator(actuator, moved));
            }
            "adhesion" => {
                let (adhesion, body) = Adhesion::of_element(element).map_err(of(element))?;
                self.acts.push(Act::Adhesion(adhesion, body));
            }
            "exclude" => self.add_pair(element, ["body1", "body2"])?,
            "pair" => self.add_pair(element, ["geom1", "geom2"])?,
            "site" => self.add_site(element),
            "joint" if element.attribute("name").is_some() => self.add_joint(element)?,
            _ => self.unknown.push(format!("<{}>", element.name)),
        }
        Ok(())
    }

    /// Names what has no counterpart of something that has one.
    fn name_all(&mut self, warnings: &[Warning]) {
        let told = warnings
            .iter()
            .map(|warning| format!("<{}> ({})", warning.element, warning.message));
        self.unknown.extend(told);
    }

    fn add_site(&mut self, element: &Element) {
        let (pose, warnings) = pose_of_element(element);
        self.name_all(&warnings);
        let name = element.attribute("name").unwrap_or("site").to_owned();
        self.acts.push(Act::Site(Site { name, pose }));
    }

    fn add_pair(&mut self, element: &Element, keys: [&str; 2]) -> Result<()> {
        let [Some(one), Some(other)] = keys.map(|key| element.attribute(key)) else {
            let [one, other] = keys;
            return Err(refused(format!(
                "<{}>: it has no {one} and {other}.",
                element.name
            )));
        };
        let touches = element.name == "pair";
        let friction = element.attribute("friction").map(|text| {
            let first = text
                .split_whitespace()
                .next()
                .and_then(|word| word.parse().ok());
            let friction = first.filter(|x: &f64| x.is_finite() && *x >= 0.0);
            friction.ok_or_else(|| refused(format!("<pair>: friction is '{text}'.")))
        });
        let friction = match element.attribute("condim") {
            Some("1") => Some(0.0),
            _ => friction.transpose()?,
        };
        self.acts.push(Act::Pair(Pair {
            names: [one.to_owned(), other.to_owned()],
            touches,
            friction: friction.filter(|_| touches),
            element: format!("<{}>", element.name),
        }));
        Ok(())
    }

    /// Attributes of a joint that there is.
    fn add_joint(&mut self, element: &Element) -> Result<()> {
        let (mut name, mut values) = (String::new(), Vec::new());
        for (key, text) in &element.attributes {
            if key == "name" {
                name.clone_from(text);
                continue;
            }
            let Some(known) = OF_JOINT.iter().find(|known| *known == key) else {
                self.unknown.push(format!("<joint {key}>"));
                continue;
            };
            let number = text.parse().ok().filter(|x: &f64| x.is_finite());
            let wrong = || refused(format!("<joint>: {key} is '{text}'."));
            values.push((*known, number.ok_or_else(wrong)?));
        }
        self.acts.push(Act::Joint(JointChange { name, values }));
        Ok(())
    }

    fn add_soft(&mut self, element: &Element, body: &str, mask: Option<i64>) -> Result<()> {
        let (flex, warnings) = Flex::of_element(element, body).map_err(of(element))?;
        self.name_all(&warnings);
        let mut shape = SoftShape::new(&flex).map_err(of(element))?;
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

/// Why an element is not read, as an error.
fn of(element: &Element) -> impl Fn(String) -> ApiError + '_ {
    |reason| refused(format!("<{}>: {reason}.", element.name))
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
