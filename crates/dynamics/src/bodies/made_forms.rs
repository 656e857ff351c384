//! Forms of meshes that were made before. To decompose a robot's meshes takes seconds, and each start of a simulation, and each copy, needs the same forms.

use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::{Rc, Weak};
use std::sync::Arc;

use file_cache::Key;
use geometry::Mesh;
use heap::outside;
use rapier3d_f64::prelude::SharedShape;

use super::form_maker::{FormMaker, Making};
use super::pieces;

/// Largest number of meshes whose pieces are kept for equal ones, such as those of a robot that is loaded again.
const MAX_RECENT: usize = 128;

/// The mesh, and its form; None where there is none.
type Known = (Weak<Mesh>, Option<SharedShape>);

thread_local! {
    /// The pieces of the last meshes, which may be gone, by their content. Simulators of a thread share it, so it lies outside of their memory.
    static RECENT: RefCell<Recent> = RefCell::default();
}

/// What is to be made of a mesh, and on what that depends where others may have made it.
struct Wanted<'a> {
    mesh: &'a Rc<Mesh>,
    making: Making,
    key: Option<Key>,
}

/// The forms of the meshes of a simulator.
#[derive(Default)]
pub(crate) struct Forms {
    maker: FormMaker,
    /// By the address of the mesh, which is no other's while it is known here.
    known: HashMap<(*const Mesh, Making), Known>,
}

impl Forms {
    pub(crate) fn new(maker: FormMaker) -> Self {
        Self {
            maker,
            known: HashMap::new(),
        }
    }

    /// The form of a mesh that was made; None where there is none.
    pub(super) fn form_of(&self, mesh: &Rc<Mesh>, making: Making) -> Option<SharedShape> {
        self.known.get(&(Rc::as_ptr(mesh), making))?.1.clone()
    }

    /// Makes the forms of meshes, each once while the mesh exists: meshes never change in place.
    pub(super) fn make_all<'a>(&mut self, meshes: impl Iterator<Item = (&'a Rc<Mesh>, Making)>) {
        let wanted = self.unknown(meshes);
        let mut keys = HashSet::new();
        let is_missing = |wanted: &&Wanted| {
            let is_recent = |key| RECENT.with_borrow(|recent| recent.forms.contains_key(&key));
            wanted
                .key
                .is_none_or(|key| !is_recent(key) && keys.insert(key))
        };
        let missing: Vec<_> = wanted.iter().filter(is_missing).collect();
        let order: Vec<_> = missing
            .iter()
            .map(|wanted| (&**wanted.mesh, wanted.making, wanted.key))
            .collect();
        for (wanted, form) in missing.into_iter().zip(self.maker.make(&order)) {
            if let Some(key) = wanted.key {
                keep_recent(key, form.as_ref());
            }
            self.remember(wanted.mesh, wanted.making, form);
        }
        for Wanted { mesh, making, key } in &wanted {
            let is_made = self.known.contains_key(&(Rc::as_ptr(mesh), *making));
            if let Some(key) = key.as_ref().filter(|_| !is_made) {
                self.remember(mesh, *making, recent(key));
            }
        }
        RECENT.with_borrow_mut(|recent| outside(|| recent.drop_oldest()));
    }

    /// What was not made yet, each once.
    fn unknown<'a>(&self, meshes: impl Iterator<Item = (&'a Rc<Mesh>, Making)>) -> Vec<Wanted<'a>> {
        let mut seen = HashSet::new();
        meshes
            .filter(|&(mesh, making)| {
                let place = (Rc::as_ptr(mesh), making);
                !self.known.contains_key(&place) && seen.insert(place)
            })
            .map(|(mesh, making)| Wanted {
                mesh,
                making,
                key: (making == Making::Pieces).then(|| pieces::key(mesh)),
            })
            .collect()
    }

    fn remember(&mut self, mesh: &Rc<Mesh>, making: Making, form: Option<SharedShape>) {
        // Only before it would grow, so that many meshes cost little.
        if self.known.len() == self.known.capacity() {
            self.known.retain(|_, (mesh, _)| mesh.strong_count() > 0);
        }
        let known = (Rc::downgrade(mesh), form);
        self.known.insert((Rc::as_ptr(mesh), making), known);
    }
}

/// Keeps a copy of a form for other simulators.
fn keep_recent(key: Key, form: Option<&SharedShape>) {
    RECENT.with_borrow_mut(|recent| outside(|| recent.add(key, form.map(copied))));
}

/// A copy of a form that was kept.
fn recent(key: &Key) -> Option<SharedShape> {
    RECENT.with_borrow_mut(|recent| recent.get(key).map(copied))
}

