//! Scenes and models as folders that people and version control can read: `scene.json` with all chunks by name, scripts as `.lua` files,
//! meshes as `.obj` files, other bytes as they are. A folder says all that its file said.
//!
//! JSON rather than TOML: trees of meshes within objects nest deeper than TOML's tables read well, and every language has a reader.

mod edits;
mod names;
mod obj;

use std::path::{Component, Path};

use crate::scene_file::ScriptSources;
use crate::ttt::File;
use crate::ttt::chunks::{MeshData, MeshNode};
use crate::ttt::mesh_arrays::MeshArrays;
use crate::ttt::node::{Node, NodeResult, at};
use crate::ttt::tree::{Class, MeshTree};
pub use edits::{Edits, note};
use names::Names;
use permissions::Permissions;

/// The file with the tree.
const TREE: &str = "scene.json";
/// Folders that belong to a scene; what is in them is replaced.
const PARTS: [&str; 3] = [SCRIPTS, "meshes", "data"];
const SCRIPTS: &str = "scripts";
/// Byte strings up to this length are stored in the tree.
const SHORT: usize = 64;

/// Whether a folder is an unpacked scene.
pub fn is_scene(folder: &Path) -> bool {
    folder.join(TREE).is_file()
}

/// The same where permissions say what is read.
pub(crate) fn is_read_as_scene(folder: &Path, permissions: &Permissions) -> bool {
    permissions.is_file(&folder.join(TREE))
}

/// Writes a file as a folder, in place of an earlier one.
///
/// # Errors
/// When the folder holds something else, or edits that are to be kept, cannot be written, or the meshes of the file are damaged.
pub fn unpack(file: &File, folder: &Path, edits: Edits) -> NodeResult<()> {
    let is_new = std::fs::read_dir(folder).map_or(true, |mut entries| entries.next().is_none());
    if !is_new && !is_scene(folder) {
        return Err(format!(
            "{} is not empty, and no unpacked scene",
            folder.display()
        ));
    }
    if !is_new && edits == Edits::Keep && would_lose_edits(file, folder)? {
        return Err(format!(
            "{0}: files in it were changed since it was unpacked, and would be lost. `swanilda pack {0} FILE` saves them first, --force replaces them",
            folder.display()
        ));
    }
    write(file, folder)?;
    note(folder).map_err(|error| format!("{}: {error}", folder.display()))
}

/// Whether the folder has files that neither its last unpacking made nor this one would.
fn would_lose_edits(file: &File, folder: &Path) -> NodeResult<bool> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    if edits::are_as_noted(folder).map_err(failed)? == Some(true) {
        return Ok(false);
    }
    let fresh = tempfile::tempdir().map_err(failed)?;
    write(file, fresh.path())?;
    let [new, old] = [fresh.path(), folder].map(edits::checksum);
    Ok(new.map_err(failed)? != old.map_err(failed)?)
}

fn write(file: &File, folder: &Path) -> NodeResult<()> {
    for part in PARTS
        .map(|part| folder.join(part))
        .iter()
        .filter(|part| part.is_dir())
    {
        std::fs::remove_dir_all(part).map_err(|error| format!("{}: {error}", part.display()))?;
    }
    let mut outside = Outside {
        folder,
        names: Names::default(),
        blobs: 0,
    };
    let mut file = file.clone();
    let scripts = names::of_scripts(&file);
    for (number, text) in take_meshes(&mut file)?.into_iter().enumerate() {
        outside.write(&mesh_name(numbers::count_i32(number)), text.as_bytes())?;
    }
    let mut tree = file.to_node();
    if let Some(Node::List(objects)) = tree
        .get_mut("contents")
        .and_then(|contents| contents.get_mut("objects"))
    {
        objects
            .iter_mut()
            .zip(&scripts.objects)
            .try_for_each(|(object, name)| outside.put(object, name))?;
    }
    if let Some(Node::List(attached)) = tree
        .get_mut("contents")
        .and_then(|contents| contents.get_mut("scripts"))
    {
        attached
            .iter_mut()
            .zip(&scripts.attached)
            .try_for_each(|(script, name)| outside.put(script, name))?;
    }
    outside.put(&mut tree, "file")?;
    outside.write(TREE, (tree.print() + "\n").as_bytes())
}

/// The file an unpacked scene says.
///
/// # Errors
/// Describes the fault and its place in the tree.
pub fn pack(folder: &Path, permissions: &Permissions) -> NodeResult<File> {
    let inside = Inside {
        folder,
        permissions,
    };
    let mut tree = inside.tree()?;
    inside.bring_in(&mut tree)?;
    let mut file = at(TREE, File::from_node(&tree))?;
    inside.put_meshes(&mut file)?;
    Ok(file)
}

