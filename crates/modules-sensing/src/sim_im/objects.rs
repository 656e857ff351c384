//! The images of one script, by the handles it has of them.
//!
//! A handle is a text, `<hexadecimal number>:cv.Mat`. The number holds that of the script, so that nobody takes the image of another
//! script for his own.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use imaging::matrix::{Matrix, MatrixResult, Values};

use crate::{ApiError, Cx, Result};

const KIND: &str = "cv.Mat";
/// Handles of one script.
const NUMBERS_PER_SCRIPT: u64 = 1 << 32;
/// Bytes of all images of a script.
const MAX_BYTES: usize = 2 << 30;

/// Images of a script. They are dropped with the script's state.
#[derive(Default)]
pub(super) struct Images {
    images: RefCell<BTreeMap<u64, Rc<Matrix>>>,
    bytes: Cell<usize>,
    last: Cell<u64>,
}

pub(super) fn images(cx: &Cx) -> Rc<Images> {
    cx.script_state()
}

fn invalid() -> ApiError {
    ApiError::Other("invalid object handle".into())
}

fn number(handle: &str) -> Result<u64> {
    let (digits, kind) = handle.split_once(':').ok_or_else(invalid)?;
    u64::from_str_radix(digits, 16)
        .ok()
        .filter(|_| kind == KIND)
        .ok_or_else(invalid)
}

fn byte_count(image: &Matrix) -> usize {
    match image.values() {
        Values::Bytes(values) => values.len(),
        Values::Floats(values) => values.len() * 4,
    }
}

impl Images {
    /// # Errors
    /// When there is no such image.
    pub(super) fn get(&self, handle: &str) -> Result<Rc<Matrix>> {
        self.images
            .borrow()
            .get(&number(handle)?)
            .cloned()
            .ok_or_else(invalid)
    }

    /// # Errors
    /// When the images of the script take too much memory.
    pub(super) fn add(&self, cx: &Cx, image: Matrix) -> Result<String> {
        self.last.set(self.last.get() + 1);
        let number = cx.script().id.unsigned_abs() * NUMBERS_PER_SCRIPT + self.last.get();
        self.insert(number, image)?;
        Ok(format!("{number:x}:{KIND}"))
    }

    /// # Errors
    /// When there is no such image, or the images of the script take too much memory.
    pub(super) fn replace(&self, handle: &str, image: Matrix) -> Result<()> {
        self.get(handle)?;
        self.insert(number(handle)?, image)
    }

    fn insert(&self, number: u64, image: Matrix) -> Result<()> {
        let mut images = self.images.borrow_mut();
        let old = images.get(&number).map_or(0, |image| byte_count(image));
        let bytes = self.bytes.get() - old + byte_count(&image);
        if bytes > MAX_BYTES {
            return Err(ApiError::Other(
                "the images of a script take 2 GiB at most: destroy some.".into(),
            ));
        }
        self.bytes.set(bytes);
        images.insert(number, Rc::new(image));
        Ok(())
    }

    /// # Errors
    /// When there is no such image.
    pub(super) fn remove(&self, handle: &str) -> Result<()> {
        let image = self
            .images
            .borrow_mut()
            .remove(&number(handle)?)
            .ok_or_else(invalid)?;
        self.bytes.set(self.bytes.get() - byte_count(&image));
        Ok(())
    }

    /// Changes an image.
    ///
    /// # Errors
    /// When there is no such image, and those of `change`.
    pub(super) fn modify<T>(
        &self,
        handle: &str,
        change: impl FnOnce(&mut Matrix) -> T,
    ) -> Result<T> {
        let mut images = self.images.borrow_mut();
        let image = images.get_mut(&number(handle)?).ok_or_else(invalid)?;
        Ok(change(Rc::make_mut(image)))
    }
}

/// The handle of a result: a new image, or the image `handle` changed.
pub(super) fn finish(
    cx: &Cx,
    handle: String,
    result: MatrixResult<Matrix>,
    in_place: bool,
) -> Result<String> {
    let images = images(cx);
    if !in_place {
        return images.add(cx, result?);
    }
    images.replace(&handle, result?)?;
    Ok(handle)
}

/// An operation on an image.
pub(super) fn unary(
    cx: &Cx,
    handle: String,
    in_place: bool,
    operation: impl FnOnce(&Matrix) -> MatrixResult<Matrix>,
) -> Result<String> {
    let image = images(cx).get(&handle)?;
    finish(cx, handle, operation(&image), in_place)
}

/// An operation on two images.
pub(super) fn binary(
    cx: &Cx,
    handle_1: String,
    handle_2: &str,
    in_place: bool,
    operation: impl FnOnce(&Matrix, &Matrix) -> MatrixResult<Matrix>,
) -> Result<String> {
    let images = images(cx);
    let (first, second) = (images.get(&handle_1)?, images.get(handle_2)?);
    finish(cx, handle_1, operation(&first, &second), in_place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_handle_is_a_number_and_a_kind() {
        assert_eq!(number("1f:cv.Mat"), Ok(31));
        for bad in [
            "",
            ":",
            "cv.Mat",
            "1",
            "1:zmq.msg",
            "x:cv.Mat",
            "-1:cv.Mat",
            "1:cv.Mat:",
        ] {
            assert_eq!(number(bad), Err(invalid()), "{bad}");
        }
    }
}
