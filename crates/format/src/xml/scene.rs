//! A whole scene or model from elements and to elements: objects, the tree, scripts.

use std::collections::BTreeMap;

use super::document::{Document, Element};
use super::read::{Reading, put};
use super::side_files::SideFiles;
use super::table::Step;
use super::write::{Item, Writing};
use crate::ttt::chunks::MeshPool;
use crate::ttt::tree::Object;
use crate::ttt::{File, FileKind, FileResult, Header, Node, Skipped, object_node, object_of_node};

/// The elements of objects, and the types they are. The first of a type is written, in the simple variant the last.
const CLASSES: [(&str, &str); 14] = [
    ("shape", "Shape"),
    ("joint", "Joint"),
    ("graph", "Graph"),
    ("camera", "Camera"),
    ("light", "Light"),
    ("octree", "OcTree"),
    ("ocTree", "OcTree"),
    ("pointCloud", "PointCloud"),
    ("dummy", "Dummy"),
    ("script", "ScriptObject"),
    ("proximitySensor", "ProximitySensor"),
    ("visionSensor", "VisionSensor"),
    ("path", "Path"),
    ("forceSensor", "ForceSensor"),
];
/// Types that become dummies, so that the tree stays complete.
const GONE: [&str; 4] = ["mirror", "mill", "marker", "customSceneObject"];
/// Scripts attached to objects, and their types.
const ATTACHED: [(&str, i64); 2] = [("childScript", 1), ("customizationScript", 6)];
const MAIN_SCRIPT: i64 = 0;
/// Where this bit of a main script is clear, it is the default one.
const OWN_MAIN_SCRIPT: i64 = 0x8;
/// Collections have handles from here on.
const FIRST_COLLECTION: i32 = 2_000_000;

/// A script of an object: the object's handle, the type, the script.
type Attached = (i64, i64, Node);

/// An object of the simple variant and the place of its parent.
type Placed<'a> = (Element<'a>, Option<usize>);

/// # Errors
/// Describes the fault, with line, column and the names of the elements.
pub(super) fn read(document: &Document, side_files: SideFiles<'_>) -> FileResult<File> {
    let root = document.root().mark();
    let what = root
        .find(&["filetype"])
        .filter(|_| root.name() == "CoppeliaSim");
    let what = what.ok_or_else(|| {
        root.error("this is no scene or model of CoppeliaSim: `filetype` is missing")
    })?;
    let (simple, kind) = match what.mark().text().trim() {
        "simpleScene" => (true, FileKind::Scene),
        "simpleModel" => (true, FileKind::Model),
        "exhaustiveScene" => (false, FileKind::Scene),
        "exhaustiveModel" => (false, FileKind::Model),
        _ => return Err(what.error("the type is unknown")),
    };
    let header = header(root, kind, simple)?;
    let (references, pool) = (BTreeMap::new(), MeshPool::default());
    let mut reading = Reading {
        simple,
        references,
        side_files,
        pool,
        groups: 0,
    };
    let (objects, attached) = if simple {
        simple_objects(&mut reading, root)?
    } else {
        (objects(&mut reading, root)?, Vec::new())
    };
    let mut contents = reading.section("Contents", root)?;
    let own = contents
        .get("scripts")
        .and_then(|scripts| scripts.list().ok())
        .unwrap_or_default();
    let scripts = own.iter().cloned().chain(attached).collect();
    put(&mut contents, &[Step::Name("scripts")], Node::List(scripts));
    number_collections(&mut contents, simple);
    if let Some(camera) = placed(root)
        .iter()
        .position(|(element, _)| simple && is_main_camera(*element))
    {
        put(
            &mut contents,
            &[Step::Name("views")],
            view_of(numbers::count(camera)),
        );
    }
    let tree = Node::table([("header", header), ("contents", contents)]);
    let mut file = File::from_node(&tree).map_err(|what| root.error(what))?;
    (file.contents.objects, file.contents.mesh_pool) = (objects, Some(reading.pool));
    file.skipped = document.unused().map(skipped).collect();
    Ok(file)
}

/// Whether a camera of the simple variant is what the window shows.
fn is_main_camera(element: Element<'_>) -> bool {
    let flag = element
        .find(&["mainCamera"])
        .filter(|_| element.name() == "camera");
    flag.is_some_and(|flag| flag.mark().text().trim() == "true")
}

