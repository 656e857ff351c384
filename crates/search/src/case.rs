//! One case of a test while it runs: it makes the choices the test asks for.

use std::ops::Range;

use super::choice::{Choice, Domain, Value};
use super::random::Random;
use super::{Report, Status};

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

/// Choices that belong together, such as those of an element of a list; others may have been made between them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Span {
    /// The numbers of its choices, from 0, in ascending order.
    pub parts: Vec<Range<usize>>,
}

impl Span {
    /// How many choices it has.
    pub fn len(&self) -> usize {
        self.parts.iter().map(Range::len).sum()
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The numbers of its choices.
    pub fn numbers(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        self.parts.iter().flat_map(Range::clone)
    }
}

/// How a case ended, in the words of the test.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseEnd {
    /// How it ended.
    pub status: Status,
    /// Where it failed.
    pub place: String,
    /// How far it was from failing; infinite when that was not measured.
    pub robustness: f64,
    /// Lines of scripts that ran, as numbers, where they are counted.
    pub covered: Vec<u64>,
}

/// A case while it runs.
#[derive(Debug, Clone)]
pub struct Case {
    plan: Plan,
    random: Random,
    choices: Vec<Choice>,
    spans: Vec<Span>,
    /// Spans whose choices are being made, the innermost last, each with the number of the first choice of this part.
    open: Vec<(usize, usize)>,
    branches: Vec<usize>,
}

impl Case {
    /// A case that follows that plan.
    pub fn new(plan: Plan) -> Self {
        Self {
            random: random_of(&plan),
            plan,
            choices: Vec::new(),
            spans: Vec::new(),
            open: Vec::new(),
            branches: Vec::new(),
        }
    }

    /// The case of another plan that has made the same choices so far. None when that one makes others.
    pub fn resumed(&self, plan: &Plan) -> Option<Self> {
        let planned = plan.values.get(..self.choices.len())?;
        let is_same = |(choice, value): (&Choice, &Value)| choice.value == *value;
        let are_same = self.choices.iter().zip(planned).all(is_same);
        are_same.then(|| Self {
            random: random_of(plan),
            plan: plan.clone(),
            ..self.clone()
        })
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

    /// The choices that follow belong together. Returns a number for [`resume_span`](Self::resume_span).
    pub fn begin_span(&mut self) -> usize {
        self.spans.push(Span::default());
        self.resume_span(self.spans.len() - 1);
        self.spans.len() - 1
    }

    /// The choices that follow belong to a span that has ended.
    pub fn resume_span(&mut self, span: usize) {
        self.open.push((span, self.choices.len()));
    }

    /// The last span that has begun is over.
    pub fn end_span(&mut self) {
        let end = self.choices.len();
        let Some((span, start)) = self.open.pop() else {
            return;
        };
        if let Some(span) = self.spans.get_mut(span).filter(|_| start < end) {
            span.parts.push(start..end);
        }
    }

    /// Other cases may go on from here: time has passed since the last choice.
    pub fn add_branch(&mut self) {
        self.branches.push(self.choices.len());
    }

    /// The values that were chosen so far.
    pub fn values(&self) -> Vec<Value> {
        self.choices.iter().map(|choice| choice.value).collect()
    }

    /// What the case has chosen, with all spans ended, and how it ended.
    pub fn finish(mut self, end: CaseEnd) -> Report {
        while !self.open.is_empty() {
            self.end_span();
        }
        self.spans.retain(|span| !span.is_empty());
        Report {
            choices: self.choices,
            spans: self.spans,
            branches: self.branches,
            status: end.status,
            place: end.place,
            robustness: end.robustness,
            covered: end.covered,
        }
    }
}

fn random_of(plan: &Plan) -> Random {
    Random::new(match plan.rest {
        Rest::Random(seed) => seed,
        Rest::Simplest | Rest::Min | Rest::Max => 0,
    })
}
