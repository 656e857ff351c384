//! The Lua files that are part of the simulator.

use std::sync::OnceLock;

use crate::script::lua::Bytecode;

/// `(module, text)` of every file below `lua/`.
pub(crate) const FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/lua_files.rs"));

/// An embedded Lua module: its text, and its bytecode once it was needed.
pub(crate) struct Embedded {
    pub source: &'static str,
    bytecode: OnceLock<Bytecode>,
}

impl Embedded {
    pub(crate) fn new(source: &'static str) -> Self {
        Self { source, bytecode: OnceLock::new() }
    }

    /// Compiled once per process. Error positions read `[string "name"]` as in scripts.
    pub(crate) fn bytecode(&self, name: &str) -> &Bytecode {
        self.bytecode.get_or_init(|| {
            Bytecode::compile(self.source.as_bytes(), name).expect("a test compiles every embedded file")
        })
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_embedded_file_compiles() {
        for (name, text) in super::FILES {
            super::Bytecode::compile(text.as_bytes(), name).expect(name);
        }
    }
}
