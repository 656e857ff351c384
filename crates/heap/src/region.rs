//! One region of a heap: small blocks from lists of free ones, larger ones from `talc`. All it knows of itself lies in the region, so
//! that a restore brings it back as well.

use std::alloc::Layout;
use std::ptr::{NonNull, null_mut};
use std::sync::atomic::{AtomicBool, AtomicPtr, Ordering};

use talc::DefaultBinning;
use talc::base::Talc;
use talc::base::binning::Binning;
use talc::source::Source;

use super::space::{REGION_LEN, commit};

/// Sizes of small blocks are rounded up to a multiple of this, which is their alignment too.
const STEP: usize = 16;
const CLASSES: usize = 32;
const LARGEST_SMALL: usize = STEP * CLASSES;
/// Small blocks are cut from pieces of this many bytes.
const PIECE: usize = 16 << 10;
/// Memory becomes usable in steps of so many bytes at least.
const MIN_GROWTH: usize = 256 << 10;
const MAX_GROWTH: usize = 16 << 20;
const PAGE: usize = 4096;

/// A free small block: the next of its list.
struct Free(*mut Free);

/// A block that was freed outside: the next of its list, and its size and alignment.
struct Returned {
    next: *mut Returned,
    size: usize,
}

/// The alignment as a power of two is below the size.
const ALIGN_BITS: u32 = 6;

impl Returned {
    fn new(next: *mut Self, layout: Layout) -> Self {
        let align = layout.align().trailing_zeros() as usize;
        Self {
            next,
            size: layout.size() << ALIGN_BITS | align,
        }
    }

    fn layout(&self) -> Option<Layout> {
        let align = 1 << (self.size & ((1 << ALIGN_BITS) - 1));
        Layout::from_size_align(self.size >> ALIGN_BITS, align).ok()
    }
}

const _: () = assert!(size_of::<Returned>() <= STEP, "each block has room for it");

/// The state of a region, at its beginning.
#[derive(Debug)]
pub(super) struct Region {
    /// Held while it changes, where several threads are inside.
    lock: AtomicBool,
    is_shared: AtomicBool,
    /// Blocks that were freed outside, until the next allocation.
    returned: AtomicPtr<Returned>,
    free: [*mut Free; CLASSES],
    /// The unused rest of the last piece.
    rest: *mut u8,
    rest_len: usize,
    live: usize,
    bytes: usize,
    talc: Talc<Growth, DefaultBinning>,
}

/// Where `talc` gets memory: more of the region.
#[derive(Debug)]
struct Growth {
    /// The end of what is usable.
    end: usize,
    limit: usize,
    talc_end: Option<NonNull<u8>>,
}

// SAFETY: allocates nothing.
unsafe impl Source for Growth {
    fn acquire<B: Binning>(talc: &mut Talc<Self, B>, layout: Layout) -> Result<(), ()> {
        let start = talc.source.end;
        let usable = REGION_LEN - (talc.source.limit - start);
        let step = (usable / 8).clamp(MIN_GROWTH, MAX_GROWTH);
        let needed = layout.size().checked_add(layout.align() + PAGE).ok_or(())?;
        let len = needed.max(step).next_multiple_of(PAGE);
        if len > talc.source.limit - start || !commit(start, len) {
            return Err(());
        }
        let (first, end) = (
            std::ptr::with_exposed_provenance_mut::<u8>(start),
            std::ptr::with_exposed_provenance_mut::<u8>(start + len),
        );
        talc.source.end = start + len;
        // SAFETY: usable since just now, and of nobody else.
        talc.source.talc_end = unsafe {
            match talc.source.talc_end {
                Some(talc_end) => Some(talc.extend(talc_end, end)),
                None => talc.claim(first, len),
            }
        };
        talc.source.talc_end.map(drop).ok_or(())
    }
}

