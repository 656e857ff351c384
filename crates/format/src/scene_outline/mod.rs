//! Textual description of a scene or model, object by object: to look at, and to compare.
//!
//! A file is loaded and described as it would be saved today, so that files of different versions are told apart by what they say, not by
//! how they say it. Objects are known by their paths, not by handles.

mod compare;
mod lines;

use std::collections::BTreeMap;

use super::scene_file::{LoadedScript, SceneFile, save};
use super::ttt::chunks::MeshPool;
use super::ttt::node::{Node, NodeResult};
use super::ttt::{File, Indices, Rest};
pub use compare::differences;
use scene::object::script_object::ScriptType;
use scene::{Handle, Scene};

/// Fields that are other ones in each session, or follow from others.
const LEFT_OUT: [&str; 20] = [
    "signature",
    "handles",
    "child_order",
    "alias",
    "name",
    "alt_name",
    "dna",
    "persistent_id",
    "switches_2",
    "old_values",
    "old_inertia",
    "old_frame",
    "old_vertex_frame",
    "vertices_at",
    "indices_at",
    "normals_at",
    "edges_at",
    "ids",
    "cust_obj_handle",
    "screw_pitch",
];
/// Fields with the handle of an object, alone or as the first of a list.
const HANDLES: [&str; 5] = [
    "dependency",
    "linked_dummy",
    "tracked_and_size",
    "detectable",
    "renderable",
];

/// A scene or model in words.
pub struct Outline {
    /// In the order of the tree.
    pub objects: Vec<OutlineItem>,
    /// Simulation, physics, environment.
    pub settings: Vec<(String, String)>,
}

/// An object in words.
pub struct OutlineItem {
    /// Path in the tree, such as `/Robot/link`.
    pub path: String,
    /// How far below the top of the tree it is.
    pub depth: usize,
    /// What it is: the type of an object, of a script.
    pub kind: String,
    persistent_id: String,
    /// Fields as JSON, by the names that lead there.
    pub fields: Vec<(String, String)>,
    /// Its text, where it is a script, and those of scripts attached to it, by their names.
    pub scripts: Vec<(String, String)>,
    /// How many triangles it has.
    pub triangles: usize,
    /// Its meshes, by the names of the fields with their sums.
    meshes: BTreeMap<String, Mesh>,
}

/// A mesh as it is stored: three numbers for a vertex, three indices for a triangle.
struct Mesh {
    vertices: Vec<f32>,
    indices: Vec<i32>,
}

impl Outline {
    /// Describes the objects and settings of a file.
    ///
    /// # Errors
    /// When the scene is too large.
    pub fn new(file: SceneFile) -> NodeResult<Self> {
        let is_model = file.is_model();
        let mut scene = Scene::new();
        let loaded = file
            .add_to(&mut scene, !is_model)
            .map_err(|error| error.to_string())?;
        let saved = save::scene(&scene, &loaded.scripts).map_err(|error| error.to_string())?;
        let paths: BTreeMap<i64, String> = scene
            .objects()
            .map(scene::Object::handle)
            .map(|h| (h.raw(), path(&scene, h)))
            .collect();
        let mut objects: Vec<OutlineItem> = saved
            .contents
            .objects
            .iter()
            .map(|object| {
                let handle = object.common.handles.map_or(-1, |[handle, _]| handle);
                item(&scene, &paths, handle.into(), &saved, object)
            })
            .collect();
        attach(&mut objects, &paths, &loaded.scripts);
        Ok(Self {
            objects,
            settings: if is_model {
                Vec::new()
            } else {
                settings(&saved)
            },
        })
    }

    /// One line per fact, for tools that compare texts line by line.
    pub fn text(&self) -> String {
        let mut out = String::new();
        self.settings
            .iter()
            .for_each(|(name, value)| out += &format!("{name}: {value}\n"));
        for item in &self.objects {
            out += &format!("\n[{}] {}\n", item.path, item.kind);
            item.fields
                .iter()
                .for_each(|(name, value)| out += &format!("{name}: {value}\n"));
            for (name, text) in &item.scripts {
                out += &format!("{name}:\n");
                text.lines()
                    .for_each(|line| out += &format!("  | {line}\n"));
            }
        }
        out
    }
}

fn path(scene: &Scene, handle: Handle) -> String {
    scene.full_path(handle).unwrap_or_default()
}

fn item(
    scene: &Scene,
    paths: &BTreeMap<i64, String>,
    raw: i64,
    file: &File,
    object: &super::ttt::tree::Object,
) -> OutlineItem {
    let tree = super::ttt::object_node(object);
    let Node::Table(entries) = &tree else {
        unreachable!("objects are tables")
    };
    let kind = entries
        .iter()
        .map(|(name, _)| name.as_str())
        .find(|name| *name != "Object")
        .unwrap_or("Object");
    let mut walk = Walk {
        paths,
        pool: file.contents.mesh_pool.as_ref(),
        fields: Vec::new(),
        scripts: Vec::new(),
        meshes: BTreeMap::new(),
    };
    // Common attributes have no prefix, those of the type have its name.
    entries
        .iter()
        .for_each(|(name, node)| walk.visit(if name == "Object" { "" } else { name }, node));
    let id = object
        .common
        .persistent_id
        .as_ref()
        .map(crate::ttt::Text::decode)
        .unwrap_or_default();
    OutlineItem {
        path: paths.get(&raw).cloned().unwrap_or_default(),
        depth: Handle::from_raw(raw).map_or(0, |handle| scene.ancestors(handle).count()),
        kind: kind.to_owned(),
        persistent_id: id,
        fields: walk.fields,
        scripts: walk.scripts,
        triangles: walk
            .meshes
            .values()
            .map(|mesh| mesh.indices.len() / 3)
            .sum(),
        meshes: walk.meshes,
    }
}

