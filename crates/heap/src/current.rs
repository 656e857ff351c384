//! Which heap a thread is inside of.

use std::cell::Cell;
use std::marker::PhantomData;
use std::ptr::null_mut;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::region::Region;
use super::space::Address;

thread_local! {
    /// The region that allocations go to; null outside.
    static CURRENT: Cell<*mut Region> = const { Cell::new(null_mut()) };
}

/// The region that allocations go to; null outside, and while the thread ends.
#[inline]
pub(super) fn region() -> *mut Region {
    CURRENT.try_with(Cell::get).unwrap_or(null_mut())
}

/// The heap the thread is inside of.
pub(super) fn heap() -> Option<Address> {
    Address::of(region().cast())
}

/// Inside of a heap, of its memory for scripts, or outside, until it is dropped.
#[derive(Debug)]
pub struct Entered {
    before: *mut Region,
    /// How many calls of the owner are inside of the heap, this one among them.
    calls: Option<&'static AtomicUsize>,
    _this_thread: PhantomData<*const ()>,
}

impl Entered {
    /// By the thread that owns the heap.
    pub(super) fn begin(heap: Address) -> Self {
        let calls = heap.calls();
        // Of one thread only.
        calls.store(calls.load(Ordering::Relaxed) + 1, Ordering::Relaxed);
        let mut entered = Self::switch(heap.general());
        entered.calls = Some(calls);
        entered
    }

    pub(super) fn switch(region: *mut Region) -> Self {
        Self {
            before: CURRENT.replace(region),
            calls: None,
            _this_thread: PhantomData,
        }
    }
}

impl Drop for Entered {
    fn drop(&mut self) {
        CURRENT.set(self.before);
        if let Some(calls) = self.calls {
            calls.store(calls.load(Ordering::Relaxed) - 1, Ordering::Relaxed);
        }
    }
}

/// Runs `work` with the system's memory: for what outlives the simulator, or belongs to the program around it.
pub fn outside<T>(work: impl FnOnce() -> T) -> T {
    let _entered = Entered::switch(null_mut());
    work()
}

/// What `work` computes with the system's memory, copied to where the thread is: for results of the program around a simulator.
pub fn brought_in<T: Clone>(work: impl FnOnce() -> T) -> T {
    if heap().is_none() {
        return work();
    }
    let outer = outside(work);
    let inner = outer.clone();
    outside(|| drop(outer));
    inner
}
