//! Names of script files: the paths of their objects.

use std::collections::{BTreeMap, HashSet};

use crate::ttt::File;
use crate::ttt::tree::Object;
use scene::clean_alias;

/// Bytes of a name; longer aliases are cut, since systems limit the names of files.
const MAX_NAME_LENGTH: usize = 60;
/// Levels of folders; more are left out.
const MAX_DEPTH: usize = 20;

/// Names that have been given.
#[derive(Default)]
pub(super) struct Names {
    taken: HashSet<String>,
}

impl Names {
    /// The name with an extension; with a number where it has been given already. Some systems do not tell capitals apart.
    pub(super) fn free(&mut self, name: &str, extension: &str) -> String {
        let numbered = |n: usize| {
            if n == 1 {
                format!("scripts/{name}.{extension}")
            } else {
                format!("scripts/{name}-{n}.{extension}")
            }
        };
        (1..)
            .map(numbered)
            .find(|name| self.taken.insert(name.to_lowercase()))
            .unwrap_or_default()
    }
}

/// Names of scripts, by the positions of objects and of attached scripts in a file.
pub(super) struct ScriptNames {
    pub(super) objects: Vec<String>,
    pub(super) attached: Vec<String>,
}

pub(super) fn of_scripts(file: &File) -> ScriptNames {
    let objects = &file.contents.objects;
    let by_handle: BTreeMap<i32, &Object> = objects
        .iter()
        .filter_map(|object| Some((object.common.handles?[0], object)))
        .collect();
    let attached = file.contents.scripts.iter().map(|script| {
        let [_, owner, kind] = script.ids.unwrap_or([-1; 3]);
        let owner = by_handle
            .get(&owner)
            .or_else(|| by_handle.get(&script.cust_obj_handle?))
            .map(|o| path(o, &by_handle));
        match (kind, owner) {
            (0, _) => "main".to_owned(),
            (6, Some(owner)) => format!("{owner}/customization"),
            (_, Some(owner)) => format!("{owner}/simulation"),
            (_, None) => "script".to_owned(),
        }
    });
    ScriptNames {
        objects: objects
            .iter()
            .map(|object| path(object, &by_handle))
            .collect(),
        attached: attached.collect(),
    }
}

fn path(object: &Object, by_handle: &BTreeMap<i32, &Object>) -> String {
    let mut names = vec![alias(object)];
    let mut above = object;
    while let Some(parent) = above
        .common
        .handles
        .and_then(|[_, parent]| by_handle.get(&parent))
        .filter(|_| names.len() < MAX_DEPTH)
    {
        names.push(alias(parent));
        above = parent;
    }
    names.reverse();
    names.join("/")
}

fn alias(object: &Object) -> String {
    let common = &object.common;
    let name = common
        .alias
        .as_ref()
        .or(common.name.as_ref())
        .map(crate::ttt::Text::decode)
        .unwrap_or_default();
    let mut name = clean_alias(name.split('#').next().unwrap_or_default().as_bytes());
    name.truncate(MAX_NAME_LENGTH);
    name
}
