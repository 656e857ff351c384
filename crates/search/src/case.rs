//! One case of a test while it runs: it makes the choices the test asks for.

use super::choice::{Choice, Domain, Value};
use super::random::Random;

/// Choices that a case may make; a test that asks for more is stopped.
const MAX_CHOICES: usize = 10_000;

/// What a case is to choose.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The values of its first choices; the nearest one is taken where it is not in the domain.
    pub values: Vec<Value>,
    /// The values of those that follow.
    pub rest: Rest,
}

/// How choices are made that a plan has no value for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rest {
    /// The simplest value.
    Simplest,
    /// The least value.
    Min,
    /// The greatest value.
    Max,
    /// Values at random, from that seed.
    Random(u64),
}

/// Choices that belong together, such as those of an element of a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Span {
    /// The number of its first choice, from 0.
    pub start: usize,
    /// The number of the first choice after it.
    pub end: usize,
}

/// A case while it runs.
#[derive(Debug)]
pub struct Case {
    plan: Plan,
    random: Random,
    choices: Vec<Choice>,
    spans: Vec<Span>,
    /// Where spans begin that have not ended.
    open: Vec<usize>,
}

impl Case {
    /// A case that follows that plan.
    pub fn new(plan: Plan) -> Self {
        let seed = match plan.rest {
            Rest::Random(seed) => seed,
            Rest::Simplest | Rest::Min | Rest::Max => 0,
        };
        Self {
            plan,
            random: Random::new(seed),
            choices: Vec::new(),
            spans: Vec::new(),
            open: Vec::new(),
        }
    }

    /// Makes a choice. None when there were too many.
    pub fn choose(&mut self, domain: Domain) -> Option<Value> {
        let number = self.choices.len();
        if number >= MAX_CHOICES {
            return None;
        }
        let value = match (self.plan.values.get(number), self.plan.rest) {
            (Some(value), _) => domain.nearest(*value),
            (None, Rest::Simplest) => domain.simplest(),
            (None, Rest::Min) => domain.min(),
            (None, Rest::Max) => domain.max(),
            (None, Rest::Random(_)) => self.random.value(domain),
        };
        self.choices.push(Choice { domain, value });
        Some(value)
    }

    /// The choices that follow belong together.
    pub fn begin_span(&mut self) {
        self.open.push(self.choices.len());
    }

    /// The last span that has begun is over.
    pub fn end_span(&mut self) {
        let end = self.choices.len();
        if let Some(start) = self.open.pop().filter(|start| *start < end) {
            self.spans.push(Span { start, end });
        }
    }

    /// The values that were chosen so far.
    pub fn values(&self) -> Vec<Value> {
        self.choices.iter().map(|choice| choice.value).collect()
    }

    /// What was chosen, with all spans ended.
    pub fn finish(mut self) -> (Vec<Choice>, Vec<Span>) {
        while !self.open.is_empty() {
            self.end_span();
        }
        (self.choices, self.spans)
    }
}
