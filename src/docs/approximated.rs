//! Functions and modules that do less than in CoppeliaSim, and what is different.

use std::collections::HashMap;
use std::sync::LazyLock;

use crate::api;

/// `name<TAB>what is different`: functions as they are called (`sim.name`), or modules.
const TABLE: &str = include_str!("approximated.tsv");

static DIFFERENCES: LazyLock<HashMap<String, &str>> = LazyLock::new(|| {
    let own: HashMap<&str, &str> = api::pairs(TABLE).collect();
    let aliases = api::pairs(api::ALIASES)
        .filter_map(|(old, new)| Some((format!("sim.{old}"), *own.get(format!("sim.{new}").as_str())?)));
    own.iter().map(|(name, how)| ((*name).to_owned(), *how)).chain(aliases).collect()
});

/// What a function or module does not do, or does differently; None for those that work in full.
pub fn difference(name: &str) -> Option<&'static str> {
    DIFFERENCES.get(name).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::docs::{functions, modules};

    #[test]
    fn only_what_is_there_is_approximated() {
        let mut known: Vec<String> = functions().into_iter().map(|function| function.name).collect();
        known.extend(modules::names());
        known.extend(api::registry().members.keys().map(|member| format!("sim.{member}")));
        for (name, _) in api::pairs(TABLE) {
            assert!(known.iter().any(|known| known == name), "{name}");
        }
    }

    #[test]
    fn aliases_share_the_difference() {
        assert_eq!(difference("sim.createDrawingObject"), difference("sim.addDrawingObject"));
        assert_eq!(difference("sim.getObject"), None);
    }
}
