//! glTF 2.0, JSON or binary: the triangles of its scene, placed by its nodes; or its nodes with their meshes, cameras and lights. Points, lines,
//! animations, skins (which are read in the pose of their mesh) and vertex colours are left out; extensions that a file requires are refused.

mod accessor;
mod asset;
mod buffers;
mod material;
mod primitive;
mod read_asset;
mod scene;
mod viewers;
mod write;

use std::rc::Rc;

pub use asset::{Animation, Asset, Camera, Extent, Light, LightKind, Node, Track};
use serde_json::Value;
pub(crate) use write::write;

use crate::Resolve;
use crate::error::{Location, ReadError, Result};
use crate::limits::Limits;
use crate::mesh_file::{MeshFile, Part, UpAxis};
use buffers::Buffers;

/// Extensions that change nothing for meshes, or that are read.
const KNOWN_EXTENSIONS: &[&str] = &[
    "KHR_materials_unlit",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_ior",
    "KHR_materials_emissive_strength",
    "KHR_materials_clearcoat",
    "KHR_materials_transmission",
    "KHR_texture_transform",
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "EXT_texture_webp",
];

/// What was read already, and the file so far.
struct Reader<'a, 'r> {
    root: &'a Value,
    buffers: Buffers<'a>,
    /// Of each mesh, once it was read.
    meshes: Vec<Option<Rc<Vec<Part>>>>,
    /// Of each image, once it was looked up: its number among the textures.
    images: Vec<Option<Option<usize>>>,
    limits: Limits,
    file: MeshFile,
    resolve: Resolve<'r>,
}

/// The triangles of a file.
pub(crate) fn read(bytes: &[u8], limits: Limits, resolve: Resolve) -> Result<MeshFile> {
    with_reader(bytes, limits, resolve, |mut reader| {
        reader.flatten()?;
        Ok(reader.file)
    })
}

fn with_reader<T>(
    bytes: &[u8],
    limits: Limits,
    resolve: Resolve,
    use_it: impl FnOnce(Reader<'_, '_>) -> Result<T>,
) -> Result<T> {
    let (json, binary) = buffers::container(bytes)?;
    let root: Value = serde_json::from_slice(json).map_err(not_json)?;
    let version = string(&root["asset"], "version").unwrap_or("");
    if !version.starts_with("2.") {
        return Err(ReadError::new(
            Location::File,
            "asset",
            format!("version {version:?} instead of 2.0"),
        ));
    }
    check_extensions(&root)?;
    use_it(Reader {
        root: &root,
        buffers: Buffers::load(&root, binary, resolve)?,
        meshes: vec![None; list(&root, "meshes").len()],
        images: vec![None; list(&root, "images").len()],
        limits,
        file: MeshFile {
            unit: Some(1.0),
            up: Some(UpAxis::Y),
            ..MeshFile::default()
        },
        resolve,
    })
}

fn not_json(error: serde_json::Error) -> ReadError {
    ReadError::new(Location::Line(error.line()), "JSON", error.to_string())
}

fn check_extensions(root: &Value) -> Result<()> {
    let required = list(root, "extensionsRequired")
        .iter()
        .filter_map(Value::as_str);
    match required
        .into_iter()
        .find(|name| !KNOWN_EXTENSIONS.contains(name))
    {
        None => Ok(()),
        Some(name) => Err(ReadError::new(
            Location::File,
            "extensionsRequired",
            format!("{name} is not supported"),
        )),
    }
}

/// An array of an object; empty if there is none.
fn list<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value
        .get(name)
        .and_then(Value::as_array)
        .map_or(&[], Vec::as_slice)
}

fn string<'a>(value: &'a Value, name: &str) -> Option<&'a str> {
    value.get(name)?.as_str()
}

/// A count, length or index: `None` if it is not there.
fn integer(value: &Value, name: &str, element: &str) -> Result<Option<usize>> {
    let Some(member) = value.get(name) else {
        return Ok(None);
    };
    let integer = member
        .as_u64()
        .and_then(|integer| usize::try_from(integer).ok());
    integer
        .map(Some)
        .ok_or_else(|| refused(element, format!("{name} is no count")))
}

/// `N` numbers: `None` if they are not there.
fn numbers<const N: usize>(value: &Value, name: &str, element: &str) -> Result<Option<[f64; N]>> {
    let Some(member) = value.get(name) else {
        return Ok(None);
    };
    let numbers: Option<Vec<f64>> = member
        .as_array()
        .and_then(|array| array.iter().map(Value::as_f64).collect());
    match numbers.and_then(|numbers| numbers.try_into().ok()) {
        Some(numbers) => Ok(Some(numbers)),
        None => Err(refused(element, format!("{name} must be {N} numbers"))),
    }
}

/// Element `index` of an array of the file.
fn item<'a>(root: &'a Value, array: &str, index: usize) -> Result<&'a Value> {
    list(root, array)
        .get(index)
        .ok_or_else(|| refused(array, format!("{index} of {}", list(root, array).len())))
}

fn refused(element: impl Into<String>, problem: impl Into<String>) -> ReadError {
    ReadError::new(Location::File, element, problem)
}
