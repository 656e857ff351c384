//! Memory budget of Lua code.

use std::cell::Cell;

/// The memory of all states of one simulator. Allocations of Lua code beyond the limit are refused: Lua collects its garbage, and if that is
/// not enough raises `not enough memory`. What the host itself pushes always goes through, since a refusal would raise through Rust;
/// it is bounded by other means and counted all the same.
#[derive(Debug)]
pub struct Budget {
    used: Cell<usize>,
    limit: usize,
    /// Rust code runs, not Lua code.
    in_host: Cell<bool>,
}

impl Budget {
    /// At most `limit` bytes.
    pub(crate) fn new(limit: usize) -> Self {
        Self {
            used: Cell::new(0),
            limit,
            in_host: Cell::new(true),
        }
    }

    /// Whether anything can be refused.
    pub(crate) fn is_limited(&self) -> bool {
        self.limit != usize::MAX
    }

    #[cfg(test)]
    pub(crate) fn used(&self) -> usize {
        self.used.get()
    }

    /// Accounts for a block that changes its size; false when that is refused.
    pub(crate) fn resize(&self, old_size: usize, size: usize) -> bool {
        let used = self.used.get() - old_size + size;
        if used > self.limit && size > old_size && !self.in_host.get() {
            return false;
        }
        self.used.set(used);
        true
    }

    /// Marks the beginning of host code, or of Lua code; returns what ran before, to be restored by [`leave`](Self::leave).
    pub(crate) fn enter(&self, host: bool) -> bool {
        self.in_host.replace(host)
    }

    pub(crate) fn leave(&self, before: bool) {
        self.in_host.set(before);
    }
}

impl Default for Budget {
    fn default() -> Self {
        Self::new(usize::MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::Budget;

    #[test]
    fn lua_code_is_refused_what_the_host_gets() {
        let budget = Budget::new(100);
        let host = budget.enter(false);
        assert!(budget.resize(0, 90) && !budget.resize(0, 20) && budget.resize(0, 10));
        budget.leave(host);
        assert!(budget.resize(0, 20), "the host");
        budget.enter(false);
        assert!(budget.resize(90, 40), "shrinking");
        assert!(budget.resize(0, 30) && !budget.resize(30, 31));
    }
}
