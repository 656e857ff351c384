//! The native part of properties: `t.property` runs its function for many cases, each of which makes choices.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::rc::Rc;
use std::time::Duration;

use api_macro::api;

use super::super::{ApiError, ApiFn, Cx, Result, functions};
use super::branch::{Branches, Called, called, not_undone};
use super::{bench, rows_of};
use scene::Data;
use script::coverage::{CountedText, LineCounts};
use script::test_cases::{Signal, TestCases};
use script::{ScriptCallback, ScriptFunction};
use search::{CaseEnd, Domain, Status, Value};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    are_cases_undone,
    begin_case,
    each_case,
    each_branch,
    end_case,
    choose_integer,
    choose_float,
    follows,
    begin_span,
    resume_span,
    end_span,
    note,
    leave_signal
];

/// A case has to run for so long before others go on from there, since to go back there takes time as well.
const MIN_AGE: Duration = Duration::from_millis(4);
/// So many moments of a case from which others go on.
const MAX_DEPTH: usize = 9;

fn cases(cx: &Cx) -> Result<Rc<TestCases>> {
    let cases = bench(cx)?.cases.borrow().clone();
    cases.ok_or_else(|| ApiError::Other("only a property has cases: see t.property.".into()))
}

/// Whether each case of the property is undone.
///
/// @return undone
#[api("swanilda.test.areCasesUndone")]
fn are_cases_undone(cx: &Cx) -> Result<bool> {
    Ok(cases(cx)?.are_undone())
}

/// Begins the case of a property whose cases are not undone.
///
/// @return single whether it is the only one, whose failure is that of the test, rather than reported to a search; nil: there are no more
#[api("swanilda.test.beginCase")]
fn begin_case(cx: &mut Cx) -> Result<Option<bool>> {
    let cases = cases(cx)?;
    let has_begun = cases.begin(|| cx.is_interrupted());
    Ok(has_begun.then(|| cases.is_single()))
}

/// Calls a function for each case of the property, and undoes what it did.
///
/// @param fn the function, without arguments
/// @return error
#[api("swanilda.test.eachCase")]
fn each_case(cx: &mut Cx, r#fn: ScriptFunction) -> Result<Option<String>> {
    let open = cx.open_resources();
    if !open.is_empty() {
        return Err(not_undone(&open));
    }
    let cases = cases(cx)?;
    if !cases.begin(|| cx.is_interrupted()) {
        return Ok(None);
    }
    each(cx, r#fn, || cases.begin(|| cx.is_interrupted()))
}

/// Calls a function for the case that runs, and for each one that goes on from where it has come to; undoes what it did. A moment from which
/// others may go on is noted in any case.
///
/// @param fn the function, without arguments
/// @return called whether it was: going back may take longer than the run since the last such moment, or not be possible
/// @return error
#[api("swanilda.test.eachBranch")]
fn each_branch(cx: &mut Cx, r#fn: ScriptFunction) -> Result<(bool, Option<String>)> {
    let cases = cases(cx)?;
    cases.add_branch();
    let depth = cx.module_state::<Branches>().depth.get();
    let is_possible = cases.are_undone() && cx.open_resources().is_empty();
    let is_worth_it = cases.age() >= MIN_AGE && depth < MAX_DEPTH;
    let Some(branch) = cases.branch().filter(|_| is_possible && is_worth_it) else {
        return Ok((false, None));
    };
    cases.renew_age();
    let goes_on = || cases.go_on(&branch, || cx.is_interrupted());
    Ok((true, each(cx, r#fn, goes_on)?))
}

/// Calls a function as long as it `goes_on`; its error.
fn each(cx: &Cx, r#fn: ScriptFunction, goes_on: impl Fn() -> bool) -> Result<Option<String>> {
    let callback = ScriptCallback::new(cx, r#fn);
    let bench = bench(cx)?;
    let lines = bench.line_count();
    let is_good = |(results, open): &Called| results.is_ok() && open.is_empty();
    let last = cx.undone_while(
        || called(cx, &callback),
        |ended| {
            bench.truncate_lines(lines);
            is_good(ended) && goes_on()
        },
    );
    match last.get() {
        (_, open) if !open.is_empty() => Err(not_undone(open)),
        (Err(error), _) => Ok(Some(error.clone())),
        (Ok(_), _) => Ok(None),
    }
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

/// Begins choices that belong together.
///
/// @return span a number for resumeSpan
#[api("swanilda.test.beginSpan")]
fn begin_span(cx: &Cx) -> Result<i64> {
    let span = cases(cx)?.begin_span();
    Ok(span.map_or(0, |span| span as i64))
}

/// Begins choices that belong to those of a span that was ended.
///
/// @param span its number
#[api("swanilda.test.resumeSpan")]
fn resume_span(cx: &Cx, span: i64) -> Result<()> {
    if let Ok(span) = usize::try_from(span) {
        cases(cx)?.resume_span(span);
    }
    Ok(())
}

/// Ends the choices that belong together.
#[api("swanilda.test.endSpan")]
fn end_span(cx: &Cx) -> Result<()> {
    cases(cx)?.end_span();
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
