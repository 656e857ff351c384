//! The description of a module, from which its registration, the reference, editor stubs and the knowledge of tools are derived.

use super::ApiFn;
use super::hooks::Hooks;

/// A module: `sim`, or what `require` finds under another name.
///
/// It is data. A [`Registry`](super::registry::Registry) makes it callable; `crate::docs` makes pages of it. A Lua file of the module's
/// name, below `lua/`, is its Lua part: it gets a table of everything that is native as its second argument and returns the module.
pub struct Module {
    /// The name by which `require` finds it.
    pub name: &'static str,
    /// The purpose of the module, in one line; empty if it is in the head of the Lua part.
    pub about: &'static str,
    /// Functions for scripts, by category. A name without a dot is a global function.
    pub functions: &'static [(&'static str, &'static [ApiFn])],
    /// Functions for the module's Lua part only.
    pub inner: &'static [&'static [ApiFn]],
    /// `name<TAB>integer`; `enumeration.name` for what belongs to an enumeration.
    pub constants: &'static str,
    /// `old<TAB>new`: names that do exactly what another does.
    pub aliases: &'static str,
    /// `name<TAB>replacement`: names that log their deprecation at the first call.
    pub deprecated: &'static str,
    /// `name<TAB>category<TAB>age<TAB>signature` of every function the module has in CoppeliaSim. Those that are not here raise an error.
    pub reference: &'static str,
    /// `simName<TAB>name`: global names from before there were modules, where they follow no rule.
    pub old_names: &'static str,
    /// The folder of Lua files whose functions `M.name` are members, each loaded when one of its functions is first used.
    pub lua_members: Option<&'static str>,
    /// What the module does without being called.
    pub hooks: Hooks,
    /// Which of its functions call the world outside: what they return is captured, and they are not called in a replay.
    pub outside: Outside,
    /// Whether wrong arguments are refused in the words that plugins of CoppeliaSim have in common.
    pub plugin_errors: bool,
}

impl Module {
    /// A module without anything: what others add to.
    pub const fn new(name: &'static str) -> Self {
        Self {
            name,
            about: "",
            functions: &[],
            inner: &[],
            constants: "",
            aliases: "",
            deprecated: "",
            reference: "",
            old_names: "",
            lua_members: None,
            hooks: Hooks::NONE,
            outside: Outside::Nothing,
            plugin_errors: false,
        }
    }

    /// Whether it is a plugin in CoppeliaSim, such as simUI; sim itself and Lua's libraries are not.
    pub(crate) fn is_plugin(&self) -> bool {
        self.name.len() > "sim".len() && self.name.starts_with("sim")
    }

    /// The functions for scripts, of all categories.
    pub fn public_functions(&self) -> impl Iterator<Item = &'static ApiFn> {
        self.functions.iter().flat_map(|(_, functions)| *functions)
    }

    /// The names the module has in CoppeliaSim.
    pub(crate) fn reference_names(&self) -> impl Iterator<Item = &'static str> {
        self.reference
            .lines()
            .filter_map(|line| line.split('\t').next())
    }

    /// Names of the reference that belong to the version after the one whose interface is here.
    pub(crate) fn later_names(&self) -> impl Iterator<Item = &'static str> {
        let columns = self.reference.lines().map(|line| line.split('\t'));
        columns.filter_map(|mut columns| {
            let name = columns.next()?;
            (columns.nth(1) == Some("later")).then_some(name)
        })
    }

    /// The Lua files whose functions are members, out of all embedded ones.
    pub fn member_files<'a>(
        &self,
        files: &'a [(&'static str, &'static str)],
    ) -> impl Iterator<Item = (&'static str, &'static str)> + 'a {
        let folder = self.lua_members;
        files
            .iter()
            .copied()
            .filter(move |(path, _)| folder.is_some_and(|folder| path.starts_with(folder)))
    }
}

/// Functions of a module that call the world outside: files, sockets, devices, programs. They call no scripts, change nothing that scripts see, and what they
/// return is all that scripts learn from them.
#[derive(Debug, Clone, Copy)]
pub enum Outside {
    /// None.
    Nothing,
    /// All, inner ones as well, but those with these names.
    AllBut(&'static [&'static str]),
    /// Those with these names.
    Only(&'static [&'static str]),
}

impl Outside {
    /// Whether a function is one of them.
    pub fn has(self, name: &str) -> bool {
        match self {
            Self::Nothing => false,
            Self::AllBut(names) => !names.contains(&name),
            Self::Only(names) => names.contains(&name),
        }
    }
}

/// The rows of a table of two columns.
pub fn pairs(table: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    table.lines().filter_map(|line| line.split_once('\t'))
}
