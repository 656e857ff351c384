//! The index: every object with geometry, in a tree of the boxes around them.
//!
//! It is made by the first query, and reads the journal before each further one; so it costs nothing where nobody asks. Meshes are
//! prepared when a query comes near them.

mod body;
mod growth;

use std::collections::{BTreeMap, BTreeSet};

use proximity::{Bounds, BoundsTree};

use super::entity::{Group, Purpose};
pub(crate) use body::Body;
use body::Meshes;
use scene::{Change, Cursor, Field, Handle, Scene, Topic, Topics, Unread};

/// Changes that can move an object or change its geometry.
const TOPICS: Topics = Topics::TREE
    .with(Topic::Added)
    .with(Topic::Removed)
    .with_fields(&[
        Field::Pose,
        Field::Geometry,
        Field::Joint,
        Field::JointPosition,
        Field::Other,
    ]);

/// The bodies of a scene.
#[derive(Debug, Default)]
pub(crate) struct Index {
    /// None before the first query.
    cursor: Option<Cursor>,
    bodies: BTreeMap<Handle, Body>,
    /// By the numbers of the handles.
    tree: BoundsTree,
    meshes: Meshes,
    /// Bodies that were placed where their objects stood for a query only.
    displaced: Vec<Handle>,
}

/// Changes since the last query.
#[derive(Default)]
struct News {
    /// Came, or got another geometry.
    changed: BTreeSet<Handle>,
    removed: BTreeSet<Handle>,
    /// Moved, with what is below them.
    moved: BTreeSet<Handle>,
}

impl Index {
    /// Brings the index up to date. Takes time in proportion to what changed.
    pub(crate) fn update(&mut self, scene: &Scene) {
        self.read_journal(scene);
        for handle in std::mem::take(&mut self.displaced) {
            self.place(handle, scene);
        }
    }

    /// Brings the index up to date, and places bodies whose objects stand elsewhere for the length of a query: the next one places them again.
    pub(super) fn place_displaced(&mut self, scene: &Scene, bodies: &[Handle]) {
        if self.displaced == bodies {
            self.read_journal(scene);
        } else {
            self.update(scene);
            self.displaced = bodies.to_vec();
        }
        bodies.iter().for_each(|&handle| self.place(handle, scene));
    }

    /// The objects with a body among some and all that are below them.
    pub(super) fn bodies_below(
        &self,
        scene: &Scene,
        roots: impl IntoIterator<Item = Handle>,
    ) -> Vec<Handle> {
        let below: BTreeSet<Handle> = roots
            .into_iter()
            .flat_map(|root| scene.subtree(root))
            .collect();
        below
            .into_iter()
            .filter(|handle| self.bodies.contains_key(handle))
            .collect()
    }

    fn read_journal(&mut self, scene: &Scene) {
        let cursor = self
            .cursor
            .get_or_insert_with(|| scene.journal().follow(TOPICS));
        match scene.journal().read(cursor) {
            Unread::Everything => self.rebuild(scene),
            Unread::Changes(changes) => {
                let mut news = News::default();
                changes.for_each(|change| news.note(change));
                self.apply(news, scene);
            }
        }
    }

    fn rebuild(&mut self, scene: &Scene) {
        (self.bodies, self.tree) = (BTreeMap::new(), BoundsTree::default());
        scene
            .objects()
            .for_each(|object| self.renew(object.handle(), scene));
        self.meshes.drop_unused();
    }

    fn apply(&mut self, news: News, scene: &Scene) {
        let geometry_changed = !(news.removed.is_empty() && news.changed.is_empty());
        news.removed
            .into_iter()
            .for_each(|handle| self.remove(handle));
        news.changed
            .into_iter()
            .for_each(|handle| self.renew(handle, scene));
        let mut placed = BTreeSet::new();
        news.moved
            .into_iter()
            .for_each(|handle| self.place_below(handle, scene, &mut placed));
        if geometry_changed {
            self.meshes.drop_unused();
        }
    }

    fn remove(&mut self, handle: Handle) {
        self.bodies.remove(&handle);
        self.tree.remove(handle.0);
    }

    /// Makes the body of an object anew, or adds to it what has come.
    fn renew(&mut self, handle: Handle, scene: &Scene) {
        let body = self.bodies.get_mut(&handle);
        let object = scene.object(handle);
        if body.is_some_and(|body| object.is_ok_and(|object| body.follow(object))) {
            return self.place(handle, scene);
        }
        self.remove(handle);
        let Ok(object) = scene.object(handle) else {
            return;
        };
        if let Some(body) = Body::of(object, &mut self.meshes) {
            self.bodies.insert(handle, body);
            self.place(handle, scene);
        }
    }

    fn place(&mut self, handle: Handle, scene: &Scene) {
        if let (Some(body), Ok(pose)) = (self.bodies.get_mut(&handle), scene.world_pose(handle)) {
            body.place(&pose);
            self.tree.insert(handle.0, &body.bounds);
        }
    }

