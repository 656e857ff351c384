//! Calls of functions that call the world outside: captured, or replayed from a capture.

use std::ffi::c_int;

use capture::Tape;
use scene::Data;

use super::args::Args;
use super::data::{push_data, read_data};
use super::registry::Bound;
use super::source::Values;
use crate::error::{ApiError, ApiResult};
use crate::lua::{LuaObject, Stack, Type};
use crate::tape::{Outcome, Output};

impl Bound {
    /// Calls the function with the arguments on a stack; `who` calls, in the words of a difference.
    #[inline]
    pub(crate) fn call(&self, stack: Stack<'_>, who: impl Fn() -> String) -> ApiResult<c_int> {
        let mut args = Args::new(stack).for_plugin(self.is_plugin);
        if !self.is_outside || !stack.tape().is_on() {
            return (self.function.call)(&mut args);
        }
        let mut returned = None;
        let call = || {
            let count = (self.function.call)(&mut args);
            returned = count.as_ref().ok().copied();
            Outcome(count.map(|count| results(stack, count)))
        };
        let outcome = stack.tape().input_for(self.function.name, who, call);
        let outputs = outcome.map_or_else(|lost| Err(lost.into()), |outcome| outcome.0)?;
        if let Some(count) = returned
            && !outputs.iter().any(is_table)
        {
            return Ok(count);
        }
        // What is pushed again after a capture is what a replay pushes: tables have the same order. Objects are not: each is collected once.
        stack.set_top(0);
        outputs.iter().for_each(|output| push(stack, output));
        Ok(stack.top())
    }

    /// The same with plain values.
    pub(crate) fn call_data(
        &self,
        tape: &Tape,
        values: Values<'_>,
        who: impl Fn() -> String,
    ) -> ApiResult<Vec<Data>> {
        let mut args = Args::new(values).for_plugin(self.is_plugin);
        if !self.is_outside || !tape.is_on() {
            return (self.function.call_data)(&mut args);
        }
        let call = || {
            let results = (self.function.call_data)(&mut args);
            Outcome(results.map(|results| results.into_iter().map(Output::Plain).collect()))
        };
        let outcome = tape.input_for(self.function.name, who, call);
        let outputs = outcome.map_or_else(|lost| Err(lost.into()), |outcome| outcome.0)?;
        outputs.into_iter().map(plain).collect()
    }
}

impl From<capture::Lost> for ApiError {
    fn from(lost: capture::Lost) -> Self {
        Self::Other(lost.to_string())
    }
}

/// Whether it is a table. No function returns objects beside tables.
fn is_table(output: &Output) -> bool {
    matches!(output, Output::Plain(Data::Map(_) | Data::Array(_)))
}

fn plain(output: Output) -> ApiResult<Data> {
    match output {
        Output::Plain(data) => Ok(data),
        Output::Object { .. } => Err(ApiError::NeedsLua),
    }
}

/// The results on top of a stack.
fn results(stack: Stack<'_>, count: c_int) -> Vec<Output> {
    let first = stack.top() - count + 1;
    (first..=stack.top())
        .map(|index| output(stack, index))
        .collect()
}

fn output(stack: Stack<'_>, index: c_int) -> Output {
    match stack.object(index) {
        Some(LuaObject { class, id }) => Output::Object { class, id },
        None if stack.kind(index) == Type::UserData => {
            stack
                .tape()
                .lacks("an object of Lua that a function returned");
            Output::Plain(Data::Nil)
        }
        // Results are no deeper than what can be passed on.
        None => Output::Plain(read_data(stack, index).unwrap_or(Data::Nil)),
    }
}

fn push(stack: Stack<'_>, output: &Output) {
    match output {
        Output::Plain(data) => push_data(stack, data),
        &Output::Object { class, id } => stack.push_object(LuaObject { class, id }),
    }
}
