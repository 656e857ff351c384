//! Nodes with what lies in them. Scales are part of the meshes: frames have none.

use super::scene::Placed;
use super::{Asset, Node, Reader, integer, list, string, with_reader};
use crate::Resolve;
use crate::error::{Location, ReadError, Result};
use crate::limits::Limits;
use crate::mesh_file::Part;
use crate::transform::Transform;

/// A larger file is not read: its JSON may take twenty times as much memory.
const MAX_BYTES: usize = 256 << 20;

impl Asset {
    /// Reads a file, binary or text: all nodes of its scene, each with a mesh of its own. What it names, `resolve` looks up.
    ///
    /// # Errors
    ///
    /// Where the file is damaged, requires an extension that is not known, or exceeds the limits.
    pub fn read(bytes: &[u8], limits: Limits, resolve: Resolve) -> Result<Self> {
        if bytes.len() > MAX_BYTES {
            return Err(ReadError::new(
                Location::File,
                "file",
                format!("larger than {} MiB", MAX_BYTES >> 20),
            ));
        }
        with_reader(bytes, limits, resolve, |mut reader| {
            let placed = reader.scene()?;
            let mut asset = Asset::default();
            for one in &placed {
                reader.add_node(one, &placed, &mut asset)?;
            }
            asset.textures = std::mem::take(&mut reader.file.textures);
            asset.warnings = std::mem::take(&mut reader.file.warnings);
            asset.warnings.extend(reader.left_out());
            asset.check_finite()?;
            Ok(asset)
        })
    }

    fn check_finite(&self) -> Result<()> {
        for (number, node) in self.nodes.iter().enumerate() {
            let coordinates = node
                .mesh
                .map_or(&[][..], |mesh| &self.meshes[mesh])
                .iter()
                .flat_map(|part| part.vertices.as_flattened());
            if !node
                .translation
                .iter()
                .chain(&node.rotation)
                .chain(coordinates)
                .all(|x| x.is_finite())
            {
                let problem = "a place that is not finite";
                return Err(ReadError::new(
                    Location::File,
                    format!("node {number} of the scene"),
                    problem,
                ));
            }
        }
        Ok(())
    }
}

impl Reader<'_, '_> {
    fn add_node(&mut self, placed: &Placed, all: &[Placed], asset: &mut Asset) -> Result<()> {
        let node = &list(self.root, "nodes")[placed.node];
        let element = format!("node {}", placed.node);
        let rigid = placed.transform.rigid();
        let parts = self.parts_of(
            node,
            placed.node,
            &rigid.rigid_inverse().after(&placed.transform),
        )?;
        let parts: Vec<Part> = parts
            .into_iter()
            .filter(|part| !part.triangles.is_empty())
            .collect();
        let mesh = (!parts.is_empty()).then_some(asset.meshes.len());
        asset.meshes.extend(mesh.map(|_| parts));
        let above = placed
            .parent
            .map_or(Transform::IDENTITY, |parent| all[parent].transform.rigid());
        let local = above.rigid_inverse().after(&rigid);
        asset.nodes.push(Node {
            name: string(node, "name").unwrap_or("").into(),
            parent: placed.parent,
            translation: local.0.map(|row| row[3]),
            rotation: local.quaternion(),
            mesh,
            camera: integer(node, "camera", &element)?
                .map(|index| self.camera(index))
                .transpose()?,
            light: self.light_of(node, &element)?,
        });
        Ok(())
    }

    /// What an asset has no place for.
    fn left_out(&self) -> Vec<String> {
        let names = ["animations", "skins"]
            .into_iter()
            .filter(|name| !list(self.root, name).is_empty());
        names.map(|name| format!("{name} are left out")).collect()
    }
}
