//! Proposes cases, and learns from what they report.
//!
//! First come the bounds of all values, then values at random. Where a test measures how far it is from failing (`robustness`), cases near
//! the closest ones follow, by steps of all sizes: which size makes progress depends on how close they are. Where lines of scripts are counted,
//! cases that reach new lines are varied as well. Of a case that has chosen values in the midst of its run, only what it chose from some
//! moment on may be varied: such cases come one after the other, and share their run up to there. Values at random go on all the time.

use std::collections::BTreeSet;

use super::case::{Plan, Rest};
use super::choice::{Choice, Value};
use super::random::Random;
use super::{Report, Status};

/// Cases that are proposed at once; the same number on every machine, so that the result is the same.
pub(crate) const BATCH: usize = 16;
/// Cases at random before others follow.
const WARM_UP: usize = 3 * BATCH;
/// How many of the cases that are closest to failing are varied.
const ELITE: usize = 6;
/// How many cases that reached new lines are varied.
const CORPUS: usize = 64;
/// The largest step of a variation, as a share of the domain, and how much smaller the smallest one is.
const STEP: f64 = 0.4;
const STEP_RANGE: f64 = 10_000.0;
/// How many cases go on from one moment of another.
const BRANCHES: usize = 4;

/// What is known of the cases so far.
#[derive(Debug)]
pub struct Explorer {
    random: Random,
    /// Cases that were proposed.
    proposed: usize,
    /// The closest to failing, the closest first.
    elite: Vec<Report>,
    /// Those that reached new lines.
    corpus: Vec<Report>,
    covered: BTreeSet<u64>,
    /// Cases are made that go on from a moment of another.
    fork: Option<Fork>,
}

/// A moment of a case from which others go on.
#[derive(Debug)]
struct Fork {
    choices: Vec<Choice>,
    /// How many of the choices had been made.
    kept: usize,
    /// How many cases are still to come.
    left: usize,
}

/// An exploration from that seed.
pub fn explore(seed: u64) -> Explorer {
    Explorer {
        random: Random::new(seed),
        proposed: 0,
        elite: Vec::new(),
        corpus: Vec::new(),
        covered: BTreeSet::new(),
        fork: None,
    }
}

impl Explorer {
    /// The next cases, at most `most`.
    pub fn propose(&mut self, most: usize) -> Vec<Plan> {
        (0..BATCH.min(most)).map(|_| self.next()).collect()
    }

    fn next(&mut self) -> Plan {
        self.proposed += 1;
        let rest = match self.proposed {
            1 => Rest::Simplest,
            2 => Rest::Min,
            3 => Rest::Max,
            _ => Rest::Random(self.random.bits()),
        };
        let values = if self.proposed <= WARM_UP {
            Vec::new()
        } else {
            self.varied()
        };
        Plan { values, rest }
    }

    /// Values near those of a case worth it; none for a case at random.
    fn varied(&mut self) -> Vec<Value> {
        if let Some(values) = self.forked() {
            return values;
        }
        let kind = self.random.below(4);
        if kind < 2 && !self.elite.is_empty() {
            // The closest is varied most.
            let at = self.elite.len() - 1 - self.random.late_below(self.elite.len());
            self.fork = Fork::of(&self.elite[at], &mut self.random);
            let forked = self.forked();
            return forked.unwrap_or_else(|| vary(&self.elite[at].choices, &mut self.random));
        }
        if kind == 2 && !self.corpus.is_empty() {
            // The latest went furthest.
            let at = self.random.late_below(self.corpus.len());
            return resample(&self.corpus[at].choices, &mut self.random);
        }
        Vec::new()
    }

    /// Values of the next case that goes on from the moment of a fork, if there is one.
    fn forked(&mut self) -> Option<Vec<Value>> {
        let fork = self.fork.as_mut().filter(|fork| fork.left > 0)?;
        fork.left -= 1;
        let (kept, later) = fork.choices.split_at(fork.kept);
        let mut values: Vec<_> = kept.iter().map(|choice| choice.value).collect();
        // The last one is made anew from there.
        if fork.left > 0 {
            values.extend(vary(later, &mut self.random));
        }
        Some(values)
    }

    /// Learns from cases that have passed.
    pub fn learn(&mut self, reports: &[Report]) {
        for report in reports.iter().filter(|r| r.status == Status::Passed) {
            self.learn_one(report);
        }
    }

    fn learn_one(&mut self, report: &Report) {
        let known = self.covered.len();
        self.covered.extend(&report.covered);
        if self.covered.len() > known && self.corpus.len() < CORPUS {
            self.corpus.push(report.clone());
        }
        if report.robustness.is_finite() {
            let is_closer = |other: &Report| other.robustness <= report.robustness;
            let at = self.elite.partition_point(is_closer);
            self.elite.insert(at, report.clone());
            self.elite.truncate(ELITE);
        }
    }

    /// How many lines of scripts the cases have reached.
    pub fn lines(&self) -> usize {
        self.covered.len()
    }

    /// The smallest robustness so far; infinite when nothing was measured.
    pub fn robustness(&self) -> f64 {
        self.elite.first().map_or(f64::INFINITY, |r| r.robustness)
    }
}

impl Fork {
    /// At one of the moments at which a case has chosen values while it ran, later ones more often; for every other case.
    fn of(report: &Report, random: &mut Random) -> Option<Self> {
        let count = report.choices.len();
        let moments = report
            .branches
            .iter()
            .filter(|kept| (1..count).contains(*kept));
        let moments: Vec<_> = moments.copied().collect();
        if moments.is_empty() || random.below(2) == 0 {
            return None;
        }
        Some(Self {
            choices: report.choices.clone(),
            kept: moments[random.late_below(moments.len())],
            left: BRANCHES,
        })
    }
}

/// Values near those of a case: about one in three moves, all by steps of about one size.
fn vary(choices: &[Choice], random: &mut Random) -> Vec<Value> {
    let step = STEP * libm::pow(STEP_RANGE, -random.share());
    let share = (1.0 / choices.len().max(1) as f64).max(0.35);
    let moved = |choice: &Choice| {
        if random.share() >= share {
            return choice.value;
        }
        let width = choice.domain.width();
        if matches!(choice.value, Value::Integer(_)) && width < 8.0 {
            // Such are alternatives, without an order that means anything.
            return random.value(choice.domain);
        }
        let value = choice.value.as_float() + random.normal() * step * width;
        choice.domain.nearest(Value::Float(value))
    };
    choices.iter().map(moved).collect()
}

/// The values of a case, one or two of them made anew.
fn resample(choices: &[Choice], random: &mut Random) -> Vec<Value> {
    let mut values: Vec<_> = choices.iter().map(|choice| choice.value).collect();
    if values.is_empty() {
        return values;
    }
    for _ in 0..=random.below(2) {
        let at = random.late_below(values.len());
        values[at] = random.value(choices[at].domain);
    }
    values
}
