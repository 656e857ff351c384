//! The memory of a simulator in one place: at addresses that are the same in every process, copied by a [`Snapshot`], brought back by
//! [`Heap::restore`].
//!
//! A program declares [`Allocator`] as its global allocator. A thread is *inside* a heap while [`Heap::enter`] runs: then all it
//! allocates lies in that heap, whatever type allocates it. Elsewhere it is the system's allocator as ever. Whoever frees a block, its
//! address says whose it is.
//!
//! A restore brings back every byte of the heap, so nothing that lives there can be forgotten, and no destructor of what came after
//! the snapshot runs. This is sound as long as nothing outside refers to what only the future had, and nothing inside to memory
//! outside that is gone:
//! - What outlives a simulator (statics, values of a thread) is made with [`outside`], as are calls of what the embedding program gave.
//! - Values that leave a simulator are copied ([`Heap::enter_and_copy`]).
//! - Threads, sockets and files are no memory: a [`resource::Resource`] names each, and there is no snapshot while one is open.
//!
//! Two rules make mistakes harmless where they can be: while a heap has snapshots, code inside frees nothing outside (nor drops what an
//! [`Outer`] holds), and code outside frees nothing inside. [`on_crossing`] reports both, which is how tests find them.

#![expect(unsafe_code, reason = "an allocator")]

mod allocator;
mod contained;
mod crossing;
mod current;
mod image;
mod lazy;
mod outer;
mod region;
pub mod resource;
mod scripts;
mod snapshot;
mod space;

pub use allocator::{Allocator, is_installed};
pub use contained::Contained;
pub use crossing::{Crossing, on_crossing};
pub use current::{Entered, brought_in, outside};
pub use lazy::Lazy;
pub use outer::Outer;
pub use scripts::{Scripts, in_scripts};
pub use snapshot::{Moment, RestoreError, Snapshot};

use std::cell::RefCell;
use std::marker::PhantomData;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use image::Image;
use region::Region;
use space::Slot;

/// How many heaps there were.
static COUNT: AtomicU64 = AtomicU64::new(0);

/// The memory of one simulator. Belongs to the thread that made it; other threads enter it for a while by [`Heap::handle`].
#[derive(Debug)]
pub struct Heap {
    slot: Slot,
    number: u64,
    /// What the memory was at the last snapshot or restore: pages that did not change since are shared.
    last: RefCell<Option<Arc<[Image; 2]>>>,
    _not_sync: PhantomData<*const ()>,
}

/// A heap by another name, for values that do not own it.
#[derive(Debug, Clone, Copy)]
pub struct Handle {
    address: space::Address,
    _not_send: PhantomData<*const ()>,
}

/// A heap as other threads know it, which work for the one that owns it.
#[derive(Debug, Clone, Copy)]
pub struct SharedHandle(space::Address);

impl Heap {
    /// An empty heap; None where the program has another allocator, or the system gives no such addresses.
    pub fn new() -> Option<Self> {
        if !is_installed() {
            return None;
        }
        let slot = Slot::take()?;
        slot.address().set_ending(false);
        for region in slot.regions() {
            // SAFETY: the slot is new, so its regions are nobody else's memory.
            unsafe { Region::establish(region) }?;
        }
        Some(Self {
            slot,
            number: COUNT.fetch_add(1, Ordering::Relaxed),
            last: RefCell::default(),
            _not_sync: PhantomData,
        })
    }

    /// Runs `work` inside.
    pub fn enter<T>(&self, work: impl FnOnce() -> T) -> T {
        let _entered = self.entered();
        work()
    }

    /// Inside until the result is dropped.
    pub fn entered(&self) -> Entered {
        Entered::begin(self.slot.address())
    }

    /// Runs `work` inside, and copies its result out.
    pub fn enter_and_copy<T: Clone>(&self, work: impl FnOnce() -> T) -> T {
        enter_and_copy(Some(self.handle()), work)
    }

    /// The heap by another name.
    pub fn handle(&self) -> Handle {
        Handle {
            address: self.slot.address(),
            _not_send: PhantomData,
        }
    }

    /// The end begins: no snapshot is brought back any more.
    pub fn end(&self) {
        self.slot.address().set_ending(true);
    }

    /// Bytes in use, and blocks.
    pub fn usage(&self) -> (usize, usize) {
        let of = |region: *mut Region| {
            // SAFETY: the regions live as long as the slot, and the owner's thread is here, not inside.
            unsafe { ((*region).used_bytes(), (*region).live_blocks()) }
        };
        let [general, scripts] = self.slot.regions().map(of);
        (general.0 + scripts.0, general.1 + scripts.1)
    }
}

impl Handle {
    /// The heap this thread is inside of.
    pub fn current() -> Option<Self> {
        current::heap().map(|address| Self {
            address,
            _not_send: PhantomData,
        })
    }

    /// The heap that a value lies in.
    pub fn of<T>(value: &T) -> Option<Self> {
        space::Address::of(std::ptr::from_ref(value).cast()).map(|address| Self {
            address,
            _not_send: PhantomData,
        })
    }

    /// Inside until the result is dropped. The heap must be there still: ask something that lies in it.
    pub fn entered(self) -> Entered {
        Entered::begin(self.address)
    }

    /// For threads that work for this one, which waits for them.
    pub fn shared(self) -> SharedHandle {
        // SAFETY: the heap is there, as its thread is here; the flag is atomic.
        unsafe { (*self.address.general()).share() };
        SharedHandle(self.address)
    }
}

impl SharedHandle {
    /// Inside until the result is dropped, with other threads at the same time. The thread that owns the heap waits for this one.
    pub fn entered(self) -> Entered {
        Entered::switch(self.0.general())
    }
}

/// What `work` computes inside of the heap, if there is one, copied out.
pub fn enter_and_copy<T: Clone>(heap: Option<Handle>, work: impl FnOnce() -> T) -> T {
    let Some(heap) = heap else { return work() };
    let inner = {
        let _entered = heap.entered();
        work()
    };
    let outer = outside(|| inner.clone());
    let _entered = heap.entered();
    drop(inner);
    outer
}

impl Drop for Heap {
    fn drop(&mut self) {
        self.last.take();
        let left = |region: *mut Region| {
            // SAFETY: the owner's thread is here, not inside.
            unsafe {
                (*region).take_returned();
                (*region).live_blocks()
            }
        };
        let blocks: usize = self.slot.regions().map(left).iter().sum();
        self.slot.release(blocks == 0);
    }
}

#[cfg(test)]
mod tests;
