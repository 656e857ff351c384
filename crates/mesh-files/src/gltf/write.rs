//! Writes binary glTF: a mesh, a material and a node for each part, one buffer. Vertices are those of corners where corners have normals or
//! texture coordinates, since glTF knows no others.

use serde_json::{Map, Value, json};

use crate::error::WriteError;
use crate::mesh_file::{Material, MeshFile, Part, Texture, UpAxis};

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

#[derive(Default)]
struct Writer {
    buffer: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

pub(crate) fn write(file: &MeshFile) -> Result<Vec<u8>, WriteError> {
    let mut writer = Writer::default();
    let parts: Vec<&Part> = file.parts.iter().filter(|part| !part.triangles.is_empty()).collect();
    let meshes: Vec<Value> = parts.iter().enumerate().map(|(number, part)| writer.mesh(number, part)).collect();
    let images: Vec<Value> = file.textures.iter().map(|texture| writer.image(texture)).collect();
    let textures: Vec<Value> = (0..images.len()).map(|source| json!({ "source": source })).collect();
    let materials: Vec<Value> = parts.iter().map(|part| material(&part.material, images.len())).collect();
    let mut nodes: Vec<Value> = parts.iter().enumerate().map(|(number, part)| node(number, part)).collect();
    let root = upright(file, &mut nodes);
    let lists = [
        ("nodes", nodes),
        ("meshes", meshes),
        ("materials", materials),
        ("textures", textures),
        ("images", images),
        ("accessors", std::mem::take(&mut writer.accessors)),
        ("bufferViews", std::mem::take(&mut writer.views)),
    ];
    let mut document = Map::new();
    document.insert("asset".into(), json!({ "version": "2.0", "generator": "Swanilda" }));
    document.insert("scene".into(), json!(0));
    document.insert("scenes".into(), json!([root]));
    // Empty lists are not allowed.
    document.extend(
        lists
            .into_iter()
            .filter(|(_, list)| !list.is_empty())
            .map(|(name, list)| (name.to_owned(), Value::Array(list))),
    );
    if !writer.buffer.is_empty() {
        document.insert("buffers".into(), json!([{ "byteLength": writer.buffer.len() }]));
    }
    container(&Value::Object(document).to_string(), writer.buffer)
}

/// Header, JSON and buffer, each padded to four bytes.
fn container(json: &str, mut buffer: Vec<u8>) -> Result<Vec<u8>, WriteError> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let length = |bytes: usize| u32::try_from(bytes).map_err(|_| WriteError::TooLarge).map(u32::to_le_bytes);
    let binary_head = if buffer.is_empty() { 0 } else { 8 };
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend(length(12 + 8 + json.len() + binary_head + buffer.len())?);
    file.extend(length(json.len())?);
    file.extend(b"JSON");
    file.extend(json);
    if !buffer.is_empty() {
        file.extend(length(buffer.len())?);
        file.extend(b"BIN\0");
        file.extend(buffer);
    }
    Ok(file)
}

/// The scene: glTF's y points up, so a node above all turns other files.
fn upright(file: &MeshFile, nodes: &mut Vec<Value>) -> Value {
    let all: Vec<usize> = (0..nodes.len()).collect();
    let half = 0.5_f64.sqrt();
    let turn = match file.up {
        Some(UpAxis::Y) => None,
        Some(UpAxis::X) => Some([0.0, 0.0, half, half]),
        _ => Some([-half, 0.0, 0.0, half]),
    };
    match turn {
        _ if all.is_empty() => json!({}),
        None => json!({ "nodes": all }),
        Some(rotation) => {
            nodes.push(json!({ "rotation": rotation, "children": all }));
            json!({ "nodes": [nodes.len() - 1] })
        }
    }
}

fn node(number: usize, part: &Part) -> Value {
    let name = if part.name.is_empty() { format!("part{number}") } else { part.name.clone() };
    json!({ "name": name, "mesh": number })
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
    value
}

impl Writer {
    fn mesh(&mut self, number: usize, part: &Part) -> Value {
        let has_corners = !(part.normals.is_empty() && part.uv.is_empty());
        let corners = || part.triangles.as_flattened().iter();
        let (positions, indices): (Vec<[f64; 3]>, Vec<u32>) = if has_corners {
            let count = 3 * part.triangles.len() as u32;
            (corners().map(|index| part.vertices[*index as usize]).collect(), (0..count).collect())
        } else {
            (part.vertices.clone(), corners().copied().collect())
        };
        let mut attributes = json!({ "POSITION": self.floats(&positions, "VEC3", true) });
        if !part.normals.is_empty() {
            let normals: Vec<[f64; 3]> = part.normals.as_flattened().iter().map(|normal| unit_or_up(*normal)).collect();
            attributes["NORMAL"] = self.floats(&normals, "VEC3", false);
        }
        if !part.uv.is_empty() {
            let uv: Vec<[f64; 2]> = part.uv.as_flattened().iter().map(|[u, v]| [*u, 1.0 - v]).collect();
            attributes["TEXCOORD_0"] = self.floats(&uv, "VEC2", false);
        }
        json!({ "primitives": [{ "attributes": attributes, "indices": self.indices(&indices), "material": number }] })
    }

    /// An accessor of rows of 32-bit numbers. Positions must say their bounds.
    fn floats<const N: usize>(&mut self, rows: &[[f64; N]], kind: &str, has_bounds: bool) -> Value {
        let bytes: Vec<u8> = rows.as_flattened().iter().flat_map(|x| (*x as f32).to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ARRAY_BUFFER));
        let mut accessor = json!({ "bufferView": view, "componentType": FLOAT, "count": rows.len(), "type": kind });
        if has_bounds {
            let bound = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
                (0..N).filter_map(|k| rows.iter().map(|row| row[k] as f32).reduce(pick)).collect()
            };
            accessor["min"] = json!(bound(f32::min));
            accessor["max"] = json!(bound(f32::max));
        }
        self.accessors.push(accessor);
        json!(self.accessors.len() - 1)
    }

    fn indices(&mut self, indices: &[u32]) -> Value {
        let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        self.accessors.push(
            json!({ "bufferView": view, "componentType": UNSIGNED_INT, "count": indices.len(), "type": "SCALAR" }),
        );
        json!(self.accessors.len() - 1)
    }

    fn image(&mut self, texture: &Texture) -> Value {
        let kind = if texture.bytes.starts_with(b"\x89PNG") { "image/png" } else { "image/jpeg" };
        let view = self.view(&texture.bytes, None);
        json!({ "bufferView": view, "mimeType": kind, "name": texture.name })
    }

    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": self.buffer.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.buffer.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }
}

/// glTF wants unit normals everywhere: a corner without one gets some direction.
fn unit_or_up(normal: [f64; 3]) -> [f64; 3] {
    let unit = crate::transform::unit(normal);
    if unit == [0.0; 3] { [0.0, 0.0, 1.0] } else { unit }
}
