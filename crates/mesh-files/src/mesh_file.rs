//! What a mesh file contains.

use crate::error::{Location, ReadError, Result};
use crate::weld::weld;

/// Which axis points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UpAxis {
    /// The x axis.
    X,
    /// The y axis.
    Y,
    /// The z axis.
    Z,
}

/// A texture's picture, encoded as in the file it comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texture {
    /// The name in the mesh file, without folders.
    pub name: String,
    /// PNG, JPEG, ...: its first bytes say which.
    pub bytes: Vec<u8>,
}

/// How a part looks. Colours are red, green, blue from 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// As in the file; empty if it has none.
    pub name: String,
    /// The colour in white light; `None` if the file says nothing of it.
    pub diffuse: Option<[f64; 3]>,
    /// The colour of highlights.
    pub specular: Option<[f64; 3]>,
    /// The light that the part emits.
    pub emission: Option<[f64; 3]>,
    /// 0: opaque, 1: invisible.
    pub transparency: f64,
    /// An index of [`MeshFile::textures`].
    pub texture: Option<usize>,
    /// Whether the back of its triangles is seen too.
    pub double_sided: bool,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            diffuse: None,
            specular: None,
            emission: None,
            transparency: 0.0,
            texture: None,
            double_sided: false,
        }
    }
}

/// A mesh of one material.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Part {
    /// As in the file; empty if it has none.
    pub name: String,
    /// In the frame and unit of the file.
    pub vertices: Vec<[f64; 3]>,
    /// Indices of vertices, counterclockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Of each corner of each triangle, or empty. A zero vector: this corner has none.
    pub normals: Vec<[[f64; 3]; 3]>,
    /// Texture coordinates of each corner of each triangle, the origin at the lower left; or empty.
    pub uv: Vec<[[f64; 2]; 3]>,
    /// How it looks.
    pub material: Material,
}

/// The contents of a mesh file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshFile {
    /// At least one, each with at least one triangle.
    pub parts: Vec<Part>,
    /// What the materials refer to.
    pub textures: Vec<Texture>,
    /// Metres per unit, if the file says so.
    pub unit: Option<f64>,
    /// The axis that points up, if the file or its format says so.
    pub up: Option<UpAxis>,
    /// What was left out, a sentence each: textures that were not found, elements that are no triangles.
    pub warnings: Vec<String>,
}

impl Part {
    /// Merges vertices of the same position.
    pub fn merge_identical(&mut self) {
        weld(&mut self.vertices, &mut self.triangles);
    }

    fn append(&mut self, other: &Part) {
        let first = numbers::count_u32(self.vertices.len());
        let has_normals = !(self.normals.is_empty() && other.normals.is_empty());
        let has_uv = !(self.uv.is_empty() && other.uv.is_empty());
        pad(&mut self.normals, self.triangles.len(), has_normals);
        pad(&mut self.uv, self.triangles.len(), has_uv);
        self.vertices.extend_from_slice(&other.vertices);
        self.triangles.extend(
            other
                .triangles
                .iter()
                .map(|triangle| triangle.map(|index| index + first)),
        );
        self.normals.extend_from_slice(&other.normals);
        self.uv.extend_from_slice(&other.uv);
        pad(&mut self.normals, self.triangles.len(), has_normals);
        pad(&mut self.uv, self.triangles.len(), has_uv);
    }
}

/// Zeros for triangles without the attribute, where others have it.
fn pad<const N: usize>(attribute: &mut Vec<[[f64; N]; 3]>, triangles: usize, is_used: bool) {
    if is_used {
        attribute.resize(triangles, [[0.0; N]; 3]);
    }
}

impl MeshFile {
    /// Merges vertices of the same position, within each part.
    pub fn merge_identical(&mut self) {
        self.parts.iter_mut().for_each(Part::merge_identical);
    }

    /// Joins the parts that look the same.
    pub fn merge_parts(&mut self) {
        let mut merged: Vec<Part> = Vec::new();
        for part in self.parts.drain(..) {
            let room = u32::MAX as usize - part.vertices.len();
            match merged
                .iter_mut()
                .find(|other| other.material == part.material && other.vertices.len() <= room)
            {
                Some(other) => other.append(&part),
                None => merged.push(part),
            }
        }
        self.parts = merged;
    }

    /// Multiplies all coordinates by a positive factor.
    pub fn scale(&mut self, factor: f64) {
        for vertex in self.parts.iter_mut().flat_map(|part| &mut part.vertices) {
            *vertex = vertex.map(|x| x * factor);
        }
        self.unit = self.unit.map(|unit| unit / factor);
    }

    /// Turns a file whose `from` axis points up so that z does: (x, y, z) becomes (x, -z, y), or (-y, -z, x).
    pub fn turn_up(&mut self, from: UpAxis) {
        let turn = |[x, y, z]: [f64; 3]| match from {
            UpAxis::X => [-y, -z, x],
            UpAxis::Y => [x, -z, y],
            UpAxis::Z => [x, y, z],
        };
        for part in &mut self.parts {
            part.vertices
                .iter_mut()
                .for_each(|vertex| *vertex = turn(*vertex));
            part.normals
                .as_flattened_mut()
                .iter_mut()
                .for_each(|normal| *normal = turn(*normal));
        }
        self.up = Some(UpAxis::Z);
    }

    /// The smallest and the largest coordinates.
    pub fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        let mut bounds = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for vertex in self.parts.iter().flat_map(|part| &part.vertices) {
            for (axis, &x) in vertex.iter().enumerate() {
                bounds.0[axis] = bounds.0[axis].min(x);
                bounds.1[axis] = bounds.1[axis].max(x);
            }
        }
        bounds
    }

    /// What every reader ends with: parts without triangles go, and coordinates must be finite (a transform may have made them infinite).
    pub(crate) fn checked(mut self) -> Result<Self> {
        self.parts.retain(|part| !part.triangles.is_empty());
        if self.parts.is_empty() {
            return Err(ReadError::new(Location::File, "file", "no triangles"));
        }
        for (number, part) in self.parts.iter().enumerate() {
            if !part.vertices.as_flattened().iter().all(|x| x.is_finite()) {
                return Err(ReadError::new(
                    Location::File,
                    format!("part {number}"),
                    "coordinates that are not finite",
                ));
            }
        }
        Ok(self)
    }
}
