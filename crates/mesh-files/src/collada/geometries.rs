//! Geometries: triangles, polygons, strips and fans of a mesh.

use std::rc::Rc;

use bounded_xml::Node;

use super::{Elements, Reader};
use crate::corners::{Corner, Lists, NONE, part, push_polygon};
use crate::error::Result;
use crate::mesh_file::{Material, Part};
use crate::ply::push_strip;
use crate::text::quoted;

/// Triangles with the symbol of their material, which the place in the scene binds to a material.
pub(super) struct Primitive {
    pub(super) symbol: String,
    pub(super) part: Part,
}

/// The lists of a primitive, and where in a corner's row of indices the index of each is.
#[derive(Default)]
struct Inputs {
    positions: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    uv: Vec<[f64; 2]>,
    position: Option<usize>,
    normal: Option<usize>,
    uv_offset: Option<usize>,
    stride: usize,
}

impl<'a> Reader<'a, '_> {
    /// The primitives of a geometry.
    pub(super) fn geometry(&mut self, node: Node<'a, 'a>) -> Result<Rc<Vec<Primitive>>> {
        if let Some(known) = self.geometries.get(&node.id()) {
            return Ok(known.clone());
        }
        let name = node
            .attribute("name")
            .or(node.attribute("id"))
            .unwrap_or("");
        let mut primitives = Vec::new();
        match node.first("mesh") {
            Some(mesh) => {
                for element in mesh.children().filter(Node::is_element) {
                    primitives.extend(self.primitive(element, name)?);
                }
            }
            None => self
                .file
                .warnings
                .push(format!("geometry {name}: not a mesh, left out")),
        }
        let primitives = Rc::new(primitives);
        self.geometries.insert(node.id(), primitives.clone());
        Ok(primitives)
    }

    fn primitive(&mut self, node: Node<'a, 'a>, name: &str) -> Result<Option<Primitive>> {
        let kind = node.tag_name().name();
        match kind {
            "triangles" | "polylist" | "polygons" | "tristrips" | "trifans" => {}
            "lines" | "linestrips" => {
                self.file
                    .warnings
                    .push(format!("geometry {name}: {kind} left out"));
                return Ok(None);
            }
            _ => return Ok(None),
        }
        let inputs = self.inputs(node)?;
        let triangles = self.triangles(node, &inputs)?;
        let lists = Lists {
            positions: &inputs.positions,
            normals: &inputs.normals,
            uv: &inputs.uv,
        };
        let part = part(name.into(), lists, &triangles, Material::default());
        Ok(Some(Primitive {
            symbol: node.attribute("material").unwrap_or("").into(),
            part,
        }))
    }

    fn inputs(&mut self, node: Node<'a, 'a>) -> Result<Inputs> {
        let mut inputs = Inputs::default();
        for input in node.all("input") {
            let offset: usize = input
                .attribute("offset")
                .unwrap_or("0")
                .trim()
                .parse()
                .unwrap_or(usize::MAX);
            if offset > 1000 {
                return Err(self.refused(input, "offset is not a small number"));
            }
            inputs.stride = inputs.stride.max(offset + 1);
            if input.attribute("semantic") == Some("VERTEX") {
                for input in self.referred(input, "source")?.all("input") {
                    self.input(input, offset, &mut inputs)?;
                }
            } else {
                self.input(input, offset, &mut inputs)?;
            }
        }
        if inputs.position.is_none() && node.first("p").is_some() {
            return Err(self.refused(node, "no input has the positions"));
        }
        Ok(inputs)
    }

    /// The first input of each meaning counts.
    fn input(&mut self, input: Node<'a, 'a>, offset: usize, inputs: &mut Inputs) -> Result<()> {
        match input.attribute("semantic") {
            Some("POSITION") if inputs.position.is_none() => {
                inputs.positions = self.source(input)?.list();
                inputs.position = Some(offset);
            }
            Some("NORMAL") if inputs.normal.is_none() => {
                inputs.normals = finite(self.source(input)?.list());
                inputs.normal = Some(offset);
            }
            Some("TEXCOORD") if inputs.uv_offset.is_none() => {
                inputs.uv = finite(self.source(input)?.list());
                inputs.uv_offset = Some(offset);
            }
            _ => {}
        }
        Ok(())
    }

    fn triangles(&mut self, node: Node<'a, 'a>, inputs: &Inputs) -> Result<Vec<[Corner; 3]>> {
        let mut triangles = Vec::new();
        let kind = node.tag_name().name();
        for list in node.all("p") {
            let corners = self.corners(list, inputs)?;
            match kind {
                "triangles" => triangles.extend(corners.as_chunks::<3>().0),
                "polylist" => self.polylist(node, &corners, inputs, &mut triangles)?,
                "tristrips" => push_strip(&corners, &mut triangles),
                "trifans" => triangles
                    .extend((2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]])),
                _ => push_polygon(&corners, &inputs.positions, &mut triangles),
            }
        }
        for holed in node.all("ph") {
            let Some(outline) = holed.first("p") else {
                continue;
            };
            push_polygon(
                &self.corners(outline, inputs)?,
                &inputs.positions,
                &mut triangles,
            );
            self.file
                .warnings
                .push("holes of polygons are filled".into());
        }
        Ok(triangles)
    }

    fn polylist(
        &self,
        node: Node<'a, 'a>,
        corners: &[Corner],
        inputs: &Inputs,
        triangles: &mut Vec<[Corner; 3]>,
    ) -> Result<()> {
        let Some(counts) = node.first("vcount") else {
            return Err(self.refused(node, "no vcount"));
        };
        let mut left = corners;
        for count in counts.text().unwrap_or("").split_ascii_whitespace() {
            let polygon = count
                .parse()
                .ok()
                .and_then(|count| left.split_at_checked(count));
            let refused = || {
                self.refused(
                    counts,
                    format!(
                        "{} corners, p has {} more",
                        quoted(count.as_bytes()),
                        left.len()
                    ),
                )
            };
            let (polygon, rest) = polygon.ok_or_else(refused)?;
            push_polygon(polygon, &inputs.positions, triangles);
            left = rest;
        }
        Ok(())
    }

    /// The corners of a list of indices. Normals and texture coordinates that are not there are left out, positions must be.
    fn corners(&self, list: Node<'a, 'a>, inputs: &Inputs) -> Result<Vec<Corner>> {
        let mut indices = Vec::new();
        for word in list.text().unwrap_or("").split_ascii_whitespace() {
            let index: u32 = word.parse().map_err(|_| {
                self.refused(list, format!("{} is no index", quoted(word.as_bytes())))
            })?;
            indices.push(index);
        }
        let mut corners = Vec::new();
        for row in indices.chunks_exact(inputs.stride.max(1)) {
            let of = |offset: Option<usize>, length: usize| {
                offset
                    .map(|offset| row[offset])
                    .filter(|index| numbers::place(*index) < length)
                    .unwrap_or(NONE)
            };
            let position = of(inputs.position, inputs.positions.len());
            if position == NONE {
                return Err(self.refused(
                    list,
                    format!("an index beyond the {} positions", inputs.positions.len()),
                ));
            }
            let (normal, uv) = (
                of(inputs.normal, inputs.normals.len()),
                of(inputs.uv_offset, inputs.uv.len()),
            );
            corners.push(Corner {
                position,
                normal,
                uv,
            });
        }
        Ok(corners)
    }
}

fn finite<const N: usize>(mut list: Vec<[f64; N]>) -> Vec<[f64; N]> {
    list.as_flattened_mut()
        .iter_mut()
        .filter(|x| !x.is_finite())
        .for_each(|x| *x = 0.0);
    list
}
