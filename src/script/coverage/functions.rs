//! Where a running function stands, by its address.

use std::cell::Cell;
use std::ffi::c_void;

const SLOTS: usize = 64;

/// The functions that ran lines last, with their places. Whoever frees memory must tell: another function may come to lie at the same address.
pub(crate) struct FunctionCache {
    slots: [Cell<Slot>; SLOTS],
}

/// Where a function stands: which text, and which of its functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Place {
    pub text: u32,
    pub function: u32,
}

#[derive(Clone, Copy)]
struct Slot {
    function: *const c_void,
    place: Option<Place>,
}

const EMPTY: Slot = Slot { function: std::ptr::null(), place: None };

impl FunctionCache {
    pub(crate) fn new() -> Self {
        Self { slots: [const { Cell::new(EMPTY) }; SLOTS] }
    }

    fn slot(&self, function: *const c_void) -> &Cell<Slot> {
        // Blocks lie at multiples of 16.
        &self.slots[(function as usize >> 4) % SLOTS]
    }

    /// The place of a function, None when its lines are not counted; `find` is asked about functions that are new here.
    pub(crate) fn place(&self, function: *const c_void, find: impl FnOnce() -> Option<Place>) -> Option<Place> {
        let slot = self.slot(function);
        let known = slot.get();
        if known.function == function {
            return known.place;
        }
        let place = find();
        slot.set(Slot { function, place });
        place
    }

    /// What lies at that address is freed.
    pub(crate) fn forget(&self, block: *const c_void) {
        let slot = self.slot(block);
        if slot.get().function == block {
            slot.set(EMPTY);
        }
    }

    pub(crate) fn clear(&self) {
        self.slots.iter().for_each(|slot| slot.set(EMPTY));
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::c_void;

    use super::{FunctionCache, Place};

    #[test]
    fn a_function_is_looked_up_once_until_its_memory_is_freed() {
        let cache = FunctionCache::new();
        let at = |address: usize| address as *const c_void;
        let place = Some(Place { text: 3, function: 1 });
        assert_eq!(cache.place(at(0x1000), || place), place);
        assert_eq!(cache.place(at(0x1000), || unreachable!("it is known")), place);
        cache.forget(at(0x1000 + 16 * 64));
        assert_eq!(cache.place(at(0x1000), || unreachable!("another block of the slot was freed")), place);
        cache.forget(at(0x1000));
        assert_eq!(cache.place(at(0x1000), || None), None);
        assert_eq!(cache.place(at(0x1000), || unreachable!("that it is not counted is known")), None);
    }
}
