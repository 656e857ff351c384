//! Any text as a script whose lines are counted, under any name: the LCOV report has the lines LCOV knows, with sums that are right.
//!
//! The first line of the input is the name.
//!
//! `cargo fuzz run lcov`
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use testing::Coverage;
use swanilda::{Options, Permissions, ScriptKind, Simulator};

/// Checks one record; `found` and `hit` are the lines counted so far.
fn check(report: &str) {
    let (mut found, mut hit) = (0, 0);
    for line in report.lines() {
        if line == "end_of_record" {
            (found, hit) = (0, 0);
            continue;
        }
        let (key, value) = line.split_once(':').expect("key and value");
        match key {
            "DA" => {
                let (line, count) = value.split_once(',').expect("line and count");
                assert!(line.parse::<u32>().expect("a line") > 0);
                found += 1;
                hit += usize::from(count.parse::<u64>().expect("a count") > 0);
            }
            "LF" => assert_eq!(value.parse(), Ok(found)),
            "LH" => assert_eq!(value.parse(), Ok(hit)),
            "FN" | "FNDA" => assert!(value.contains(',')),
            "TN" | "SF" | "FNF" | "FNH" => {}
            _ => panic!("{line:?} is no line of LCOV's"),
        }
    }
}

fuzz_target!(|input: &[u8]| {
    let end = input.iter().position(|&byte| byte == b'\n').unwrap_or(0);
    let (name, text) = (String::from_utf8_lossy(&input[..end]), &input[end..]);
    let options = Options { count_lines: true, permissions: Permissions::strict(), ..Options::default() };
    let mut sim = Simulator::new(options);
    // What the text does does not matter here: a function around it keeps it from running.
    let code = [b"function never()", text, b"\nend"].concat();
    let _ = sim.add_script(ScriptKind::Customization, &name, &code);
    let counts = sim.take_line_counts();
    check(&Coverage::of(Path::new("report.info"), &[], counts).lcov());
});
