//! Lookup of objects below another by the parts of a path.

use std::borrow::Cow;
use std::collections::HashMap;

use crate::{Handle, Object, Scene};

/// One part of a path: a pattern, and which one of the siblings that match it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Component {
    pattern: String,
    /// Without wildcards, the pattern is an alias.
    is_alias: bool,
    sibling: Option<usize>,
}

impl Component {
    pub(super) fn new(pattern: &str, sibling: Option<usize>) -> Self {
        Self {
            pattern: pattern.to_owned(),
            is_alias: !pattern.contains(['*', '?']),
            sibling,
        }
    }

    fn matches(&self, object: &Object) -> bool {
        if self.is_alias {
            object.alias() == self.pattern
        } else {
            wildcard_match(self.pattern.as_bytes(), object.alias().as_bytes())
        }
    }

    /// Whether the search goes on below an object: not below those of which only one was asked for.
    fn goes_below(&self, object: &Object) -> bool {
        !object.children().is_empty() && (self.sibling.is_none() || !self.matches(object))
    }
}

/// One lookup. Subtrees without a match are remembered, so that patterns such as `/*/*/*/x` visit each object once for each part.
pub(super) struct Search<'a> {
    scene: &'a Scene,
    /// Number of matches below an object for the last so many components.
    hits: HashMap<(Option<Handle>, usize), usize>,
    /// How many lists of children were looked through.
    lists: usize,
}

impl<'a> Search<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        Self {
            scene,
            hits: HashMap::new(),
            lists: 0,
        }
    }

    /// The match number `nth` below `base`; otherwise `nth` is lowered by the number of matches.
    pub(super) fn run(
        &mut self,
        base: Option<Handle>,
        components: &[Component],
        nth: &mut usize,
    ) -> Option<Handle> {
        let (first, rest) = components.split_first()?;
        if first.is_alias
            && let Some(parent) = self.scene.namesakes.only_parent(&first.pattern)
        {
            let matching = self.matching(parent, first);
            return self
                .is_below(parent, base)
                .then(|| self.match_among(&matching, first, rest, nth))?;
        }
        let known = self.hits.get(&(base, components.len()));
        if let Some(hits) = known.filter(|&hits| hits <= nth) {
            *nth -= hits;
            return None;
        }
        let index = *nth;
        let found = self.walk(base, first, rest, nth);
        if found.is_none() {
            self.hits.insert((base, components.len()), index - *nth);
        }
        found
    }

    /// Whether a search below `base` comes to the children of `parent`.
    fn is_below(&self, parent: Option<Handle>, base: Option<Handle>) -> bool {
        base.is_none_or(|base| {
            parent.is_some_and(|parent| self.scene.is_ancestor_or_self(base, parent))
        })
    }

    /// All children first, then what is below the first child, and so on.
    fn walk(
        &mut self,
        base: Option<Handle>,
        first: &Component,
        rest: &[Component],
        nth: &mut usize,
    ) -> Option<Handle> {
        let mut unseen = self.number_in_scene(first);
        let mut pending = vec![base];
        while unseen > 0
            && let Some(base) = pending.pop()
        {
            let matching = self.matching(base, first);
            if let Some(hit) = self.match_among(&matching, first, rest, nth) {
                return Some(hit);
            }
            unseen -= matching.len();
            let children = self.scene.children_of(base).iter().rev();
            let objects = children.filter_map(|&child| self.scene.object(child).ok());
            let parents = objects.filter(|object| first.goes_below(object));
            pending.extend(parents.map(|object| Some(object.handle())));
        }
        None
    }

    /// The match number `nth` that begins with one of the children that match; otherwise `nth` is lowered by the number of such matches.
    fn match_among(
        &mut self,
        matching: &[Handle],
        first: &Component,
        rest: &[Component],
        nth: &mut usize,
    ) -> Option<Handle> {
        let chosen = match first.sibling {
            None => matching,
            Some(number) => matching.get(number..=number).unwrap_or_default(),
        };
        if !rest.is_empty() {
            return chosen
                .iter()
                .find_map(|&child| self.run(Some(child), rest, nth));
        }
        let hit = chosen.get(*nth).copied();
        *nth -= if hit.is_some() { 0 } else { chosen.len() };
        hit
    }

    /// The children of `parent` that match, in their order.
    fn matching(&mut self, parent: Option<Handle>, component: &Component) -> Cow<'a, [Handle]> {
        self.lists += 1;
        let scene = self.scene;
        if component.is_alias {
            return scene.namesakes.among(&component.pattern, parent).into();
        }
        let matches = |child: &&Handle| scene.object(**child).is_ok_and(|o| component.matches(o));
        let children = scene.children_of(parent).iter();
        children.filter(matches).copied().collect()
    }

    /// How many objects may match, at most.
    fn number_in_scene(&self, component: &Component) -> usize {
        if component.is_alias {
            self.scene.namesakes.count(&component.pattern)
        } else {
            self.scene.len()
        }
    }
}

/// Whether all of `text` fits `pattern`, in which `*` is any run of characters and `?` is one.
fn wildcard_match(pattern: &[u8], text: &[u8]) -> bool {
    let (mut p, mut t) = (0, 0);
    // Behind the last star, and where its run ends for now.
    let mut retry: Option<(usize, usize)> = None;
    while t < text.len() {
        match pattern.get(p) {
            Some(b'*') => {
                retry = Some((p + 1, t));
                p += 1;
            }
            Some(&c) if c == b'?' || c == text[t] => (p, t) = (p + 1, t + 1),
            _ => match &mut retry {
                Some((after, end)) => {
                    *end += 1;
                    (p, t) = (*after, *end);
                }
                None => return false,
            },
        }
    }
    pattern[p..].iter().all(|&c| c == b'*')
}

#[cfg(test)]
mod tests;