/// The pages of a window with one view.
fn view_of(camera: i64) -> Node {
    let view = Node::table([("linked_object", Node::Int(camera))]);
    let page = Node::table([
        ("page_type", Node::Int(0)),
        ("views", Node::List(vec![view])),
    ]);
    Node::table([
        ("pages", Node::List(vec![page])),
        ("active_page", Node::Int(0)),
    ])
}

fn skipped(element: Element<'_>) -> Skipped {
    Skipped {
        offset: element.offset(),
        path: element.path(),
        size: element.size(),
    }
}

/// Header with the version of the program that wrote the file: a number such as 41000, or 4.10.0.
fn header(root: Element<'_>, kind: FileKind, simple: bool) -> FileResult<Node> {
    let current = Header::current(kind);
    let _ = ["xmlSerializationNb", "prgFlavor", "modelThumbnail"]
        .map(|name| root.find(&[name]).map(Element::mark));
    let version = match root.find(&["prgVer"]) {
        Some(element) => version(element.mark().text().trim())
            .ok_or_else(|| element.error("this is no version"))?,
        None if simple => current.version.into(),
        None => return Err(root.error("`prgVer` is missing")),
    };
    let revision = root
        .find(&["prgRev"])
        .and_then(|element| element.mark().text().trim().parse().ok())
        .unwrap_or(0);
    // The serializations that releases began to write.
    let known = [
        (40_600, 25),
        (40_501, 24),
        (40_200, 23),
        (30_601, 22),
        (30_400, 21),
    ];
    let serialization = known
        .iter()
        .find(|(since, _)| version >= *since)
        .map_or(18, |(_, number)| *number);
    Ok(Node::table([
        ("serialization", Node::Int(serialization)),
        ("version", Node::Int(version)),
        ("revision", Node::Int(revision)),
        ("kind", Node::Int(kind as i64)),
    ]))
}

fn version(text: &str) -> Option<i64> {
    let parts = text
        .split('.')
        .map(|part| part.parse::<u16>().ok())
        .collect::<Option<Vec<u16>>>()?;
    let number = match parts.as_slice() {
        [number] => i64::from(*number),
        [major, minor, rest @ ..] if rest.len() < 2 => {
            10_000 * i64::from(*major)
                + 100 * i64::from(*minor)
                + rest.first().map_or(0, |patch| i64::from(*patch))
        }
        _ => return None,
    };
    u16::try_from(number).ok().map(i64::from)
}

