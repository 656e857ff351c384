//! Stanford polygon files: `vertex`, `face` and `tristrips`, in text and binary of both byte orders. Other elements and vertex colours are left out.

mod header;
mod values;
mod write;

pub(crate) use write::{write_binary, write_text};

use crate::Resolve;
use crate::corners::{Corner, Lists, NONE, part, push_polygon};
use crate::error::{ReadError, Result};
use crate::limits::Limits;
use crate::mesh_file::{Material, MeshFile, Texture};
use crate::text::file_name;
use header::{Element, Header};
use values::Values;

#[derive(Default)]
struct Reader {
    positions: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    uv: Vec<[f64; 2]>,
    /// Texture coordinates of the corners of faces, which count more than those of vertices.
    corner_uv: Vec<[f64; 2]>,
    triangles: Vec<[Corner; 3]>,
}

pub(crate) fn read(bytes: &[u8], mut limits: Limits, resolve: Resolve) -> Result<MeshFile> {
    let header = Header::read(bytes)?;
    let mut values = Values::new(bytes, &header);
    let mut reader = Reader::default();
    for element in &header.elements {
        values.check_room(element)?;
        match element.name.as_str() {
            "vertex" => reader.vertices(element, &mut values)?,
            "face" => reader.faces(element, &mut values)?,
            "tristrips" => reader.strips(element, &mut values)?,
            _ => skip(element, &mut values)?,
        }
    }
    let uv = if reader.corner_uv.is_empty() {
        &reader.uv
    } else {
        &reader.corner_uv
    };
    let lists = Lists {
        positions: &reader.positions,
        normals: &reader.normals,
        uv,
    };
    let mut file = MeshFile::default();
    let material = material(&header, &mut file, resolve);
    let part = part(String::new(), lists, &reader.triangles, material);
    limits.take(part.vertices.len(), part.triangles.len())?;
    file.parts.push(part);
    Ok(file)
}

/// The texture that a comment names, as MeshLab writes it.
fn material(header: &Header, file: &mut MeshFile, resolve: Resolve) -> Material {
    let Some(path) = &header.texture else {
        return Material::default();
    };
    match resolve(path) {
        Ok(bytes) => file.textures.push(Texture {
            name: file_name(path).into(),
            bytes,
        }),
        Err(why) => file.warnings.push(format!("texture {path}: {why}")),
    }
    Material {
        texture: (!file.textures.is_empty()).then_some(0),
        ..Material::default()
    }
}

fn skip(element: &Element, values: &mut Values) -> Result<()> {
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            values.skip(&property.kind, &element.name)?;
        }
    }
    Ok(())
}

/// The number of the first property with one of these names.
fn find(element: &Element, names: &[&str]) -> Option<usize> {
    element
        .properties
        .iter()
        .position(|property| names.contains(&property.name.as_str()))
}

impl Reader {
    fn vertices(&mut self, element: &Element, values: &mut Values) -> Result<()> {
        let place = |names: &[&[&str]]| {
            names
                .iter()
                .map(|names| find(element, names))
                .collect::<Option<Vec<_>>>()
        };
        let normal = place(&[&["nx"], &["ny"], &["nz"]]);
        let uv = place(&[&["s", "u", "texture_u"], &["t", "v", "texture_v"]]);
        let Some(position) = place(&[&["x"], &["y"], &["z"]]) else {
            return Err(ReadError::new(
                values.place(),
                "vertex",
                "without the properties x, y and z",
            ));
        };
        let mut row = vec![0.0; element.properties.len()];
        for _ in 0..element.count {
            for (value, property) in row.iter_mut().zip(&element.properties) {
                *value = values.scalar_of(&property.kind, "vertex")?;
            }
            let of = |places: &[usize], k: usize| row[places[k]];
            let vertex = [0, 1, 2].map(|k| of(&position, k));
            if !vertex.iter().all(|x| x.is_finite()) {
                return Err(ReadError::new(
                    values.place(),
                    "vertex",
                    "a coordinate that is not finite",
                ));
            }
            self.positions.push(vertex);
            self.normals.extend(
                normal
                    .as_ref()
                    .map(|places| [0, 1, 2].map(|k| finite(of(places, k)))),
            );
            self.uv.extend(
                uv.as_ref()
                    .map(|places| [0, 1].map(|k| finite(of(places, k)))),
            );
        }
        Ok(())
    }

