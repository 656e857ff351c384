//! Mathematical functions: results must have the same bits on every processor and with every C library, so those of `libm` are called,
//! and not those of the standard library, which are the C library's.

use super::imports::{code_lines, has_word, is_test, read, relative, sources, without_tests};

/// Methods of floats that the standard library passes on to C, or that a processor may do in another way.
const METHODS: &[&str] = &[
    "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "cos", "cosh", "exp",
    "exp2", "exp_m1", "hypot", "ln", "ln_1p", "log10", "log2", "mul_add", "powf", "sin", "sin_cos",
    "sinh", "tan", "tanh",
];

/// Files that call some of them, with the reason. The list only becomes shorter.
const ALLOWED: &[(&str, &str)] = &[];

/// Crates of others that call C's functions, with what depends on them. `Cargo.lock` says whether they are still there.
const CRATES_OF_OTHERS: &[(&str, &str)] = &[(
    "rsruckig",
    "trajectories of Ruckig: cubic roots, and angles for roots of polynomials, which Newton steps refine",
)];

#[test]
fn mathematical_functions_are_those_of_libm() {
    let mut wrong = Vec::new();
    for file in sources().into_iter().filter(|file| !is_test(file)) {
        let is_allowed = |(name, _): &(&str, &str)| relative(&file).ends_with(name);
        let found = calls(&without_tests(&read(&file)));
        match ALLOWED.iter().any(is_allowed) {
            true if found.is_empty() => {
                wrong.push(format!("{}: nothing left to allow", file.display()));
            }
            true => {}
            false => wrong.extend(
                found
                    .iter()
                    .map(|call| format!("{}: {call}", file.display())),
            ),
        }
    }
    assert!(
        wrong.is_empty(),
        "call the functions of `libm`:\n{}",
        wrong.join("\n")
    );
}

#[test]
fn crates_of_others_with_functions_of_c_are_still_there() {
    let lock = read(&super::imports::root().join("Cargo.lock"));
    for (name, _) in CRATES_OF_OTHERS {
        assert!(lock.contains(&format!("name = \"{name}\"")), "{name}");
    }
}

/// The lines with such calls: `x.sin()`, `f64::sin`.
fn calls(text: &str) -> Vec<String> {
    let is_call = |line: &str| {
        METHODS.iter().any(|method| {
            let by_dot = line.contains(&format!(".{method}("));
            let by_name = ["f64::", "f32::"]
                .iter()
                .any(|ty| line.contains(&format!("{ty}{method}")) && has_word(line, method));
            by_dot || by_name
        })
    };
    let lines = code_lines(text).filter(|line| is_call(line));
    lines.map(|line| line.trim().to_owned()).collect()
}

#[test]
fn calls_are_found() {
    assert_eq!(calls("let x = y.sin();").len(), 1);
    assert_eq!(calls("values.map(f64::exp)").len(), 1);
    assert_eq!(calls("    .powf(2.0)").len(), 1);
    assert!(calls("libm::sin(x); console.log(x); a.exponent();").is_empty());
}