/// Which files of an unpacked scene hold the texts of its scripts.
///
/// # Errors
/// When the tree of the folder may not or cannot be read.
pub fn sources(folder: &Path, permissions: &Permissions) -> NodeResult<ScriptSources> {
    let tree = Inside {
        folder,
        permissions,
    }
    .tree()?;
    let list = |name: &str| match tree.get("contents").and_then(|contents| contents.get(name)) {
        Some(Node::List(items)) => items
            .iter()
            .map(|item| Some(path_of(folder, source(item)?)))
            .collect(),
        _ => Vec::new(),
    };
    Ok(ScriptSources {
        objects: list("objects"),
        attached: list("scripts"),
    })
}

fn path_of(folder: &Path, name: &str) -> String {
    folder.join(name).to_string_lossy().into_owned()
}

/// The file of the script of an object.
fn source(node: &Node) -> Option<&str> {
    let Node::Table(entries) = node else {
        return None;
    };
    entries.iter().find_map(|(key, item)| match item {
        Node::Text(name) if key == "file" && name.starts_with(SCRIPTS) => Some(name.as_str()),
        _ => source(item),
    })
}

fn mesh_name(number: i32) -> String {
    format!("meshes/{number}.obj")
}

/// Files written beside the tree.
struct Outside<'a> {
    folder: &'a Path,
    names: Names,
    blobs: usize,
}

impl Outside<'_> {
    /// Writes scripts and long bytes of a tree to files, whose names take their places. Scripts are called `name`.
    fn put(&mut self, node: &mut Node, name: &str) -> NodeResult<()> {
        match node {
            Node::Script(text) => {
                let file = self.names.free(name, "lua");
                self.write(&file, text)?;
                *node = Node::table([("file", Node::Text(file))]);
            }
            Node::Bytes(bytes) if bytes.len() > SHORT => {
                let file = format!("data/{}.bin", self.blobs);
                self.blobs += 1;
                self.write(&file, bytes)?;
                *node = Node::table([("file", Node::Text(file))]);
            }
            Node::List(items) => items.iter_mut().try_for_each(|item| self.put(item, name))?,
            Node::Table(entries) => entries
                .iter_mut()
                .try_for_each(|(_, item)| self.put(item, name))?,
            _ => {}
        }
        Ok(())
    }

    fn write(&self, name: &str, bytes: &[u8]) -> NodeResult<()> {
        let path = self.folder.join(name);
        let folder = path.parent().unwrap_or(self.folder);
        let written = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(&path, bytes));
        written.map_err(|error| format!("{}: {error}", path.display()))
    }
}

/// Files read beside the tree.
struct Inside<'a> {
    folder: &'a Path,
    permissions: &'a Permissions,
}

impl Inside<'_> {
    /// A file of the folder; never one outside of it, except by a link to what may be read.
    fn read(&self, name: &str) -> NodeResult<Vec<u8>> {
        if !Path::new(name)
            .components()
            .all(|part| matches!(part, Component::Normal(_)))
        {
            return Err(format!("`{name}` is not in the folder"));
        }
        let path = self.folder.join(name);
        self.permissions
            .read_file(&path)
            .map_err(|error| format!("{}: {error}", path.display()))
    }

    fn tree(&self) -> NodeResult<Node> {
        let text = String::from_utf8(self.read(TREE)?).map_err(|error| error.to_string());
        at(TREE, text.and_then(|text| Node::parse(&text)))
    }

    /// Puts files in the places of their names.
    fn bring_in(&self, node: &mut Node) -> NodeResult<()> {
        match node {
            Node::Table(entries) => {
                if let [(key, Node::Text(name))] = entries.as_slice()
                    && key == "file"
                {
                    *node = Node::Bytes(self.read(name)?);
                    return Ok(());
                }
                entries
                    .iter_mut()
                    .try_for_each(|(_, item)| self.bring_in(item))
            }
            Node::List(items) => items.iter_mut().try_for_each(|item| self.bring_in(item)),
            _ => Ok(()),
        }
    }

    fn put_meshes(&self, file: &mut File) -> NodeResult<()> {
        let mut arrays = MeshArrays::default();
        let mut known = std::collections::HashMap::new();
        let mut any = false;
        for_each_mesh(file, &mut |data| {
            let Some(number) = data.vertices_at else {
                return Ok(());
            };
            any = true;
            let places = match known.get(&number) {
                Some(places) => *places,
                None => {
                    let name = mesh_name(number);
                    let places = arrays.add(at(
                        &name,
                        self.read(&name).and_then(|text| obj::read(&text)),
                    )?);
                    *known.entry(number).or_insert(places)
                }
            };
            [
                data.vertices_at,
                data.indices_at,
                data.normals_at,
                data.edges_at,
            ] = places;
            Ok(())
        })?;
        file.contents.mesh_pool = any.then_some(arrays.pool);
        Ok(())
    }
}