    /// A corner at a vertex.
    fn corner(&self, index: i64, values: &Values) -> Result<Corner> {
        let Some(position) = u32::try_from(index)
            .ok()
            .filter(|index| numbers::place(*index) < self.positions.len())
        else {
            let problem = format!("vertex {index} of {}", self.positions.len());
            return Err(ReadError::new(values.place(), "face", problem));
        };
        let index_in = |length: usize| if length == 0 { NONE } else { position };
        Ok(Corner {
            position,
            normal: index_in(self.normals.len()),
            uv: index_in(self.uv.len()),
        })
    }

    fn faces(&mut self, element: &Element, values: &mut Values) -> Result<()> {
        let indices = find(element, &["vertex_indices", "vertex_index"]);
        let texture = find(element, &["texcoord"]);
        let (mut polygon, mut list, mut uv) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..element.count {
            polygon.clear();
            uv.clear();
            for (number, property) in element.properties.iter().enumerate() {
                if Some(number) == indices {
                    values.list(&property.kind, "face", &mut list)?;
                    polygon.extend(
                        list.iter()
                            .map(|index| self.corner(numbers::truncated(*index), values))
                            .collect::<Result<Vec<_>>>()?,
                    );
                } else if Some(number) == texture {
                    values.list(&property.kind, "face", &mut uv)?;
                } else {
                    values.skip(&property.kind, "face")?;
                }
            }
            self.set_corner_uv(&mut polygon, &uv);
            push_polygon(&polygon, &self.positions, &mut self.triangles);
        }
        Ok(())
    }

    /// Two numbers for each corner, or none.
    fn set_corner_uv(&mut self, polygon: &mut [Corner], uv: &[f64]) {
        let (pairs, rest) = uv.as_chunks::<2>();
        if pairs.len() == polygon.len() && rest.is_empty() {
            for (corner, pair) in polygon.iter_mut().zip(pairs) {
                corner.uv = numbers::count_u32(self.corner_uv.len());
                self.corner_uv.push(pair.map(finite));
            }
        }
    }

    /// Lists of vertices, each of which makes a triangle with the two before it, in alternating sense; -1 begins anew.
    fn strips(&mut self, element: &Element, values: &mut Values) -> Result<()> {
        let indices = find(element, &["vertex_indices", "vertex_index"]);
        let mut list = Vec::new();
        for _ in 0..element.count {
            for (number, property) in element.properties.iter().enumerate() {
                if Some(number) != indices {
                    values.skip(&property.kind, "tristrips")?;
                    continue;
                }
                values.list(&property.kind, "tristrips", &mut list)?;
                for strip in list.split(|index| *index < 0.0) {
                    let strip = strip
                        .iter()
                        .map(|index| self.corner(numbers::truncated(*index), values))
                        .collect::<Result<Vec<_>>>()?;
                    push_strip(&strip, &mut self.triangles);
                }
            }
        }
        Ok(())
    }
}

/// The triangles of a strip; those that lead from one row to the next, of a vertex twice, are left out.
pub(crate) fn push_strip(strip: &[Corner], triangles: &mut Vec<[Corner; 3]>) {
    for (number, window) in strip.windows(3).enumerate() {
        let [a, b, c] = [window[0], window[1], window[2]];
        if a.position != b.position && b.position != c.position && c.position != a.position {
            triangles.push(if number % 2 == 0 {
                [a, b, c]
            } else {
                [b, a, c]
            });
        }
    }
}

fn finite(x: f64) -> f64 {
    if x.is_finite() { x } else { 0.0 }
}
