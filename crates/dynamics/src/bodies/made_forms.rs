//! Forms of meshes that were made before. To decompose a robot's meshes takes seconds, and each start of a simulation, and each copy, needs the same forms.

use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::{Rc, Weak};

use file_cache::Key;
use geometry::Mesh;
use rapier3d_f64::prelude::SharedShape;

use super::form_maker::{FormMaker, Making};
use super::pieces;

/// Largest number of meshes whose pieces are kept for equal ones, such as those of a robot that is loaded again.
const MAX_RECENT: usize = 128;

/// The mesh, and its form; None where there is none.
type Known = (Weak<Mesh>, Option<SharedShape>);

thread_local! {
    /// By the address of the mesh, which is no other's while it is known here. Simulators of a thread share it.
    static KNOWN: RefCell<HashMap<(*const Mesh, Making), Known>> = RefCell::default();
    /// The pieces of the last meshes, which may be gone, by their content.
    static RECENT: RefCell<Recent> = RefCell::default();
}

/// What is to be made of a mesh, and on what that depends where others may have made it.
struct Wanted<'a> {
    mesh: &'a Rc<Mesh>,
    making: Making,
    key: Option<Key>,
}

/// The form of a mesh that was made; None where there is none.
pub(super) fn form_of(mesh: &Rc<Mesh>, making: Making) -> Option<SharedShape> {
    KNOWN.with_borrow(|known| known.get(&(Rc::as_ptr(mesh), making))?.1.clone())
}

/// Makes the forms of meshes, each once while the mesh exists: meshes never change in place.
pub(super) fn make_all<'a>(
    meshes: impl Iterator<Item = (&'a Rc<Mesh>, Making)>,
    maker: &FormMaker,
) {
    let wanted = unknown(meshes);
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
    for (wanted, form) in missing.into_iter().zip(maker.make(&order)) {
        match wanted.key {
            Some(key) => RECENT.with_borrow_mut(|recent| recent.add(key, form)),
            None => remember(wanted.mesh, wanted.making, form),
        }
    }
    RECENT.with_borrow_mut(|recent| {
        for wanted in &wanted {
            if let Some(key) = &wanted.key {
                remember(wanted.mesh, wanted.making, recent.get(key));
            }
        }
        recent.drop_oldest();
    });
}

/// What was not made yet, each once.
fn unknown<'a>(meshes: impl Iterator<Item = (&'a Rc<Mesh>, Making)>) -> Vec<Wanted<'a>> {
    let mut seen = HashSet::new();
    meshes
        .filter(|&(mesh, making)| {
            let place = (Rc::as_ptr(mesh), making);
            let is_known = KNOWN.with_borrow(|known| known.contains_key(&place));
            !is_known && seen.insert(place)
        })
        .map(|(mesh, making)| Wanted {
            mesh,
            making,
            key: (making == Making::Pieces).then(|| pieces::key(mesh)),
        })
        .collect()
}

fn remember(mesh: &Rc<Mesh>, making: Making, form: Option<SharedShape>) {
    KNOWN.with_borrow_mut(|known| {
        // Only before it would grow, so that many meshes cost little.
        if known.len() == known.capacity() {
            known.retain(|_, (mesh, _)| mesh.strong_count() > 0);
        }
        known.insert((Rc::as_ptr(mesh), making), (Rc::downgrade(mesh), form));
    });
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

    fn get(&mut self, key: &Key) -> Option<SharedShape> {
        self.uses += 1;
        let (last, form) = self.forms.get_mut(key)?;
        *last = self.uses;
        form.clone()
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

    fn make(mesh: &Rc<Mesh>, making: Making, maker: &FormMaker) -> Option<SharedShape> {
        make_all([(mesh, making)].into_iter(), maker);
        form_of(mesh, making)
    }

    fn is_same(first: Option<&SharedShape>, second: Option<&SharedShape>) -> bool {
        let both = first.zip(second);
        both.is_some_and(|(first, second)| std::sync::Arc::ptr_eq(&first.0, &second.0))
    }

    #[test]
    fn a_form_is_made_once_while_its_mesh_exists() {
        let (mesh, maker) = (notched(1.0), FormMaker::default());
        let hull = make(&mesh, Making::Hull, &maker);
        let is_again = |mesh, making| is_same(hull.as_ref(), make(mesh, making, &maker).as_ref());
        assert!(is_again(&mesh, Making::Hull));
        assert!(!is_again(&mesh, Making::Pieces));
        assert!(!is_again(&notched(1.0), Making::Hull));
        for _ in 0..1000 {
            let _ = make(&Rc::new(Mesh::default()), Making::Hull, &maker);
        }
        let kept = KNOWN.with_borrow(HashMap::len);
        assert!(
            kept < 100,
            "forms of meshes that are gone are dropped: {kept}"
        );
    }

    #[test]
    fn equal_meshes_have_the_same_pieces() {
        let maker = FormMaker::default();
        let pieces = make(&notched(1.1), Making::Pieces, &maker);
        let is_again = |size| {
            let others = make(&notched(size), Making::Pieces, &maker);
            is_same(pieces.as_ref(), others.as_ref())
        };
        assert!(is_again(1.1) && !is_again(1.2));
        let meshes = [notched(1.3), notched(1.3)];
        make_all(meshes.iter().map(|mesh| (mesh, Making::Pieces)), &maker);
        let [first, second] = meshes.map(|mesh| form_of(&mesh, Making::Pieces));
        assert!(is_same(first.as_ref(), second.as_ref()));
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
