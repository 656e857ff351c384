//! The state of modules: per simulator, and per script.

use std::any::{Any, TypeId};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// One value of each type, made at the first use and dropped with the owner of the store.
#[derive(Default)]
pub struct States(RefCell<BTreeMap<TypeId, Rc<dyn Any>>>);

impl States {
    /// The value of type `T`, which is made if there is none.
    pub fn get<T: Default + 'static>(&self) -> Rc<T> {
        if let Some(state) = self.existing() {
            return state;
        }
        // Nothing is borrowed while `T` is made: it may look here itself.
        let state = Rc::new(T::default());
        self.0.borrow_mut().insert(TypeId::of::<T>(), state.clone());
        state
    }

    /// The value of type `T`, if it was made.
    pub fn existing<T: 'static>(&self) -> Option<Rc<T>> {
        let state = self.0.borrow().get(&TypeId::of::<T>()).cloned()?;
        Some(state.downcast().expect("the key is the type"))
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::rc::Rc;

    use super::States;

    #[derive(Default)]
    struct Count(Cell<u32>);

    #[test]
    fn each_type_has_one_value_for_as_long_as_the_store_lives() {
        let states = States::default();
        assert!(states.existing::<Count>().is_none());
        states.get::<Count>().0.set(3);
        assert_eq!(states.get::<Count>().0.get(), 3);
        let gone = Rc::downgrade(&states.get::<Count>());
        drop(states);
        assert!(gone.upgrade().is_none());
    }
}
