//! Stereolithography: text and binary. Normals are left out, since files are often wrong about them: the corners' order counts.

mod text;
mod write;

pub(crate) use write::{write_binary, write_text};

use crate::bytes::Bytes;
use crate::error::{Location, ReadError, Result};
use crate::limits::Limits;
use crate::mesh_file::{Material, MeshFile, Part};

const HEADER: usize = 80;
const TRIANGLE: usize = 50;

pub(crate) fn read(bytes: &[u8], limits: Limits) -> Result<MeshFile> {
    if is_text(bytes) {
        text::read(bytes, limits)
    } else {
        binary(bytes, limits)
    }
}

/// Some binary files begin with `solid` too: their length or the words after it give them away.
fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    if !start
        .get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
    {
        return false;
    }
    let has_count = bytes.get(HEADER..HEADER + 4).is_some_and(|count| {
        let count = u32::from_le_bytes(count.try_into().expect("four bytes"));
        bytes.len() as u64 == HEADER as u64 + 4 + u64::from(count) * TRIANGLE as u64
    });
    let mut head = start[5..start.len().min(2048)].split(u8::is_ascii_whitespace);
    !has_count
        && head.any(|word| {
            word.eq_ignore_ascii_case(b"facet") || word.eq_ignore_ascii_case(b"endsolid")
        })
}

fn binary(bytes: &[u8], mut limits: Limits) -> Result<MeshFile> {
    let mut reader = Bytes::new(bytes, 0);
    let header = reader.take(HEADER, "header")?;
    let count = numbers::place(reader.u32("number of triangles")?);
    reader.check_room(count, TRIANGLE, "triangles")?;
    limits.take(count.saturating_mul(3), count)?;
    let mut part = Part {
        material: Material {
            diffuse: header_colour(header),
            ..Material::default()
        },
        ..Part::default()
    };
    part.vertices.reserve_exact(3 * count);
    let (triangles, _) = reader
        .take(count * TRIANGLE, "triangles")?
        .as_chunks::<TRIANGLE>();
    for (number, triangle) in triangles.iter().enumerate() {
        let corners = vertices(triangle);
        if !corners.as_flattened().iter().all(|x| x.is_finite()) {
            let place = Location::Byte(HEADER + 4 + number * TRIANGLE);
            return Err(ReadError::new(
                place,
                format!("triangle {number}"),
                "a coordinate that is not finite",
            ));
        }
        part.vertices
            .extend(corners.map(|corner| corner.map(f64::from)));
    }
    part.triangles.extend(
        (0..numbers::count_u32(count)).map(|number| [3 * number, 3 * number + 1, 3 * number + 2]),
    );
    Ok(MeshFile {
        parts: vec![part],
        ..MeshFile::default()
    })
}

/// The vertices of a triangle: after the normal, before the attribute.
fn vertices(triangle: &[u8; TRIANGLE]) -> [[f32; 3]; 3] {
    let (floats, _) = triangle[12..].as_chunks::<4>();
    [0, 3, 6].map(|first| [0, 1, 2].map(|axis| f32::from_le_bytes(floats[first + axis])))
}

/// `COLOR=` and four bytes in the header, as Materialise Magics writes.
fn header_colour(header: &[u8]) -> Option<[f64; 3]> {
    let at = header.windows(6).position(|word| word == b"COLOR=")? + 6;
    let &[red, green, blue] = header.get(at..at + 3)? else {
        return None;
    };
    Some([red, green, blue].map(|share| f64::from(share) / 255.0))
}
