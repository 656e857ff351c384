//! Searches whose results are known.

use super::*;

/// A test over choices: how it ended, the place of its failure, its robustness, the lines it reached.
type Test = fn(&mut Case) -> (Status, &'static str, f64, Vec<u64>);

struct Runs(Test);

impl Evaluate for Runs {
    fn evaluate(&mut self, plans: &[Plan]) -> Result<Vec<Report>, WorkersGone> {
        let mut reports = Vec::new();
        for plan in plans {
            reports.push(run(self.0, plan.clone()));
            if reports.last().is_some_and(|r| r.status == Status::Failed) {
                break;
            }
        }
        Ok(reports)
    }
}

fn run(test: Test, plan: Plan) -> Report {
    let mut case = Case::new(plan);
    let (status, place, robustness, covered) = test(&mut case);
    case.finish(CaseEnd {
        status,
        place: place.to_owned(),
        robustness,
        covered,
    })
}

fn settings(cases: usize) -> Settings {
    Settings {
        seed: 1,
        budget: Budget {
            cases,
            shrinks: 1000,
        },
        known: Vec::new(),
    }
}

fn found(test: Test, settings: &Settings) -> Found {
    search(settings, &mut Runs(test), &mut || false, &mut |_, _| {}).expect("cases run")
}

fn integer(case: &mut Case, min: i64, max: i64) -> i64 {
    match case.choose(Domain::integers(min, max)) {
        Some(Value::Integer(value)) => value,
        other => panic!("no whole number: {other:?}"),
    }
}

fn float(case: &mut Case, min: f64, max: f64) -> f64 {
    let value = case.choose(Domain::floats(min, max));
    value.expect("there are few").as_float()
}

/// Elements until a choice ends them, each a span with the choice before it.
fn list(case: &mut Case, mut element: impl FnMut(&mut Case) -> f64) -> Vec<f64> {
    let mut elements = Vec::new();
    while elements.len() < 20 {
        case.begin_span();
        let more = case.choose(Domain::Follows { probability: 0.8 }) == Some(Value::Integer(1));
        if more {
            elements.push(element(case));
        }
        case.end_span();
        if !more {
            break;
        }
    }
    elements
}

fn verdict(holds: bool) -> (Status, &'static str, f64, Vec<u64>) {
    let status = if holds {
        Status::Passed
    } else {
        Status::Failed
    };
    (status, "here", f64::INFINITY, Vec::new())
}

fn simplest(test: Test, cases: usize) -> Vec<Value> {
    let found = found(test, &settings(cases));
    let simplest = found.simplest.expect("it fails somewhere");
    assert!(shrink_order(&simplest, &found.failing.expect("it failed")));
    simplest.values()
}

fn shrink_order(a: &Report, b: &Report) -> bool {
    super::shrink::compare(a, b).is_le()
}

#[test]
fn numbers_shrink_to_the_bound_of_failure() {
    let test: Test = |case| verdict(integer(case, -1000, 1000) < 37);
    assert_eq!(simplest(test, 100), [Value::Integer(37)]);
    let negative: Test = |case| verdict(integer(case, i64::MIN, i64::MAX) > -12);
    assert_eq!(simplest(negative, 100), [Value::Integer(-12)]);
    let test: Test = |case| verdict(float(case, -10.0, 10.0) <= 2.5);
    assert_eq!(simplest(test, 100), [Value::Float(3.0)]);
    let small: Test = |case| verdict(!(0.2..0.3).contains(&float(case, 0.0, 1.0)));
    assert_eq!(simplest(small, 1000), [Value::Float(0.2)]);
}

#[test]
fn lists_lose_what_does_not_matter() {
    let test: Test = |case| {
        let sum: f64 = list(case, |case| float(case, 0.0, 10.0)).iter().sum();
        verdict(sum < 17.0)
    };
    let more = |value: f64| [Value::Integer(1), Value::Float(value)];
    let end = [Value::Integer(0)];
    let values = simplest(test, 500);
    assert_eq!(values.len(), 5, "two elements and an end: {values:?}");
    assert_eq!(values[4..], end);
    assert_eq!(values[..2], more(7.0));
    assert_eq!(values[2..4], more(10.0));
}

/// A failure of another kind is no simpler form of the first one.
#[test]
fn shrinking_stays_with_the_failure_it_began_with() {
    let test: Test = |case| match integer(case, 0, 1000) {
        600.. => (Status::Failed, "large", f64::INFINITY, Vec::new()),
        5 => (Status::Failed, "five", f64::INFINITY, Vec::new()),
        _ => verdict(true),
    };
    let found = found(test, &settings(500));
    let (failing, simplest) = (found.failing.unwrap(), found.simplest.unwrap());
    assert_eq!(failing.place, "large");
    assert_eq!(simplest.values(), [Value::Integer(600)]);
}

/// One in a million at random, but robustness leads there.
#[test]
fn robustness_leads_to_the_failure() {
    let test: Test = |case| {
        let (x, y, z) = (
            float(case, -10.0, 10.0),
            float(case, -10.0, 10.0),
            float(case, -10.0, 10.0),
        );
        let distance = libm::hypot(libm::hypot(x - 3.3, y + 7.1), z - 0.4);
        let status = if distance < 0.1 {
            Status::Failed
        } else {
            Status::Passed
        };
        (status, "close", distance - 0.1, Vec::new())
    };
    let found = found(test, &settings(2000));
    assert!(found.failing.is_some(), "{:?}", found.closest);
}

/// A path of eight decisions, each on a line of its own: covered lines lead through it.
#[test]
fn covered_lines_lead_to_the_failure() {
    let test: Test = |case| {
        let mut covered = Vec::new();
        for (line, wanted) in [3, 1, 4, 1, 5, 2, 6, 5].into_iter().enumerate() {
            let right = integer(case, 0, 9) == wanted;
            covered.push(2 * line as u64 + u64::from(right));
            if !right {
                return (Status::Passed, "", f64::INFINITY, covered);
            }
        }
        (Status::Failed, "through", f64::INFINITY, covered)
    };
    let found = found(test, &settings(5000));
    assert!(found.failing.is_some(), "{} lines", found.lines);
}

#[test]
fn known_failures_come_first() {
    let test: Test = |case| verdict(integer(case, 0, 1_000_000) != 123_456);
    assert_eq!(found(test, &settings(300)).failing, None);
    let known = Settings {
        known: vec![vec![Value::Integer(123_456)]],
        ..settings(300)
    };
    let found = found(test, &known);
    assert_eq!(found.cases, 1);
    assert_eq!(found.failing.unwrap().values(), [Value::Integer(123_456)]);
}

#[test]
fn discarded_cases_are_counted_and_never_fail() {
    let test: Test = |case| match integer(case, 0, 9) {
        0..5 => (Status::Discarded, "", f64::INFINITY, Vec::new()),
        _ => verdict(true),
    };
    let found = found(test, &settings(200));
    assert_eq!((found.cases, found.failing), (200, None));
    assert!((50..150).contains(&found.discarded), "{}", found.discarded);
}

/// A test that makes choices at three moments, each of which others may go on from; it fails near one point of eight values.
fn in_three_parts(case: &mut Case) -> (Status, &'static str, f64, Vec<u64>) {
    let mut distance = 0.0;
    for part in 0..3 {
        if part > 0 {
            case.add_branch();
        }
        let wanted = 0.2 + 0.3 * f64::from(part);
        distance += libm::fabs(float(case, 0.0, 1.0) - wanted);
        distance += libm::fabs(float(case, 0.0, 1.0) - wanted);
    }
    let status = if distance < 0.15 {
        Status::Failed
    } else {
        Status::Passed
    };
    (status, "close", distance - 0.15, Vec::new())
}

/// Cases that only change what was chosen late share what came before, one after the other.
#[test]
fn cases_go_on_from_moments_of_others() {
    let mut shared = 0;
    let mut last: Vec<Value> = Vec::new();
    let mut follow = |found: &Found, reports: &[Report]| {
        for report in reports.iter().filter(|_| found.cases > 100) {
            let values = report.values();
            shared += usize::from(last.get(..2) == values.get(..2));
            last = values;
        }
    };
    let mut runs = Runs(in_three_parts);
    let found = search(&settings(2000), &mut runs, &mut || false, &mut follow).expect("cases run");
    assert!(found.failing.is_some(), "{:?}", found.closest);
    assert!(shared * 8 > found.cases, "{shared} of {}", found.cases);
}

/// A case that goes on from a moment is the one that runs from the beginning.
#[test]
fn a_case_goes_on_as_if_it_had_run_from_the_beginning() {
    let plan = |values: &[f64], seed| Plan {
        values: values.iter().copied().map(Value::Float).collect(),
        rest: Rest::Random(seed),
    };
    let whole = |case: &mut Case| {
        case.begin_span();
        let _ = float(case, 0.0, 1.0);
        case.end_span();
    };
    let mut first = Case::new(plan(&[0.25], 1));
    whole(&mut first);
    first.add_branch();
    let begun = first.clone();
    whole(&mut first);
    let next = plan(&[0.25], 2);
    let mut resumed = begun.resumed(&next).expect("it has chosen the same");
    let mut fresh = Case::new(next);
    whole(&mut fresh);
    fresh.add_branch();
    for case in [&mut resumed, &mut fresh] {
        whole(case);
    }
    let end = CaseEnd {
        status: Status::Passed,
        place: String::new(),
        robustness: 0.0,
        covered: Vec::new(),
    };
    assert_ne!(resumed.values(), first.values());
    assert_eq!(resumed.finish(end.clone()), fresh.finish(end));
    assert!(begun.resumed(&plan(&[0.5, 0.1], 2)).is_none());
    assert!(begun.resumed(&plan(&[], 2)).is_none());
}

/// The elements of a list are chosen in two parts, with something else between them; they are left out as a whole.
#[test]
fn choices_that_belong_together_may_lie_apart() {
    let test: Test = |case| {
        let mut spans = Vec::new();
        for number in 0..3 {
            let span = case.begin_span();
            let probability = if number < 2 { 0.8 } else { 0.0 };
            let follows = case.choose(Domain::Follows { probability });
            case.end_span();
            if follows != Some(Value::Integer(1)) {
                break;
            }
            spans.push(span);
        }
        let between = integer(case, 0, 100);
        let mut largest = 0;
        for span in spans {
            case.resume_span(span);
            largest = largest.max(integer(case, 1, 60));
            case.end_span();
        }
        let after = integer(case, 0, 100);
        verdict(between < 20 || after < 30 || largest < 7)
    };
    // One element, the end of the list, what is between, the rest of the element, what comes after.
    assert_eq!(simplest(test, 500), [1, 0, 20, 7, 30].map(Value::Integer));
}

/// The same result by any number of threads, whatever their order.
#[test]
fn threads_change_nothing() {
    let test: Test = |case| {
        let (x, y) = (float(case, 0.0, 1.0), float(case, 0.0, 1.0));
        let distance = libm::hypot(x - 0.7, y - 0.2) - 0.01;
        let status = if distance < 0.0 {
            Status::Failed
        } else {
            Status::Passed
        };
        (status, "close", distance, vec![(x * 10.0) as u64])
    };
    let expected = found(test, &settings(1000));
    assert!(expected.failing.is_some());
    for threads in [1, 3] {
        assert_eq!(found_by(threads, test), expected);
    }
    let expected = found(in_three_parts, &settings(1000));
    assert!(expected.failing.is_some());
    assert_eq!(found_by(2, in_three_parts), expected);
}

fn found_by(threads: usize, test: Test) -> Found {
    let server = Server::new(threads, || {});
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some((number, plan)) = server.next(|| false) {
                    server.finish(number, run(test, plan));
                }
                server.leave();
            });
        }
        let mut evaluate = &server;
        let found = search(
            &settings(1000),
            &mut evaluate,
            &mut || false,
            &mut |_, _| {},
        );
        server.close();
        found.expect("cases run")
    })
}

