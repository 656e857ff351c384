//! Versions of the event protocol, and the property names of version 4.

use heap::Lazy;
use std::collections::HashMap;

/// The dialect of the stream.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Protocol {
    /// CoppeliaSim 4.7 to 4.10: plain numbers and arrays.
    #[default]
    V3 = 3,
    /// CoppeliaSim after 4.10: new names, and tags for what the values mean.
    V4 = 4,
}

impl Protocol {
    pub(crate) fn from_number(number: i64) -> Option<Self> {
        [Self::V3, Self::V4]
            .into_iter()
            .find(|&protocol| protocol as i64 == number)
    }
}

/// The form of a value in protocol 4.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Meaning {
    Same,
    /// Of the opposite sense.
    Not,
    Handle,
    Handles,
}

/// `class<TAB>name<TAB>name in protocol 4<TAB>meaning`: properties that were renamed. Those whose type became another one are not
/// here; they keep their name and value.
const RENAMED: &str = include_str!("protocol4.tsv");

type Renamed = HashMap<(&'static str, &'static str), (&'static str, Meaning)>;

/// Parameters of the physics engines are below `dynamics.` now.
const ENGINES: [&str; 5] = ["bullet.", "ode.", "vortex.", "newton.", "mujoco."];

/// Name and meaning of a property in protocol 4. `class` is its path as returned by `sim.getPropertyName`.
pub(crate) fn renamed(class: &'static str, name: &'static str) -> (&'static str, Meaning) {
    static TABLE: Lazy<Renamed> = Lazy::new(read);
    if ENGINES.iter().any(|engine| name.starts_with(engine)) {
        // Few names, built once per class of targets.
        return (
            Box::leak(format!("dynamics.{name}").into_boxed_str()),
            Meaning::Same,
        );
    }
    let word = class.rsplit('.').next().unwrap_or(class);
    TABLE
        .get(&(word, name))
        .copied()
        .unwrap_or((name, Meaning::Same))
}

/// A property that has another name in the version after 4.10.
pub struct LaterName {
    /// The class of its target, without those above.
    pub class: &'static str,
    /// Its name in 4.10.
    pub name: &'static str,
    /// Its name in the later version.
    pub later: &'static str,
    /// Whether true there is false here.
    pub is_opposite: bool,
}

/// The properties that have another name in the version after 4.10.
pub fn later_names() -> impl Iterator<Item = LaterName> {
    RENAMED.lines().filter_map(|line| {
        let mut fields = line.split('\t');
        let (class, name, later) = (fields.next()?, fields.next()?, fields.next()?);
        (name != later).then_some(LaterName {
            class,
            name,
            later,
            is_opposite: fields.next() == Some("not"),
        })
    })
}

fn read() -> Renamed {
    let row = |line: &'static str| {
        let fields: Vec<&'static str> = line.split('\t').collect();
        let [class, old, new, meaning] = fields[..] else {
            panic!("a line of protocol4.tsv has four fields: {line}")
        };
        let meaning = match meaning {
            "not" => Meaning::Not,
            "handle" => Meaning::Handle,
            "handles" => Meaning::Handles,
            _ => Meaning::Same,
        };
        ((class, old), (new, meaning))
    };
    RENAMED.lines().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::{Meaning, renamed};

    #[test]
    fn names_depend_on_the_class() {
        assert_eq!(renamed("app.scene", "scenePath"), ("path", Meaning::Same));
        assert_eq!(renamed("app", "scenePath"), ("paths.scenes", Meaning::Same));
        assert_eq!(
            renamed("app.scene.object", "parentHandle"),
            ("parent", Meaning::Handle)
        );
        assert_eq!(
            renamed("app.scene.object.joint", "ode.bounce").0,
            "dynamics.ode.bounce"
        );
        assert_eq!(
            renamed("app.scene.object", "layer"),
            ("layer", Meaning::Same)
        );
    }
}
