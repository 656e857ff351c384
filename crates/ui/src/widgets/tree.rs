//! Trees of items with columns of text.

use std::collections::BTreeMap;

use super::table::{HeaderTexts, Sizes};

/// An item.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TreeItem {
    /// The id of its parent; 0 at the top.
    pub parent: i64,
    /// The text of each column.
    pub texts: Vec<String>,
    /// Whether the items below it are shown.
    pub expanded: bool,
    /// Items of a parent are in the order of their creation.
    pub order: u64,
}

/// A tree.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tree {
    /// The items by their ids.
    pub items: BTreeMap<i64, TreeItem>,
    /// Number of columns.
    pub column_count: i64,
    /// Titles of columns by their index.
    pub column_headers: HeaderTexts,
    /// Smallest and largest width of columns, pixels; None for the default.
    pub column_width: Sizes,
    pub(crate) show_header: bool,
    pub(crate) autosize_header: bool,
    pub(crate) sortable: bool,
    /// The id of the selected item; 0 for none.
    pub selected: i64,
    /// How many items were added so far.
    pub added: u64,
}

impl Tree {
    /// Adds an item, or replaces the one with that id. Nothing happens when the parent is unknown.
    pub fn add(&mut self, id: i64, parent: i64, texts: Vec<String>, expanded: bool) {
        if (parent != 0 && !self.items.contains_key(&parent)) || self.is_within(parent, id) {
            return;
        }
        self.added += 1;
        self.items.insert(
            id,
            TreeItem {
                parent,
                texts,
                expanded,
                order: self.added,
            },
        );
    }

    /// Whether `item` is `ancestor` or below it.
    fn is_within(&self, item: i64, ancestor: i64) -> bool {
        let mut at = item;
        while at != 0 {
            if at == ancestor {
                return true;
            }
            at = self.items.get(&at).map_or(0, |item| item.parent);
        }
        false
    }

    /// The items of a parent, 0 for the top, in their order.
    pub(crate) fn children(&self, parent: i64) -> Vec<i64> {
        let mut found: Vec<(u64, i64)> = self
            .items
            .iter()
            .filter(|(_, item)| item.parent == parent)
            .map(|(id, item)| (item.order, *id))
            .collect();
        found.sort_unstable();
        found.into_iter().map(|(_, id)| id).collect()
    }

    /// Moves an item that has a parent below another, or to the top for 0. Nothing happens for one at the top, as in the original, for unknown
    /// ones, and where it would come below itself.
    pub fn move_item(&mut self, id: i64, parent: i64) {
        let known = parent == 0 || self.items.contains_key(&parent);
        if !known || self.is_within(parent, id) {
            return;
        }
        if let Some(item) = self.items.get_mut(&id).filter(|item| item.parent != 0) {
            self.added += 1;
            (item.parent, item.order) = (parent, self.added);
        }
    }

    /// Removes an item with those below it.
    pub fn remove(&mut self, id: i64) {
        let mut gone = vec![id];
        while let Some(id) = gone.pop() {
            if self.items.remove(&id).is_some() {
                gone.extend(self.children(id));
            }
        }
        if !self.items.contains_key(&self.selected) {
            self.selected = 0;
        }
    }

    /// Expands the items of the first `depth` levels below the top one and collapses the others.
    pub fn expand_to(&mut self, depth: i64) {
        let depths: Vec<(i64, i64)> = self.items.keys().map(|id| (*id, self.depth(*id))).collect();
        for (id, at) in depths {
            if let Some(item) = self.items.get_mut(&id) {
                item.expanded = at <= depth;
            }
        }
    }

    fn depth(&self, id: i64) -> i64 {
        let parent = |id: &i64| {
            self.items
                .get(id)
                .map(|item| item.parent)
                .filter(|parent| *parent != 0)
        };
        std::iter::successors(parent(&id), parent).count() as i64
    }
}
