//! The buffer: meshes, images, and the accessors and views that describe it.

use std::collections::HashMap;

use serde_json::{Map, Value, json};

use super::insert;
use crate::mesh_file::{Material, Part, Texture};
use crate::weld::Table;

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// One buffer, and what lies in it.
#[derive(Default)]
pub(super) struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    /// The number of each material, by its text.
    known_materials: HashMap<String, usize>,
    images: Vec<Value>,
}

impl Buffer {
    pub(super) fn new(textures: &[Texture]) -> Self {
        let mut buffer = Self::default();
        buffer.images = textures
            .iter()
            .map(|texture| buffer.image(texture))
            .collect();
        buffer
    }

    /// Adds the lists to the document; the bytes of the buffer.
    pub(super) fn finish(self, document: &mut Map<String, Value>) -> Vec<u8> {
        let textures = (0..self.images.len())
            .map(|source| json!({ "source": source }))
            .collect();
        insert(document, "materials", self.materials);
        insert(document, "textures", textures);
        insert(document, "images", self.images);
        insert(document, "accessors", self.accessors);
        insert(document, "bufferViews", self.views);
        if !self.bytes.is_empty() {
            document.insert(
                "buffers".into(),
                json!([{ "byteLength": self.bytes.len() }]),
            );
        }
        self.bytes
    }

    /// A primitive for each part.
    pub(super) fn mesh(&mut self, parts: &[Part]) -> Value {
        let parts = parts.iter().filter(|part| !part.triangles.is_empty());
        json!({ "primitives": parts.map(|part| self.primitive(part)).collect::<Vec<_>>() })
    }

    fn primitive(&mut self, part: &Part) -> Value {
        let (positions, normals, uv, indices) = vertices(part);
        let mut attributes =
            json!({ "POSITION": self.vectors(&positions, true, Some(ARRAY_BUFFER)) });
        if !normals.is_empty() {
            attributes["NORMAL"] = self.vectors(&normals, false, Some(ARRAY_BUFFER)).into();
        }
        if !uv.is_empty() {
            attributes["TEXCOORD_0"] = self.vectors(&uv, false, Some(ARRAY_BUFFER)).into();
        }
        let (indices, material) = (self.indices(&indices), self.material(&part.material));
        json!({ "attributes": attributes, "indices": indices, "material": material })
    }

    /// The number of an accessor of rows of 32-bit numbers. Positions and times must say their bounds.
    pub(super) fn vectors<const N: usize>(
        &mut self,
        rows: &[[f64; N]],
        has_bounds: bool,
        target: Option<u32>,
    ) -> usize {
        let bytes: Vec<u8> = rows
            .as_flattened()
            .iter()
            .flat_map(|x| numbers::single(*x).to_le_bytes())
            .collect();
        let view = self.view(&bytes, target);
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        let mut accessor = json!({ "bufferView": view, "componentType": FLOAT, "count": rows.len(), "type": kind });
        if has_bounds {
            let bound = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
                (0..N)
                    .filter_map(|k| rows.iter().map(|row| numbers::single(row[k])).reduce(pick))
                    .collect()
            };
            accessor["min"] = json!(bound(f32::min));
            accessor["max"] = json!(bound(f32::max));
        }
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn indices(&mut self, indices: &[u32]) -> usize {
        let bytes: Vec<u8> = indices
            .iter()
            .flat_map(|index| index.to_le_bytes())
            .collect();
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        self.accessors.push(
            json!({ "bufferView": view, "componentType": UNSIGNED_INT, "count": indices.len(), "type": "SCALAR" }),
        );
        self.accessors.len() - 1
    }

    /// Parts that look the same have the same material.
    fn material(&mut self, source: &Material) -> usize {
        let value = material(source, self.images.len());
        let next = self.materials.len();
        let number = *self
            .known_materials
            .entry(value.to_string())
            .or_insert(next);
        if number == next {
            self.materials.push(value);
        }
        number
    }

    fn image(&mut self, texture: &Texture) -> Value {
        let kind = match texture.bytes.as_slice() {
            [0x89, b'P', b'N', b'G', ..] => "image/png",
            [b'B', b'M', ..] => "image/bmp",
            _ => "image/jpeg",
        };
        let view = self.view(&texture.bytes, None);
        json!({ "bufferView": view, "mimeType": kind, "name": texture.name })
    }

    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view =
            json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }
}

/// Positions, normals and texture coordinates of vertices, and the indices of the triangles.
type Vertices = (Vec<[f64; 3]>, Vec<[f64; 3]>, Vec<[f64; 2]>, Vec<u32>);

/// The vertices of a part; where corners have attributes, a vertex for all corners that have the same.
fn vertices(part: &Part) -> Vertices {
    let (has_normals, has_uv) = (!part.normals.is_empty(), !part.uv.is_empty());
    if !(has_normals || has_uv) {
        return (
            part.vertices.clone(),
            Vec::new(),
            Vec::new(),
            part.triangles.as_flattened().to_vec(),
        );
    }
    let mut table = Table::<8>::default();
    let corner = |(number, index): (usize, &u32)| {
        let normal = part
            .normals
            .as_flattened()
            .get(number)
            .map_or([0.0; 3], |normal| unit_or_up(*normal));
        let [u, v] = part
            .uv
            .as_flattened()
            .get(number)
            .map_or([0.0; 2], |[u, v]| [*u, 1.0 - v]);
        let ([x, y, z], [a, b, c]) = (part.vertices[numbers::place(*index)], normal);
        table.index([x, y, z, a, b, c, u, v])
    };
    let indices = part
        .triangles
        .as_flattened()
        .iter()
        .enumerate()
        .map(corner)
        .collect();
    let rows = &table.seen;
    let normals = rows
        .iter()
        .filter(|_| has_normals)
        .map(|row| [row[3], row[4], row[5]])
        .collect();
    let uv = rows
        .iter()
        .filter(|_| has_uv)
        .map(|row| [row[6], row[7]])
        .collect();
    (
        rows.iter().map(|row| [row[0], row[1], row[2]]).collect(),
        normals,
        uv,
        indices,
    )
}

/// glTF wants unit normals everywhere: a corner without one gets some direction.
fn unit_or_up(normal: [f64; 3]) -> [f64; 3] {
    let unit = crate::transform::unit(normal);
    if unit == [0.0; 3] {
        [0.0, 0.0, 1.0]
    } else {
        unit
    }
}

fn material(material: &Material, textures: usize) -> Value {
    let [red, green, blue] = material.diffuse.unwrap_or([1.0; 3]);
    let mut base = json!({ "baseColorFactor": [red, green, blue, 1.0 - material.transparency], "metallicFactor": 0, "roughnessFactor": 1 });
    if let Some(index) = material.texture.filter(|index| *index < textures) {
        base["baseColorTexture"] = json!({ "index": index });
    }
    let mut value = json!({ "pbrMetallicRoughness": base });
    if !material.name.is_empty() {
        value["name"] = json!(material.name);
    }
    if let Some(emission) = material.emission {
        value["emissiveFactor"] = json!(emission);
    }
    if material.transparency > 0.0 {
        value["alphaMode"] = json!("BLEND");
    }
    if material.double_sided {
        value["doubleSided"] = json!(true);
    }
    value
}
