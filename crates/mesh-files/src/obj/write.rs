//! OBJ with its MTL and textures.

use std::fmt::Write;

use crate::format::Written;
use crate::mesh_file::{Material, MeshFile, Part};

/// The OBJ, and if parts have colours or textures, the MTL of the same name and the textures.
pub(crate) fn write(file: &MeshFile, name: &str) -> Vec<Written> {
    let has_materials = file
        .parts
        .iter()
        .any(|part| part.material.diffuse.is_some() || part.material.texture.is_some());
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let materials = format!("{stem}.mtl");
    let mut text = String::new();
    if has_materials {
        text += &format!("mtllib {}\n", crate::text::file_name(&materials));
    }
    let mut first = [1; 3];
    for (number, part) in file.parts.iter().enumerate() {
        write_part(&mut text, part, number, has_materials, &mut first)
            .expect("writing into a string succeeds");
    }
    let mut written = vec![Written {
        name: name.into(),
        bytes: text.into_bytes(),
    }];
    if has_materials {
        written.push(Written {
            name: materials,
            bytes: library(file).into_bytes(),
        });
        written.extend(file.textures.iter().map(|texture| Written {
            name: texture.name.clone(),
            bytes: texture.bytes.clone(),
        }));
    }
    written
}

/// `first` is the index of the part's first position, texture coordinates and normal.
fn write_part(
    text: &mut String,
    part: &Part,
    number: usize,
    has_materials: bool,
    first: &mut [usize; 3],
) -> std::fmt::Result {
    writeln!(
        text,
        "o {}",
        if part.name.is_empty() {
            format!("part{number}")
        } else {
            one_word(&part.name)
        }
    )?;
    if has_materials {
        writeln!(text, "usemtl material{number}")?;
    }
    part.vertices
        .iter()
        .try_for_each(|[x, y, z]| writeln!(text, "v {x} {y} {z}"))?;
    part.uv
        .as_flattened()
        .iter()
        .try_for_each(|[u, v]| writeln!(text, "vt {u} {v}"))?;
    part.normals
        .as_flattened()
        .iter()
        .try_for_each(|[x, y, z]| writeln!(text, "vn {x} {y} {z}"))?;
    for (number, triangle) in part.triangles.iter().enumerate() {
        text.push('f');
        for (corner, index) in triangle.iter().enumerate() {
            let (position, own) = (numbers::place(*index) + first[0], 3 * number + corner);
            match (part.uv.is_empty(), part.normals.is_empty()) {
                (true, true) => write!(text, " {position}")?,
                (false, true) => write!(text, " {position}/{}", own + first[1])?,
                (true, false) => write!(text, " {position}//{}", own + first[2])?,
                (false, false) => {
                    write!(text, " {position}/{}/{}", own + first[1], own + first[2])?;
                }
            }
        }
        text.push('\n');
    }
    *first = [
        first[0] + part.vertices.len(),
        first[1] + 3 * part.uv.len(),
        first[2] + 3 * part.normals.len(),
    ];
    Ok(())
}

fn library(file: &MeshFile) -> String {
    let mut text = String::new();
    for (number, part) in file.parts.iter().enumerate() {
        let texture = part
            .material
            .texture
            .and_then(|index| file.textures.get(index));
        material(
            &mut text,
            number,
            &part.material,
            texture.map(|texture| texture.name.as_str()),
        );
    }
    text
}

fn material(text: &mut String, number: usize, material: &Material, texture: Option<&str>) {
    *text += &format!("newmtl material{number}\n");
    let colours = [
        ("Kd", material.diffuse),
        ("Ks", material.specular),
        ("Ke", material.emission),
    ];
    for (keyword, colour) in colours {
        if let Some([red, green, blue]) = colour {
            *text += &format!("{keyword} {red} {green} {blue}\n");
        }
    }
    if material.transparency > 0.0 {
        *text += &format!("d {}\n", 1.0 - material.transparency);
    }
    if let Some(texture) = texture {
        *text += &format!("map_Kd {texture}\n");
    }
}

/// A name that a line can hold.
fn one_word(name: &str) -> String {
    name.chars()
        .map(|c| {
            if c.is_control() || c.is_whitespace() {
                '_'
            } else {
                c
            }
        })
        .collect()
}
