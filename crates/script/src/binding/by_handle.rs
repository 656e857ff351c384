//! Resources that a script refers to by number.

use std::collections::BTreeMap;

/// Values by handle. Handles count from 1 and are never reused.
pub struct ByHandle<T> {
    last: i64,
    values: BTreeMap<i64, T>,
}

impl<T> Default for ByHandle<T> {
    fn default() -> Self {
        Self {
            last: 0,
            values: BTreeMap::new(),
        }
    }
}

impl<T> ByHandle<T> {
    /// Stores a value and returns its handle.
    pub fn add(&mut self, value: T) -> i64 {
        self.last += 1;
        self.values.insert(self.last, value);
        self.last
    }

    /// The value with that handle, if it was not removed.
    pub fn get_mut(&mut self, handle: i64) -> Option<&mut T> {
        self.values.get_mut(&handle)
    }

    /// The values in the order of their handles.
    pub fn values(&self) -> impl Iterator<Item = &T> {
        self.values.values()
    }

    /// Drops all values; their handles are not reused.
    pub fn clear(&mut self) {
        self.values.clear();
    }

    /// Removes the value with that handle and returns it.
    pub fn remove(&mut self, handle: i64) -> Option<T> {
        self.values.remove(&handle)
    }
}
