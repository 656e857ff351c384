//! The Lua files that are part of the simulator.

use std::sync::OnceLock;

use crate::lua::Bytecode;

/// An embedded Lua module: its text, and its bytecode once it was needed.
pub struct Embedded {
    /// The text of the file.
    pub source: &'static str,
    bytecode: OnceLock<Bytecode>,
}

impl Embedded {
    pub(crate) fn new(source: &'static str) -> Self {
        Self {
            source,
            bytecode: OnceLock::new(),
        }
    }

    /// Compiled once per process. Error positions read `[string "name"]` as in scripts.
    pub(crate) fn bytecode(&self, name: &str) -> &Bytecode {
        self.bytecode.get_or_init(|| {
            heap::outside(|| Bytecode::compile(self.source.as_bytes(), name))
                .expect("a test compiles every embedded file")
        })
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_embedded_file_compiles() {
        for (name, text) in lua_library::FILES {
            super::Bytecode::compile(text.as_bytes(), name).expect(name);
        }
    }
}
