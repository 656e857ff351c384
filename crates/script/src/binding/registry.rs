//! Everything scripts of a simulator can reach, by name: made from a list of modules.

mod bind;

use std::borrow::Cow;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::{Arc, OnceLock};

use super::ApiFn;
use super::embedded::Embedded;
use super::hooks::Hooks;
use super::module::Module;
use super::states::States;
use crate::error::ApiError;

/// A native function, by its place in the registry of a simulator. Lua code holds it as a number, so that no pointer can be forged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct FunctionId(usize);

impl FunctionId {
    /// The number Lua keeps.
    pub(crate) fn number(self) -> usize {
        self.0
    }
}

/// A name of the reference that is not built, by its place in the registry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MissingId(usize);

impl MissingId {
    /// The number Lua keeps.
    pub(crate) fn number(self) -> usize {
        self.0
    }
}

/// A function CoppeliaSim has and Swanilda has not.
pub(crate) struct Missing {
    module: &'static str,
    name: &'static str,
    /// It belongs to the version after the one whose interface is here.
    is_later: bool,
}

impl Bound {
    /// The error in the words of the module the function belongs to.
    pub(crate) fn worded(&self, error: ApiError) -> ApiError {
        match error {
            ApiError::MoreArguments if self.plugin_errors => {
                ApiError::Other("not enough arguments".into())
            }
            ApiError::NotA { position, .. } if self.plugin_errors => {
                let parameter = usize::try_from(position - 1)
                    .ok()
                    .and_then(|place| self.function.params.get(place));
                parameter.map_or(error, |parameter| {
                    let expected = parameter.ty.split('[').next().unwrap_or_default();
                    ApiError::Other(format!(
                        "read in arg {position} ({}): expected {expected}",
                        parameter.name
                    ))
                })
            }
            // Of what should have been a table, the functions of sim name no position.
            ApiError::NotA {
                expected: "table", ..
            } if !self.is_plugin => ApiError::ArgumentType,
            _ => error,
        }
    }
}

impl Missing {
    pub(crate) fn error(&self) -> ApiError {
        let name = format!("{}.{}", self.module, self.name);
        ApiError::NotImplemented(if self.is_later {
            format!("{name}, which belongs to CoppeliaSim 4.11, the version after 4.10")
        } else {
            name
        })
    }
}

/// A name scripts can call, with the function behind it.
pub(crate) struct Bound {
    /// `module.name`, or a bare name for globals.
    pub name: Cow<'static, str>,
    /// The function's description and code.
    pub function: &'static ApiFn,
    /// The replacement of a deprecated name; empty without one.
    pub replacement: Option<&'static str>,
    /// As of its module.
    pub plugin_errors: bool,
    /// Whether it belongs to a plugin of CoppeliaSim: integers may be floats.
    pub is_plugin: bool,
    /// Whether it calls the world outside.
    pub is_outside: bool,
}

/// A member of a module.
#[derive(Debug, Clone, Copy)]
pub enum Member {
    /// An integer.
    Constant(i64),
    /// A function in Rust.
    Native(FunctionId),
    /// Implemented as `function` in the embedded Lua file `file`.
    Lua {
        /// The path of the embedded file.
        file: &'static str,
        /// The name of the function in that file.
        function: &'static str,
        /// What replaces a deprecated name; empty where nothing does.
        replacement: Option<&'static str>,
    },
    /// In CoppeliaSim's reference, but not built.
    Missing(MissingId),
}

/// A module with its names bound.
pub struct Namespace {
    /// The description the names were bound from.
    pub module: &'static Module,
    members: HashMap<&'static str, Member>,
    /// Names of constants and native functions as the module lists them.
    listed: Vec<&'static str>,
    /// Functions for the Lua part, by the last part of their names.
    pub inner: Vec<(&'static str, FunctionId)>,
    old_names: HashMap<&'static str, &'static str>,
    /// Functions that were never members, such as `simAddObjectCustomData`.
    old_functions: HashMap<&'static str, FunctionId>,
}

impl Namespace {
    /// The member with that name.
    pub fn get(&self, name: &str) -> Option<Member> {
        self.members.get(name).copied()
    }

