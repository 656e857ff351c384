//! Aliases and object paths (spec: addressing): `/a/b[1]`, `./x`, `:/y{2}`.
//!
//! Who the emitter of a relative path is, is decided by the caller.

use super::search::{Component, Search};
use crate::{Field, Handle, Object, Scene, SceneError, SceneResult};

/// Paths with more parts than this are written in full.
const SHORT_PATH_PARTS: usize = 8;
/// Longer paths are abbreviated in log lines.
const PRINT_PATH_LENGTH: usize = 40;

/// Consecutive parts, and which one of their matches is meant.
type Group = (Vec<Component>, usize);

/// `alias` as it is kept: everything but letters, digits and underscores becomes an underscore.
pub fn clean_alias(alias: &[u8]) -> String {
    let legal = |&byte: &u8| {
        if byte.is_ascii_alphanumeric() {
            char::from(byte)
        } else {
            '_'
        }
    };
    if alias.is_empty() {
        "_".to_owned()
    } else {
        alias.iter().map(legal).collect()
    }
}

impl Scene {
    /// Renames an object; illegal characters become underscores. The old name becomes the same, or the next that is free.
    pub fn set_alias(&mut self, handle: Handle, alias: &[u8]) -> SceneResult<()> {
        let alias = clean_alias(alias);
        let old_name = self.claim_old_name(handle, &alias)?;
        self.forget_name(handle)?;
        self.modify(handle, Field::Alias, |object| {
            (object.alias, object.old_name) = (alias, old_name);
        })?;
        self.note_name(handle)
    }

    /// The object at `path`, relative paths starting at `emitter`; `index` picks another match than the first.
    ///
    /// # Errors
    /// When there is none.
    pub fn find(
        &self,
        path: &str,
        emitter: Option<Handle>,
        index: Option<usize>,
    ) -> SceneResult<Handle> {
        let (base, rest) = self
            .path_base(path, emitter)
            .ok_or(SceneError::NoSuchPath)?;
        if rest.is_empty() {
            return base.ok_or(SceneError::NoSuchPath);
        }
        let mut found = base;
        for (components, nth) in groups(rest, index) {
            found = Some(
                self.search(found, &components, nth)
                    .ok_or(SceneError::NoSuchPath)?,
            );
        }
        found.ok_or(SceneError::NoSuchPath)
    }

