//! The committed reference is what the sources say. `UPDATE=1 cargo test --test repository generated` rewrites it.

#![allow(clippy::disallowed_methods, reason = "UPDATE=1 asks for new files")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

#[test]
fn reference_is_current() {
    let files = docs::files();
    let stale: Vec<&str> = files
        .iter()
        .filter(|(path, text)| {
            fs::read_to_string(root().join(path)).map_or(true, |committed| committed != *text)
        })
        .map(|(path, _)| path.as_str())
        .collect();
    let left_over = left_over(&files);
    if std::env::var_os("UPDATE").is_some() {
        return update(&files, &left_over);
    }
    assert!(
        stale.is_empty(),
        "stale: {stale:?}\nrun UPDATE=1 cargo test --test repository generated"
    );
    assert!(left_over.is_empty(), "no longer generated: {left_over:?}");
}

/// The table on the first screen is that of the sources.
#[test]
fn readme_is_current() {
    let path = root().join("README.md");
    let readme = fs::read_to_string(&path).expect("README exists");
    let current = docs::with_overview(&readme).expect("README has the marks of the overview");
    if std::env::var_os("UPDATE").is_some() {
        return fs::write(path, current).expect("the repository is writable");
    }
    assert!(
        readme == current,
        "README.md is stale: run UPDATE=1 cargo test --test repository generated"
    );
}

#[test]
fn every_function_says_what_it_does() {
    let silent: Vec<String> = docs::functions()
        .into_iter()
        .filter(|f| f.text.is_empty() && f.alias_of.is_none())
        .map(|f| f.name)
        .collect();
    assert!(silent.is_empty(), "no documentation: {silent:?}");
}

#[test]
fn documented_parameters_exist() {
    let names: BTreeSet<String> = docs::functions().iter().map(|f| f.name.clone()).collect();
    assert!(
        names.contains("sim.getObjectPosition"),
        "the table of functions is read"
    );
    for function in docs::functions() {
        let mut seen = BTreeSet::new();
        for parameter in &function.parameters {
            assert!(
                seen.insert(&parameter.name),
                "{}: two parameters named {}",
                function.name,
                parameter.name
            );
        }
    }
}

/// Defaults are what a script could write in the place of the argument: code that runs, and names that exist.
#[test]
fn defaults_are_values_in_lua() {
    const CODE: &str = "function fault(default)
        local module = default:match '^(sim%w*)%.'
        local values = setmetatable({[module or false] = module and require(module)}, {__index = _G})
        local get, fault = load('return ' .. default, default, 't', values)
        if not get then return fault end
        local ok, value = pcall(get)
        if not ok then return value end
        if value == nil and default ~= 'nil' then return 'there is no such value' end
        return ''
    end";
    let mut sim = Simulator::new(Options::default());
    let sandbox = sim
        .add_script(ScriptKind::Sandbox, "defaults", CODE.as_bytes())
        .expect("the chunk runs");
    let mut faults = Vec::new();
    for function in docs::functions()
        .into_iter()
        .chain(docs::module_functions())
    {
        let is_parameter = |word: &str| {
            function
                .parameters
                .iter()
                .any(|parameter| parameter.name == word)
        };
        let defaults = function
            .parameters
            .iter()
            .filter_map(|parameter| parameter.default.as_deref());
        // What depends on another parameter is no value by itself.
        for default in defaults.filter(|default| !is_parameter(default.trim_start_matches('#'))) {
            let fault = sim
                .call(&sandbox, "fault", &[Data::text(default)])
                .expect("it runs");
            if fault != [Data::text("")] {
                faults.push(format!("{}: {default}: {fault:?}", function.name));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

/// Modules whose functions are described with types: what `require` returns is what the reference has. Where that is nothing, they are global,
/// and in a part of the module.
#[test]
fn modules_have_the_functions_their_pages_describe() {
    const MODULES: &[&str] = &[
        "base16",
        "base64",
        "copy",
        "functional",
        "itertools",
        "lfs",
        "mathx",
        "stringx",
        "tablex",
        "var",
        "simCmd",
        "simConvex",
        "simGeom",
        "simSubprocess",
        "simWS",
        "simZMQ",
    ];
    const CODE: &str = "function functions(module)
        local names = {}
        local loaded = require(module)
        if loaded == true then loaded = require(module .. '.functions') end
        for name, member in pairs(loaded) do
            if type(member) == 'function' and name ~= 'unittest' and name:sub(1, 1) ~= '_' then names[#names + 1] = name end
        end
        table.sort(names)
        return names
    end";
    let mut sim = Simulator::new(Options::default());
    let sandbox = sim
        .add_script(ScriptKind::Sandbox, "functions", CODE.as_bytes())
        .expect("the chunk runs");
    let functions = docs::module_functions();
    for module in MODULES {
        let described: Vec<String> = functions
            .iter()
            .filter(|f| f.category == *module && !f.name.ends_with(".unittest"))
            .map(|f| f.name.clone())
            .collect();
        let found = sim
            .call(&sandbox, "functions", &[Data::text(module)])
            .expect("the module loads");
        let [Data::Array(found)] = &found[..] else {
            panic!("a list of names: {found:?}")
        };
        let found = found.iter().map(|name| match name {
            Data::Text(name) => format!("{module}.{}", String::from_utf8_lossy(name)),
            other => panic!("a name: {other:?}"),
        });
        assert_eq!(described, found.collect::<Vec<_>>());
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Pages of categories that are no more.
fn left_over(files: &[(String, String)]) -> Vec<PathBuf> {
    let Ok(pages) = fs::read_dir(root().join("docs/api")) else {
        return Vec::new();
    };
    let generated: Vec<PathBuf> = files.iter().map(|(path, _)| root().join(path)).collect();
    pages
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| !generated.contains(path))
        .collect()
}

fn update(files: &[(String, String)], left_over: &[PathBuf]) {
    for (path, text) in files {
        let path = root().join(path);
        fs::create_dir_all(path.parent().expect("files lie in folders"))
            .expect("the repository is writable");
        fs::write(path, text).expect("the repository is writable");
    }
    left_over
        .iter()
        .for_each(|path| fs::remove_file(path).expect("the repository is writable"));
}