    /// Whether there is a member with that name.
    pub fn contains(&self, name: &str) -> bool {
        self.members.contains_key(name)
    }

    /// Whether a name belongs to the version after the one whose interface is here, and is not built.
    pub fn is_later(&self, name: &str) -> bool {
        let is_missing = matches!(self.get(name), Some(Member::Missing(_)));
        is_missing && self.module.later_names().any(|later| later == name)
    }

    /// All names, in alphabetical order.
    pub fn names(&self) -> Vec<&'static str> {
        let mut names: Vec<&str> = self.members.keys().copied().collect();
        names.sort_unstable();
        names
    }

    /// The members that need no Lua file, in the order in which the module lists them, then what is missing, in alphabetical order.
    pub(crate) fn listed(&self) -> impl Iterator<Item = (&'static str, Member)> {
        let missing = self
            .names()
            .into_iter()
            .filter(|name| matches!(self.get(name), Some(Member::Missing(_))));
        self.listed
            .iter()
            .copied()
            .chain(missing)
            .filter_map(|name| Some((name, self.get(name)?)))
    }

    /// The function of a global name from before there were modules that became no member.
    pub(crate) fn old_function(&self, name: &str) -> Option<FunctionId> {
        self.old_functions.get(name).copied()
    }

    /// What a global name from before there were modules stands for: `simGetObjectHandle` is `sim.getObjectHandle`, `sim_handle_all` is
    /// `sim.handle_all`.
    pub fn of_global(&self, name: &str) -> Option<Member> {
        if let Some(id) = self.old_function(name) {
            return Some(Member::Native(id));
        }
        if let Some(member) = self.of_old_name(name) {
            return self.get(member);
        }
        self.get(&member_by_rule(name)?)
    }

    /// The member of a global name from before there were modules.
    pub fn of_old_name(&self, name: &str) -> Option<&'static str> {
        self.old_names.get(name).copied()
    }
}

/// The member that the global name of V-REP stands for, if it is one of the regular ones: `getObject` for `simGetObject`, `handle_all` for
/// `sim_handle_all`.
pub fn member_by_rule(global: &str) -> Option<String> {
    let rest = global.strip_prefix("sim")?;
    match (rest.strip_prefix('_'), rest.chars().next()?) {
        (Some(constant), _) => Some(constant.to_owned()),
        (None, first) if first.is_ascii_uppercase() => {
            Some(first.to_ascii_lowercase().to_string() + &rest[1..])
        }
        _ => None,
    }
}

/// The modules of one simulator.
pub struct Modules {
    /// Their names and functions.
    #[expect(
        clippy::redundant_allocation,
        reason = "what scripts hold of it is counted in the memory of the simulator"
    )]
    pub registry: Rc<Arc<Registry>>,
    /// Their state for the simulator.
    pub states: States,
}

