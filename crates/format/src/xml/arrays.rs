//! Large values: the arrays of meshes and the pixels of textures. Both may be in files beside the scene.

use super::document::Element;
use super::read::{Reading, put};
use super::side_files::Bytes;
use super::table::Step;
use super::write::Item;
use crate::picture::{Layout, Picture};
use crate::ttt::chunks::MeshPool;
use crate::ttt::{FileResult, Indices, Node, Normals, Rest};

/// The fields that say where the arrays of a mesh are in the pool.
const PLACES: [&str; 4] = ["vertices_at", "indices_at", "normals_at", "edges_at"];

/// The arrays of a mesh: vertices, indices, a normal for each corner, and which edges are drawn, three for each triangle.
#[derive(Debug, Default)]
pub(super) struct Arrays {
    pub vertices: Vec<f32>,
    pub indices: Vec<i32>,
    pub normals: Vec<f32>,
    pub edges: Vec<u8>,
}

impl Arrays {
    fn check(&self) -> Result<(), String> {
        let (vertices, corners) = (self.vertices.len() / 3, self.indices.len());
        if vertices == 0
            || corners == 0
            || !self.vertices.len().is_multiple_of(3)
            || !corners.is_multiple_of(3)
        {
            return Err(
                "a mesh needs vertices of three numbers and triangles of three corners".into(),
            );
        }
        if !self.vertices.iter().all(|number| number.is_finite()) {
            return Err("a mesh has a vertex that is not finite".into());
        }
        if !self
            .indices
            .iter()
            .all(|at| usize::try_from(*at).is_ok_and(|at| at < vertices))
        {
            return Err("a mesh has a triangle whose corner is not there".into());
        }
        Ok(())
    }
}

impl Reading<'_> {
    pub(super) fn arrays(&mut self, element: Element<'_>, node: &mut Node) -> FileResult<()> {
        let file = element
            .attribute("name")
            .or_else(|| element.find(&["file"])?.mark().attribute("name"));
        let arrays = match file {
            Some(name) => self
                .side_files
                .read(name)
                .and_then(|bytes| of_file(name, &bytes)),
            None => of_elements(element),
        };
        let place = arrays
            .and_then(|arrays| self.add(arrays))
            .map_err(|what| element.error(what))?;
        refer(node, place);
        Ok(())
    }

    /// Puts arrays into the pool; their place.
    ///
    /// # Errors
    /// When they do not fit each other; in words.
    pub(super) fn add(&mut self, arrays: Arrays) -> Result<i32, String> {
        arrays.check()?;
        let pool = &mut self.pool;
        let place = numbers::count_i32(pool.vertices.len());
        pool.vertices.push(Rest(arrays.vertices));
        pool.indices.push(Indices(arrays.indices));
        pool.normals.push(Normals(arrays.normals));
        pool.edges.push(Rest(packed(&arrays.edges)));
        Ok(place)
    }

    /// The pixels of a texture out of a picture, or out of the raw form: width, height, whether there is alpha, pixels.
    pub(super) fn picture(&mut self, element: Element<'_>, node: &mut Node) -> FileResult<()> {
        let wrong = |what: String| element.error(what);
        let file = element
            .attribute("name")
            .or_else(|| element.find(&["file"])?.mark().attribute("name"));
        let bytes = self
            .side_files
            .read(file.unwrap_or_default())
            .map_err(wrong)?;
        let alpha = node
            .get("flags")
            .is_some_and(|flags| *flags != Node::Int(0));
        let pixels = if Picture::is_file(&bytes) {
            let layout = if alpha { Layout::Rgba } else { Layout::Rgb };
            Picture::decode(&bytes, layout)
                .map_err(|error| wrong(error.to_string()))?
                .into_bytes()
        } else {
            raw_picture(&bytes)
                .ok_or_else(|| wrong("the file is no picture of a known kind".into()))?
        };
        put(node, &[Step::Name("pixels")], Node::Bytes(pixels));
        Ok(())
    }
}

