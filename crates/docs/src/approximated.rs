//! Functions and modules that do less than in CoppeliaSim, and what is different.

use std::collections::HashMap;
use std::sync::LazyLock;

use script::pairs;

/// `name<TAB>what is different`: functions as they are called (`sim.name`), or modules.
const TABLE: &str = include_str!("approximated.tsv");

static DIFFERENCES: LazyLock<HashMap<&str, &str>> = LazyLock::new(|| pairs(TABLE).collect());

/// Limitations or differences of a function or module; None for those that work in full.
pub fn difference(name: &str) -> Option<&'static str> {
    DIFFERENCES.get(name).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{functions, modules};

    #[test]
    fn only_what_is_there_is_approximated() {
        let mut known: Vec<String> = functions()
            .into_iter()
            .map(|function| function.name)
            .collect();
        known.extend(modules::names());
        known.extend(
            ::modules::registry()
                .members_of_sim()
                .names()
                .into_iter()
                .map(|member| format!("sim.{member}")),
        );
        for (name, _) in pairs(TABLE) {
            assert!(known.iter().any(|known| known == name), "{name}");
        }
    }

    #[test]
    fn what_works_in_full_has_no_difference() {
        assert_eq!(
            difference("sim.adjustView"),
            Some("accepted without effect: there are no windows")
        );
        assert_eq!(difference("sim.getObject"), None);
    }
}