/// Modules with their names bound. Simulators with the same modules share it.
pub struct Registry {
    functions: Vec<Bound>,
    missing: Vec<Missing>,
    /// Functions that are globals, with their names.
    pub globals: Vec<(&'static str, FunctionId)>,
    /// In the order of the list; `sim` is the first.
    namespaces: Vec<Namespace>,
    by_name: HashMap<&'static str, usize>,
    /// Of all modules, in their order.
    pub hooks: Vec<Hooks>,
    /// Embedded Lua files by path.
    pub files: HashMap<&'static str, Embedded>,
    result_types: OnceLock<ResultTypes>,
}

/// By function, with its module.
type ResultTypes = HashMap<&'static str, Vec<&'static str>>;

impl Registry {
    /// Binds `modules`, of which the first is `sim`. `files` are the paths and texts of the embedded Lua files.
    pub fn new(
        modules: &[&'static Module],
        files: &'static [(&'static str, &'static str)],
    ) -> Self {
        let mut registry = Self {
            functions: Vec::new(),
            missing: Vec::new(),
            globals: Vec::new(),
            namespaces: Vec::new(),
            by_name: HashMap::new(),
            hooks: modules.iter().map(|module| module.hooks).collect(),
            files: files
                .iter()
                .map(|&(name, source)| (name, Embedded::new(source)))
                .collect(),
            result_types: OnceLock::new(),
        };
        for (place, &module) in modules.iter().enumerate() {
            let namespace = registry.bind(module, files);
            registry.namespaces.push(namespace);
            registry.by_name.insert(module.name, place);
        }
        registry
    }

    /// The module `sim`.
    pub fn members_of_sim(&self) -> &Namespace {
        &self.namespaces[0]
    }

    /// The module with that name.
    pub fn module(&self, name: &str) -> Option<&Namespace> {
        self.by_name.get(name).map(|&place| &self.namespaces[place])
    }

    /// The member of the name `module.member`, or of a global function.
    pub fn find(&self, name: &str) -> Option<Member> {
        match name.rsplit_once('.') {
            Some((module, member)) => self.module(module)?.get(member),
            None => {
                let global = self
                    .globals
                    .iter()
                    .find(|(global, _)| *global == name)
                    .map(|&(_, id)| id);
                let old = || self.namespaces.first()?.old_function(name);
                global.or_else(old).map(Member::Native)
            }
        }
    }

    /// The function `module.name` that only the Lua part of the module has.
    pub fn find_inner(&self, name: &str) -> Option<Member> {
        let (module, member) = name.rsplit_once('.')?;
        let mut inner = self.module(module)?.inner.iter();
        let found = inner.find(|(own, _)| *own == member)?;
        Some(Member::Native(found.1))
    }

    pub(crate) fn missing_function(&self, id: MissingId) -> &Missing {
        &self.missing[id.0]
    }

    /// The function that Lua code has by `number`; None for an unknown number.
    pub(crate) fn function(&self, number: usize) -> Option<&Bound> {
        self.functions.get(number)
    }

    /// The missing function that Lua code knows by `number`.
    pub(crate) fn missing(&self, number: usize) -> Option<&Missing> {
        self.missing.get(number)
    }

    pub(crate) fn bound(&self, id: FunctionId) -> &Bound {
        &self.functions[id.0]
    }

    /// The text of the main script of a scene that has none of its own; empty when the registry has no files.
    pub fn main_script(&self) -> &'static str {
        self.files.get("main").map_or("", |file| file.source)
    }

    /// The types that a function is declared to return: a native one by its row, one in Lua by the comment above it. None without any.
    pub fn result_types(&self, name: &str) -> Option<&[&'static str]> {
        self.result_types
            .get_or_init(|| heap::outside(|| self.declared_result_types()))
            .get(name)
            .map(Vec::as_slice)
    }

    fn declared_result_types(&self) -> ResultTypes {
        let functions = self
            .namespaces
            .iter()
            .flat_map(|namespace| namespace.module.public_functions());
        let native = functions.map(|function| (function.name, function.returns.to_vec()));
        let lines = self.files.values().flat_map(|file| file.source.lines());
        let comments = lines.filter_map(|line| line.strip_prefix("-- @api "));
        native
            .chain(comments.filter_map(declared_in_comment))
            .filter(|(_, types)| !types.is_empty())
            .collect()
    }
}

/// `int a, float[3] b = module.name(...)`.
fn declared_in_comment(declaration: &'static str) -> Option<(&'static str, Vec<&'static str>)> {
    let (results, name) = declaration.split_once('(')?.0.rsplit_once(" = ")?;
    let types = results
        .split(',')
        .filter_map(|result| result.trim().split(' ').next());
    Some((name.trim(), types.collect()))
}

#[cfg(test)]
mod tests {
    use super::{Member, Module, Registry};

    #[test]
    fn members_are_listed_before_what_is_missing() {
        static MODULE: Module = Module {
            constants: "second\t2\nfirst\t1\n",
            reference: "z\nfirst\na\n",
            ..Module::new("m")
        };
        let registry = Registry::new(&[&MODULE], &[]);
        let listed: Vec<_> = registry
            .module("m")
            .expect("it was bound")
            .listed()
            .collect();
        let names: Vec<_> = listed.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, ["second", "first", "a", "z"]);
        assert!(matches!(listed[1].1, Member::Constant(1)));
        assert!(matches!(listed[2].1, Member::Missing(_)));
    }
}
