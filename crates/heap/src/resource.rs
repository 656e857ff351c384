//! What a simulator has open that is no memory: threads, sockets, files. No snapshot reaches it.

use std::collections::BTreeMap;
use std::sync::Mutex;

use super::current;
use super::outside;
use super::space::Address;

/// Something open; it is named in errors until it is dropped.
#[derive(Debug)]
pub struct Resource {
    entry: Option<(usize, u64)>,
}

type Names = BTreeMap<(usize, u64), String>;

static OPEN: Mutex<(u64, Names)> = Mutex::new((0, Names::new()));

impl Resource {
    /// Something that the simulator whose heap this thread is inside of has opened, by a name for users such as `the socket tcp://*:5555`.
    pub fn new(name: impl FnOnce() -> String) -> Self {
        let entry = current::heap().and_then(|heap| {
            outside(|| {
                let mut open = OPEN.lock().ok()?;
                open.0 += 1;
                let entry = (heap.general().addr(), open.0);
                open.1.insert(entry, name());
                Some(entry)
            })
        });
        Self { entry }
    }
}

impl Drop for Resource {
    fn drop(&mut self) {
        if let (Some(entry), Ok(mut open)) = (self.entry, OPEN.lock()) {
            outside(|| drop(open.1.remove(&entry)));
        }
    }
}

impl super::Handle {
    /// What the simulator of the heap has open, by names for users.
    pub fn open_resources(self) -> Vec<String> {
        outside(|| open_in(self.address))
    }
}

/// What the simulator of a heap has open.
pub(super) fn open_in(heap: Address) -> Vec<String> {
    let at = heap.general().addr();
    let open = OPEN
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    let range = (at, 0)..(at + 1, 0);
    open.1.range(range).map(|(_, name)| name.clone()).collect()
}
