//! Values that C passes, and the memory they point to.

use std::ffi::{CStr, c_char, c_void};
use std::ptr;

use super::library::{Callback, CallbackEntry};

/// What C passes for one parameter. `build/plugin.rs` has the same struct in C.
#[repr(C)]
#[derive(Debug)]
pub struct Value {
    /// An integer, a boolean, or how many values are behind the address.
    pub integer: i64,
    /// A number.
    pub number: f64,
    /// Where the values are.
    pub address: Address,
}

/// An address from C. Nothing else makes one, so that it leads to what the row of the called function says, or is null.
#[repr(transparent)]
#[derive(Debug, Clone, Copy)]
pub struct Address(*mut c_void);

/// Numbers that are the same in C and in Rust, and for which all bits are valid.
pub trait Plain: Copy + Default {}

impl Plain for u8 {}
impl Plain for i32 {}
impl Plain for i64 {}
impl Plain for usize {}
impl Plain for f32 {}
impl Plain for f64 {}
impl Plain for Address {}

impl Default for Address {
    fn default() -> Self {
        Self(ptr::null_mut())
    }
}

impl Value {
    /// The values of a call from C, for as long as it lasts.
    pub(super) fn of_call<'a>(values: *mut Self, count: u32) -> &'a mut [Self] {
        if values.is_null() {
            return &mut [];
        }
        // SAFETY: the generated C code passes an array of its own, with so many values, which nothing else uses until the call returns.
        unsafe { std::slice::from_raw_parts_mut(values, count as usize) }
    }
}

impl Address {
    /// Whether it is NULL.
    pub fn is_null(self) -> bool {
        self.0.is_null()
    }

    /// As a number, for tables of addresses.
    pub fn number(self) -> usize {
        self.0.addr()
    }

    /// Copies `count` values; None for a null pointer.
    pub fn read<T: Plain>(self, count: usize) -> Option<Vec<T>> {
        if self.is_null() {
            return None;
        }
        let mut values = vec![T::default(); count];
        // SAFETY: the plugin says that so many values are there. They are copied as bytes: C's arrays may lie anywhere.
        unsafe {
            ptr::copy_nonoverlapping(
                self.0.cast::<u8>(),
                values.as_mut_ptr().cast(),
                size_of_val(&*values),
            );
        };
        Some(values)
    }

    /// Writes values, unless it is a null pointer: plugins pass it for what they do not want.
    pub fn write<T: Plain>(self, values: &[T]) {
        if self.is_null() {
            return;
        }
        // SAFETY: the plugin says that there is room for so many values. Nothing of ours lies there.
        unsafe {
            ptr::copy_nonoverlapping(
                values.as_ptr().cast::<u8>(),
                self.0.cast(),
                size_of_val(values),
            );
        };
    }

    /// A text up to its NUL; None for a null pointer.
    pub fn text(self) -> Option<Vec<u8>> {
        if self.is_null() {
            return None;
        }
        // SAFETY: the row says that this is a text, and C's texts end with NUL.
        Some(
            unsafe { CStr::from_ptr(self.0.cast::<c_char>()) }
                .to_bytes()
                .to_vec(),
        )
    }

    /// Calls a function without parameters, unless it is NULL. An exception out of it ends the process.
    pub fn run(self) {
        if self.is_null() {
            return;
        }
        // SAFETY: the row says that this is a function of that type.
        let function = unsafe { std::mem::transmute::<*mut c_void, extern "C" fn()>(self.0) };
        function();
    }

    /// A function of the plugin; None for a null pointer.
    pub(crate) fn callback(self) -> Option<Callback> {
        if self.is_null() {
            return None;
        }
        // SAFETY: the row says that this is a function of that type. Libraries stay open, so that it stays where it is.
        Some(Callback(unsafe {
            std::mem::transmute::<*mut c_void, CallbackEntry>(self.0)
        }))
    }
}
