//! Reward and end of an action, where they are Lua expressions.

use scene::Data;
use simulator::Simulator;

use crate::declaration::Declaration;
use crate::expressions::Expressions;

/// The numbers of the expressions for reward and end.
pub(crate) struct Score {
    reward: Option<i64>,
    terminated: Option<i64>,
}

impl Score {
    pub(crate) fn new(
        simulator: &mut Simulator,
        expressions: &Expressions,
        declaration: &Declaration,
    ) -> Result<Option<Self>, String> {
        let mut compile = |name: &str, text: &Option<String>| {
            let head = "local o, a = ...; return";
            let text = text.as_ref();
            text.map(|text| expressions.compile(simulator, name, head, text))
                .transpose()
        };
        let (reward, terminated) = (
            compile("the reward", &declaration.reward)?,
            compile("the end", &declaration.terminated)?,
        );
        let is_there = reward.is_some() || terminated.is_some();
        Ok(is_there.then_some(Self { reward, terminated }))
    }

    /// Reward and end for the observations after an action, and the action.
    ///
    /// # Errors
    /// The expressions' own, and when the reward is no finite number.
    pub(crate) fn of(
        &self,
        simulator: &mut Simulator,
        expressions: &Expressions,
        observed: Vec<f64>,
        actions: Vec<f64>,
    ) -> Result<(f64, bool), String> {
        let args = [Data::from(observed), Data::from(actions)];
        let mut run = |number: Option<i64>| {
            number
                .map(|number| expressions.run(simulator, number, &args))
                .transpose()
        };
        let reward = match run(self.reward)?.as_deref() {
            None => 0.0,
            Some([value]) if value.as_f64().is_some_and(f64::is_finite) => {
                value.as_f64().unwrap_or_default()
            }
            Some(other) => return Err(format!("the reward is no finite number: {other:?}.")),
        };
        let terminated = match run(self.terminated)?.as_deref() {
            None | Some([Data::Bool(false) | Data::Nil] | []) => false,
            Some(_) => true,
        };
        Ok((reward, terminated))
    }
}
