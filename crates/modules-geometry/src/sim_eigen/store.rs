//! The matrices and quaternions of one script, by the handles it has of them.
//!
//! A handle is a text, `<hexadecimal number>:<kind>`. The number holds that of the script, so that nobody takes the matrix of another script for his own.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use nalgebra::{DMatrix, Quaternion};

use crate::{ApiError, Args, Cx, FromScript, Result};
use scene::Data;
use script::{Source, Table};

/// Handles of one script.
const NUMBERS_PER_SCRIPT: u64 = 1 << 32;
/// Numbers in all matrices of a script: 512 MiB.
const MAX_NUMBERS: usize = 1 << 26;

/// A kind of things with handles.
pub(super) trait Stored: Clone {
    const KIND: &'static str;

    /// How many numbers it holds.
    fn size(&self) -> usize;

    fn table(store: &Store) -> &RefCell<BTreeMap<u64, Rc<Self>>>;
}

impl Stored for DMatrix<f64> {
    const KIND: &'static str = "Matrix";

    fn size(&self) -> usize {
        self.len()
    }

    fn table(store: &Store) -> &RefCell<BTreeMap<u64, Rc<Self>>> {
        &store.matrices
    }
}

impl Stored for Quaternion<f64> {
    const KIND: &'static str = "Quaternion";

    fn size(&self) -> usize {
        4
    }

    fn table(store: &Store) -> &RefCell<BTreeMap<u64, Rc<Self>>> {
        &store.quaternions
    }
}

/// What a script has made and not destroyed. It ends with the script's state.
#[derive(Default)]
pub(super) struct Store {
    matrices: RefCell<BTreeMap<u64, Rc<DMatrix<f64>>>>,
    quaternions: RefCell<BTreeMap<u64, Rc<Quaternion<f64>>>>,
    numbers: Cell<usize>,
    last: Cell<u64>,
}

pub(super) fn refused(why: &str) -> ApiError {
    ApiError::Other(why.into())
}

fn number<T: Stored>(handle: &str) -> Result<u64> {
    let number = handle
        .split_once(':')
        .filter(|(_, kind)| *kind == T::KIND)
        .map(|(digits, _)| digits);
    number
        .and_then(|digits| u64::from_str_radix(digits, 16).ok())
        .ok_or_else(|| refused("invalid object handle"))
}

fn store(cx: &Cx) -> Rc<Store> {
    cx.script_state()
}

/// # Errors
/// When there is none with that handle.
pub(super) fn get<T: Stored>(cx: &Cx, handle: &str) -> Result<Rc<T>> {
    let number = number::<T>(handle)?;
    T::table(&store(cx))
        .borrow()
        .get(&number)
        .cloned()
        .ok_or_else(|| refused("invalid object handle"))
}

/// Checked before something large is made.
///
/// # Errors
/// When the matrices of the script take too much memory.
pub(super) fn check_size(cx: &Cx, numbers: usize) -> Result<()> {
    let all = store(cx).numbers.get().saturating_add(numbers);
    if all > MAX_NUMBERS {
        Err(refused(
            "the matrices of a script take 512 MiB at most: destroy some.",
        ))
    } else {
        Ok(())
    }
}

/// Keeps it; returns its handle.
///
/// # Errors
/// When the matrices of the script take too much memory.
pub(super) fn add<T: Stored>(cx: &Cx, item: T) -> Result<String> {
    check_size(cx, item.size())?;
    let store = store(cx);
    store.numbers.set(store.numbers.get() + item.size());
    store.last.set(store.last.get() + 1);
    let number = cx.script().id.unsigned_abs() * NUMBERS_PER_SCRIPT + store.last.get();
    T::table(&store).borrow_mut().insert(number, Rc::new(item));
    Ok(format!("{number:x}:{}", T::KIND))
}

/// # Errors
/// When there is none with that handle, or the matrices of the script take too much memory.
pub(super) fn replace<T: Stored>(cx: &Cx, handle: &str, item: T) -> Result<()> {
    let old = get::<T>(cx, handle)?.size();
    check_size(cx, item.size().saturating_sub(old))?;
    let store = store(cx);
    store.numbers.set(store.numbers.get() - old + item.size());
    T::table(&store)
        .borrow_mut()
        .insert(number::<T>(handle)?, Rc::new(item));
    Ok(())
}

/// # Errors
/// When there is none with that handle.
pub(super) fn remove<T: Stored>(cx: &Cx, handle: &str) -> Result<()> {
    let size = get::<T>(cx, handle)?.size();
    let store = store(cx);
    store.numbers.set(store.numbers.get() - size);
    T::table(&store).borrow_mut().remove(&number::<T>(handle)?);
    Ok(())
}

/// Changes it without copying it.
///
/// # Errors
/// When there is none with that handle, and those of `change`.
pub(super) fn modify<T: Stored>(
    cx: &Cx,
    handle: &str,
    change: impl FnOnce(&mut T) -> Result<()>,
) -> Result<()> {
    let store = store(cx);
    let mut table = T::table(&store).borrow_mut();
    let item = table
        .get_mut(&number::<T>(handle)?)
        .ok_or_else(|| refused("invalid object handle"))?;
    change(Rc::make_mut(item))
}

/// The result in place of what it was made from, without a handle; or a new one with its handle.
///
/// # Errors
/// Those of [`replace`] and [`add`].
pub(super) fn finish<T: Stored>(
    cx: &Cx,
    handle: &str,
    result: T,
    in_place: bool,
) -> Result<Option<String>> {
    if in_place {
        return replace(cx, handle, result).map(|()| None);
    }
    add(cx, result).map(Some)
}

/// Handles of matrices.
#[derive(Debug, Clone)]
pub(super) struct HandleList(pub Vec<String>);

impl FromScript for HandleList {
    const TYPE: &'static str = "string[]";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        let Table(Data::Array(items)) = Table::from_script(args)? else {
            return Ok(Self(Vec::new()));
        };
        let text = |item: Data| match item {
            Data::Text(bytes) => Ok(String::from_utf8_lossy(&bytes).into_owned()),
            _ => Err(ApiError::NotA {
                position: -1,
                expected: "string",
            }),
        };
        items.into_iter().map(text).collect::<Result<_>>().map(Self)
    }
}
