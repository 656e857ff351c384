//! Blocks that are freed on the other side of the border of a heap.

use std::cell::Cell;
use std::sync::OnceLock;

/// What happened at the border.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crossing {
    /// Code outside freed a block of a heap.
    InsideFreedOutside,
    /// Code inside freed or grew a block of the system.
    OutsideFreedInside,
    /// Code inside one heap freed a block of another.
    BetweenHeaps,
}

static REPORT: OnceLock<fn(Crossing, usize)> = OnceLock::new();

thread_local! {
    static IS_REPORTING: Cell<bool> = const { Cell::new(false) };
}

/// Calls `report` with each crossing and the size of the block from now on: for tests. Only the first call counts.
pub fn on_crossing(report: fn(Crossing, usize)) {
    let _ = REPORT.set(report);
}

/// Reports a crossing, outside and once at a time: to report may free and allocate.
#[cold]
pub(super) fn report(crossing: Crossing, size: usize) {
    let Some(report) = REPORT.get() else { return };
    if IS_REPORTING.try_with(|is| is.replace(true)) == Ok(false) {
        super::outside(|| report(crossing, size));
        IS_REPORTING.set(false);
    }
}