/// The same form, with nothing in common with the first one.
fn copied(form: &SharedShape) -> SharedShape {
    let Some(parts) = form.as_compound() else {
        return SharedShape(Arc::from(form.clone_dyn()));
    };
    let parts = parts.shapes().iter();
    SharedShape::compound(parts.map(|(pose, part)| (*pose, copied(part))).collect())
}

/// Forms by what they depend on.
#[derive(Default)]
struct Recent {
    /// With the number of its last use.
    forms: BTreeMap<Key, (u64, Option<SharedShape>)>,
    uses: u64,
}

impl Recent {
    fn add(&mut self, key: Key, form: Option<SharedShape>) {
        self.forms.insert(key, (self.uses, form));
    }

    fn get(&mut self, key: &Key) -> Option<&SharedShape> {
        self.uses += 1;
        let (last, form) = self.forms.get_mut(key)?;
        *last = self.uses;
        form.as_ref()
    }

    /// Drops those whose last use is longest ago.
    fn drop_oldest(&mut self) {
        let mut uses: Vec<_> = self.forms.values().map(|(last, _)| *last).collect();
        if let Some(surplus) = uses.len().checked_sub(MAX_RECENT + 1) {
            let (_, &mut last, _) = uses.select_nth_unstable(surplus);
            self.forms.retain(|_, (used, _)| *used > last);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block with a notch, `size` metres long.
    fn notched(size: f64) -> Rc<Mesh> {
        use geometry::PrimitiveKind::Cuboid;
        use geometry::primitive::tessellate;
        let block = |size| tessellate(Cuboid, size, false).expect("its extents are finite");
        let mut mesh = block([size, 0.2, 0.2]);
        mesh.append(
            &block([0.2, 1.0, 0.2]),
            &geometry::Pose::translation(0.0, 0.6, 0.0),
        );
        Rc::new(mesh)
    }

    fn make(forms: &mut Forms, mesh: &Rc<Mesh>, making: Making) -> Option<SharedShape> {
        forms.make_all([(mesh, making)].into_iter());
        forms.form_of(mesh, making)
    }

    fn is_same(first: Option<&SharedShape>, second: Option<&SharedShape>) -> bool {
        let both = first.zip(second);
        both.is_some_and(|(first, second)| Arc::ptr_eq(&first.0, &second.0))
    }

    #[test]
    fn a_form_is_made_once_while_its_mesh_exists() {
        let (mesh, mut forms) = (notched(1.0), Forms::default());
        let hull = make(&mut forms, &mesh, Making::Hull);
        let mut is_again =
            |mesh, making| is_same(hull.as_ref(), make(&mut forms, mesh, making).as_ref());
        assert!(is_again(&mesh, Making::Hull));
        assert!(!is_again(&mesh, Making::Pieces));
        assert!(!is_again(&notched(1.0), Making::Hull));
        for _ in 0..1000 {
            let _ = make(&mut forms, &Rc::new(Mesh::default()), Making::Hull);
        }
        let kept = forms.known.len();
        assert!(
            kept < 100,
            "forms of meshes that are gone are dropped: {kept}"
        );
    }

    #[test]
    fn equal_meshes_have_the_same_pieces() {
        let mut forms = Forms::default();
        let pieces = make(&mut forms, &notched(1.1), Making::Pieces);
        let shown = |form: Option<&SharedShape>| {
            let parts = form
                .and_then(|form| form.as_compound())
                .map(|parts| parts.shapes());
            let parts = parts.into_iter().flatten();
            let parts: Vec<_> = parts
                .map(|(pose, part)| (*pose, part.as_typed_shape()))
                .collect();
            format!("{parts:?}")
        };
        let mut again = |size| shown(make(&mut forms, &notched(size), Making::Pieces).as_ref());
        assert_eq!(again(1.1), shown(pieces.as_ref()));
        assert_ne!(again(1.2), shown(pieces.as_ref()));
        let meshes = [notched(1.3), notched(1.3)];
        forms.make_all(meshes.iter().map(|mesh| (mesh, Making::Pieces)));
        let [first, second] = meshes.map(|mesh| forms.form_of(&mesh, Making::Pieces));
        assert!(first.is_some() && shown(first.as_ref()) == shown(second.as_ref()));
        let uses = RECENT.with_borrow(|recent| recent.forms.len());
        assert_eq!(uses, 3, "each is computed once");
    }

    #[test]
    fn only_the_last_meshes_are_recent() {
        let mut recent = Recent::default();
        let key = |number: usize| Key::of(&[&number.to_le_bytes()]);
        for number in 0..3 * MAX_RECENT {
            recent.add(key(number), Some(SharedShape::ball(1.0)));
            assert!(recent.get(&key(number)).is_some() && recent.get(&key(0)).is_some());
            recent.drop_oldest();
            assert!(recent.forms.len() <= MAX_RECENT);
        }
        assert_eq!(recent.forms.len(), MAX_RECENT);
        assert!(recent.get(&key(1)).is_none());
    }
}
