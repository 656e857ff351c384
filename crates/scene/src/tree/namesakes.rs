//! Objects by alias and parent.

use std::collections::HashMap;

use crate::Handle;

/// The objects of each alias, by parent, in their order among the children.
#[derive(Debug, Default)]
pub(crate) struct Namesakes(HashMap<String, OfAlias>);

#[derive(Debug, Default)]
struct OfAlias {
    /// How many there are.
    count: usize,
    by_parent: HashMap<Option<Handle>, Vec<Handle>>,
}

impl Namesakes {
    /// Adds an object. `place` is where it belongs among the other children of that alias.
    pub(super) fn add(
        &mut self,
        alias: &str,
        parent: Option<Handle>,
        handle: Handle,
        place: impl FnOnce(&[Handle]) -> usize,
    ) {
        if !self.0.contains_key(alias) {
            self.0.insert(alias.to_owned(), OfAlias::default());
        }
        if let Some(all) = self.0.get_mut(alias) {
            all.count += 1;
            let children = all.by_parent.entry(parent).or_default();
            children.insert(place(children), handle);
        }
    }

    /// Removes the child that is at `place` among those of an alias.
    pub(super) fn remove(
        &mut self,
        alias: &str,
        parent: Option<Handle>,
        place: impl FnOnce(&[Handle]) -> usize,
    ) {
        let Some(all) = self.0.get_mut(alias) else {
            return;
        };
        let Some(children) = all.by_parent.get_mut(&parent) else {
            return;
        };
        children.remove(place(children));
        all.count -= 1;
        if children.is_empty() {
            all.by_parent.remove(&parent);
        }
        if all.count == 0 {
            self.0.remove(alias);
        }
    }

    /// The children of `parent` (None: the roots) that have an alias, in their order.
    pub(crate) fn among(&self, alias: &str, parent: Option<Handle>) -> &[Handle] {
        let children = self.0.get(alias).and_then(|all| all.by_parent.get(&parent));
        children.map_or(&[], Vec::as_slice)
    }

    /// How many objects have an alias.
    pub(crate) fn count(&self, alias: &str) -> usize {
        self.0.get(alias).map_or(0, |all| all.count)
    }

    /// The parent of all objects with an alias, if they have the same (None: they are roots).
    pub(crate) fn only_parent(&self, alias: &str) -> Option<Option<Handle>> {
        let all = self.0.get(alias)?;
        let mut parents = all.by_parent.keys();
        parents.next().filter(|_| all.by_parent.len() == 1).copied()
    }
}
