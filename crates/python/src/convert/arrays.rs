//! Arrays of numbers from Python: their memory is copied once, by the buffer protocol.
//!
//! The limited API of Python 3.10 has no `PyObject_GetBuffer`; its memoryviews have the same facts.

use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyMemoryView};
use scene::Data;

/// The elements of an array as its method `tolist` has them: a list, of lists if it has several dimensions. None if its memory does not describe them.
///
/// # Errors
/// An unsigned number that no integer of scripts can hold.
pub fn to_list(array: &Bound<'_, PyAny>) -> PyResult<Option<Data>> {
    // Where a masked array has no number its memory has one. Scalars of numpy have memory, but no length.
    if !array.hasattr("__len__")? || array.hasattr("mask")? {
        return Ok(None);
    }
    let Ok(view) = PyMemoryView::from(array) else {
        return Ok(None);
    };
    let shape: Vec<usize> = view.getattr("shape")?.extract()?;
    let format: String = view.getattr("format")?.extract()?;
    let size: usize = view.getattr("itemsize")?.extract()?;
    let Some(element) = Element::of(&format, size).filter(|_| !shape.is_empty()) else {
        return Ok(None);
    };
    // One copy in the order of the indices, whatever the order in memory is.
    let bytes = view.call_method0("tobytes")?;
    let list = element.lists(&shape, bytes.cast::<PyBytes>()?.as_bytes());
    list.map(Some)
        .ok_or_else(|| PyOverflowError::new_err("an integer has at most 64 bits"))
}

/// How an element lies in memory.
#[derive(Clone, Copy)]
struct Element {
    kind: Kind,
    /// Bytes.
    size: usize,
    /// Whether its bytes have the other order than those of this machine.
    is_swapped: bool,
}

#[derive(Clone, Copy)]
enum Kind {
    Bool,
    Signed,
    Unsigned,
    Float,
}

impl Element {
    /// From a format of Python's module `struct`.
    fn of(format: &str, size: usize) -> Option<Self> {
        let (order, letter) = match format.as_bytes() {
            [letter] => (b'@', letter),
            [order, letter] => (*order, letter),
            _ => return None,
        };
        let is_swapped = match order {
            b'@' | b'=' => false,
            b'<' => cfg!(target_endian = "big"),
            b'>' | b'!' => cfg!(target_endian = "little"),
            _ => return None,
        };
        let kind = match letter {
            b'?' => Kind::Bool,
            b'b' | b'h' | b'i' | b'l' | b'q' | b'n' => Kind::Signed,
            b'B' | b'H' | b'I' | b'L' | b'Q' | b'N' => Kind::Unsigned,
            b'f' | b'd' => Kind::Float,
            _ => return None,
        };
        let is_known = match kind {
            Kind::Bool => size == 1,
            Kind::Signed | Kind::Unsigned => matches!(size, 1 | 2 | 4 | 8),
            Kind::Float => matches!(size, 4 | 8),
        };
        is_known.then_some(Self {
            kind,
            size,
            is_swapped,
        })
    }

    /// The elements of an array of that shape, which lie one after the other. None if one is too large.
    fn lists(self, shape: &[usize], bytes: &[u8]) -> Option<Data> {
        let [length, inner @ ..] = shape else {
            return None;
        };
        if inner.is_empty() {
            return self.list(bytes).map(Data::Array);
        }
        let part = inner.iter().product::<usize>() * self.size;
        let parts = (0..*length).map(|at| self.lists(inner, &bytes[at * part..][..part]));
        parts.collect::<Option<_>>().map(Data::Array)
    }

    fn list(self, bytes: &[u8]) -> Option<Vec<Data>> {
        let some = |number: i64| Some(Data::Int(number));
        match (self.kind, self.size) {
            (Kind::Bool, _) => self.each(bytes, |[byte]| Some(Data::Bool(byte != 0))),
            (Kind::Signed, 1) => self.each(bytes, |e| some(i8::from_ne_bytes(e).into())),
            (Kind::Signed, 2) => self.each(bytes, |e| some(i16::from_ne_bytes(e).into())),
            (Kind::Signed, 4) => self.each(bytes, |e| some(i32::from_ne_bytes(e).into())),
            (Kind::Signed, _) => self.each(bytes, |e| some(i64::from_ne_bytes(e))),
            (Kind::Unsigned, 1) => self.each(bytes, |[byte]| some(byte.into())),
            (Kind::Unsigned, 2) => self.each(bytes, |e| some(u16::from_ne_bytes(e).into())),
            (Kind::Unsigned, 4) => self.each(bytes, |e| some(u32::from_ne_bytes(e).into())),
            (Kind::Unsigned, _) => self.each(bytes, |e| {
                let number = i64::try_from(u64::from_ne_bytes(e));
                number.ok().map(Data::Int)
            }),
            (Kind::Float, 4) => {
                self.each(bytes, |e| Some(Data::Float(f32::from_ne_bytes(e).into())))
            }
            (Kind::Float, _) => self.each(bytes, |e| Some(Data::Float(f64::from_ne_bytes(e)))),
        }
    }

    /// Reads elements of N bytes.
    fn each<const N: usize>(
        self,
        bytes: &[u8],
        read: impl Fn([u8; N]) -> Option<Data>,
    ) -> Option<Vec<Data>> {
        let (elements, _) = bytes.as_chunks::<N>();
        let elements = elements.iter().map(|element| {
            let mut element = *element;
            if self.is_swapped {
                element.reverse();
            }
            read(element)
        });
        elements.collect()
    }
}
