//! Whose signals are whose.

use std::collections::BTreeMap;

use scene::Holder;

/// The script that last wrote each signal. A signal is removed with the interpreter of that script.
#[derive(Default)]
pub struct SignalOwners(BTreeMap<Holder, BTreeMap<String, i64>>);

impl SignalOwners {
    pub(crate) fn set(&mut self, holder: Holder, name: &str, script: i64) {
        let owners = self.0.entry(holder).or_default();
        match owners.get_mut(name) {
            Some(owner) => *owner = script,
            None => drop(owners.insert(name.to_owned(), script)),
        }
    }

    pub(crate) fn remove(&mut self, holder: Holder, name: &str) {
        if let Some(owners) = self.0.get_mut(&holder) {
            owners.remove(name);
        }
    }

    /// Drops the owners of the signals of a removed holder.
    pub(crate) fn forget(&mut self, holder: Holder) {
        self.0.remove(&holder);
    }

    /// Removes the signals owned by `script`.
    pub(crate) fn take(&mut self, script: i64) -> Vec<(Holder, String)> {
        let mut owned = Vec::new();
        for (&holder, owners) in &mut self.0 {
            owners.retain(|name, owner| {
                let remains = *owner != script;
                if !remains {
                    owned.push((holder, name.clone()));
                }
                remains
            });
        }
        self.0.retain(|_, owners| !owners.is_empty());
        owned
    }
}
