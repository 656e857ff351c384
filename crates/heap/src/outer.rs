//! A value of the program around a simulator, which the simulator holds.

use std::mem::ManuallyDrop;

use super::space::Address;
use super::{current, outside};

/// A value that lies outside wherever it is held: it is used and dropped there. Where snapshots may bring back its holder, it stays.
#[derive(Debug)]
pub struct Outer<T>(ManuallyDrop<T>);

impl<T> Outer<T> {
    /// Holds a value that was made outside.
    pub fn new(value: T) -> Self {
        Self(ManuallyDrop::new(value))
    }

    /// Runs `work` on the value, outside. Its result is to have no memory of its own: see [`brought_in`](super::brought_in).
    pub fn with<R>(&self, work: impl FnOnce(&T) -> R) -> R {
        outside(|| work(&self.0))
    }

    /// The value itself, to read where the thread is.
    pub fn get(&self) -> &T {
        &self.0
    }

    /// The same, to change it.
    pub fn with_mut<R>(&mut self, work: impl FnOnce(&mut T) -> R) -> R {
        outside(|| work(&mut self.0))
    }
}

impl<T> Drop for Outer<T> {
    fn drop(&mut self) {
        if current::heap().is_some_and(Address::has_snapshots) {
            return;
        }
        // SAFETY: nobody uses the value after this.
        outside(|| unsafe { ManuallyDrop::drop(&mut self.0) });
    }
}