    /// Where the search begins (None: at the roots), and what is to be searched there.
    fn path_base<'p>(
        &self,
        path: &'p str,
        emitter: Option<Handle>,
    ) -> Option<(Option<Handle>, &'p str)> {
        if let Some(rest) = path.strip_prefix('/') {
            let rest = rest.strip_suffix('/').unwrap_or(rest);
            return (!rest.is_empty() && !rest.starts_with(['/', '.', ':']))
                .then_some((None, rest));
        }
        let mut base = emitter;
        let mut rest = path.strip_suffix('/').unwrap_or(path);
        let mut first = true;
        while rest.starts_with(['.', ':']) {
            let (step, after) = rest.split_once('/').unwrap_or((rest, ""));
            base = match step {
                "." if first => base,
                ".." => self.object(base?).ok()?.parent(),
                ":" => base.and_then(|from| self.model_from(from)),
                "::" => base
                    .and_then(|from| self.model_from(from))
                    .and_then(|model| self.model_above(model)),
                _ => return None,
            };
            (rest, first) = (after, false);
        }
        (!first).then_some((base, rest))
    }

    /// The nearest model base among `handle` and its ancestors.
    fn model_from(&self, handle: Handle) -> Option<Handle> {
        std::iter::once(handle)
            .chain(self.ancestors(handle))
            .find(|&h| self.object(h).is_ok_and(Object::is_model))
    }

    /// The nearest model base above `handle`.
    fn model_above(&self, handle: Handle) -> Option<Handle> {
        self.ancestors(handle)
            .find(|&h| self.object(h).is_ok_and(Object::is_model))
    }

    /// The `nth` object below `base` that `components` lead to.
    fn search(&self, base: Option<Handle>, components: &[Component], nth: usize) -> Option<Handle> {
        Search::new(self).run(base, components, &mut { nth })
    }

    /// The alias, with `[i]` when siblings share it.
    pub fn indexed_alias(&self, handle: Handle) -> SceneResult<String> {
        let alias = self.object(handle)?.alias();
        Ok(match self.child_order(handle)? {
            Some(index) => format!("{alias}[{index}]"),
            None => alias.to_owned(),
        })
    }

    /// The path from the root, with every object on the way.
    pub fn full_path(&self, handle: Handle) -> SceneResult<String> {
        let mut parts = vec![self.indexed_alias(handle)?];
        for above in self.ancestors(handle) {
            parts.push(self.indexed_alias(above)?);
        }
        Ok(joined(&parts))
    }

    /// The shortest path that leads to an object: models on the way up, and whatever else the lookup needs.
    pub fn short_path(&self, handle: Handle) -> SceneResult<String> {
        let parts = self.short_path_parts(handle)?;
        if parts.len() > SHORT_PATH_PARTS {
            self.full_path(handle)
        } else {
            Ok(joined(&parts))
        }
    }

    /// Parts of the short path, the object's own first.
    fn short_path_parts(&self, handle: Handle) -> SceneResult<Vec<String>> {
        let mut parts = vec![self.indexed_alias(handle)?];
        let mut components = vec![component(&parts[0])];
        for above in self.ancestors(handle) {
            let object = self.object(above)?;
            if object.is_model() || self.search(object.parent(), &components, 0) != Some(handle) {
                let part = self.indexed_alias(above)?;
                components.insert(0, component(&part));
                parts.push(part);
            }
            if parts.len() > SHORT_PATH_PARTS {
                break;
            }
        }
        Ok(parts)
    }

    /// The short path as log lines show it: only its ends, when it is long.
    pub fn print_path(&self, handle: Handle) -> SceneResult<String> {
        let path = self.short_path(handle)?;
        let parts: Vec<&str> = path.split('/').skip(1).collect();
        match parts.as_slice() {
            [first, _, .., last] if path.len() > PRINT_PATH_LENGTH => {
                Ok(format!("/{first}/ ... /{last}"))
            }
            _ => Ok(path),
        }
    }

    /// `alias__handle__`, which names an object for sure.
    pub fn handle_alias(&self, handle: Handle) -> SceneResult<String> {
        Ok(format!(
            "{}__{}__",
            self.object(handle)?.alias(),
            handle.raw()
        ))
    }

    /// The alias if no other object has it, otherwise alias and handle.
    pub fn unique_alias(&self, handle: Handle) -> SceneResult<String> {
        let alias = self.object(handle)?.alias();
        if self.namesakes.count(alias) > 1 {
            self.handle_alias(handle)
        } else {
            Ok(alias.to_owned())
        }
    }

    /// Up to `models` model ancestors and the object, each with its `{n}`.
    pub fn counted_path(&self, handle: Handle, models: usize) -> SceneResult<String> {
        let is_model = |&h: &Handle| self.object(h).is_ok_and(Object::is_model);
        let mut chain = vec![handle];
        chain.extend(self.ancestors(handle).filter(is_model).take(models));
        let mut path = String::new();
        let mut base = None;
        for &step in chain.iter().rev() {
            path.push('/');
            path.push_str(&self.counted_alias(base, step)?);
            base = Some(step);
        }
        Ok(path)
    }

    /// `alias{n}`: the n-th of its name below `base`; just the alias when it is the only one.
    fn counted_alias(&self, base: Option<Handle>, handle: Handle) -> SceneResult<String> {
        let alias = self.object(handle)?.alias();
        if self.namesakes.only_parent(alias).is_some() {
            let order = self.child_order(handle)?;
            return Ok(order.map_or_else(|| alias.to_owned(), |n| format!("{alias}{{{n}}}")));
        }
        let same = |&h: &Handle| self.object(h).is_ok_and(|object| object.alias() == alias);
        let hits: Vec<Handle> = self.search_order(base).into_iter().filter(same).collect();
        let position = hits.iter().position(|&h| h == handle);
        Ok(match position.filter(|_| hits.len() > 1) {
            Some(n) => format!("{alias}{{{n}}}"),
            None => alias.to_owned(),
        })
    }

    /// Everything below `base` in the order lookups see it: all children, then what is below the first child, and so on.
    fn search_order(&self, base: Option<Handle>) -> Vec<Handle> {
        let mut pending = vec![base];
        let mut order = Vec::new();
        while let Some(base) = pending.pop() {
            let children = self.children_of(base);
            order.extend(children);
            pending.extend(children.iter().rev().map(|&child| Some(child)));
        }
        order
    }
}

