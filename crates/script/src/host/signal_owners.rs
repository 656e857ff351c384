//! Whose signals are whose.

use std::collections::{BTreeMap, BTreeSet};

use scene::Holder;

/// The script that last wrote each signal. A signal is removed with the interpreter of that script.
#[derive(Default)]
pub struct SignalOwners {
    owners: BTreeMap<Holder, BTreeMap<String, i64>>,
    /// The same the other way round, so that a script that ends does not go through the signals of others.
    owned: BTreeMap<i64, BTreeSet<(Holder, String)>>,
}

impl SignalOwners {
    pub(crate) fn set(&mut self, holder: Holder, name: &str, script: i64) {
        let owners = self.owners.entry(holder).or_default();
        let previous = match owners.get_mut(name) {
            Some(owner) => Some(std::mem::replace(owner, script)),
            None => owners.insert(name.to_owned(), script),
        };
        if previous != Some(script) {
            self.disown(previous, holder, name);
            let owned = self.owned.entry(script).or_default();
            owned.insert((holder, name.to_owned()));
        }
    }

    pub(crate) fn remove(&mut self, holder: Holder, name: &str) {
        let owners = self.owners.get_mut(&holder);
        let owner = owners.and_then(|owners| owners.remove(name));
        self.disown(owner, holder, name);
    }

    /// Drops the owners of the signals of a removed holder.
    pub(crate) fn forget(&mut self, holder: Holder) {
        let owners = self.owners.remove(&holder).unwrap_or_default();
        for (name, owner) in owners {
            self.disown(Some(owner), holder, &name);
        }
    }

    /// Removes the signals owned by `script`, in the order of their holders and names.
    pub(crate) fn take(&mut self, script: i64) -> Vec<(Holder, String)> {
        let owned = self.owned.remove(&script).unwrap_or_default();
        for (holder, name) in &owned {
            if let Some(owners) = self.owners.get_mut(holder) {
                owners.remove(name);
                if owners.is_empty() {
                    self.owners.remove(holder);
                }
            }
        }
        owned.into_iter().collect()
    }

    fn disown(&mut self, script: Option<i64>, holder: Holder, name: &str) {
        if let Some(owned) = script.and_then(|script| self.owned.get_mut(&script)) {
            owned.remove(&(holder, name.to_owned()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_signal_is_owned_by_the_script_that_wrote_it_last() {
        let mut owners = SignalOwners::default();
        let signal = |name: &str| (Holder::Scene, name.to_owned());
        for (name, script) in [("b", 1), ("a", 1), ("c", 1), ("a", 2), ("d", 1), ("d", 1)] {
            owners.set(Holder::Scene, name, script);
        }
        owners.remove(Holder::Scene, "c");
        owners.set(Holder::App, "e", 1);
        owners.forget(Holder::App);
        assert_eq!(owners.take(1), [signal("b"), signal("d")]);
        assert_eq!(owners.take(1), []);
        assert_eq!(owners.take(2), [signal("a")]);
        assert!(owners.owners.is_empty());
    }
}
