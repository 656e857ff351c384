//! The simplest case that fails as a given one does.
//!
//! As in Hypothesis, it is the sequence of choices that shrinks: spans are left out, values become simpler. Each candidate is run; where
//! the test then asks for other choices than before, these are made simplest.

use std::cmp::Ordering;

use super::case::{Plan, Rest, Span};
use super::choice::Value;
use super::server::{Evaluate, WorkersGone};
use super::{Report, Status};

/// Candidates that are run beside each other; the same number on every machine, so that the result is the same.
const BATCH: usize = 4;

/// Proposes changes of a failing case, one after the other as they are asked for: a case may have many choices.
type Pass = for<'a> fn(&'a Report) -> Box<dyn Iterator<Item = Change> + 'a>;

/// A change of the choices of a case.
enum Change {
    /// Without these.
    Without(Span),
    /// These become simplest.
    Simplest(Span),
    /// One has another value.
    Set(usize, Value),
    /// Two become simplest.
    Pair(usize, usize),
}

/// In this order: what leaves out most comes first.
const PASSES: [Pass; 4] = [
    without_spans,
    with_simplest_spans,
    with_simpler_values,
    with_simpler_pairs,
];

struct Shrinking<'a> {
    best: Report,
    /// Runs that are left.
    budget: usize,
    evaluate: &'a mut dyn Evaluate,
}

/// Shrinks a failing case with at most `budget` runs. Returns the simplest case that was found, and how many runs it took.
///
/// # Errors
/// When nobody runs cases any more.
pub fn shrink(
    failing: Report,
    budget: usize,
    evaluate: &mut dyn Evaluate,
) -> Result<(Report, usize), WorkersGone> {
    let mut shrinking = Shrinking {
        best: failing,
        budget,
        evaluate,
    };
    loop {
        let mut improved = false;
        for pass in PASSES {
            improved |= shrinking.run(pass)?;
        }
        if !improved || shrinking.budget == 0 {
            return Ok((shrinking.best, budget - shrinking.budget));
        }
    }
}

impl Shrinking<'_> {
    /// Takes what a pass proposes as long as it fails. Whether anything was taken.
    fn run(&mut self, pass: Pass) -> Result<bool, WorkersGone> {
        let (mut at, mut improved) = (0, false);
        loop {
            let changes = pass(&self.best).skip(at).take(BATCH.min(self.budget));
            let plans: Vec<_> = changes.map(|change| change.of(&self.best)).collect();
            if plans.is_empty() {
                return Ok(improved);
            }
            let reports = self.evaluate.evaluate(&plans)?;
            self.budget -= reports.len();
            match reports.iter().position(|report| self.is_better(report)) {
                Some(taken) => {
                    self.best = reports[taken].clone();
                    (at, improved) = (at + taken, true);
                }
                None => at += reports.len().max(1),
            }
        }
    }

    fn is_better(&self, report: &Report) -> bool {
        report.status == Status::Failed
            && report.place == self.best.place
            && compare(report, &self.best) == Ordering::Less
    }
}

impl Change {
    /// The changed case; choices that it does not have become simplest.
    fn of(self, report: &Report) -> Plan {
        let mut values = report.values();
        let simplest = |number: usize| report.choices[number].domain.simplest();
        match self {
            Self::Without(span) => {
                let parts = span.parts.into_iter().rev();
                parts.for_each(|part| drop(values.drain(part)));
            }
            Self::Simplest(span) => span
                .numbers()
                .for_each(|number| values[number] = simplest(number)),
            Self::Set(number, value) => values[number] = value,
            Self::Pair(a, b) => [a, b].into_iter().for_each(|n| values[n] = simplest(n)),
        }
        Plan {
            values,
            rest: Rest::Simplest,
        }
    }
}

/// Orders cases by simplicity: few choices, few that are not simplest, then choice by choice.
pub(crate) fn compare(a: &Report, b: &Report) -> Ordering {
    let chosen = |report: &Report| report.choices.iter().filter(|c| !c.is_simplest()).count();
    let by_choice = || {
        let pairs = a.choices.iter().zip(&b.choices);
        let mut orders = pairs.map(|(a, b)| a.compare(b));
        orders.find(|order| order.is_ne())
    };
    a.choices
        .len()
        .cmp(&b.choices.len())
        .then_with(|| chosen(a).cmp(&chosen(b)))
        .then_with(|| by_choice().unwrap_or(Ordering::Equal))
}

/// The longest spans first, of equal ones the last.
fn without_spans(report: &Report) -> Box<dyn Iterator<Item = Change> + '_> {
    let mut spans = report.spans.clone();
    spans.sort_by_key(|span| std::cmp::Reverse((span.len(), span.numbers().next())));
    Box::new(spans.into_iter().map(Change::Without))
}

fn with_simplest_spans(report: &Report) -> Box<dyn Iterator<Item = Change> + '_> {
    let is_shrunk = |span: &&Span| {
        let mut choices = span.numbers().map(|number| &report.choices[number]);
        span.len() > 1 && choices.any(|choice| !choice.is_simplest())
    };
    let spans = report.spans.iter().filter(is_shrunk);
    Box::new(spans.map(|span| Change::Simplest(span.clone())))
}

fn with_simpler_values(report: &Report) -> Box<dyn Iterator<Item = Change> + '_> {
    let choices = report.choices.iter().enumerate();
    Box::new(choices.flat_map(|(number, choice)| {
        let values = choice.simpler().into_iter();
        values.map(move |value| Change::Set(number, value))
    }))
}

/// Two neighbours at once, for values that only make sense together.
fn with_simpler_pairs(report: &Report) -> Box<dyn Iterator<Item = Change> + '_> {
    let chosen = || {
        let choices = report.choices.iter().enumerate();
        choices.filter(|(_, choice)| !choice.is_simplest())
    };
    let pairs = chosen().zip(chosen().skip(1));
    Box::new(pairs.map(|((a, _), (b, _))| Change::Pair(a, b)))
}
