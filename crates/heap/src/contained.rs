//! A value that lies in a heap of its own.

use std::mem::ManuallyDrop;
use std::ops::Deref;

use super::{Entered, Heap};

/// A value and the heap it lies in; without one, where there are none, it lies in the system's memory.
#[derive(Debug)]
pub struct Contained<T> {
    value: ManuallyDrop<T>,
    heap: Option<Heap>,
}

impl<T> Contained<T> {
    /// What `make` makes, inside of a new heap.
    pub fn new(make: impl FnOnce() -> T) -> Self {
        let heap = Heap::new();
        let value = match &heap {
            Some(heap) => heap.enter(make),
            None => make(),
        };
        Self {
            value: ManuallyDrop::new(value),
            heap,
        }
    }

    /// The heap, if there is one.
    pub fn heap(&self) -> Option<&Heap> {
        self.heap.as_ref()
    }

    /// Inside of the heap until the result is dropped.
    pub fn entered(&self) -> Option<Entered> {
        self.heap.as_ref().map(Heap::entered)
    }

    /// The end of the value begins: no snapshot of it is brought back any more.
    pub fn end(&self) {
        if let Some(heap) = &self.heap {
            heap.end();
        }
    }

    /// What `work` makes of the value inside, copied out.
    pub fn copied<R: Clone>(&self, work: impl FnOnce(&T) -> R) -> R {
        match &self.heap {
            Some(heap) => heap.enter_and_copy(|| work(&self.value)),
            None => work(&self.value),
        }
    }
}

impl<T> Deref for Contained<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T> Drop for Contained<T> {
    fn drop(&mut self) {
        self.end();
        let _entered = self.entered();
        // SAFETY: nobody uses the value after this.
        unsafe { ManuallyDrop::drop(&mut self.value) };
    }
}
