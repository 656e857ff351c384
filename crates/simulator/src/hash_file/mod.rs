//! Files of state hashes: one line for each step, to find where another run differs.
//!
//! The files are text. After a head, `t` lines name owners of values (objects, the scene, the application, scripts), `p` lines name
//! properties, and `s` lines are steps: number, simulated time, state hash, and the values that changed since the line before, as
//! `OWNER.PROPERTY=HASH` with the numbers of the lines above and half of the value's hash, `-` where the value is gone. So a difference
//! can be named. The values are left out from an `e` line on, where they would take more than [`MAX_VALUES`] bytes.

mod compare;
mod read;
#[cfg(test)]
mod tests;
mod write;

pub use compare::{Comparison, Difference, DifferentValue, Presence, Verdict};
pub use read::HashFileError;
pub use write::HashWriter;

/// The first line.
const HEAD: &str = "swanilda state hashes 1";
/// Bytes that the values of all steps may take; beyond it only the hashes of the steps are written.
pub const MAX_VALUES: usize = 256 << 20;

/// A part of a value's hash that is enough to find it; 0 only where there is no value.
fn short(hash: u64) -> u32 {
    let half = (hash >> 32) as u32;
    if half == 0 && hash != 0 { 1 } else { half }
}
