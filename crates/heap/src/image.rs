//! The bytes of a region at a moment, page by page; pages that did not change are shared between images.

use std::sync::{Arc, LazyLock};

use super::region::Region;

pub(super) const PAGE: usize = 4096;

type Page = [u8; PAGE];

/// The page of zeros, which images of all heaps share: most of a small heap has never been used. To compare it with memory that has never been written costs next to
/// nothing, since the system has one page for all of that too.
static ZEROS: LazyLock<Arc<Page>> = LazyLock::new(|| Arc::new([0; PAGE]));

/// What a region held.
#[derive(Debug)]
pub(super) struct Image {
    pages: Vec<Arc<Page>>,
}

impl Image {
    /// The bytes of a region now. Pages that are as in `last` are taken from there.
    ///
    /// # Safety
    /// The region is established, and nobody is inside.
    pub(super) unsafe fn of(region: *const Region, last: Option<&Self>) -> Self {
        // SAFETY: as promised.
        let count = unsafe { (*region).len() } / PAGE;
        let pages = (0..count).map(|at| {
            // SAFETY: the region is usable up to its length.
            let page = unsafe { &*region.cast::<Page>().add(at) };
            match last.and_then(|last| last.pages.get(at)) {
                Some(known) if **known == *page => Arc::clone(known),
                _ if *page == **ZEROS => Arc::clone(&ZEROS),
                _ => Arc::new(*page),
            }
        });
        Self {
            pages: pages.collect(),
        }
    }

    /// Writes the bytes back: only pages that differ.
    ///
    /// # Safety
    /// As `of`; nothing refers to what the region holds now but not then.
    pub(super) unsafe fn restore(&self, region: *mut Region) {
        for (at, page) in self.pages.iter().enumerate() {
            // SAFETY: a region never becomes shorter, so all of it is usable.
            unsafe {
                let there = region.cast::<Page>().add(at);
                if *there != **page {
                    there.write(**page);
                }
            }
        }
    }

    /// How many bytes only this image holds.
    pub(super) fn own_bytes(&self) -> usize {
        let own = self
            .pages
            .iter()
            .filter(|page| Arc::strong_count(page) == 1);
        own.count() * PAGE
    }
}