impl Region {
    /// Makes an empty region in reserved memory; None if there is none.
    ///
    /// # Safety
    /// The region is reserved, and nothing is in it.
    pub(super) unsafe fn establish(region: *mut Self) -> Option<()> {
        let start = region.addr();
        let len = MIN_GROWTH;
        if !commit(start, len) {
            return None;
        }
        let header = size_of::<Self>().next_multiple_of(64);
        let growth = Growth {
            end: start + len,
            limit: start + REGION_LEN,
            talc_end: None,
        };
        // SAFETY: usable since just now; the state comes first, and the rest is the allocator's.
        unsafe {
            region.write(Self {
                lock: AtomicBool::new(false),
                is_shared: AtomicBool::new(false),
                returned: AtomicPtr::new(null_mut()),
                free: [null_mut(); CLASSES],
                rest: null_mut(),
                rest_len: 0,
                live: 0,
                bytes: 0,
                talc: Talc::new(growth),
            });
            let first = region.cast::<u8>().add(header);
            let talc = &mut (*region).talc;
            talc.source.talc_end = talc.claim(first, len - header);
            talc.source.talc_end.map(drop)
        }
    }

    /// From now on several threads may be inside.
    pub(super) fn share(&self) {
        self.is_shared.store(true, Ordering::Release);
    }

    /// How far it reaches: bytes from its beginning that may hold something.
    pub(super) fn len(&self) -> usize {
        REGION_LEN - (self.talc.source.limit - self.talc.source.end)
    }

    pub(super) fn live_blocks(&self) -> usize {
        self.live
    }

    pub(super) fn used_bytes(&self) -> usize {
        self.bytes
    }

    /// A block; null when the region is full.
    ///
    /// # Safety
    /// `region` is established and its heap not dropped; the size is not zero.
    #[inline]
    pub(super) unsafe fn allocate(region: *mut Self, layout: Layout) -> *mut u8 {
        // SAFETY: as promised; the guard excludes other threads.
        unsafe {
            let _guard = Guard::lock(region);
            let region = &mut *region;
            if !region.returned.load(Ordering::Relaxed).is_null() {
                region.take_returned();
            }
            let block = region.acquire(layout);
            if !block.is_null() {
                region.live += 1;
                region.bytes += layout.size();
            }
            block
        }
    }

    /// Frees a block.
    ///
    /// # Safety
    /// The block is of this region and layout, and not used any more.
    #[inline]
    pub(super) unsafe fn deallocate(region: *mut Self, block: *mut u8, layout: Layout) {
        // SAFETY: as promised; the guard excludes other threads.
        unsafe {
            let _guard = Guard::lock(region);
            (*region).free(block, layout);
        }
    }

    /// Grows or shrinks a block where it is, if there is room.
    ///
    /// # Safety
    /// As `deallocate`; the new size is not zero.
    pub(super) unsafe fn resize_in_place(
        region: *mut Self,
        block: *mut u8,
        layout: Layout,
        size: usize,
    ) -> bool {
        let new = resized(layout, size);
        // SAFETY: as promised; the guard excludes other threads, and `talc` made the block if neither size is small.
        unsafe {
            let _guard = Guard::lock(region);
            let region = &mut *region;
            let done = match (is_small(layout), is_small(new)) {
                (true, true) => class_of(layout.size()) == class_of(size),
                (false, false) => region
                    .talc
                    .try_realloc_in_place(block, aligned(layout), size),
                _ => false,
            };
            if done {
                region.bytes = region.bytes - layout.size() + size;
            }
            done
        }
    }

    /// One block fewer is in use, though it is not freed.
    ///
    /// # Safety
    /// `region` is established and its heap not dropped.
    pub(super) unsafe fn abandon_block(region: *mut Self) {
        // SAFETY: as promised; the guard excludes other threads.
        unsafe {
            let _guard = Guard::lock(region);
            (*region).live -= 1;
        }
    }

    /// Frees a block from outside, where the owner may be inside at the same time: it is put into a list.
    ///
    /// # Safety
    /// As `deallocate`.
    pub(super) unsafe fn return_block(region: *mut Self, block: *mut u8, layout: Layout) {
        #[expect(clippy::cast_ptr_alignment, reason = "blocks are aligned to `STEP`")]
        let returned = block.cast::<Returned>();
        // SAFETY: the block is nobody's any more, large enough, and aligned to `STEP`.
        unsafe {
            let list = &(*region).returned;
            let mut next = list.load(Ordering::Relaxed);
            loop {
                returned.write(Returned::new(next, layout));
                match list.compare_exchange_weak(
                    next,
                    returned,
                    Ordering::Release,
                    Ordering::Relaxed,
                ) {
                    Ok(_) => return,
                    Err(other) => next = other,
                }
            }
        }
    }

