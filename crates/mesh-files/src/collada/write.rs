//! Writes COLLADA 1.4.1: a geometry, an effect and a node for each part.

use std::fmt::Write;

use crate::format::Written;
use crate::mesh_file::{Material, MeshFile, Part, UpAxis};

/// The file, and the textures beside it.
pub(crate) fn write(file: &MeshFile, name: &str) -> Vec<Written> {
    let mut text = String::new();
    document(&mut text, file).expect("writing into a string succeeds");
    let mut written = vec![Written {
        name: name.into(),
        bytes: text.into_bytes(),
    }];
    written.extend(file.textures.iter().map(|texture| Written {
        name: texture.name.clone(),
        bytes: texture.bytes.clone(),
    }));
    written
}

fn document(text: &mut String, file: &MeshFile) -> std::fmt::Result {
    let up = match file.up {
        Some(UpAxis::X) => "X_UP",
        Some(UpAxis::Y) => "Y_UP",
        _ => "Z_UP",
    };
    writeln!(text, "<?xml version=\"1.0\" encoding=\"utf-8\"?>")?;
    writeln!(
        text,
        "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
    )?;
    writeln!(
        text,
        "<asset><created>1970-01-01T00:00:00Z</created><modified>1970-01-01T00:00:00Z</modified>"
    )?;
    writeln!(
        text,
        "<unit meter=\"{}\"/><up_axis>{up}</up_axis></asset>",
        file.unit.unwrap_or(1.0)
    )?;
    library(
        text,
        "library_images",
        file.textures.iter().enumerate(),
        |text, (number, texture)| {
            writeln!(
                text,
                "<image id=\"image{number}\"><init_from>{}</init_from></image>",
                escaped(&texture.name)
            )
        },
    )?;
    let parts = || file.parts.iter().enumerate();
    library(text, "library_effects", parts(), |text, (number, part)| {
        effect(text, number, &part.material, file.textures.len())
    })?;
    library(text, "library_materials", parts(), |text, (number, _)| {
        writeln!(
            text,
            "<material id=\"material{number}\"><instance_effect url=\"#effect{number}\"/></material>"
        )
    })?;
    library(
        text,
        "library_geometries",
        parts(),
        |text, (number, part)| geometry(text, number, part),
    )?;
    writeln!(text, "<library_visual_scenes><visual_scene id=\"scene\">")?;
    parts().try_for_each(|(number, part)| node(text, number, part))?;
    writeln!(text, "</visual_scene></library_visual_scenes>")?;
    writeln!(
        text,
        "<scene><instance_visual_scene url=\"#scene\"/></scene>\n</COLLADA>"
    )
}

/// A library; empty ones are not allowed.
fn library<T>(
    text: &mut String,
    name: &str,
    mut items: impl Iterator<Item = T>,
    mut item: impl FnMut(&mut String, T) -> std::fmt::Result,
) -> std::fmt::Result {
    let Some(first) = items.next() else {
        return Ok(());
    };
    writeln!(text, "<{name}>")?;
    item(text, first)?;
    items.try_for_each(|next| item(text, next))?;
    writeln!(text, "</{name}>")
}

fn effect(
    text: &mut String,
    number: usize,
    material: &Material,
    textures: usize,
) -> std::fmt::Result {
    let texture = material.texture.filter(|index| *index < textures);
    writeln!(text, "<effect id=\"effect{number}\"><profile_COMMON>")?;
    if let Some(image) = texture {
        writeln!(
            text,
            "<newparam sid=\"surface\"><surface type=\"2D\"><init_from>image{image}</init_from></surface></newparam>"
        )?;
        writeln!(
            text,
            "<newparam sid=\"sampler\"><sampler2D><source>surface</source></sampler2D></newparam>"
        )?;
    }
    writeln!(text, "<technique sid=\"common\"><phong>")?;
    colour(text, "emission", material.emission)?;
    match texture {
        Some(_) => writeln!(
            text,
            "<diffuse><texture texture=\"sampler\" texcoord=\"UV\"/></diffuse>"
        )?,
        None => colour(text, "diffuse", material.diffuse)?,
    }
    colour(text, "specular", material.specular)?;
    if material.transparency > 0.0 {
        writeln!(
            text,
            "<transparent opaque=\"A_ONE\"><color>1 1 1 1</color></transparent>"
        )?;
        writeln!(
            text,
            "<transparency><float>{}</float></transparency>",
            1.0 - material.transparency
        )?;
    }
    writeln!(text, "</phong></technique></profile_COMMON></effect>")
}

