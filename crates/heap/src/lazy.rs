//! Values of the process that are made at their first use.

use std::ops::Deref;
use std::sync::OnceLock;

use super::outside;

/// A static value, made outside of all heaps when it is used first: it outlives the simulator that needs it.
#[derive(Debug)]
pub struct Lazy<T> {
    value: OnceLock<T>,
    make: fn() -> T,
}

impl<T> Lazy<T> {
    /// The value that `make` will make.
    pub const fn new(make: fn() -> T) -> Self {
        Self {
            value: OnceLock::new(),
            make,
        }
    }
}

impl<T> Deref for Lazy<T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.value.get_or_init(|| outside(self.make))
    }
}