/// The writer left out the last bytes: they are black.
fn raw_picture(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut rest = Bytes(bytes);
    let (width, height) = (rest.int().ok()?, rest.int().ok()?);
    let (alpha, pixels) = rest.0.split_first()?;
    let size = usize::try_from(width)
        .ok()?
        .checked_mul(usize::try_from(height).ok()?)?;
    let size = size.checked_mul(if *alpha == 0 { 3 } else { 4 })?;
    let missing = size.checked_sub(pixels.len())?;
    (missing <= 9).then(|| {
        pixels
            .iter()
            .copied()
            .chain(std::iter::repeat_n(0, missing))
            .collect()
    })
}

fn of_file(name: &str, bytes: &[u8]) -> Result<Arrays, String> {
    if !name.ends_with(".bin") {
        return Err(format!(
            "meshes in files such as '{name}' are not implemented in Swanilda, only those in .bin files"
        ));
    }
    let mut rest = Bytes(bytes);
    rest.int()?;
    let floats = |bytes: &[[u8; 4]]| bytes.iter().map(|b| f32::from_le_bytes(*b)).collect();
    Ok(Arrays {
        vertices: floats(rest.counted()?),
        indices: rest
            .counted()?
            .iter()
            .map(|b| i32::from_le_bytes(*b))
            .collect(),
        normals: floats(rest.counted()?),
        edges: rest.counted::<1>()?.as_flattened().to_vec(),
    })
}

fn of_elements(element: Element<'_>) -> Result<Arrays, String> {
    Ok(Arrays {
        vertices: list(element, "vertices")?,
        indices: list(element, "indices")?,
        normals: list(element, "normals")?,
        edges: list(element, "edges")?,
    })
}

/// The numbers of an element; none where it is missing.
pub(super) fn list<T: std::str::FromStr>(
    element: Element<'_>,
    name: &str,
) -> Result<Vec<T>, String> {
    let Some(found) = element.find(&[name]) else {
        return Ok(Vec::new());
    };
    let text = found.mark().text();
    let number = |text: &str| {
        text.parse()
            .map_err(|_| format!("{name}: '{text:.40}' is no number"))
    };
    text.split_ascii_whitespace().map(number).collect()
}

/// One bit for each edge.
fn packed(edges: &[u8]) -> Vec<u8> {
    edges
        .chunks(8)
        .map(|eight| {
            eight
                .iter()
                .enumerate()
                .fold(0, |bits, (at, on)| bits | (on & 1) << at)
        })
        .collect()
}

/// Writes the arrays of a mesh.
pub(super) fn write(pool: &MeshPool, data: &Node, out: &mut Item) {
    if data.get(PLACES[0]).is_none() {
        return;
    }
    let item = out.push("meshData");
    write_triangles(pool, data, item);
    if let Some(Normals(normals)) = array(&pool.normals, data, PLACES[2]) {
        item.leaf("normals", joined(normals));
    }
    let corners = array(&pool.indices, data, PLACES[1]).map_or(0, |Indices(indices)| indices.len());
    if let Some(Rest(edges)) = array(&pool.edges, data, PLACES[3]) {
        let bits =
            (0..corners).map(|edge| edges.get(edge / 8).map_or(0, |byte| byte >> (edge % 8) & 1));
        item.leaf("edges", joined(&bits.collect::<Vec<u8>>()));
    }
}

/// Writes vertices and indices.
pub(super) fn write_triangles(pool: &MeshPool, data: &Node, out: &mut Item) {
    if let Some(Rest(vertices)) = array(&pool.vertices, data, PLACES[0]) {
        out.leaf("vertices", joined(vertices));
    }
    if let Some(Indices(indices)) = array(&pool.indices, data, PLACES[1]) {
        out.leaf("indices", joined(indices));
    }
}

/// The array of a pool that a field says the place of.
fn array<'a, T>(pool: &'a [T], data: &Node, place: &str) -> Option<&'a T> {
    pool.get(usize::try_from(data.get(place)?.int().ok()?).ok()?)
}

pub(super) fn joined<T: std::fmt::Display>(numbers: &[T]) -> String {
    numbers
        .iter()
        .map(T::to_string)
        .collect::<Vec<String>>()
        .join(" ")
}

/// Says in a mesh where its arrays are.
pub(super) fn refer(node: &mut Node, place: i32) {
    for name in PLACES {
        put(node, &[Step::Name(name)], Node::Int(place.into()));
    }
}
