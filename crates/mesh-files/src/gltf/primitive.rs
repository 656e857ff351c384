//! Meshes: a part for each primitive of triangles.

use std::rc::Rc;

use serde_json::Value;

use super::{Reader, integer, item, list, refused, string};
use crate::corners::{Corner, Lists, NONE, part};
use crate::error::Result;
use crate::mesh_file::{Material, Part};
use crate::ply::push_strip;

const TRIANGLES: usize = 4;
const STRIP: usize = 5;
const FAN: usize = 6;

impl Reader<'_, '_> {
    /// The parts of a mesh.
    pub(super) fn mesh(&mut self, index: usize) -> Result<Rc<Vec<Part>>> {
        if let Some(Some(known)) = self.meshes.get(index) {
            return Ok(known.clone());
        }
        let mesh = item(self.root, "meshes", index)?;
        let name = string(mesh, "name").unwrap_or("");
        let mut parts = Vec::new();
        for (number, primitive) in list(mesh, "primitives").iter().enumerate() {
            parts.extend(self.primitive(
                primitive,
                name,
                &format!("mesh {index} primitive {number}"),
            )?);
        }
        let parts = Rc::new(parts);
        self.meshes[index] = Some(parts.clone());
        Ok(parts)
    }

    fn primitive(&mut self, primitive: &Value, name: &str, element: &str) -> Result<Option<Part>> {
        let mode = integer(primitive, "mode", element)?.unwrap_or(TRIANGLES);
        if ![TRIANGLES, STRIP, FAN].contains(&mode) {
            self.file
                .warnings
                .push(format!("{element}: points and lines are left out"));
            return Ok(None);
        }
        let attributes = &primitive["attributes"];
        let Some(position) = integer(attributes, "POSITION", element)? else {
            return Ok(None);
        };
        // What is shared by many primitives is read for each of them, so each pays.
        self.limits.take(self.rows_of(position), 0)?;
        let positions = self.accessor::<3>(position)?;
        let normals = self.attribute::<3>(attributes, "NORMAL", positions.len(), element)?;
        let uv = self.attribute::<2>(attributes, "TEXCOORD_0", positions.len(), element)?;
        let uv: Vec<[f64; 2]> = uv.into_iter().map(|[u, v]| [u, 1.0 - v]).collect();
        let corners = self.corners(
            primitive,
            positions.len(),
            [!normals.is_empty(), !uv.is_empty()],
            element,
        )?;
        let triangles = triangles(mode, &corners);
        self.limits.take(0, triangles.len())?;
        let material = match integer(primitive, "material", element)? {
            Some(index) => self.material(index)?,
            None => Material::default(),
        };
        let lists = Lists {
            positions: &positions,
            normals: &normals,
            uv: &uv,
        };
        Ok(Some(part(name.into(), lists, &triangles, material)))
    }

    /// Of each vertex, or empty. Numbers that are none become 0.
    fn attribute<const N: usize>(
        &self,
        attributes: &Value,
        name: &str,
        vertices: usize,
        element: &str,
    ) -> Result<Vec<[f64; N]>> {
        let Some(index) = integer(attributes, name, element)? else {
            return Ok(Vec::new());
        };
        let mut rows = self.accessor(index)?;
        if rows.len() != vertices {
            return Err(refused(
                element,
                format!("{name} has {} rows for {vertices} vertices", rows.len()),
            ));
        }
        rows.as_flattened_mut()
            .iter_mut()
            .filter(|x| !x.is_finite())
            .for_each(|x| *x = 0.0);
        Ok(rows)
    }

    /// The vertices in the order of the indices, or of the list.
    fn corners(
        &self,
        primitive: &Value,
        vertices: usize,
        has: [bool; 2],
        element: &str,
    ) -> Result<Vec<Corner>> {
        let corner = |position: u32| {
            let [normal, uv] = has.map(|has| if has { position } else { NONE });
            Corner {
                position,
                normal,
                uv,
            }
        };
        let Some(index) = integer(primitive, "indices", element)? else {
            return Ok((0..numbers::count_u32(vertices)).map(corner).collect());
        };
        let indices = self.accessor::<1>(index)?;
        let wrong = indices
            .as_flattened()
            .iter()
            .find(|index| !(**index >= 0.0 && **index < numbers::real(vertices)));
        match wrong {
            Some(index) => Err(refused(element, format!("vertex {index} of {vertices}"))),
            None => Ok(indices
                .iter()
                .map(|[index]| corner(numbers::truncated_u32(*index)))
                .collect()),
        }
    }
}

fn triangles(mode: usize, corners: &[Corner]) -> Vec<[Corner; 3]> {
    let mut triangles = Vec::new();
    match mode {
        STRIP => push_strip(corners, &mut triangles),
        FAN => {
            triangles.extend((2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]]));
        }
        _ => triangles.extend(corners.as_chunks::<3>().0),
    }
    triangles
}
