//! The attributes of an element by type, with the errors of the original and warnings of names it does not know.

use std::cell::{Cell, RefCell};

use super::super::xml::Element;

/// What is said about a text that is used all the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Warning {
    Unknown {
        attribute: String,
        widget: String,
    },
    /// It is said once for each name.
    Deprecated {
        old: String,
        new: &'static str,
    },
}

impl Warning {
    pub(crate) fn text(&self) -> String {
        match self {
            Self::Unknown { attribute, widget } => {
                format!("unknown UI XML attribute '{attribute}' in widget '{widget}'")
            }
            Self::Deprecated { old, new } => {
                format!("attribute name '{old}' is deprecated. please use '{new}' instead.")
            }
        }
    }
}

/// Why a text cannot be used.
pub(super) type Result<T> = std::result::Result<T, String>;

/// The attributes of one element; each that is read counts as known.
pub(super) struct Attributes<'a> {
    element: &'a Element,
    known: Vec<Cell<bool>>,
    warnings: &'a RefCell<Vec<Warning>>,
}

impl<'a> Attributes<'a> {
    pub(super) fn new(element: &'a Element, warnings: &'a RefCell<Vec<Warning>>) -> Self {
        Self {
            element,
            known: element
                .attributes
                .iter()
                .map(|_| Cell::new(false))
                .collect(),
            warnings,
        }
    }

    /// The value of an attribute. One with a hyphen had a name without before.
    pub(super) fn get(&self, name: &'static str) -> Option<&'a str> {
        let new = self.find(name);
        let old = if name.contains('-') {
            self.replaced(&name.replace('-', ""), name)
        } else {
            None
        };
        new.or(old)
    }

    fn find(&self, name: &str) -> Option<&'a str> {
        let mut found = None;
        for (known, (key, value)) in self.known.iter().zip(&self.element.attributes) {
            if key == name {
                known.set(true);
                found = found.or(Some(value.as_str()));
            }
        }
        found
    }

    /// The value of an attribute by the name it had before.
    pub(super) fn replaced(&self, old: &str, new: &'static str) -> Option<&'a str> {
        let value = self.find(old)?;
        self.warnings.borrow_mut().push(Warning::Deprecated {
            old: old.to_owned(),
            new,
        });
        Some(value)
    }

    pub(super) fn text(&self, name: &'static str, default: &str) -> String {
        self.get(name).unwrap_or(default).to_owned()
    }

    pub(super) fn bool(&self, name: &'static str, default: bool) -> Result<bool> {
        self.get(name)
            .map_or(Ok(default), |value| bool_of(value, name))
    }

    pub(super) fn int(&self, name: &'static str, default: i64) -> Result<i64> {
        self.get(name).map_or(Ok(default), int_of)
    }

    /// A finite number, if it is there.
    pub(super) fn float(&self, name: &'static str) -> Result<Option<f64>> {
        self.get(name).map(float_of).transpose()
    }

    /// Integers with single commas between them.
    pub(super) fn ints<const N: usize>(&self, name: &'static str) -> Result<Option<[i64; N]>> {
        let Some(value) = self.get(name) else {
            return Ok(None);
        };
        let numbers = value.split(',').map(int_of).collect::<Result<Vec<_>>>()?;
        let wrong = || format!("attribute '{name}' must have exactly {N} elements");
        numbers.try_into().map(Some).map_err(|_| wrong())
    }

    pub(super) fn choice(
        &self,
        name: &'static str,
        choices: &[&'static str],
        default: &'static str,
    ) -> Result<&'static str> {
        let Some(value) = self.get(name) else {
            return Ok(default);
        };
        let found = choices.iter().find(|choice| **choice == value);
        found.copied().ok_or_else(|| {
            let all: Vec<String> = choices.iter().map(|choice| format!("'{choice}'")).collect();
            format!(
                "invalid value for attribute '{name}': '{value}' (must be one of: {})",
                all.join(", ")
            )
        })
    }

    /// Notes the attributes that nobody has read.
    pub(super) fn warn_of_unknown(&self) {
        let mut warnings = self.warnings.borrow_mut();
        for ((attribute, _), _) in self
            .element
            .attributes
            .iter()
            .zip(&self.known)
            .filter(|(_, known)| !known.get())
        {
            warnings.push(Warning::Unknown {
                attribute: attribute.clone(),
                widget: self.element.name.clone(),
            });
        }
    }
}

pub(super) fn bool_of(value: &str, name: &str) -> Result<bool> {
    match value {
        "true" => Ok(true),
        "false" => Ok(false),
        _ => Err(format!(
            "invalid value '{value}' for attribute '{name}': must be true or false"
        )),
    }
}

const NO_NUMBER: &str = "bad lexical cast: source type value could not be interpreted as target";

fn int_of(value: &str) -> Result<i64> {
    value
        .parse::<i32>()
        .map(i64::from)
        .map_err(|_| NO_NUMBER.to_owned())
}

fn float_of(value: &str) -> Result<f64> {
    value
        .parse()
        .ok()
        .filter(|number: &f64| number.is_finite())
        .ok_or_else(|| NO_NUMBER.to_owned())
}
