//! What scripts have a handle of at a node of ROS: publishers, subscriptions, services. It ends with its script. The same for both generations.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::{Rc, Weak};

use super::{ApiError, Cx, Result};

/// The entities of a node, in the order of their creation.
pub(super) struct Entities<E> {
    by_number: RefCell<BTreeMap<u64, E>>,
    count: Cell<u64>,
}

/// What a script has made: it ends with the script.
struct Owned<E>(RefCell<Vec<Ownership<E>>>);

struct Ownership<E> {
    entities: Weak<Entities<E>>,
    number: u64,
}

impl<E> Default for Entities<E> {
    fn default() -> Self {
        Self {
            by_number: RefCell::default(),
            count: Cell::default(),
        }
    }
}

impl<E> Default for Owned<E> {
    fn default() -> Self {
        Self(RefCell::default())
    }
}

impl<E> Drop for Ownership<E> {
    fn drop(&mut self) {
        if let Some(entities) = self.entities.upgrade() {
            entities.remove(self.number);
        }
    }
}

impl<E> Entities<E> {
    fn remove(&self, number: u64) {
        // Nothing is borrowed while it ends and its callback is released.
        let removed = self.by_number.borrow_mut().remove(&number);
        drop(removed);
    }
}

impl<E: Clone + 'static> Entities<E> {
    /// Adds something of the calling script. Returns its handle.
    pub(super) fn add(self: &Rc<Self>, cx: &Cx, entity: E) -> String {
        let number = self.count.get() + 1;
        self.count.set(number);
        self.by_number.borrow_mut().insert(number, entity);
        let owned = cx.script_state::<Owned<E>>();
        let mut owned = owned.0.borrow_mut();
        owned.retain(|other| self.by_number.borrow().contains_key(&other.number));
        owned.push(Ownership {
            entities: Rc::downgrade(self),
            number,
        });
        format!("{number:x}:ptr")
    }

    /// What a handle stands for, if it is of the kind that `choose` accepts.
    ///
    /// # Errors
    /// When it is not.
    pub(super) fn get<T>(&self, handle: &str, choose: impl Fn(E) -> Option<T>) -> Result<T> {
        Ok(self.find(handle, choose)?.1)
    }

    /// Ends what a handle stands for, if it is of the kind that `choose` accepts.
    ///
    /// # Errors
    /// When it is not.
    pub(super) fn shut_down<T>(&self, handle: &str, choose: impl Fn(E) -> Option<T>) -> Result<()> {
        self.remove(self.find(handle, choose)?.0);
        Ok(())
    }

    fn find<T>(&self, handle: &str, choose: impl Fn(E) -> Option<T>) -> Result<(u64, T)> {
        let entity = |number| self.by_number.borrow().get(&number).cloned();
        let found = number_of(handle).and_then(|number| Some((number, choose(entity(number)?)?)));
        found.ok_or_else(|| ApiError::Other("invalid object handle".into()))
    }

    /// Visits what there is now in the order of creation. A visit may end others, and add some, which are not visited.
    pub(super) fn for_each(&self, mut visit: impl FnMut(E)) {
        let numbers: Vec<u64> = self.by_number.borrow().keys().copied().collect();
        for number in numbers {
            let entity = self.by_number.borrow().get(&number).cloned();
            entity.into_iter().for_each(&mut visit);
        }
    }
}

fn number_of(handle: &str) -> Option<u64> {
    let digits = handle.strip_suffix(":ptr")?;
    u64::from_str_radix(digits, 16)
        .ok()
        .filter(|number| format!("{number:x}") == digits)
}
