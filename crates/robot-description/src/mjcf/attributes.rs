//! Attributes of elements, with those that classes of defaults add.

use std::collections::BTreeMap;

use super::element::{Element, Report};

/// Elements that MuJoCo takes for one kind, whose defaults they share.
const ACTUATORS: &[&str] = &[
    "general",
    "motor",
    "position",
    "velocity",
    "intvelocity",
    "damper",
    "cylinder",
    "muscle",
    "adhesion",
];
/// The class of elements that name none.
pub const MAIN: &str = "main";

/// Classes of default attributes, by name.
#[derive(Debug, Default)]
pub struct Defaults {
    classes: Vec<Class>,
    names: BTreeMap<String, usize>,
}

#[derive(Debug, Default)]
struct Class {
    /// The class that it is inside of.
    parent: Option<usize>,
    /// Attributes by the kind of the element.
    kinds: BTreeMap<String, BTreeMap<String, String>>,
}

impl Defaults {
    pub fn new(root: &Element, report: &mut Report) -> Self {
        let mut defaults = Self::default();
        defaults.class_named(MAIN, None);
        for element in root.named("default") {
            defaults.add(element, None, report);
        }
        defaults
    }

    /// Outermost classes are the main one, whatever they are named.
    fn add(&mut self, element: &Element, parent: Option<usize>, report: &mut Report) {
        let name = element.attribute("class");
        let index = match (parent, name) {
            (None, None | Some(MAIN)) => 0,
            (None, Some(name)) => self.class_named(name, Some(0)),
            (Some(_), None) => {
                return report.leave_out(element, "a class inside of a class needs a name");
            }
            (Some(parent), Some(name)) => self.class_named(name, Some(parent)),
        };
        for child in &element.children {
            if child.name == "default" {
                self.add(child, Some(index), report);
            } else {
                let kind = self.classes[index]
                    .kinds
                    .entry(kind(&child.name).to_owned())
                    .or_default();
                kind.extend(
                    child
                        .attributes
                        .iter()
                        .filter(|(key, _)| key != "class")
                        .cloned(),
                );
            }
        }
    }

    fn class_named(&mut self, name: &str, parent: Option<usize>) -> usize {
        if let Some(index) = self.names.get(name) {
            return *index;
        }
        self.classes.push(Class {
            parent,
            ..Class::default()
        });
        self.names.insert(name.to_owned(), self.classes.len() - 1);
        self.classes.len() - 1
    }

    /// The same for an element whose defaults are those of another kind.
    pub fn of_kind<'a>(
        &'a self,
        element: &'a Element,
        kind: &'a str,
        class: &str,
        report: &mut Report,
    ) -> Attributes<'a> {
        Attributes {
            kind,
            ..self.of(element, class, report)
        }
    }

    /// The attributes of an element, in a place where the class is the given one unless the element names another.
    pub fn of<'a>(
        &'a self,
        element: &'a Element,
        class: &str,
        report: &mut Report,
    ) -> Attributes<'a> {
        let own = element.attribute("class");
        let named = own.unwrap_or(class);
        let class = self.names.get(named).copied();
        if class.is_none() && own.is_some() {
            report.warn(
                element,
                format!("there is no class '{}'", crate::xml::short(named)),
            );
        }
        Attributes {
            defaults: self,
            element,
            kind: kind(&element.name),
            class: class.unwrap_or(0),
        }
    }
}

/// What an element is taken for.
fn kind(name: &str) -> &str {
    if ACTUATORS.contains(&name) {
        "general"
    } else {
        name
    }
}

/// The attributes of an element, its own ones first.
#[derive(Debug, Clone, Copy)]
pub struct Attributes<'a> {
    defaults: &'a Defaults,
    pub element: &'a Element,
    /// Of which the defaults are.
    kind: &'a str,
    class: usize,
}

impl<'a> Attributes<'a> {
    pub fn get(&self, name: &str) -> Option<&'a str> {
        self.first_of(&[name]).map(|(_, value)| value)
    }

    /// The attribute of several that is said in the nearest place.
    pub fn first_of<'n>(&self, names: &[&'n str]) -> Option<(&'n str, &'a str)> {
        let own = |name: &&'n str| self.element.attribute(name).map(|value| (*name, value));
        if let Some(found) = names.iter().find_map(own) {
            return Some(found);
        }
        let mut class = Some(self.class);
        while let Some(index) = class {
            let class_here = &self.defaults.classes[index];
            let kind = class_here.kinds.get(self.kind);
            let here = |name: &&'n str| kind?.get(*name).map(|value| (*name, value.as_str()));
            if let Some(found) = names.iter().find_map(here) {
                return Some(found);
            }
            class = class_here.parent;
        }
        None
    }

    pub fn list(&self, report: &mut Report, name: &str) -> Option<Vec<f64>> {
        self.get(name)
            .map(|text| report.numbers(self.element, name, text))
    }

    pub fn number(&self, report: &mut Report, name: &str) -> Option<f64> {
        self.list(report, name)?.first().copied()
    }

    /// Numbers; those that are not there are the given ones.
    pub fn numbers<const N: usize>(
        &self,
        report: &mut Report,
        name: &str,
        otherwise: [f64; N],
    ) -> [f64; N] {
        let Some(found) = self.list(report, name) else {
            return otherwise;
        };
        std::array::from_fn(|i| found.get(i).copied().unwrap_or(otherwise[i]))
    }

    pub fn is_true(&self, name: &str) -> Option<bool> {
        match self.get(name) {
            Some("true") => Some(true),
            Some("false") => Some(false),
            _ => None,
        }
    }
}
