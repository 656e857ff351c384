//! What counting costs on this machine.
#![allow(clippy::disallowed_methods, reason = "what something costs is told by the wall clock")]

use std::time::{Duration, Instant};

use crate::scene::Data;
use crate::{Limits, Options, ScriptKind, Simulator};

/// A loop with a line that never runs, so that its lines are told to the end.
const SCRIPT: &[u8] = b"function loop(n)\n local sum = 0\n for i = 1, n do\n  if i < 0 then\n   sum = 0\n  end\n  sum = sum + i\n end\nend";
const ROUNDS: i64 = 5000;
/// The fastest of so many tries counts: others were interrupted.
const TRIES: usize = 3;

/// How long Lua code takes longer for each line that is told, measured with a small loop; None where that cannot be measured.
pub(super) fn of_an_event() -> Option<Duration> {
    let (plain, _) = time_of(false)?;
    let (counted, events) = time_of(true)?;
    Some(counted.saturating_sub(plain) / u32::try_from(events).ok().filter(|&events| events > 0)?)
}

/// The time of the loop, and how many events it had.
fn time_of(count_lines: bool) -> Option<(Duration, u64)> {
    let limits = Some(Limits { memory: 1 << 30 });
    let mut sim = Simulator::new(Options { limits, count_lines, ..Options::default() });
    let script = sim.add_script(ScriptKind::Customization, "", SCRIPT).ok()?;
    let mut best = (Duration::MAX, 0);
    for _ in 0..TRIES {
        sim.take_line_counts();
        let begun = Instant::now();
        sim.call(&script, "loop", &[Data::Int(ROUNDS)]).ok()?;
        best = best.min((begun.elapsed(), sim.take_line_counts().events));
    }
    Some(best)
}
