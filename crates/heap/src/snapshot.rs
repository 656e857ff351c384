//! Snapshots of a heap.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use super::image::Image;
use super::region::Region;
use super::resource::open_in;
use super::space::Address;
use super::{Handle, Heap, outside};

/// All that a heap held at a moment. Unchanged pages are shared with other snapshots of the heap.
#[derive(Debug)]
pub struct Snapshot {
    heap: Address,
    /// Which of the heaps at that place.
    number: u64,
    images: Arc<[Image; 2]>,
}

/// Why there is no snapshot, or why one cannot be brought back.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RestoreError {
    /// Something is open that is no memory.
    Open(Vec<String>),
    /// The snapshot is of another heap.
    OtherHeap,
    /// A call is inside of the heap, or waits for what it has called outside.
    Inside,
}

impl std::fmt::Display for RestoreError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Open(names) => write!(
                f,
                "a snapshot does not reach {}: close it first",
                names.join(", ")
            ),
            Self::OtherHeap => f.write_str("the snapshot is of another simulator"),
            Self::Inside => f.write_str("the simulator is at work"),
        }
    }
}

impl std::error::Error for RestoreError {}

impl Heap {
    /// Copies what the heap holds.
    ///
    /// # Errors
    /// When something is open that is no memory, or a call is inside.
    pub fn snapshot(&self) -> Result<Snapshot, RestoreError> {
        self.check()?;
        let last = self.last.borrow().clone();
        let of = |at: usize, region: *mut Region| {
            // SAFETY: the owner's thread is here and not inside; those that work for it are not either.
            unsafe {
                (*region).take_returned();
                Image::of(region, last.as_deref().map(|images| &images[at]))
            }
        };
        let [general, scripts] = self.slot.regions();
        let images = Arc::new([of(0, general), of(1, scripts)]);
        self.last.replace(Some(Arc::clone(&images)));
        let heap = self.slot.address();
        heap.snapshots().fetch_add(1, Ordering::Relaxed);
        Ok(Snapshot {
            heap,
            number: self.number,
            images,
        })
    }

    /// Brings back what the heap held: everything that came after is gone, without its destructors.
    ///
    /// # Errors
    /// When something is open that is no memory, a call is inside, or the snapshot is of another heap.
    ///
    /// # Safety
    /// Nothing outside refers to memory that the heap got after the snapshot, and nothing that the heap held then and that lies outside is gone.
    pub unsafe fn restore(&self, snapshot: &Snapshot) -> Result<(), RestoreError> {
        self.check()?;
        if snapshot.number != self.number {
            return Err(RestoreError::OtherHeap);
        }
        for (region, image) in self.slot.regions().into_iter().zip(&*snapshot.images) {
            // SAFETY: the caller's promise; nobody is inside.
            unsafe { image.restore(region) };
        }
        self.last.replace(Some(Arc::clone(&snapshot.images)));
        Ok(())
    }

    fn check(&self) -> Result<(), RestoreError> {
        let open = open_in(self.slot.address());
        if !open.is_empty() {
            return Err(RestoreError::Open(open));
        }
        let calls = self.slot.address().calls();
        (calls.load(Ordering::Relaxed) == 0)
            .then_some(())
            .ok_or(RestoreError::Inside)
    }
}

impl Snapshot {
    /// Bytes that only this snapshot holds.
    pub fn own_bytes(&self) -> usize {
        self.images.iter().map(Image::own_bytes).sum()
    }
}

/// What a heap held in the midst of code that runs inside, and which stands still meanwhile.
#[derive(Debug)]
pub struct Moment {
    heap: Address,
    images: [Image; 2],
}

impl Handle {
    /// Copies what the heap holds, in the midst of code that runs inside.
    pub fn moment(self) -> Moment {
        outside(|| {
            let of = |region: *mut Region| {
                // SAFETY: the owner's thread is here, and allocates outside; those that work for it are not inside.
                unsafe {
                    (*region).take_returned();
                    Image::of(region, None)
                }
            };
            let heap = self.address;
            let images = [of(heap.general()), of(heap.scripts())];
            heap.snapshots().fetch_add(1, Ordering::Relaxed);
            Moment { heap, images }
        })
    }
}

impl Moment {
    /// Brings back what the heap held; as often as wanted.
    ///
    /// # Safety
    /// The code that ran when it was made has stood still since, and nothing refers to what the heap has got since.
    pub unsafe fn bring_back(&self) {
        let regions = [self.heap.general(), self.heap.scripts()];
        for (region, image) in regions.into_iter().zip(&self.images) {
            // SAFETY: the caller's promise.
            unsafe { image.restore(region) };
        }
    }
}

impl Drop for Moment {
    fn drop(&mut self) {
        self.heap.snapshots().fetch_sub(1, Ordering::Relaxed);
    }
}

impl Drop for Snapshot {
    fn drop(&mut self) {
        self.heap.snapshots().fetch_sub(1, Ordering::Relaxed);
    }
}