    /// Frees what was freed outside.
    ///
    /// # Safety
    /// The caller has the lock.
    #[cold]
    pub(super) unsafe fn take_returned(&mut self) {
        let mut next = self.returned.swap(null_mut(), Ordering::Acquire);
        while !next.is_null() {
            // SAFETY: written by `return_block`.
            unsafe {
                let returned = next.read();
                if let Some(layout) = returned.layout() {
                    self.free(next.cast(), layout);
                }
                next = returned.next;
            }
        }
    }

    unsafe fn acquire(&mut self, layout: Layout) -> *mut u8 {
        if !is_small(layout) {
            // SAFETY: the size is not zero.
            return unsafe { self.talc.allocate(aligned(layout)) }
                .map_or(null_mut(), NonNull::as_ptr);
        }
        let class = class_of(layout.size());
        let block = self.free[class];
        if block.is_null() {
            return self.cut((class + 1) * STEP);
        }
        // SAFETY: blocks of the lists were put there by `free`.
        self.free[class] = unsafe { (*block).0 };
        block.cast()
    }

    unsafe fn free(&mut self, block: *mut u8, layout: Layout) {
        self.live -= 1;
        self.bytes -= layout.size();
        if !is_small(layout) {
            // SAFETY: a block of `talc` of that layout.
            return unsafe { self.talc.deallocate(block, aligned(layout)) };
        }
        let class = class_of(layout.size());
        #[expect(clippy::cast_ptr_alignment, reason = "blocks are aligned to `STEP`")]
        let block = block.cast::<Free>();
        // SAFETY: nobody's any more; each has room for a pointer and is aligned for it.
        unsafe { block.write(Free(self.free[class])) };
        self.free[class] = block;
    }

    /// A small block from the rest of the last piece, or from a new one.
    fn cut(&mut self, size: usize) -> *mut u8 {
        if self.rest_len < size {
            let piece = Layout::from_size_align(PIECE, STEP).unwrap_or(Layout::new::<u128>());
            // SAFETY: the size is not zero.
            let Some(piece) = (unsafe { self.talc.allocate(piece) }) else {
                return null_mut();
            };
            (self.rest, self.rest_len) = (piece.as_ptr(), PIECE);
        }
        let block = self.rest;
        self.rest = block.wrapping_add(size);
        self.rest_len -= size;
        block
    }
}

fn is_small(layout: Layout) -> bool {
    layout.size() <= LARGEST_SMALL && layout.align() <= STEP
}

fn class_of(size: usize) -> usize {
    (size - 1) / STEP
}

fn resized(layout: Layout, size: usize) -> Layout {
    Layout::from_size_align(size, layout.align()).unwrap_or(layout)
}

/// Larger blocks are aligned as small ones are, at least.
fn aligned(layout: Layout) -> Layout {
    layout.align_to(STEP).unwrap_or(layout)
}

/// Excludes other threads where there are any.
struct Guard(Option<*const AtomicBool>);

impl Guard {
    #[inline]
    unsafe fn lock(region: *mut Region) -> Self {
        // SAFETY: the region is established; only atomic values are read here.
        let (lock, is_shared) = unsafe { (&raw const (*region).lock, &(*region).is_shared) };
        if !is_shared.load(Ordering::Acquire) {
            return Self(None);
        }
        // SAFETY: as above.
        let state = unsafe { &*lock };
        while state.swap(true, Ordering::Acquire) {
            std::hint::spin_loop();
        }
        Self(Some(lock))
    }
}

impl Drop for Guard {
    #[inline]
    fn drop(&mut self) {
        if let Some(lock) = self.0 {
            // SAFETY: the region outlives the guard.
            unsafe { (*lock).store(false, Ordering::Release) };
        }
    }
}