    /// Places an object and all below it, except for trees that were placed before.
    fn place_below(&mut self, handle: Handle, scene: &Scene, placed: &mut BTreeSet<Handle>) {
        let mut open = vec![handle];
        while let Some(handle) = open.pop() {
            if placed.insert(handle)
                && let Ok(object) = scene.object(handle)
            {
                self.place(handle, scene);
                open.extend(object.children());
            }
        }
    }

    /// The body of an object, if it has geometry.
    pub(crate) fn body(&self, handle: Handle) -> Option<&Body> {
        self.bodies.get(&handle)
    }

    /// How many meshes bodies have, those that several share once.
    #[cfg(test)]
    pub(crate) fn kept_meshes(&self) -> usize {
        self.meshes.count()
    }

    /// Visits the bodies of a group by ascending lower bound, as long as it is smaller than the limit. `visit` gets the limit and returns
    /// the new one. Of a box inside of another, the lower bound must not be smaller.
    pub(crate) fn nearest_first(
        &self,
        group: &Group,
        (scene, purpose): (&Scene, Purpose),
        lower_bound: impl Fn(&Bounds) -> f64,
        mut limit: f64,
        mut visit: impl FnMut(Handle, &Body, f64) -> f64,
    ) {
        match group {
            Group::List(list) => {
                let bodies = list
                    .iter()
                    .filter_map(|&handle| Some((handle, self.body(handle)?)));
                let mut bodies: Vec<_> = bodies
                    .map(|(handle, body)| (lower_bound(&body.bounds), handle, body))
                    .collect();
                bodies.sort_by(|a, b| a.0.total_cmp(&b.0));
                for (bound, handle, body) in bodies {
                    if bound < limit {
                        limit = visit(handle, body, limit);
                    }
                }
            }
            Group::All { except } => {
                self.tree
                    .nearest_first(lower_bound, limit, |key, _, limit| {
                        match self.member(key, except, scene, purpose) {
                            Some((handle, body)) => visit(handle, body, limit),
                            None => limit,
                        }
                    });
            }
        }
    }

    /// Visits the bodies of a group that a ray meets, in no particular order. `visit` gets the distance up to which the ray counts, and
    /// returns the new one.
    pub(crate) fn along_ray(
        &self,
        group: &Group,
        (scene, purpose): (&Scene, Purpose),
        (origin, direction): ([f64; 3], [f64; 3]),
        range: [f64; 2],
        mut visit: impl FnMut(Handle, &Body, f64) -> f64,
    ) {
        match group {
            Group::List(list) => {
                let bodies = list
                    .iter()
                    .filter_map(|&handle| Some((handle, self.body(handle)?)));
                bodies.fold(range[1], |to, (handle, body)| visit(handle, body, to));
            }
            Group::All { except } => self.tree.along_ray(origin, direction, range, |key, to| {
                match self.member(key, except, scene, purpose) {
                    Some((handle, body)) => visit(handle, body, to),
                    None => to,
                }
            }),
        }
    }

    /// The bodies of a group whose boxes overlap a box, in the order of the scene.
    pub(crate) fn overlapping(
        &self,
        group: &Group,
        (scene, purpose): (&Scene, Purpose),
        bounds: &Bounds,
    ) -> Vec<(Handle, &Body)> {
        match group {
            Group::List(list) => {
                let bodies = list
                    .iter()
                    .filter_map(|&handle| Some((handle, self.body(handle)?)));
                bodies
                    .filter(|(_, body)| body.bounds.overlaps(bounds))
                    .collect()
            }
            Group::All { except } => {
                let mut found = Vec::new();
                self.tree.overlapping(bounds, |key| {
                    found.extend(self.member(key, except, scene, purpose));
                });
                found.sort_by_key(|(_, body)| body.uid);
                found
            }
        }
    }

    /// The object with a number of the tree, if it takes part.
    fn member(
        &self,
        key: u32,
        except: &BTreeSet<Handle>,
        scene: &Scene,
        purpose: Purpose,
    ) -> Option<(Handle, &Body)> {
        let handle = Handle(key);
        let object = scene.object(handle).ok()?;
        let takes_part = !except.contains(&handle) && purpose.includes(scene, object);
        takes_part
            .then(|| self.body(handle))
            .flatten()
            .map(|body| (handle, body))
    }
}

impl News {
    fn note(&mut self, change: &Change) {
        match *change {
            Change::Added(handle) => {
                self.removed.remove(&handle);
                self.changed.insert(handle);
            }
            Change::Removed(handle, _) => {
                self.changed.remove(&handle);
                self.moved.remove(&handle);
                self.removed.insert(handle);
            }
            Change::Modified(handle, Field::Geometry | Field::Other) => {
                self.changed.insert(handle);
                self.moved.insert(handle);
            }
            Change::Modified(handle, _) => drop(self.moved.insert(handle)),
            Change::Selection | Change::Settings | Change::Stored { .. } => {}
        }
    }
}
