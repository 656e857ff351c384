//! How forms are made of meshes: on several threads, and convex pieces once for all processes.

use std::num::NonZero;
use std::sync::Mutex;

use file_cache::{FileCache, Key};
use geometry::Mesh;
use heap::{Handle, SharedHandle, outside};
use rapier3d_f64::prelude::SharedShape;

use super::kept_hulls::{Hull, decode, encode};
use super::{colliders, pieces};

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

/// How forms are made of meshes. What they are does not depend on it.
#[derive(Debug, Clone)]
pub struct FormMaker {
    /// Threads that work on different meshes at the same time.
    pub threads: NonZero<usize>,
    /// Where convex pieces are kept, which take long to compute.
    pub kept: Option<FileCache>,
}

impl Default for FormMaker {
    fn default() -> Self {
        Self {
            threads: NonZero::<usize>::MIN,
            kept: None,
        }
    }
}

/// What is to be made of which mesh; what convex pieces depend on.
pub(super) type Order<'a> = (&'a Mesh, Making, Option<Key>);

/// A form that was made, and what is to be kept of it.
struct Made {
    form: Option<SharedShape>,
    new: Option<(Key, Vec<u8>)>,
}

impl FormMaker {
    /// The forms of meshes, in their order; None where there is none.
    pub(super) fn make(&self, wanted: &[Order<'_>]) -> Vec<Option<SharedShape>> {
        let made = for_each(self.threads, wanted, |order| self.form(*order));
        let (forms, new): (Vec<_>, Vec<_>) =
            made.into_iter().map(|made| (made.form, made.new)).unzip();
        if let Some(kept) = &self.kept {
            kept.put(&new.into_iter().flatten().collect::<Vec<_>>());
        }
        forms
    }

    fn form(&self, (mesh, making, key): Order<'_>) -> Made {
        let (solid, new) = match making {
            Making::Hull => (colliders::hull(mesh), None),
            Making::Pieces => self.pieces(mesh, key),
            Making::Surface => (None, None),
        };
        let form = solid.or_else(|| colliders::surface(mesh));
        Made { form, new }
    }

    /// The pieces of a mesh, and what is to be kept where they were not.
    fn pieces(
        &self,
        mesh: &Mesh,
        key: Option<Key>,
    ) -> (Option<SharedShape>, Option<(Key, Vec<u8>)>) {
        let Some((kept, key)) = self.kept.as_ref().zip(key) else {
            return (pieces::form(&pieces::hulls(mesh)), None);
        };
        if let Some(hulls) = kept.get(&key).and_then(|bytes| read(mesh, &bytes)) {
            return (pieces::form(&hulls), None);
        }
        let hulls = pieces::hulls(mesh);
        // What would not be read again, since it is not quite convex, is not kept.
        let bytes = Some(encode(&hulls)).filter(|bytes| read(mesh, bytes).is_some());
        (pieces::form(&hulls), bytes.map(|bytes| (key, bytes)))
    }
}

/// Pieces of a mesh from a file; None where they are none.
fn read(mesh: &Mesh, bytes: &[u8]) -> Option<Vec<Hull>> {
    decode(bytes).filter(|hulls| pieces::are_within(hulls, mesh))
}

/// What `work` makes of each item, in their order, on up to `threads` threads.
fn for_each<T: Sync, R: Send>(
    threads: NonZero<usize>,
    items: &[T],
    work: impl Fn(&T) -> R + Sync,
) -> Vec<R> {
    let rest = Mutex::new(items.iter().enumerate());
    let next = || rest.lock().ok()?.next();
    let some = || {
        let mut results = Vec::new();
        while let Some((place, item)) = next() {
            results.push((place, work(item)));
        }
        results
    };
    let heap = (threads.get() > 1).then(Handle::current).flatten();
    let heap = heap.map(Handle::shared);
    let some_inside = || {
        let _entered = heap.map(SharedHandle::entered);
        some()
    };
    let mut results = std::thread::scope(|scope| {
        let spawn = |_| outside(|| scope.spawn(some_inside));
        let others: Vec<_> = (1..threads.get().min(items.len())).map(spawn).collect();
        let mut results = some();
        for other in others {
            match other.join() {
                Ok(more) => results.extend(more),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        results
    });
    results.sort_by_key(|(place, _)| *place);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::PrimitiveKind::Cuboid;
    use geometry::primitive::tessellate;

    /// Two blocks at a right angle.
    fn angle() -> Mesh {
        let block = |size| tessellate(Cuboid, size, false).expect("its extents are finite");
        let mut mesh = block([1.0, 0.2, 0.2]);
        let place = geometry::Pose::translation(0.4, 0.5, 0.0);
        mesh.append(&block([0.2, 1.0, 0.2]), &place);
        mesh
    }

    fn kept_in(folder: &tempfile::TempDir) -> FileCache {
        FileCache::new(folder.path().to_owned(), 1 << 20)
    }

    /// All numbers of the pieces that are made, and whether they are new.
    fn pieces_of(mesh: &Mesh, kept: &FileCache) -> (String, bool) {
        let maker = FormMaker {
            kept: Some(kept.clone()),
            ..FormMaker::default()
        };
        let (form, new) = maker.pieces(mesh, Some(pieces::key(mesh)));
        let form = form.expect("the mesh has an inside");
        let parts = form.as_compound().expect("there are several").shapes();
        let hulls = parts.iter().map(|(_, hull)| hull.as_typed_shape());
        (format!("{:?}", hulls.collect::<Vec<_>>()), new.is_some())
    }

    #[test]
    fn kept_pieces_are_the_computed_ones() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let (mesh, kept) = (angle(), kept_in(&folder));
        let (computed, is_new) = pieces_of(&mesh, &kept);
        assert!(is_new);
        let maker = FormMaker {
            kept: Some(kept.clone()),
            ..FormMaker::default()
        };
        let order = (&mesh, Making::Pieces, Some(pieces::key(&mesh)));
        assert!(maker.make(&[order])[0].is_some());
        assert_eq!(pieces_of(&mesh, &kept), (computed, false));
    }

    #[test]
    fn pieces_of_something_else_are_not_taken() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let (mesh, kept) = (angle(), kept_in(&folder));
        let (computed, _) = pieces_of(&mesh, &kept);
        let mut shifted = pieces::hulls(&mesh);
        shifted[0]
            .points
            .iter_mut()
            .for_each(|point| point[0] += 1.0);
        for planted in [b"nothing".to_vec(), encode(&shifted)] {
            kept.put(&[(pieces::key(&mesh), planted)]);
            assert_eq!(pieces_of(&mesh, &kept), (computed.clone(), true));
        }
    }

    #[test]
    fn threads_do_not_show() {
        let items: Vec<_> = (0..50).collect();
        for threads in 1..5 {
            let threads = NonZero::new(threads).expect("from one");
            let doubled = for_each(threads, &items, |item| item * 2);
            assert_eq!(doubled, (0..100).step_by(2).collect::<Vec<_>>());
        }
    }
}
