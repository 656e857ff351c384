//! Meshes as Wavefront OBJ. A comment keeps which edges are drawn, which OBJ cannot say.

use std::collections::HashMap;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::find;
use crate::ttt::chunks::MeshPool;
use crate::ttt::mesh_arrays::{Arrays, Places};
use crate::ttt::node::NodeResult;
use crate::ttt::{Indices, Normals, Rest};

const EDGES: &str = "# edges ";

/// The mesh at these places.
///
/// # Errors
/// When vertices or indices are missing, or do not fit each other.
pub(super) fn write(
    pool: &MeshPool,
    [vertices, indices, normals, edges]: Places,
) -> NodeResult<String> {
    let (Some(Rest(vertices)), Some(Indices(indices))) =
        (find(&pool.vertices, vertices), find(&pool.indices, indices))
    else {
        return Err("a mesh refers to vertices or indices that are not there".into());
    };
    let (points, triangles) = (vertices.as_chunks::<3>().0, indices.as_chunks::<3>().0);
    if indices
        .iter()
        .any(|i| usize::try_from(*i).map_or(true, |i| i >= points.len()))
    {
        return Err("a mesh has a triangle whose corner is not there".into());
    }
    let mut out = String::from("# made by `swanilda unpack`\n");
    if let Some(Rest(edges)) = find(&pool.edges, edges) {
        out += &format!("{EDGES}{}\n", STANDARD.encode(edges));
    }
    points
        .iter()
        .for_each(|[x, y, z]| out += &format!("v {x:?} {y:?} {z:?}\n"));
    let normals =
        find(&pool.normals, normals).filter(|Normals(normals)| normals.len() == 3 * indices.len());
    let mut corners = Vec::new();
    if let Some(Normals(normals)) = normals {
        let mut known: HashMap<[u32; 3], usize> = HashMap::new();
        for normal in normals.as_chunks::<3>().0 {
            let next = known.len() + 1;
            corners.push(*known.entry(normal.map(f32::to_bits)).or_insert_with(|| {
                out += &format!("vn {:?} {:?} {:?}\n", normal[0], normal[1], normal[2]);
                next
            }));
        }
    }
    for (face, triangle) in triangles.iter().enumerate() {
        out.push('f');
        for (corner, index) in triangle.iter().enumerate() {
            out += &format!(" {}", index + 1);
            if let Some(normal) = corners.get(3 * face + corner) {
                out += &format!("//{normal}");
            }
        }
        out.push('\n');
    }
    Ok(out)
}

/// The mesh in an OBJ file.
///
/// # Errors
/// When the text is no mesh.
pub(super) fn read(text: &[u8]) -> NodeResult<Arrays> {
    let mesh = Parsed::read(&String::from_utf8_lossy(text))?;
    let normals = Some(mesh.corner_normals).filter(|normals| !normals.is_empty());
    Ok(Arrays {
        vertices: mesh.vertices,
        indices: mesh.indices,
        normals,
        edges: mesh.edges,
    })
}

#[derive(Default)]
struct Parsed {
    vertices: Vec<f32>,
    normals: Vec<[f32; 3]>,
    indices: Vec<i32>,
    /// Of each corner; empty when one has none.
    corner_normals: Vec<f32>,
    edges: Option<Vec<u8>>,
}

impl Parsed {
    fn read(text: &str) -> NodeResult<Self> {
        let mut mesh = Self::default();
        for (number, line) in (1..).zip(text.lines()) {
            mesh.line(line.trim())
                .map_err(|what| format!("line {number}: {what}"))?;
        }
        if mesh.corner_normals.len() != 3 * mesh.indices.len() {
            mesh.corner_normals.clear();
        }
        Ok(mesh)
    }

    fn line(&mut self, line: &str) -> NodeResult<()> {
        if let Some(edges) = line.strip_prefix(EDGES) {
            self.edges = Some(STANDARD.decode(edges).map_err(|error| error.to_string())?);
            return Ok(());
        }
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => self.vertices.extend(three(words)?),
            Some("vn") => self.normals.push(three(words)?),
            Some("f") => self.face(&words.collect::<Vec<_>>())?,
            _ => {}
        }
        Ok(())
    }

    /// Triangles around the first corner.
    fn face(&mut self, corners: &[&str]) -> NodeResult<()> {
        let corners = corners
            .iter()
            .map(|corner| self.corner(corner))
            .collect::<NodeResult<Vec<_>>>()?;
        let [first, rest @ ..] = corners.as_slice() else {
            return Err("a face has no corners".into());
        };
        for pair in rest.windows(2) {
            for (vertex, normal) in [first, &pair[0], &pair[1]] {
                self.indices.push(*vertex);
                self.corner_normals.extend(normal.iter().flatten());
            }
        }
        Ok(())
    }

    /// `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`; negative numbers count from the end.
    fn corner(&self, word: &str) -> NodeResult<(i32, Option<[f32; 3]>)> {
        let mut numbers = word.split('/');
        let vertex = index(numbers.next().unwrap_or_default(), self.vertices.len() / 3)?;
        let normal = numbers.nth(1).filter(|word| !word.is_empty());
        let normal = normal
            .map(|word| index(word, self.normals.len()))
            .transpose()?;
        Ok((
            numbers::count_i32(vertex),
            normal.map(|at| self.normals[at]),
        ))
    }
}

/// From 1 on, to a place in a list of `len`.
fn index(word: &str, len: usize) -> NodeResult<usize> {
    let number: i64 = word.parse().map_err(|_| format!("`{word}` is no number"))?;
    let at = if number < 0 {
        numbers::count(len) + number
    } else {
        number - 1
    };
    usize::try_from(at)
        .ok()
        .filter(|at| *at < len)
        .ok_or_else(|| format!("there is no {number}"))
}

fn three<'a>(words: impl Iterator<Item = &'a str>) -> NodeResult<[f32; 3]> {
    let numbers: Option<Vec<f32>> = words.take(3).map(|word| word.parse().ok()).collect();
    numbers
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| "three numbers are needed".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_other_programs_are_read() {
        let square =
            b"o square\nv 0 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf -4/1 2/1 3/1 4/1\n";
        let mesh = read(square).expect("a mesh");
        assert_eq!(
            (mesh.vertices.len(), mesh.normals, mesh.edges),
            (12, None, None)
        );
        assert_eq!(mesh.indices, [0, 1, 2, 0, 2, 3]);
    }

    #[test]
    fn damaged_files_are_errors() {
        for text in [
            "v 1 2",
            "f 1 2 3",
            "v 0 0 0\nf 1 1 2",
            "v 0 0 0\nf 1//1 1 1",
            "v 0 0 0\nf x 1 1",
            "# edges ?",
        ] {
            assert!(read(text.as_bytes()).is_err(), "{text}");
        }
    }
}
