//! What a module lists becomes its members: constants, functions in Rust and in Lua, other names for them, and what is missing.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use super::super::ApiFn;
use super::super::module::{Module, pairs};
use super::{Bound, FunctionId, Member, Missing, MissingId, Namespace, Registry};

impl Registry {
    pub(super) fn bind(
        &mut self,
        module: &'static Module,
        files: &[(&'static str, &'static str)],
    ) -> Namespace {
        let deprecated: HashMap<&str, &'static str> = pairs(module.deprecated).collect();
        let mut namespace = Namespace {
            module,
            members: HashMap::new(),
            listed: Vec::new(),
            inner: Vec::new(),
            old_names: pairs(module.old_names).collect(),
            old_functions: HashMap::new(),
        };
        self.add_missing(&mut namespace);
        add_constants(&mut namespace);
        add_lua_members(&mut namespace, files, &deprecated);
        for function in module.public_functions() {
            self.add_function(&mut namespace, function, &deprecated);
        }
        for function in module.inner.iter().copied().flatten() {
            let id = self.add(function.name.into(), function, None, namespace.module);
            namespace.inner.push((last_part(function.name), id));
        }
        for (old, new) in pairs(module.old_names) {
            if let Some(id) = namespace.old_function(new) {
                namespace.old_functions.insert(old, id);
            }
        }
        self.add_aliases(&mut namespace, &deprecated);
        namespace
    }

    /// Names of the reference; implemented functions replace them.
    fn add_missing(&mut self, namespace: &mut Namespace) {
        let module = namespace.module;
        let later: HashSet<&str> = module.later_names().collect();
        for name in module.reference_names() {
            self.missing.push(Missing {
                module: module.name,
                name,
                is_later: later.contains(name),
            });
            namespace
                .members
                .insert(name, Member::Missing(MissingId(self.missing.len() - 1)));
        }
    }

    fn add(
        &mut self,
        name: Cow<'static, str>,
        function: &'static ApiFn,
        replacement: Option<&'static str>,
        module: &Module,
    ) -> FunctionId {
        self.functions.push(Bound {
            name,
            function,
            replacement,
            plugin_errors: module.plugin_errors,
            is_plugin: module.is_plugin(),
            is_outside: module.outside.has(function.name),
        });
        FunctionId(self.functions.len() - 1)
    }

    fn add_function(
        &mut self,
        namespace: &mut Namespace,
        function: &'static ApiFn,
        deprecated: &HashMap<&str, &'static str>,
    ) {
        if !function.name.contains('.') {
            let id = self.add(function.name.into(), function, None, namespace.module);
            if function.name.starts_with("sim") {
                namespace.old_functions.insert(function.name, id);
            } else {
                self.globals.push((function.name, id));
            }
            return;
        }
        let member = last_part(function.name);
        let id = self.add(
            function.name.into(),
            function,
            deprecated.get(member).copied(),
            namespace.module,
        );
        namespace.members.insert(member, Member::Native(id));
        namespace.listed.push(member);
    }

    fn add_aliases(&mut self, namespace: &mut Namespace, deprecated: &HashMap<&str, &'static str>) {
        for (old, new) in pairs(namespace.module.aliases) {
            let global = self
                .globals
                .iter()
                .find(|(name, _)| *name == new)
                .map(|&(_, id)| Member::Native(id));
            let replacement = deprecated.get(old).copied();
            let member = match namespace.get(new).filter(|_| old != new).or(global) {
                Some(Member::Native(id)) => {
                    let name = format!("{}.{old}", namespace.module.name).into();
                    Member::Native(self.add(
                        name,
                        self.bound(id).function,
                        replacement,
                        namespace.module,
                    ))
                }
                Some(Member::Lua { file, function, .. }) => Member::Lua {
                    file,
                    function,
                    replacement,
                },
                Some(Member::Constant(_) | Member::Missing(_)) | None => continue,
            };
            namespace.members.insert(old, member);
            namespace.listed.push(old);
        }
    }
}

fn last_part(name: &'static str) -> &'static str {
    name.rsplit('.').next().unwrap_or(name)
}

fn add_constants(namespace: &mut Namespace) {
    for (name, value) in pairs(namespace.module.constants) {
        let value = value
            .parse()
            .expect("a table of constants holds integers, which a test reads");
        namespace.members.insert(name, Member::Constant(value));
        namespace.listed.push(name);
    }
}

/// Functions of the module's Lua files: each is a line `function M.name(`.
fn add_lua_members(
    namespace: &mut Namespace,
    files: &[(&'static str, &'static str)],
    deprecated: &HashMap<&str, &'static str>,
) {
    for (file, source) in namespace.module.member_files(files) {
        let declarations = source
            .lines()
            .filter_map(|line| line.strip_prefix("function M."));
        for function in declarations.filter_map(|declaration| declaration.split('(').next()) {
            let replacement = deprecated.get(function).copied();
            namespace.members.insert(
                function,
                Member::Lua {
                    file,
                    function,
                    replacement,
                },
            );
        }
    }
}
