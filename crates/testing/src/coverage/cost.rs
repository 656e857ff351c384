//! Measured overhead of coverage on this machine.
#![allow(
    clippy::disallowed_methods,
    reason = "what something costs is told by the wall clock"
)]

use std::time::{Duration, Instant};

use scene::Data;
use simulator::{Limits, Options, ScriptKind, Simulator};

/// A loop of short lines.
const SCRIPT: &[u8] = b"function loop(n)\n local sum = 0\n for i = 1, n do\n  if i < 0 then\n   sum = 0\n  end\n  sum = sum + i\n end\nend";
const ROUNDS: i64 = 20_000;
/// The fastest of so many tries counts: others were interrupted.
const TRIES: usize = 5;

/// How many times longer the loop takes when its lines are counted; None where that cannot be measured.
pub(super) fn of_a_loop() -> Option<f64> {
    let plain = time_of(false)?.as_secs_f64();
    let counted = time_of(true)?.as_secs_f64();
    (plain > 0.0).then(|| (counted / plain).max(1.0))
}

fn time_of(count_lines: bool) -> Option<Duration> {
    let limits = Some(Limits { memory: 1 << 30 });
    let mut sim = Simulator::new(Options {
        limits,
        count_lines,
        ..Options::default()
    });
    let script = sim.add_script(ScriptKind::Customization, "", SCRIPT).ok()?;
    let mut best = Duration::MAX;
    for _ in 0..TRIES {
        let begun = Instant::now();
        sim.call(&script, "loop", &[Data::Int(ROUNDS)]).ok()?;
        best = best.min(begun.elapsed());
    }
    Some(best)
}
