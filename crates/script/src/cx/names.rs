//! The names of functions that scripts have.

use super::Cx;
use crate::binding::ApiFn;
use crate::binding::registry::Member;

impl Cx<'_> {
    /// The description of a function in Rust, `module.name`; None for all else.
    pub fn native_function(&self, name: &str) -> Option<&'static ApiFn> {
        let registry = &self.sim.modules.registry;
        match registry.find(name) {
            Some(Member::Native(id)) => Some(registry.bound(id).function),
            _ => None,
        }
    }

    /// The names of the members of a module in alphabetical order; None where there is no such module.
    pub fn member_names(&self, module: &str) -> Option<Vec<&'static str>> {
        let module = self.sim.modules.registry.module(module)?;
        Some(module.names())
    }
}
