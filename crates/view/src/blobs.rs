//! Blobs: meshes, textures and points as bytes, named by a hash of their content. Little endian; docs/VIEW_PROTOCOL.md has their layout.

use std::sync::Arc;

use nalgebra::Point3;
use ring::digest::{SHA256, digest};

use perception::vision::texture_coordinates;
use scene::appearance::texture::Texture;
use scene::shape::Part;

pub(crate) use super::hash::Hash;

impl Hash {
    pub(crate) fn of(bytes: &[u8]) -> Self {
        let digest = digest(&SHA256, bytes);
        Self(*digest.as_ref().first_chunk().expect("SHA-256 has 32 bytes"))
    }
}

/// Bytes with their name. They never change.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Blob {
    pub hash: Hash,
    pub bytes: Vec<u8>,
}

impl Blob {
    fn new(bytes: Vec<u8>) -> Arc<Self> {
        Arc::new(Self {
            hash: Hash::of(&bytes),
            bytes,
        })
    }

    /// A mesh in the frame of its shape; with the edges between faces that meet at more than `edge_angle` (radians).
    pub(crate) fn mesh(part: &Part, edge_angle: Option<f64>) -> Arc<Self> {
        let mesh = &*part.mesh;
        let (vertices, triangles) = (&mesh.vertices, &mesh.triangles);
        let coordinates = texture_coordinates(part);
        // Scripts may set too few texture coordinates: the mesh is then drawn without them.
        let has_coordinates = coordinates.len() == 3 * triangles.len() && !coordinates.is_empty();
        let edges = edge_angle.map_or_else(Vec::new, |angle| mesh.sharp_edges(angle));
        let mut bytes =
            Vec::with_capacity(20 + 12 * vertices.len() + 72 * triangles.len() + 8 * edges.len());
        bytes.extend_from_slice(b"MESH");
        let counts = [
            vertices.len() as u32,
            triangles.len() as u32,
            edges.len() as u32,
            u32::from(has_coordinates),
        ];
        counts
            .iter()
            .for_each(|count| bytes.extend_from_slice(&count.to_le_bytes()));
        for vertex in vertices {
            push_numbers(
                &mut bytes,
                (part.pose * Point3::from(*vertex)).coords.into(),
            );
        }
        triangles
            .iter()
            .flatten()
            .for_each(|index| bytes.extend_from_slice(&index.to_le_bytes()));
        for normal in &mesh.normals {
            push_numbers(
                &mut bytes,
                (part.pose.rotation * nalgebra::Vector3::from(*normal)).into(),
            );
        }
        if has_coordinates {
            coordinates
                .iter()
                .flatten()
                .for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
        }
        edges
            .iter()
            .flatten()
            .for_each(|index| bytes.extend_from_slice(&index.to_le_bytes()));
        Self::new(bytes)
    }

    /// An image, whose first row is the bottom one.
    pub(crate) fn texture(texture: &Texture) -> Arc<Self> {
        Self::image(texture.size(), &texture.rgba())
    }

    /// The same of red, green, blue and opacity of each pixel.
    pub(crate) fn image(size: [u32; 2], rgba: &[u8]) -> Arc<Self> {
        let mut bytes = Vec::with_capacity(12 + rgba.len());
        bytes.extend_from_slice(b"TEXR");
        size.iter()
            .for_each(|side| bytes.extend_from_slice(&side.to_le_bytes()));
        bytes.extend_from_slice(rgba);
        Self::new(bytes)
    }

    /// Points, or centres of voxels, in the frame of their object, with red, green and blue of each.
    pub(crate) fn points(points: &[([f64; 3], [u8; 3])]) -> Arc<Self> {
        let mut bytes = Vec::with_capacity(8 + 16 * points.len());
        bytes.extend_from_slice(b"PNTS");
        bytes.extend_from_slice(&(points.len() as u32).to_le_bytes());
        points
            .iter()
            .for_each(|(position, _)| push_numbers(&mut bytes, *position));
        points
            .iter()
            .for_each(|(_, [r, g, b])| bytes.extend_from_slice(&[*r, *g, *b, u8::MAX]));
        Self::new(bytes)
    }
}

fn push_numbers(bytes: &mut Vec<u8>, numbers: [f64; 3]) {
    numbers
        .iter()
        .for_each(|number| bytes.extend_from_slice(&(*number as f32).to_le_bytes()));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_are_written_and_read() {
        let hash = Hash::of(b"a");
        assert_eq!(hash.to_string().len(), 32);
        assert_eq!(Hash::from_text(&hash.to_string()), Some(hash));
        for text in [
            "",
            "ca978112ca1bbdcafac231b39a23dc4",
            "+a978112ca1bbdcafac231b39a23dc4d",
            "CA978112CA1BBDCAFAC231B39A23DC4D",
        ] {
            assert_eq!(Hash::from_text(text), None, "{text}");
        }
    }

    #[test]
    fn points_have_the_layout_of_the_protocol() {
        let blob = Blob::points(&[([1.0, 2.0, 3.0], [4, 5, 6]), ([0.0; 3], [7; 3])]);
        assert_eq!(&blob.bytes[..8], b"PNTS\x02\0\0\0");
        assert_eq!(blob.bytes[8..12], 1f32.to_le_bytes());
        assert_eq!(blob.bytes[32..], [4, 5, 6, 255, 7, 7, 7, 255]);
        assert_eq!(
            blob.hash,
            Blob::points(&[([1.0, 2.0, 3.0], [4, 5, 6]), ([0.0; 3], [7; 3])]).hash
        );
    }
}
