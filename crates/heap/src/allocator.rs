//! The global allocator.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicBool, Ordering};

use super::crossing::{Crossing, report};
use super::current;
use super::region::Region;
use super::space::{Address, region_of};

/// The allocator that a program declares, so that its simulators have heaps:
///
/// ```
/// #[global_allocator]
/// static ALLOCATOR: heap::Allocator = heap::Allocator;
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct Allocator;

/// Whether the allocator has been called.
static IS_INSTALLED: AtomicBool = AtomicBool::new(false);

/// Whether the program has declared [`Allocator`].
pub fn is_installed() -> bool {
    // Something is allocated, so that there was a call.
    drop(std::hint::black_box(Box::new(0_u8)));
    IS_INSTALLED.load(Ordering::Relaxed)
}

// SAFETY: every block comes from a region or from the system, and goes back to where its address says it came from.
unsafe impl GlobalAlloc for Allocator {
    #[inline]
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let region = current::region();
        // SAFETY: the caller's promise; the region is that of a heap that the thread has entered.
        unsafe {
            if region.is_null() {
                note_installed();
                return System.alloc(layout);
            }
            let block = Region::allocate(region, layout);
            if block.is_null() {
                System.alloc(layout)
            } else {
                block
            }
        }
    }

    #[inline]
    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise.
        unsafe {
            match Address::of(block) {
                Some(heap) => free_in_heap(heap, block, layout),
                None => free_of_system(block, layout),
            }
        }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        let heap = Address::of(block);
        let is_here = current::heap() == heap;
        // SAFETY: the caller's promise; a block that moves is copied before it is freed.
        unsafe {
            if is_here && heap.is_none() {
                return System.realloc(block, layout, size);
            }
            if is_here && Region::resize_in_place(region_of(block), block, layout, size) {
                return block;
            }
            self.moved(block, layout, size)
        }
    }
}

impl Allocator {
    /// A block of another size with the same bytes, where the thread is now.
    unsafe fn moved(self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller of `realloc` has promised that the size is not zero and fits.
        unsafe {
            let new = self.alloc(Layout::from_size_align_unchecked(size, layout.align()));
            if !new.is_null() {
                block.copy_to_nonoverlapping(new, layout.size().min(size));
                self.dealloc(block, layout);
            }
            new
        }
    }
}

#[inline]
fn note_installed() {
    if !IS_INSTALLED.load(Ordering::Relaxed) {
        IS_INSTALLED.store(true, Ordering::Relaxed);
    }
}

/// # Safety
/// The block is of that heap and layout, and not used any more.
#[inline]
unsafe fn free_in_heap(heap: Address, block: *mut u8, layout: Layout) {
    let here = current::heap();
    if here == Some(heap) {
        // SAFETY: as promised.
        return unsafe { Region::deallocate(region_of(block), block, layout) };
    }
    report(
        here.map_or(Crossing::InsideFreedOutside, |_| Crossing::BetweenHeaps),
        layout.size(),
    );
    // With snapshots it stays: after a restore it is what it was then, and in use.
    if !heap.has_snapshots() {
        // SAFETY: as promised.
        unsafe { Region::return_block(region_of(block), block, layout) };
    }
}

/// # Safety
/// The block is of the system and of that layout, and not used any more.
#[inline]
unsafe fn free_of_system(block: *mut u8, layout: Layout) {
    if let Some(here) = current::heap() {
        report(Crossing::OutsideFreedInside, layout.size());
        if here.has_snapshots() {
            // After a restore it is in use again.
            return;
        }
    }
    // SAFETY: as promised.
    unsafe { System.dealloc(block, layout) };
}
