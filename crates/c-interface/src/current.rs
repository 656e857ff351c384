//! Which plugin runs on this thread, and for which simulator.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

use super::buffers::Buffers;
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
    /// Missing functions that were called, and are in the log.
    missing: RefCell<BTreeSet<&'static str>>,
}

/// A call by the simulator into a plugin.
pub(super) struct Frame {
    pub shared: Rc<Shared>,
    pub plugin: Rc<Plugin>,
    pub host: Rc<dyn Host>,
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
pub(super) fn within<T>(frame: Frame, code: impl FnOnce(&Plugin) -> T) -> T {
    let _leave = Leave;
    let plugin = Rc::clone(&frame.plugin);
    FRAMES.with(|frames| frames.borrow_mut().push(Rc::new(frame)));
    plugin.calls.set(plugin.calls.get() + 1);
    let _end = End(&plugin);
    code(&plugin)
}

struct Leave;

impl Drop for Leave {
    fn drop(&mut self) {
        drop(FRAMES.with(|frames| frames.borrow_mut().pop()));
    }
}

struct End<'a>(&'a Plugin);

impl Drop for End<'_> {
    fn drop(&mut self) {
        self.0.calls.set(self.0.calls.get() - 1);
    }
}

impl Frame {
    pub fn note_failure(&self, row: &Symbol, reason: String) {
        if row.is_missing() && self.shared.missing.borrow_mut().insert(row.symbol) {
            self.host.log(
                &self.plugin.name,
                ERRORS,
                &format!("the plugin calls {}: {reason}", row.symbol),
            );
        }
        self.shared
            .last_error
            .replace(Some(format!("{}: {reason}", row.symbol)));
    }

    /// Keeps a result until the plugin releases it; its address, 0 where there is none. `length` becomes the number of its items.
    pub fn keep(&self, ty: char, result: Option<Data>, length: &mut usize) -> i64 {
        let bytes = match (ty, result) {
            ('I', Some(Data::Array(items))) => {
                *length = items.len();
                items
                    .iter()
                    .flat_map(|item| numbers::low_i32(super::dispatch::integer(item)).to_ne_bytes())
                    .collect()
            }
            ('D', Some(Data::Array(items))) => {
                *length = items.len();
                items
                    .iter()
                    .flat_map(|item| item.as_f64().unwrap_or_default().to_ne_bytes())
                    .collect()
            }
            (_, Some(Data::Text(bytes) | Data::Buffer(bytes))) => {
                *length = bytes.len();
                bytes
            }
            _ => {
                *length = 0;
                return 0;
            }
        };
        self.shared.buffers.borrow_mut().add(&bytes)
    }
}

/// Level of log lines about mistakes.
pub(super) const ERRORS: i64 = 200;
/// Level of log lines that a plugin has asked for.
pub(super) const INFOS: i64 = 450;