fn colour(text: &mut String, name: &str, colour: Option<[f64; 3]>) -> std::fmt::Result {
    let Some([red, green, blue]) = colour else {
        return Ok(());
    };
    writeln!(
        text,
        "<{name}><color>{red} {green} {blue} 1</color></{name}>"
    )
}

fn geometry(text: &mut String, number: usize, part: &Part) -> std::fmt::Result {
    let id = format!("mesh{number}");
    writeln!(
        text,
        "<geometry id=\"{id}\" name=\"{}\"><mesh>",
        escaped(&part.name)
    )?;
    source(
        text,
        &format!("{id}-positions"),
        &["X", "Y", "Z"],
        &part.vertices,
    )?;
    source(
        text,
        &format!("{id}-normals"),
        &["X", "Y", "Z"],
        part.normals.as_flattened(),
    )?;
    source(
        text,
        &format!("{id}-uv"),
        &["S", "T"],
        part.uv.as_flattened(),
    )?;
    writeln!(
        text,
        "<vertices id=\"{id}-vertices\"><input semantic=\"POSITION\" source=\"#{id}-positions\"/></vertices>"
    )?;
    writeln!(
        text,
        "<triangles count=\"{}\" material=\"symbol{number}\">",
        part.triangles.len()
    )?;
    writeln!(
        text,
        "<input semantic=\"VERTEX\" source=\"#{id}-vertices\" offset=\"0\"/>"
    )?;
    if !part.normals.is_empty() {
        writeln!(
            text,
            "<input semantic=\"NORMAL\" source=\"#{id}-normals\" offset=\"1\"/>"
        )?;
    }
    if !part.uv.is_empty() {
        writeln!(
            text,
            "<input semantic=\"TEXCOORD\" source=\"#{id}-uv\" offset=\"1\" set=\"0\"/>"
        )?;
    }
    write!(text, "<p>")?;
    let has_corners = !(part.normals.is_empty() && part.uv.is_empty());
    for (corner, index) in part.triangles.as_flattened().iter().enumerate() {
        if has_corners {
            write!(text, "{index} {corner} ")?;
        } else {
            write!(text, "{index} ")?;
        }
    }
    writeln!(text, "</p></triangles></mesh></geometry>")
}

fn source<const N: usize>(
    text: &mut String,
    id: &str,
    names: &[&str],
    rows: &[[f64; N]],
) -> std::fmt::Result {
    if rows.is_empty() {
        return Ok(());
    }
    write!(
        text,
        "<source id=\"{id}\"><float_array id=\"{id}-array\" count=\"{}\">",
        N * rows.len()
    )?;
    rows.as_flattened()
        .iter()
        .try_for_each(|x| write!(text, "{x} "))?;
    write!(
        text,
        "</float_array><technique_common><accessor source=\"#{id}-array\" count=\"{}\" stride=\"{N}\">",
        rows.len()
    )?;
    names
        .iter()
        .try_for_each(|name| write!(text, "<param name=\"{name}\" type=\"float\"/>"))?;
    writeln!(text, "</accessor></technique_common></source>")
}

fn node(text: &mut String, number: usize, part: &Part) -> std::fmt::Result {
    let name = if part.name.is_empty() {
        format!("part{number}")
    } else {
        escaped(&part.name)
    };
    writeln!(
        text,
        "<node id=\"node{number}\" name=\"{name}\"><instance_geometry url=\"#mesh{number}\"><bind_material><technique_common>"
    )?;
    writeln!(
        text,
        "<instance_material symbol=\"symbol{number}\" target=\"#material{number}\">"
    )?;
    writeln!(
        text,
        "<bind_vertex_input semantic=\"UV\" input_semantic=\"TEXCOORD\" input_set=\"0\"/></instance_material>"
    )?;
    writeln!(
        text,
        "</technique_common></bind_material></instance_geometry></node>"
    )
}

/// For contents and attributes; control characters, which XML cannot hold, become underscores.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            c if c.is_control() || c == '\u{fffe}' || c == '\u{ffff}' => escaped.push('_'),
            c => escaped.push(c),
        }
    }
    escaped
}