/// All meshes of a file, in its order.
fn for_each_mesh(
    file: &mut File,
    visit: &mut impl FnMut(&mut MeshData) -> NodeResult<()>,
) -> NodeResult<()> {
    fn of_group(
        group: &mut MeshNode,
        visit: &mut impl FnMut(&mut MeshData) -> NodeResult<()>,
    ) -> NodeResult<()> {
        group.children.iter_mut().try_for_each(|child| match child {
            MeshTree::Mesh(mesh) => visit(&mut mesh.data),
            MeshTree::Group(group) => of_group(group, visit),
        })
    }
    for object in &mut file.contents.objects {
        let Class::Shape(shape) = &mut object.class else {
            continue;
        };
        let Some(geometry) = &mut shape.geometry else {
            continue;
        };
        geometry
            .mesh
            .iter_mut()
            .try_for_each(|mesh| visit(&mut mesh.data))?;
        geometry
            .group
            .iter_mut()
            .try_for_each(|group| of_group(group, visit))?;
    }
    Ok(())
}

/// Takes the shared arrays out of a file. Each mesh then has the number of a text in OBJ format as that of its vertices.
fn take_meshes(file: &mut File) -> NodeResult<Vec<String>> {
    let Some(pool) = file.contents.mesh_pool.take() else {
        return Ok(Vec::new());
    };
    let (mut known, mut texts) = (std::collections::HashMap::new(), Vec::new());
    for_each_mesh(file, &mut |data| {
        let places = [
            data.vertices_at.take(),
            data.indices_at.take(),
            data.normals_at.take(),
            data.edges_at.take(),
        ];
        let number = match known.get(&places) {
            Some(number) => *number,
            None => {
                texts.push(obj::write(&pool, places)?);
                *known
                    .entry(places)
                    .or_insert(numbers::count_i32(texts.len()) - 1)
            }
        };
        data.vertices_at = Some(number);
        Ok(())
    })?;
    Ok(texts)
}

/// The array at a place.
fn find<T>(list: &[T], place: Option<i32>) -> Option<&T> {
    list.get(usize::try_from(place?).ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::tests::{own_files, real_files};

    #[test]
    fn an_unpacked_scene_packs_to_the_same() {
        for path in own_files().into_iter().chain(real_files()) {
            let what = path.display().to_string();
            let file = File::read(&std::fs::read(&path).unwrap()).unwrap();
            let folder = tempfile::tempdir().unwrap();
            unpack(&file, folder.path(), Edits::Keep).unwrap_or_else(|e| panic!("{what}: {e}"));
            let packed =
                pack(folder.path(), &Permissions::all()).unwrap_or_else(|e| panic!("{what}: {e}"));
            let (mut a, mut b) = (file, packed.clone());
            assert_eq!(
                take_meshes(&mut a).unwrap(),
                take_meshes(&mut b).unwrap(),
                "{what}: other meshes"
            );
            // As text, since numbers that are none differ from themselves.
            assert!(
                a.to_node().print() == b.to_node().print(),
                "{what}: another tree"
            );
            let again = tempfile::tempdir().unwrap();
            unpack(&packed, again.path(), Edits::Keep).unwrap();
            let tree = |folder: &Path| std::fs::read(folder.join(TREE)).unwrap();
            assert_eq!(tree(folder.path()), tree(again.path()), "{what}");
        }
    }

    #[test]
    fn folders_of_others_are_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("mine.txt"), "x").unwrap();
        let file = File::read(&std::fs::read(&own_files()[0]).unwrap()).unwrap();
        assert!(
            unpack(&file, folder.path(), Edits::Keep)
                .unwrap_err()
                .contains("not empty")
        );
        assert!(pack(folder.path(), &Permissions::all()).is_err());
    }

    #[test]
    fn nothing_outside_of_the_folder_is_read() {
        for name in ["/etc/passwd", "../scene.json", "a/../../b", "."] {
            let inside = Inside {
                folder: Path::new("."),
                permissions: &Permissions::all(),
            };
            assert!(
                inside.read(name).unwrap_err().contains("not in the folder"),
                "{name}"
            );
        }
    }
}