#[test]
fn a_case_that_is_left_unfinished_ends_the_search() {
    let server = Server::new(2, || {});
    let is_taken = std::sync::Barrier::new(2);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            assert!(server.next(|| false).is_some());
            is_taken.wait();
            server.give_up(Vec::new());
            server.leave();
        });
        scope.spawn(|| {
            is_taken.wait();
            while let Some((number, plan)) = server.next(|| false) {
                server.finish(number, run(|_| verdict(true), plan));
            }
            server.leave();
        });
        let mut evaluate = &server;
        let found = search(&settings(100), &mut evaluate, &mut || false, &mut |_, _| {});
        server.close();
        assert_eq!(found, Err(WorkersGone));
    });
}

#[test]
fn values_outside_of_a_domain_become_the_nearest() {
    let integers = Domain::integers(-3, 9);
    assert_eq!(integers.nearest(Value::Float(4.6)), Value::Integer(5));
    assert_eq!(integers.nearest(Value::Float(f64::NAN)), Value::Integer(0));
    assert_eq!(integers.nearest(Value::Float(1e300)), Value::Integer(9));
    let floats = Domain::floats(2.0, 3.0);
    assert_eq!(floats.simplest(), Value::Float(2.0));
    assert_eq!(floats.nearest(Value::Integer(7)), Value::Float(3.0));
    assert_eq!(floats.nearest(Value::Float(f64::NAN)), Value::Float(2.0));
}

