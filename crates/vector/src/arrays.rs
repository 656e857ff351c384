//! Numbers that worlds write and read in place, and the program too.
//!
//! The program (numpy) sees the memory itself, at any time. So the numbers are atomics, which are read and written without order:
//! the order comes from the calls of [`Vector`](crate::Vector).

use std::sync::atomic::{AtomicU8, AtomicU64, Ordering::Relaxed};

/// A number that lies in an array.
pub trait Item: Copy {
    /// What holds it.
    type Cell: Send + Sync;
    /// A cell with the number.
    fn cell(self) -> Self::Cell;
    /// Reads a cell.
    fn get(cell: &Self::Cell) -> Self;
    /// Writes a cell.
    fn set(self, cell: &Self::Cell);
}

impl Item for f64 {
    type Cell = AtomicU64;

    fn cell(self) -> AtomicU64 {
        AtomicU64::new(self.to_bits())
    }

    fn get(cell: &AtomicU64) -> Self {
        Self::from_bits(cell.load(Relaxed))
    }

    fn set(self, cell: &AtomicU64) {
        cell.store(self.to_bits(), Relaxed);
    }
}

impl Item for u8 {
    type Cell = AtomicU8;

    fn cell(self) -> AtomicU8 {
        AtomicU8::new(self)
    }

    fn get(cell: &AtomicU8) -> Self {
        cell.load(Relaxed)
    }

    fn set(self, cell: &AtomicU8) {
        cell.store(self, Relaxed);
    }
}

/// A row of numbers for each world.
#[derive(Debug)]
pub struct Array<T: Item> {
    cells: Box<[T::Cell]>,
    width: usize,
}

impl<T: Item> Array<T> {
    /// `count` rows of `width` numbers.
    pub fn new(count: usize, width: usize, value: T) -> Self {
        Self {
            cells: (0..count * width).map(|_| value.cell()).collect(),
            width,
        }
    }

    /// Numbers of a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Where the numbers lie: an address that stays as long as the array.
    pub fn address(&self) -> usize {
        self.cells.as_ptr().expose_provenance()
    }

    /// The row of a world.
    pub fn row(&self, world: usize) -> &[T::Cell] {
        &self.cells[world * self.width..(world + 1) * self.width]
    }

    /// The first number of a row.
    pub fn get(&self, world: usize) -> T {
        T::get(&self.row(world)[0])
    }

    /// Writes the first number of a row.
    pub fn set(&self, world: usize, value: T) {
        value.set(&self.row(world)[0]);
    }

    /// Reads a row.
    pub fn read(&self, world: usize) -> Vec<T> {
        self.row(world).iter().map(T::get).collect()
    }

    /// Writes a row.
    pub fn write(&self, world: usize, values: &[T]) {
        for (cell, value) in self.row(world).iter().zip(values) {
            value.set(cell);
        }
    }
}

/// All arrays of an environment: a row for each world.
#[derive(Debug)]
pub struct Arrays {
    /// Written by the program before a step.
    pub actions: Array<f64>,
    /// What is observed.
    pub observations: Array<f64>,
    /// What is read beside the observations.
    pub infos: Array<f64>,
    /// One number each.
    pub rewards: Array<f64>,
    /// 1 where the episode has come to its end.
    pub terminated: Array<u8>,
    /// 1 where the episode has had all its steps.
    pub truncated: Array<u8>,
    /// Written by the program: 1 for worlds whose next step begins an episode instead.
    pub resets: Array<u8>,
    /// 1 where the world has failed: its other numbers mean nothing until its next episode.
    pub failed: Array<u8>,
    /// Pixels of each camera: red, green, blue, the highest row first.
    pub images: Vec<Array<u8>>,
}
