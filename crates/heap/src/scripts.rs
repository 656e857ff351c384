//! The memory of scripts' languages: apart from all other, so that its addresses only depend on what scripts do.

use super::current::{self, Entered};
use super::region::Region;
use super::space::Address;

/// Memory of a heap that only scripts' languages allocate from, in an order that the same run repeats.
#[derive(Debug, Clone, Copy)]
pub struct Scripts(Address);

impl Scripts {
    /// That of the heap that the thread is inside of.
    pub fn current() -> Option<Self> {
        current::heap().map(Self)
    }

    /// Notes that a block there is never freed, and nobody knows of it: the heap ends without it.
    pub fn abandon_block(self) {
        // SAFETY: the heap is there, as the thread is inside of it.
        unsafe { Region::abandon_block(self.0.scripts()) };
    }

    /// Runs `work`: what it allocates comes from there.
    #[inline]
    pub fn enter<T>(self, work: impl FnOnce() -> T) -> T {
        let _entered = Entered::switch(self.0.scripts());
        work()
    }
}

/// Runs `work` with the memory of scripts' languages, if the thread is inside of a heap.
#[inline]
pub fn in_scripts<T>(work: impl FnOnce() -> T) -> T {
    match Scripts::current() {
        Some(scripts) => scripts.enter(work),
        None => work(),
    }
}