/// On the way through the tree of an object.
struct Walk<'a> {
    paths: &'a BTreeMap<i64, String>,
    pool: Option<&'a MeshPool>,
    fields: Vec<(String, String)>,
    scripts: Vec<(String, String)>,
    meshes: BTreeMap<String, Mesh>,
}

impl Walk<'_> {
    fn visit(&mut self, name: &str, node: &Node) {
        match node {
            Node::Table(entries) => self.table(name, entries),
            Node::List(items) if items.iter().any(|item| matches!(item, Node::Table(_))) => {
                items
                    .iter()
                    .enumerate()
                    .for_each(|(i, item)| self.visit(&format!("{name}[{i}]"), item));
            }
            Node::Script(text) => self.scripts.push((
                "text".into(),
                String::from_utf8_lossy(without_mark(text)).into_owned(),
            )),
            _ => self.fields.push((name.to_owned(), in_line(node))),
        }
    }

    fn table(&mut self, name: &str, entries: &[(String, Node)]) {
        self.mesh(name, entries);
        for (key, node) in entries
            .iter()
            .filter(|(key, _)| !LEFT_OUT.contains(&key.as_str()))
        {
            let name = if name.is_empty() {
                key.clone()
            } else {
                format!("{name}.{key}")
            };
            if HANDLES.contains(&key.as_str()) {
                self.handle(&name, node);
            } else {
                self.visit(&name, node);
            }
        }
    }

    fn handle(&mut self, name: &str, node: &Node) {
        let (first, rest) = match node {
            Node::List(items) => (items.first(), items.get(1..).unwrap_or_default()),
            node => (Some(node), &[][..]),
        };
        let object = first
            .and_then(|node| self.paths.get(&node.int().ok()?))
            .map_or("none", String::as_str);
        let rest: String = rest
            .iter()
            .map(|node| format!(" {}", in_line(node)))
            .collect();
        self.fields
            .push((name.to_owned(), format!("{object}{rest}")));
    }

    /// A mesh by its numbers and a sum over its bytes.
    fn mesh(&mut self, name: &str, entries: &[(String, Node)]) {
        let place = |key: &str| {
            let (_, node) = entries.iter().find(|(name, _)| name == key)?;
            usize::try_from(node.int().ok()?).ok()
        };
        let Some(pool) = self.pool else { return };
        let (Some(vertices), Some(indices)) = (place("vertices_at"), place("indices_at")) else {
            return;
        };
        let (Some(Rest(vertices)), Some(Indices(indices))) =
            (pool.vertices.get(vertices), pool.indices.get(indices))
        else {
            return;
        };
        let bytes = vertices
            .iter()
            .flat_map(|n| n.to_le_bytes())
            .chain(indices.iter().flat_map(|n| n.to_le_bytes()));
        let sum = format!(
            "{} vertices, {} triangles, sum {:016x}",
            vertices.len() / 3,
            indices.len() / 3,
            sum(bytes)
        );
        let name = format!("{name}.triangles");
        self.meshes.insert(
            name.clone(),
            Mesh {
                vertices: vertices.clone(),
                indices: indices.clone(),
            },
        );
        self.fields.push((name, sum));
    }
}

fn in_line(node: &Node) -> String {
    node.print()
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

/// FNV-1a: the same everywhere.
fn sum(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |sum, byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// The saver puts a comment with the language before a text.
fn without_mark(text: &[u8]) -> &[u8] {
    text.strip_prefix(b"--lua\n")
        .or_else(|| text.strip_prefix(b"#python\n"))
        .unwrap_or(text)
}

/// Scripts outside of the tree belong to their objects; the main script to the first.
fn attach(objects: &mut [OutlineItem], paths: &BTreeMap<i64, String>, scripts: &[LoadedScript]) {
    for script in scripts {
        let owner = script.owner.and_then(|owner| paths.get(&owner.raw()));
        let at = owner.map_or(Some(0), |path| {
            objects.iter().position(|item| item.path == *path)
        });
        let name = match script.script_type {
            ScriptType::Main => "main script",
            ScriptType::Customization => "customization script",
            _ => "simulation script",
        };
        if let Some(item) = at.and_then(|at| objects.get_mut(at)) {
            item.scripts.push((
                name.into(),
                String::from_utf8_lossy(&script.code).into_owned(),
            ));
        }
    }
}

fn settings(file: &File) -> Vec<(String, String)> {
    let tree = file.to_node();
    let paths = BTreeMap::new();
    let mut walk = Walk {
        paths: &paths,
        pool: None,
        fields: Vec::new(),
        scripts: Vec::new(),
        meshes: BTreeMap::new(),
    };
    for part in ["simulation", "dynamics", "environment", "custom_data"] {
        if let Some(node) = tree.get("contents").and_then(|contents| contents.get(part)) {
            walk.visit(part, node);
        }
    }
    walk.fields
}
