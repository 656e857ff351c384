//! Any bytes as the file of a failing case: it is refused, or its choices are a case whose values are within their bounds.
//!
//! `cargo fuzz run failing_case`
#![no_main]

use libfuzzer_sys::fuzz_target;
use search::{Case, Domain, KnownFailure, Plan, Rest, Value};

fuzz_target!(|bytes: &[u8]| {
    let Some(failure) = KnownFailure::read(bytes) else { return };
    let count = failure.choices.len();
    let mut case = Case::new(Plan { values: failure.choices, rest: Rest::Random(1) });
    for number in 0..=count {
        let domain = match number % 3 {
            0 => Domain::integers(-5, 9),
            1 => Domain::floats(0.5, 2.5),
            _ => Domain::Follows { probability: 0.5 },
        };
        match (number % 3, case.choose(domain)) {
            (0, Some(Value::Integer(value))) => assert!((-5..=9).contains(&value)),
            (1, Some(Value::Float(value))) => assert!((0.5..=2.5).contains(&value)),
            (2, Some(Value::Integer(value))) => assert!((0..=1).contains(&value)),
            (_, None) => assert!(number >= 10_000),
            (_, Some(value)) => panic!("{value:?} is of another kind"),
        }
    }
});