/// The parts of a path, split behind each `{n}`. With an `index` the last part's `{n}` is not understood.
fn groups(path: &str, index: Option<usize>) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut open = Vec::new();
    let parts: Vec<&str> = path.split('/').collect();
    for (i, part) in parts.iter().enumerate() {
        let last = i + 1 == parts.len();
        let (text, nth) = match numbered(part, '{', '}') {
            Some((text, nth)) if !(last && index.is_some()) => (text, Some(nth)),
            _ => (*part, index.filter(|_| last)),
        };
        open.push(component(text));
        if last || nth.is_some() {
            groups.push((std::mem::take(&mut open), nth.unwrap_or(0)));
        }
    }
    groups
}

fn component(text: &str) -> Component {
    match numbered(text, '[', ']') {
        Some((pattern, sibling)) => Component::new(pattern, Some(sibling)),
        None => Component::new(text, None),
    }
}

/// Splits `text(number)`.
fn numbered(text: &str, open: char, close: char) -> Option<(&str, usize)> {
    let (text, number) = text.strip_suffix(close)?.rsplit_once(open)?;
    Some((text, number.parse().ok()?))
}

fn joined(parts: &[String]) -> String {
    parts.iter().rev().flat_map(|part| ["/", part]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;
    use crate::object::dummy::Dummy;

    fn dummy(scene: &mut Scene, alias: &str, parent: Option<Handle>) -> Handle {
        let handle = scene.add(alias, Kind::Dummy(Dummy::new(0.01))).unwrap();
        scene.set_parent(handle, parent, true).unwrap();
        handle
    }

    #[test]
    fn skipping_levels() {
        let mut scene = Scene::new();
        let a = dummy(&mut scene, "A", None);
        let b = dummy(&mut scene, "B", Some(a));
        let inner = dummy(&mut scene, "C", Some(b));
        let outer = dummy(&mut scene, "C", None);
        assert_eq!(scene.find("/C", None, None), Ok(outer));
        assert_eq!(scene.find("/A/C", None, None), Ok(inner));
        assert_eq!(scene.find("/C{1}", None, None), Ok(inner));
        assert_eq!(scene.find("/*{1}", None, None), Ok(outer));
        assert_eq!(
            scene.find("/C{0}", None, Some(1)),
            Err(SceneError::NoSuchPath)
        );
        assert_eq!(scene.find("../../C", Some(b), None), Ok(outer));
        assert_eq!(scene.short_path(inner).unwrap(), "/A/C");
    }

    #[test]
    fn a_hopeless_pattern_ends() {
        let mut scene = Scene::new();
        let mut parent = None;
        for _ in 0..200 {
            parent = Some(dummy(&mut scene, "x", parent));
        }
        assert!(
            scene
                .find(&"/*".repeat(40).replace("/*/*", "/*/x"), None, None)
                .is_ok()
        );
        assert!(
            scene
                .find(&format!("{}/y", "/*".repeat(40)), None, None)
                .is_err()
        );
    }

    #[test]
    fn long_paths_are_printed_short() {
        let mut scene = Scene::new();
        let mut parent = None;
        for _ in 0..3 {
            parent = Some(dummy(&mut scene, "a_rather_long_alias", parent));
        }
        let path = scene.print_path(parent.unwrap()).unwrap();
        assert_eq!(path, "/a_rather_long_alias/ ... /a_rather_long_alias");
    }
}
