//! Which plugin runs on this thread, and for which simulator.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::buffers::Buffers;
use super::ffi::Address;
use super::signature::Symbol;
use super::stacks::Stacks;
use super::{Host, Plugin};
use scene::Data;
use scene::numbers;

/// What the plugins of one simulator have in common.
#[derive(Default)]
pub(super) struct Shared {
    pub stacks: RefCell<Stacks>,
    pub buffers: RefCell<Buffers>,
    /// Why the last call failed.
    pub last_error: RefCell<Option<String>>,
    /// The error that the running callback raises.
    pub raised: RefCell<Option<String>>,
    /// Memory that the caller does not release, by the function that returned it.
    lent: RefCell<BTreeMap<&'static str, i64>>,
    /// Missing functions that were called, and are in the log.
    missing: RefCell<BTreeSet<&'static str>>,
}

/// Who calls the interface, and for which simulator.
pub struct Frame {
    pub(super) shared: Rc<Shared>,
    /// The plugin that the simulator has called; None for a program.
    pub(super) plugin: Option<Rc<Plugin>>,
    pub(super) host: Rc<dyn Host>,
}

thread_local! {
    static FRAMES: RefCell<Vec<Rc<Frame>>> = const { RefCell::new(Vec::new()) };
}

/// The innermost call of this thread.
pub(super) fn current() -> Option<Rc<Frame>> {
    FRAMES
        .try_with(|frames| frames.borrow().last().cloned())
        .ok()
        .flatten()
}

/// Runs code of a plugin.
pub(super) fn within<T>(frame: Frame, code: impl FnOnce() -> T) -> T {
    let _leave = Leave;
    FRAMES.with(|frames| frames.borrow_mut().push(Rc::new(frame)));
    code()
}

struct Leave;

impl Drop for Leave {
    fn drop(&mut self) {
        drop(FRAMES.with(|frames| frames.borrow_mut().pop()));
    }
}

/// Whether calls by this thread have a host.
pub fn has_frame() -> bool {
    current().is_some()
}

/// From now on the calls of a program by this thread go to `host`, until the result is dropped. Memory that was made for the program
/// before, and its last error, remain.
pub fn attach(host: Rc<dyn Host>) -> Attached {
    let before = current();
    let frame = Rc::new(Frame {
        shared: before.map_or_else(Rc::default, |before| Rc::clone(&before.shared)),
        plugin: None,
        host,
    });
    FRAMES.with(|frames| frames.borrow_mut().push(Rc::clone(&frame)));
    Attached(frame)
}

/// The thread of a program that calls the simulator.
pub struct Attached(Rc<Frame>);

impl Drop for Attached {
    fn drop(&mut self) {
        // The values of a thread that ends go in no certain order.
        let _ = FRAMES.try_with(|frames| {
            frames
                .borrow_mut()
                .retain(|frame| !Rc::ptr_eq(frame, &self.0));
        });
    }
}

impl Frame {
    /// The simulator.
    pub fn host(&self) -> &dyn Host {
        &*self.host
    }

    /// What the log calls the caller.
    pub(super) fn origin(&self) -> &str {
        self.plugin
            .as_ref()
            .map_or("library", |plugin| &plugin.name)
    }

    /// The plugin that calls.
    ///
    /// # Errors
    /// When a program calls.
    pub(super) fn plugin(&self) -> Result<&Plugin, String> {
        let plugin = self.plugin.as_deref();
        plugin.ok_or_else(|| "only plugins may call it".to_owned())
    }

    pub(super) fn note_failure(&self, row: &Symbol, reason: String) {
        let caller = self.plugin.as_ref().map_or("program", |_| "plugin");
        if row.is_missing() && self.shared.missing.borrow_mut().insert(row.symbol) {
            self.host.log(
                self.origin(),
                ERRORS,
                &format!("the {caller} calls {}: {reason}", row.symbol),
            );
        }
        self.set_last_error(format!("{}: {reason}", row.symbol));
    }

    /// Keeps a result until the plugin releases it; its address, 0 where there is none. `length` becomes the number of its items.
    pub(super) fn keep(&self, ty: char, result: Option<Data>, length: &mut usize) -> i64 {
        let Some(bytes) = bytes_of(ty, result, length) else {
            return 0;
        };
        self.shared.buffers.borrow_mut().add(&bytes)
    }

    /// The same for a result that a parameter gets: nothing is kept where the caller passes NULL, as it does not want it.
    pub(super) fn keep_at(
        &self,
        place: Address,
        ty: char,
        result: Option<Data>,
        length: &mut usize,
    ) {
        if place.is_null() {
            bytes_of(ty, result, length);
        } else {
            place.write(&[self.keep(ty, result, length)]);
        }
    }

    /// Keeps a list of addresses of texts, with the texts, as one block that the caller releases; its address.
    pub(super) fn keep_texts(&self, texts: &[Vec<u8>]) -> i64 {
        self.shared.buffers.borrow_mut().add_texts(texts)
    }

    /// What `simGetLastError` returns next.
    pub(super) fn set_last_error(&self, reason: String) {
        self.shared.last_error.replace(Some(reason));
    }

    /// Keeps a result until the next call of `symbol`; its address, 0 where there is none.
    pub(super) fn lend(
        &self,
        symbol: &'static str,
        ty: char,
        result: Option<Data>,
        length: &mut usize,
    ) -> i64 {
        let address = self.keep(ty, result, length);
        let before = self.shared.lent.borrow_mut().insert(symbol, address);
        if let Some(before) = before.and_then(|before| usize::try_from(before).ok()) {
            self.shared.buffers.borrow_mut().release(before);
        }
        address
    }
}

/// A result as C finds it in memory; `length` becomes the number of its items.
fn bytes_of(ty: char, result: Option<Data>, length: &mut usize) -> Option<Vec<u8>> {
    let (size, bytes): (usize, Vec<u8>) = match (ty, result) {
        ('I', Some(Data::Array(items))) => {
            let integer = |item| numbers::low_i32(super::dispatch::integer(item)).to_ne_bytes();
            (4, flattened(items.iter().map(integer)))
        }
        ('L', Some(Data::Array(items))) => {
            let integer = |item| super::dispatch::integer(item).to_ne_bytes();
            (8, items.iter().flat_map(integer).collect())
        }
        ('D', Some(Data::Array(items))) => (
            8,
            flattened(items.iter().map(|item| number(item).to_ne_bytes())),
        ),
        ('F', Some(Data::Array(items))) => {
            let single = |item| numbers::single(number(item)).to_ne_bytes();
            (4, flattened(items.iter().map(single)))
        }
        // Packed already.
        ('F', Some(Data::Buffer(bytes))) => (4, bytes),
        (_, Some(Data::Text(bytes) | Data::Buffer(bytes))) => (1, bytes),
        _ => {
            *length = 0;
            return None;
        }
    };
    *length = bytes.len() / size;
    Some(bytes)
}

fn flattened<const N: usize>(numbers: impl Iterator<Item = [u8; N]>) -> Vec<u8> {
    numbers.collect::<Vec<_>>().into_flattened()
}

fn number(item: &Data) -> f64 {
    item.as_f64().unwrap_or_default()
}

/// Level of log lines about mistakes.
pub(super) const ERRORS: i64 = 200;
/// Level of log lines that a plugin has asked for.
pub(super) const INFOS: i64 = 450;
