//! Which heap a thread is inside of.

use std::cell::Cell;
use std::marker::PhantomData;
use std::ptr::null_mut;

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
    _this_thread: PhantomData<*const ()>,
}

impl Entered {
    pub(super) fn begin(heap: Address) -> Self {
        Self::switch(heap.general())
    }

    pub(super) fn switch(region: *mut Region) -> Self {
        Self {
            before: CURRENT.replace(region),
            _this_thread: PhantomData,
        }
    }
}

impl Drop for Entered {
    fn drop(&mut self) {
        CURRENT.set(self.before);
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
