//! The addresses of heaps: slots of equal size at fixed places, the lowest free one first.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::region::Region;

/// Where slots begin. Programs, libraries, stacks and the memory of sanitizers lie elsewhere on 64-bit systems.
const BASE: usize = 0x2000_0000_0000;
/// A region is a multiple of 4 GiB long: Lua orders keys by the lower half of their addresses, which is then the same in each slot.
pub(super) const REGION_LEN: usize = 16 << 30;
const SLOT_LEN: usize = 2 * REGION_LEN;
pub(super) const SLOT_COUNT: usize = 1024;
const END: usize = BASE + SLOT_COUNT * SLOT_LEN;

/// Which slots are taken.
static TAKEN: Mutex<[bool; SLOT_COUNT]> = Mutex::new([false; SLOT_COUNT]);
/// How many snapshots there are of each, of heaps that are gone as well.
static SNAPSHOTS: [AtomicUsize; SLOT_COUNT] = [const { AtomicUsize::new(0) }; SLOT_COUNT];
/// How many calls of its owner are inside of each, or outside on their way back.
static CALLS: [AtomicUsize; SLOT_COUNT] = [const { AtomicUsize::new(0) }; SLOT_COUNT];
/// Which heaps come to their end: no snapshot is brought back any more.
static ENDING: [AtomicBool; SLOT_COUNT] = [const { AtomicBool::new(false) }; SLOT_COUNT];

/// Where a heap lies: two regions, one for scripts' languages and one for all else.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Address(usize);

/// A heap's address space, as long as it is its own.
#[derive(Debug)]
pub(super) struct Slot {
    address: Address,
}

impl Address {
    /// The slot of a block; None for memory of the system.
    #[inline]
    pub(super) fn of(block: *const u8) -> Option<Self> {
        let at = block.addr();
        (BASE..END)
            .contains(&at)
            .then_some(Self(at & !(SLOT_LEN - 1)))
    }

    pub(super) fn general(self) -> *mut Region {
        std::ptr::with_exposed_provenance_mut(self.0)
    }

    pub(super) fn scripts(self) -> *mut Region {
        std::ptr::with_exposed_provenance_mut(self.0 + REGION_LEN)
    }

    fn index(self) -> usize {
        (self.0 - BASE) / SLOT_LEN
    }

    /// Counts the snapshots of the heap here.
    pub(super) fn snapshots(self) -> &'static AtomicUsize {
        &SNAPSHOTS[self.index()]
    }

    /// Whether the heap may become again what it was.
    pub(super) fn has_snapshots(self) -> bool {
        self.snapshots().load(Ordering::Relaxed) != 0
            && !ENDING[self.index()].load(Ordering::Relaxed)
    }

    /// Counts the calls that are inside.
    pub(super) fn calls(self) -> &'static AtomicUsize {
        &CALLS[self.index()]
    }

    pub(super) fn set_ending(self, is_ending: bool) {
        ENDING[self.index()].store(is_ending, Ordering::Relaxed);
    }
}

/// The region that a block lies in; it must be a block of a heap.
#[inline]
pub(super) fn region_of(block: *mut u8) -> *mut Region {
    block.map_addr(|at| at & !(REGION_LEN - 1)).cast()
}

impl Slot {
    /// The lowest free slot.
    pub(super) fn take() -> Option<Self> {
        let mut taken = TAKEN.lock().ok()?;
        let index = taken.iter().position(|taken| !taken)?;
        let at = BASE + index * SLOT_LEN;
        system::reserve(at, SLOT_LEN).then(|| {
            taken[index] = true;
            Self {
                address: Address(at),
            }
        })
    }

    pub(super) fn address(&self) -> Address {
        self.address
    }

    pub(super) fn regions(&self) -> [*mut Region; 2] {
        [self.address.general(), self.address.scripts()]
    }

    /// Gives the slot back; where blocks are still in use, it stays theirs until the process ends.
    pub(super) fn release(&self, is_empty: bool) {
        if !is_empty {
            return;
        }
        if let Ok(mut taken) = TAKEN.lock() {
            system::release(self.address.0, SLOT_LEN);
            taken[self.address.index()] = false;
        }
    }
}

/// Makes `len` bytes at `at` usable; both are multiples of the page size, inside a slot.
pub(super) fn commit(at: usize, len: usize) -> bool {
    system::commit(at, len)
}

#[cfg(all(unix, target_pointer_width = "64"))]
mod system {
    use rustix::mm::{MapFlags, MprotectFlags, ProtFlags, mmap_anonymous, mprotect, munmap};

    /// Linux refuses an address that is in use with this flag; elsewhere the address is a wish, which is then checked.
    #[cfg(target_os = "linux")]
    const AT_ADDRESS: MapFlags = MapFlags::FIXED_NOREPLACE.union(MapFlags::NORESERVE);
    #[cfg(not(target_os = "linux"))]
    const AT_ADDRESS: MapFlags = MapFlags::NORESERVE;

    pub(super) fn reserve(at: usize, len: usize) -> bool {
        let wanted = std::ptr::with_exposed_provenance_mut(at);
        let flags = MapFlags::PRIVATE | AT_ADDRESS;
        // SAFETY: new memory without access, at an address where nothing is.
        match unsafe { mmap_anonymous(wanted, len, ProtFlags::empty(), flags) } {
            Ok(found) if found == wanted => {
                wanted.expose_provenance();
                true
            }
            Ok(elsewhere) => {
                // SAFETY: mapped just now, and nobody knows of it.
                let _ = unsafe { munmap(elsewhere, len) };
                false
            }
            Err(_) => false,
        }
    }

    pub(super) fn commit(at: usize, len: usize) -> bool {
        let start = std::ptr::with_exposed_provenance_mut(at);
        // SAFETY: reserved by `reserve`, and without access until now.
        unsafe { mprotect(start, len, MprotectFlags::READ | MprotectFlags::WRITE) }.is_ok()
    }

    pub(super) fn release(at: usize, len: usize) {
        let start = std::ptr::with_exposed_provenance_mut(at);
        // SAFETY: reserved by `reserve`; no block is left in it.
        let _ = unsafe { munmap(start, len) };
    }
}

/// Elsewhere there are no heaps: memory is the system's.
#[cfg(not(all(unix, target_pointer_width = "64")))]
mod system {
    pub(super) fn reserve(_: usize, _: usize) -> bool {
        false
    }

    pub(super) fn commit(_: usize, _: usize) -> bool {
        false
    }

    pub(super) fn release(_: usize, _: usize) {}
}
