//! The native part of properties: `t.property` runs its function for many cases, each of which makes choices.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::rc::Rc;

use api_macro::api;

use super::super::{ApiError, ApiFn, Cx, Result, functions};
use super::{bench, rows_of};
use scene::Data;
use script::coverage::{CountedText, LineCounts};
use script::test_cases::{CaseEnd, Signal, TestCases};
use search::{Domain, Status, Value};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    begin_case,
    end_case,
    choose_integer,
    choose_float,
    follows,
    span,
    note,
    leave_signal
];

fn cases(cx: &Cx) -> Result<Rc<TestCases>> {
    let cases = bench(cx)?.cases.borrow().clone();
    cases.ok_or_else(|| ApiError::Other("only a property has cases: see t.property.".into()))
}

/// Begins the next case of the property; waits for it.
///
/// @return kind 'search': a case to be undone; 'one': one of a search that is not; 'single': the only one, whose failure is that of the test;
/// nil: there are no more
#[api("swanilda.test.beginCase")]
fn begin_case(cx: &mut Cx) -> Result<Option<String>> {
    let cases = cases(cx)?;
    let kind = if cases.are_undone() {
        "search"
    } else if cases.is_single() {
        "single"
    } else {
        "one"
    };
    let has_begun = cases.begin(|| cx.is_interrupted());
    Ok(has_begun.then(|| kind.to_owned()))
}

/// Ends the case, within what is undone of it.
///
/// @param status 'passed', 'failed' or 'discarded'
/// @param place where it failed
/// @param robustness how far it was from failing; infinite when that was not measured
#[api("swanilda.test.endCase")]
fn end_case(cx: &mut Cx, status: String, place: String, robustness: f64) -> Result<()> {
    let cases = cases(cx)?;
    if cx.is_interrupted() {
        // It has not come to its end, whatever its code makes of that.
        return Err(ApiError::Other("interrupted.".into()));
    }
    let status = match status.as_str() {
        "passed" => Status::Passed,
        "failed" => Status::Failed,
        _ => Status::Discarded,
    };
    let counts = cx.take_line_counts();
    cases.add_line_counts(&counts);
    cases.end(&CaseEnd {
        status,
        place,
        robustness,
        covered: covered(&counts),
    });
    Ok(())
}

/// The lines that ran, as numbers: equal ones in every simulator.
fn covered(counts: &LineCounts) -> Vec<u64> {
    let mut numbers: Vec<u64> = Vec::new();
    for (text, counts) in &counts.texts {
        let ran = counts.iter().enumerate().filter(|(_, count)| **count > 0);
        numbers.extend(ran.map(|(line, _)| number_of(text, line)));
    }
    numbers.sort_unstable();
    numbers
}

fn number_of(text: &CountedText, line: usize) -> u64 {
    let mut hasher = DefaultHasher::new();
    match text {
        CountedText::File(path) => path.hash(&mut hasher),
        CountedText::Script { path, text, .. } => (path, text).hash(&mut hasher),
    }
    line.hash(&mut hasher);
    hasher.finish()
}

/// A whole number that the case chooses.
///
/// @param min the least
/// @param max the greatest
/// @param simplest what shrinking approaches
/// @return number
#[api("swanilda.test.chooseInteger")]
fn choose_integer(cx: &Cx, min: i64, max: i64, simplest: i64) -> Result<i64> {
    let domain = Domain::Integer { min, max, simplest };
    match cases(cx)?.choose(domain) {
        Some(Value::Integer(value)) => Ok(value),
        _ => Err(no_choice()),
    }
}

/// A number that the case chooses.
///
/// @param min the least
/// @param max the greatest
/// @param simplest what shrinking approaches
/// @return number
#[api("swanilda.test.chooseFloat")]
fn choose_float(cx: &Cx, min: f64, max: f64, simplest: f64) -> Result<f64> {
    let domain = Domain::Float { min, max, simplest };
    let value = cases(cx)?.choose(domain).ok_or_else(no_choice)?;
    Ok(value.as_float())
}

/// Whether a list has one more element.
///
/// @param probability how often it has, at random
/// @return follows
#[api("swanilda.test.follows")]
fn follows(cx: &Cx, probability: f64) -> Result<bool> {
    let value = cases(cx)?.choose(Domain::Follows { probability });
    Ok(value.ok_or_else(no_choice)? == Value::Integer(1))
}

fn no_choice() -> ApiError {
    ApiError::Other("a value can be drawn while a case runs, and at most 10000 times.".into())
}

/// Begins or ends choices that belong together.
///
/// @param begins whether they begin
#[api("swanilda.test.span")]
fn span(cx: &Cx, begins: bool) -> Result<()> {
    cases(cx)?.span(begins);
    Ok(())
}

/// Notes a value that was drawn, for people.
///
/// @param line the line of the test's file; 0 if it is not known
/// @param text the value
#[api("swanilda.test.note")]
fn note(cx: &Cx, line: i64, text: String) -> Result<()> {
    let line = u32::try_from(line).ok().filter(|line| *line > 0);
    cases(cx)?.note(line, &text);
    Ok(())
}

/// Leaves what was sampled of a temporal property, for the report.
///
/// @param name the property
/// @param rows time and value, for each sample; infinite where the condition is a boolean
/// @param robustness of the whole run
#[api("swanilda.test.leaveSignal")]
fn leave_signal(cx: &Cx, name: String, rows: Data, robustness: f64) -> Result<()> {
    let rows = rows_of(&rows)?;
    let samples = rows
        .iter()
        .filter_map(|row| Some((*row.first()?, *row.get(1)?)));
    bench(cx)?.add_signal(&Signal {
        name,
        samples: samples.collect(),
        robustness,
    });
    Ok(())
}