fn class_of(element: &Element<'_>) -> Option<&'static str> {
    CLASSES
        .iter()
        .find(|(name, _)| *name == element.name())
        .map(|(_, class)| *class)
}

fn objects(reading: &mut Reading<'_>, root: Element<'_>) -> FileResult<Vec<Object>> {
    let mut objects = Vec::new();
    for wrapper in root.named("sceneObject") {
        let element = wrapper
            .mark()
            .children()
            .find(|child| child.find(&["common"]).is_some());
        let element = element
            .ok_or_else(|| wrapper.error("an object needs an element of its type with `common`"))?;
        let common = element.find(&["common"]).unwrap_or(element);
        let common = reading.section("Object", common)?;
        objects.push(object(reading, element, common)?);
    }
    Ok(objects)
}

fn object(reading: &mut Reading<'_>, element: Element<'_>, common: Node) -> FileResult<Object> {
    let (class, node) = match class_of(&element) {
        Some(class) => {
            let mut node = reading.section(class, element)?;
            if class == "Shape" && reading.simple {
                put(
                    &mut node,
                    &[Step::Name("geometry")],
                    reading.geometry(element)?,
                );
            }
            (class, node)
        }
        None => ("Unknown", Node::Bytes(b"XML".to_vec())),
    };
    if class == "Shape" && node.get("geometry").is_none() {
        return Err(element.error("a shape needs a `meshProxy` with a mesh or compound"));
    }
    let tree = Node::Table(vec![
        ("Object".to_owned(), common),
        (class.to_owned(), node),
    ]);
    let mut object = object_of_node(&tree).map_err(|what| element.error(what))?;
    object.offset = element.offset();
    Ok(object)
}

/// Objects within objects, and the scripts attached to them.
fn simple_objects(
    reading: &mut Reading<'_>,
    root: Element<'_>,
) -> FileResult<(Vec<Object>, Vec<Node>)> {
    let placed = placed(root);
    reading.references = references(root, &placed);
    let (mut objects, mut scripts) = (Vec::new(), Vec::new());
    for (handle, (element, parent)) in placed.iter().enumerate() {
        let mut common = match element.find(&["common"]) {
            Some(common) => reading.section("Object", common)?,
            None => Node::table([]),
        };
        let parent = parent.map_or(-1, numbers::count);
        put(
            &mut common,
            &[Step::Name("handles")],
            Node::List(vec![Node::Int(numbers::count(handle)), Node::Int(parent)]),
        );
        if common.get("alias").is_none() && common.get("name").is_none() {
            put(
                &mut common,
                &[Step::Name("alias")],
                Node::Text(element.name().to_owned()),
            );
        }
        objects.push(object(reading, *element, common)?);
        for (name, code) in ATTACHED {
            for script in element.named(name) {
                let mut script = reading.section("Script", script)?;
                let ids = [0, numbers::count(handle), code].map(Node::Int);
                put(&mut script, &[Step::Name("ids")], Node::List(ids.to_vec()));
                scripts.push(script);
            }
        }
    }
    Ok((objects, scripts))
}

/// All objects, parents before children.
fn placed(root: Element<'_>) -> Vec<Placed<'_>> {
    let is_object =
        |element: &Element<'_>| class_of(element).is_some() || GONE.contains(&element.name());
    let mut placed = Vec::new();
    let mut pending: Vec<Placed<'_>> = root
        .children()
        .filter(is_object)
        .map(|element| (element, None))
        .collect();
    pending.reverse();
    while let Some((element, parent)) = pending.pop() {
        let at = placed.len();
        placed.push((element, parent));
        let children: Vec<Element<'_>> = element.children().filter(is_object).collect();
        pending.extend(children.into_iter().rev().map(|child| (child, Some(at))));
    }
    placed
}

/// Objects are referred to by alias with a handle, by alias, or by their old name; collections by their name.
fn references(root: Element<'_>, placed: &[Placed<'_>]) -> BTreeMap<String, i32> {
    let mut references = BTreeMap::new();
    for (handle, (element, _)) in placed.iter().enumerate() {
        let text = |name| {
            element
                .find(&["common", name])
                .map(|found| found.text().trim().to_owned())
        };
        let alias = text("alias");
        let short = alias
            .as_ref()
            .and_then(|alias| alias.split('*').next().map(str::to_owned));
        for name in [alias, text("name"), short].into_iter().flatten() {
            references.entry(name).or_insert(numbers::count_i32(handle));
        }
    }
    for (collection, handle) in root.named("collection").zip(FIRST_COLLECTION..) {
        let name = collection
            .find(&["name"])
            .map(|name| name.text())
            .unwrap_or_default();
        references
            .entry(format!("@collection@{}", name.trim()))
            .or_insert(handle);
    }
    references
}

fn number_collections(contents: &mut Node, simple: bool) {
    if let Some(Node::List(collections)) = contents.get_mut("collections").filter(|_| simple) {
        for (collection, handle) in collections.iter_mut().zip(FIRST_COLLECTION..) {
            put(
                collection,
                &[Step::Name("handle")],
                Node::Int(handle.into()),
            );
        }
    }
}

/// The text of a file as the savers make it.
pub(super) fn write(file: &File, simple: bool) -> String {
    let mut file = file.clone();
    let pool = file.contents.mesh_pool.take().unwrap_or_default();
    let objects: Vec<Node> = std::mem::take(&mut file.contents.objects)
        .iter()
        .map(object_node)
        .collect();
    let mut tree = file.to_node();
    let mut root = Item::new("CoppeliaSim");
    let what = if file.contents.model_info.is_some() {
        "Model"
    } else {
        "Scene"
    };
    root.leaf(
        "filetype",
        format!("{}{what}", if simple { "simple" } else { "exhaustive" }),
    );
    root.leaf("xmlSerializationNb", "2");
    root.leaf("prgFlavor", "0");
    root.leaf("prgVer", file.header.version.to_string());
    root.leaf("prgRev", file.header.revision.to_string());
    let Some(contents) = tree.get_mut("contents") else {
        return root.print();
    };
    let writing = Writing {
        simple,
        pool: &pool,
        names: if simple {
            names(&objects, contents)
        } else {
            BTreeMap::new()
        },
    };
    if simple {
        let scripts = take_scripts(contents);
        let mut children = Children::new();
        objects
            .iter()
            .for_each(|object| children.entry(handles(object)[1]).or_default().push(object));
        write_children(&writing, -1, &mut children, &scripts, &mut root);
    } else {
        for object in &objects {
            write_object(&writing, object, root.push("sceneObject"));
        }
    }
    writing.section("Contents", contents, &mut root);
    root.print()
}

/// How objects and collections are called in references.
fn names(objects: &[Node], contents: &Node) -> BTreeMap<i64, String> {
    let mut names = BTreeMap::new();
    for object in objects {
        let [handle, _] = handles(object);
        let alias = object
            .get("Object")
            .and_then(|common| common.get("alias")?.bytes().ok())
            .unwrap_or_default();
        names.insert(handle, format!("{}*{handle}", crate::ttt::decode(&alias)));
    }
    for collection in contents
        .get("collections")
        .and_then(|list| list.list().ok())
        .unwrap_or_default()
    {
        let name = collection
            .get("name")
            .and_then(|name| name.bytes().ok())
            .unwrap_or_default();
        if let Some(handle) = collection
            .get("handle")
            .and_then(|handle| handle.int().ok())
        {
            names.insert(handle, format!("@collection@{}", crate::ttt::decode(&name)));
        }
    }
    names
}

fn handles(object: &Node) -> [i64; 2] {
    let pair = object
        .get("Object")
        .and_then(|common| common.get("handles")?.items::<2>().ok());
    pair.map_or([-1; 2], |pair| {
        pair.each_ref().map(|handle| handle.int().unwrap_or(-1))
    })
}

/// Takes the scripts attached to objects out of the contents, and a main script that is the default one.
fn take_scripts(contents: &mut Node) -> Vec<Attached> {
    let Some(Node::List(scripts)) = contents.get_mut("scripts") else {
        return Vec::new();
    };
    let ids = |script: &Node| {
        let ids = script.get("ids").and_then(|ids| ids.items::<3>().ok());
        ids.map_or([-1; 3], |ids| {
            ids.each_ref().map(|id| id.int().unwrap_or(-1))
        })
    };
    let is_own = |script: &Node| {
        script
            .get("switches")
            .and_then(|bits| bits.int().ok())
            .is_some_and(|bits| bits & OWN_MAIN_SCRIPT != 0)
    };
    let (mains, attached): (Vec<Node>, Vec<Node>) = std::mem::take(scripts)
        .into_iter()
        .partition(|script| ids(script)[2] == MAIN_SCRIPT);
    *scripts = mains.into_iter().filter(is_own).collect();
    attached
        .into_iter()
        .map(|script| (ids(&script)[1], ids(&script)[2], script))
        .collect()
}

/// Objects by the handle of their parent.
type Children<'a> = BTreeMap<i64, Vec<&'a Node>>;

fn write_children(
    writing: &Writing<'_>,
    parent: i64,
    children: &mut Children<'_>,
    scripts: &[Attached],
    out: &mut Item,
) {
    for object in children.remove(&parent).unwrap_or_default() {
        let [handle, _] = handles(object);
        let item = write_object(writing, object, out);
        for (_, code, script) in scripts.iter().filter(|(owner, ..)| *owner == handle) {
            if let Some((name, _)) = ATTACHED.iter().find(|(_, known)| known == code) {
                writing.section("Script", script, item.push(name));
            }
        }
        write_children(writing, handle, children, scripts, item);
    }
}

fn write_object<'a>(writing: &Writing<'_>, object: &Node, out: &'a mut Item) -> &'a mut Item {
    let Node::Table(entries) = object else {
        return out;
    };
    let of_class = entries.iter().find(|(name, _)| name != "Object");
    let (class, node) = of_class.map_or(("Dummy", object), |(name, node)| (name.as_str(), node));
    let mut names = CLASSES
        .iter()
        .filter(|(_, known)| *known == class)
        .map(|(name, _)| *name);
    let name = if writing.simple {
        names.next_back()
    } else {
        names.next()
    };
    let item = out.push(name.unwrap_or("dummy"));
    if let Some(common) = object.get("Object") {
        writing.section("Object", common, item.push("common"));
    }
    writing.section(class, node, item);
    if let Some(geometry) = node.get("geometry").filter(|_| writing.simple) {
        writing.geometry(geometry, item);
    }
    item
}
