//! Forms of meshes that were made before. To decompose a robot's meshes takes seconds, and each start of a simulation, and each copy, needs the same forms.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::{Rc, Weak};

use geometry::Mesh;
use rapier3d_f64::prelude::SharedShape;

/// What is made of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Making {
    /// Its convex hull.
    Hull,
    /// Convex pieces of it.
    Pieces,
    /// Its triangles.
    Surface,
}

/// The mesh, and its form; None where there is none.
type Known = (Weak<Mesh>, Option<SharedShape>);

thread_local! {
    /// By the address of the mesh, which is no other's while it is known here. Simulators of a thread share it.
    static KNOWN: RefCell<HashMap<(*const Mesh, Making), Known>> = RefCell::default();
}

/// The form of a mesh, which is made once while the mesh exists: meshes never change in place.
pub(super) fn form_of(
    mesh: &Rc<Mesh>,
    making: Making,
    make: impl FnOnce() -> Option<SharedShape>,
) -> Option<SharedShape> {
    let key = (Rc::as_ptr(mesh), making);
    let known = KNOWN.with_borrow(|known| known.get(&key).map(|(_, form)| form.clone()));
    known.unwrap_or_else(|| {
        let form = make();
        KNOWN.with_borrow_mut(|known| {
            // Only before it would grow, so that many meshes cost little.
            if known.len() == known.capacity() {
                known.retain(|_, (mesh, _)| mesh.strong_count() > 0);
            }
            known.insert(key, (Rc::downgrade(mesh), form.clone()));
        });
        form
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_form_is_made_once_while_its_mesh_exists() {
        let mesh = Rc::new(Mesh::default());
        let made = std::cell::Cell::new(0);
        let make = || {
            made.set(made.get() + 1);
            Some(SharedShape::ball(1.0))
        };
        for _ in 0..2 {
            assert!(form_of(&mesh, Making::Hull, make).is_some());
        }
        assert_eq!(made.get(), 1);
        let _ = form_of(&mesh, Making::Pieces, make);
        let _ = form_of(&Rc::new(Mesh::default()), Making::Hull, make);
        assert_eq!(made.get(), 3);
        for _ in 0..1000 {
            let _ = form_of(&Rc::new(Mesh::default()), Making::Hull, make);
        }
        assert_eq!(made.get(), 1003);
        let kept = KNOWN.with_borrow(HashMap::len);
        assert!(
            kept < 100,
            "forms of meshes that are gone are dropped: {kept}"
        );
    }
}