#[test]
fn bounds_may_be_all_there_are() {
    let all = Domain::integers(i64::MIN, i64::MAX);
    assert_eq!(all.at(0.0), Value::Integer(i64::MIN));
    let Value::Integer(last) = all.at(1.0 - 1e-17) else {
        panic!("a whole number")
    };
    assert_eq!(last, i64::MAX);
    let wide = Domain::floats(-f64::MAX, f64::MAX);
    assert!(wide.at(0.75).as_float().is_finite());
}

#[test]
fn failures_are_kept_until_they_are_gone() {
    let folder = tempfile::tempdir().expect("a folder");
    let failures = Failures::new(folder.path().join("failures"));
    let failure = KnownFailure {
        test: "a_test.lua::the arm / reaches".into(),
        message: "too far".into(),
        choices: vec![
            Value::Integer(2),
            Value::Float(2.0),
            Value::Float(0.1 + 0.2),
            Value::Float(-1.797_693_134_862_315_7e308),
        ],
    };
    assert_eq!(failures.load(&failure.test), None);
    let file = failures.save(&failure).expect("it can be written");
    assert_eq!(failures.load(&failure.test), Some(failure.clone()));
    assert_eq!(failures.load("another test"), None);
    for broken in ["", "{", "[]", "{\"test\": 3}", "null"] {
        std::fs::write(&file, broken).unwrap();
        assert_eq!(failures.load(&failure.test), None, "{broken}");
    }
    failures.save(&failure).unwrap();
    failures.remove(&failure.test);
    assert_eq!(failures.load(&failure.test), None);
    assert!(!file.exists());
}

