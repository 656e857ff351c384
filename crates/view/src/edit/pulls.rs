//! What pages pull at while the simulation runs: the force of a spring, once in each step, as long as the page holds on.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use serde_json::Value;

use script::wall_clock;

use crate::request::Action;

/// A page that has not said anything for so long has let go, or is gone.
const HOLD: Duration = Duration::from_millis(700);

/// What is pulled, by the handle of the object.
#[derive(Default)]
pub(crate) struct Pulls(BTreeMap<i64, Pull>);

struct Pull {
    action: Action,
    said: Instant,
    /// The step before which it acted the last time, and its answer then.
    acted: Option<(u64, Value)>,
}

impl Pulls {
    /// The answer of a pull that has acted before the coming step already, with its new target from the next one on.
    pub(crate) fn repeated(&mut self, action: &Action, step: u64) -> Option<Value> {
        let Action::Pull {
            handle,
            target: Some(_),
            ..
        } = action
        else {
            return None;
        };
        let pull = self.0.get_mut(handle)?;
        (pull.action, pull.said) = (action.clone(), wall_clock::now());
        let (acted, answer) = pull.acted.as_ref()?;
        (*acted == step).then(|| answer.clone())
    }

    /// A request was carried out before that step.
    pub(crate) fn note(&mut self, action: &Action, step: u64, answer: &Result<Value, String>) {
        let Action::Pull { handle, target, .. } = action else {
            return;
        };
        match (target, answer) {
            (Some(_), Ok(answer)) => {
                let said = self
                    .0
                    .get(handle)
                    .map_or_else(wall_clock::now, |pull| pull.said);
                let acted = Some((step, answer.clone()));
                let action = action.clone();
                self.0.insert(
                    *handle,
                    Pull {
                        action,
                        said,
                        acted,
                    },
                );
            }
            _ => drop(self.0.remove(handle)),
        }
    }

    /// Pulls that are still to act before that step.
    pub(crate) fn due(&mut self, step: u64) -> Vec<Action> {
        let now = wall_clock::now();
        self.0
            .retain(|_, pull| now.duration_since(pull.said) < HOLD);
        let is_due = |pull: &&Pull| pull.acted.as_ref().is_none_or(|(acted, _)| *acted != step);
        self.0
            .values()
            .filter(is_due)
            .map(|pull| pull.action.clone())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn pull(target: Option<[f64; 3]>) -> Action {
        Action::Pull {
            handle: 5,
            point: [0.0; 3],
            target,
        }
    }

    #[test]
    fn a_pull_acts_once_in_each_step() {
        let mut pulls = Pulls::default();
        let first = pull(Some([1.0, 0.0, 0.0]));
        assert_eq!(pulls.repeated(&first, 7), None);
        pulls.note(&first, 7, &Ok(json!("force")));
        assert_eq!(pulls.due(7), []);
        let moved = pull(Some([2.0, 0.0, 0.0]));
        assert_eq!(pulls.repeated(&moved, 7), Some(json!("force")));
        assert_eq!(pulls.due(8), [moved]);
    }

    #[test]
    fn it_ends_when_the_page_lets_go_or_it_fails() {
        for (action, answer) in [
            (pull(None), Ok(Value::Bool(true))),
            (pull(Some([0.0; 3])), Err("it is gone".to_owned())),
        ] {
            let mut pulls = Pulls::default();
            pulls.note(&pull(Some([1.0; 3])), 1, &Ok(Value::Null));
            pulls.note(&action, 2, &answer);
            assert_eq!(pulls.due(3), []);
        }
    }
}
