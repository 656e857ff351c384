//! Sentences about properties, in our own words.

use heap::Lazy;
use std::collections::HashMap;

/// `part<TAB>name<TAB>sentence`: what a property is, with its unit. Parameters of physics engines that have no effect have none.
const DESCRIPTIONS: &str = include_str!("../descriptions.tsv");

/// What is said of a parameter without an effect, by the engine's part of its name.
const ENGINES: [(&str, &str); 5] = [
    (
        "bullet.",
        "A parameter of Bullet; it is kept, without effect.",
    ),
    ("ode.", "A parameter of ODE; it is kept, without effect."),
    (
        "vortex.",
        "A parameter of Vortex; it is kept, without effect.",
    ),
    (
        "newton.",
        "A parameter of Newton; it is kept, without effect.",
    ),
    (
        "mujoco.",
        "A parameter of MuJoCo; it is kept, without effect.",
    ),
];

type Descriptions = HashMap<(&'static str, &'static str), &'static str>;

/// What a property of a part is, in a sentence; empty where there is none.
pub(super) fn description(part: &str, name: &str) -> &'static str {
    static TABLE: Lazy<Descriptions> = Lazy::new(|| rows().collect());
    let of_engine = || {
        ENGINES
            .iter()
            .find(|(engine, _)| name.starts_with(engine))
            .map_or("", |&(_, sentence)| sentence)
    };
    TABLE.get(&(part, name)).copied().unwrap_or_else(of_engine)
}

fn rows() -> impl Iterator<Item = ((&'static str, &'static str), &'static str)> {
    DESCRIPTIONS.lines().map(|line| {
        let mut fields = line.splitn(3, '\t');
        let mut next = || {
            fields
                .next()
                .expect("a line of descriptions.tsv has three fields")
        };
        ((next(), next()), next())
    })
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::super::lines::described;
    use super::rows;

    #[test]
    fn every_property_has_a_sentence() {
        for line in described() {
            let text = line.description;
            assert!(
                text.ends_with('.') && text.len() > 10,
                "{}: {} {text}",
                line.part,
                line.name
            );
        }
    }

    #[test]
    fn every_sentence_is_about_a_property() {
        let lines = described();
        let mut seen = HashSet::new();
        for (key, _) in rows() {
            assert!(seen.insert(key), "{key:?} is there once");
            assert!(
                lines.iter().any(|line| (line.part, line.name) == key),
                "{key:?} exists"
            );
        }
    }

    #[test]
    fn older_words_have_the_sentence_of_the_newer() {
        let lines = described();
        let of = |name: &str| {
            lines
                .iter()
                .find(|line| line.name == name)
                .map(|line| line.description)
        };
        assert_eq!(of("modelNotDynamic"), of("model.notDynamic"));
    }
}