/// A test that draws within loops cannot fill the memory.
#[test]
fn choices_are_limited() {
    let mut case = Case::new(Plan {
        values: Vec::new(),
        rest: Rest::Min,
    });
    let mut count = 0;
    while case.choose(Domain::integers(0, 1)).is_some() {
        count += 1;
    }
    assert_eq!(count, 10_000);
}

/// How many cases it takes in the median to come within a ten-thousandth of the domain in each of two values.
#[test]
fn few_cases_lead_far() {
    let test: Test = |case| {
        let (x, y) = (float(case, -100.0, 100.0), float(case, 0.0, 1.0));
        let distance = libm::fabs(x - 73.5) / 200.0 + libm::fabs(y - 0.123);
        let status = if distance < 1e-4 {
            Status::Failed
        } else {
            Status::Passed
        };
        (status, "close", distance - 1e-4, Vec::new())
    };
    let cases = |seed| {
        let found = found(
            test,
            &Settings {
                seed,
                ..settings(5000)
            },
        );
        assert!(found.failing.is_some(), "seed {seed}: {:?}", found.closest);
        found.cases
    };
    let mut counts: Vec<_> = (0..9).map(cases).collect();
    counts.sort_unstable();
    assert!(counts[4] < 1000, "{counts:?}");
}
