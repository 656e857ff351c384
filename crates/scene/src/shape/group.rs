//! Grouping, merging and splitting of shapes (spec: shapes 5).
//!
//! A shape keeps a flat list of parts; each knows the groups it is in. The frame of a group is that of its last part.

use std::collections::BTreeSet;
use std::rc::Rc;

use geometry::DecompositionParameters;
use geometry::MassProperties;
use geometry::Mesh;
use geometry::PrimitiveKind;

use super::reshape::box_of;
use super::{Part, Shape};
use crate::{Handle, Kind, Object, Pose, Scene, SceneError, SceneResult};

impl Shape {
    /// The parts with the mass each would have as a shape of its own, in the part's frame. Those of a group share the mass the group
    /// was given.
    fn parts_with_mass(&self) -> Vec<Part> {
        let mut parts = self.parts.clone();
        if let [part] = parts.as_mut_slice() {
            part.mass = self.mass.reexpressed(&part.pose.inverse());
        }
        let sum: f64 = parts.iter().map(|part| part.mass.mass).sum();
        parts
            .iter_mut()
            .for_each(|part| part.mass.set_mass(part.mass.mass * self.mass.mass / sum));
        parts
    }

    /// Shapes that were grouped into this one: a list of parts each, without the number of their group.
    fn members(&self) -> Vec<Vec<Part>> {
        let together = |a: &Part, b: &Part| {
            a.group
                .first()
                .is_some_and(|group| b.group.first() == Some(group))
        };
        let mut members: Vec<Vec<Part>> = self
            .parts
            .chunk_by(together)
            .map(<[Part]>::to_vec)
            .collect();
        members
            .iter_mut()
            .flatten()
            .for_each(|part| drop(part.group.drain(..part.group.len().min(1))));
        members
    }

    /// Whether physics knows all parts as solids, not as terrain.
    fn is_pure_solid(&self) -> bool {
        let solid = |p: &Part| {
            p.primitive
                .as_ref()
                .is_some_and(|p| p.kind != PrimitiveKind::Heightfield)
        };
        self.parts.iter().all(solid)
    }
}

impl Shape {
    /// A compound of shapes that have the same frame; a single one stays as it is.
    ///
    /// # Errors
    /// When there is none.
    pub fn compound(mut shapes: Vec<Shape>) -> SceneResult<Shape> {
        if shapes.len() == 1 {
            return shapes.pop().ok_or(SceneError::OperationFailed);
        }
        let placed: Vec<(Pose, &Shape)> = shapes
            .iter()
            .map(|shape| (Pose::identity(), shape))
            .collect();
        grouped(&placed, shapes.last().ok_or(SceneError::OperationFailed)?)
    }
}

impl Scene {
    /// Makes one shape of several; the last one gives its pose, place in the tree, name and flags. With `merge` the result is one
    /// mesh, with colour and mass of the last one; otherwise a compound with the mass of all. The originals are still there.
    ///
    /// # Errors
    /// When fewer than two of the handles are shapes.
    pub fn group_shapes(
        &mut self,
        handles: &[i64],
        merge: bool,
    ) -> SceneResult<(Handle, Vec<Handle>)> {
        let members = self.shapes_among(handles);
        let [.., master] = members.as_slice() else {
            return Err(SceneError::NotEnoughShapes);
        };
        if members.len() < 2 {
            return Err(SceneError::NotEnoughShapes);
        }
        let frame = self.world_pose(*master)?;
        let mut shapes = Vec::new();
        for &member in &members {
            let pose = frame.inverse() * self.world_pose(member)?;
            shapes.push((pose, self.named_shape(member)?));
        }
        let placed: Vec<_> = shapes.iter().map(|(pose, shape)| (*pose, shape)).collect();
        let (_, last) = placed.last().ok_or(SceneError::NotEnoughShapes)?;
        let shape = if merge {
            merged(&placed, last)?
        } else {
            grouped(&placed, last)?
        };
        let group = self.replace_shape(*master, shape)?;
        Ok((group, members))
    }

    /// A shape whose only part, if it has one, knows the alias of the object.
    fn named_shape(&self, handle: Handle) -> SceneResult<Shape> {
        let object = self.object(handle)?;
        let mut shape = object.shape()?.clone();
        if let [part] = shape.parts.as_mut_slice() {
            object.alias().clone_into(&mut part.alias);
        }
        Ok(shape)
    }

    /// Shapes among `handles`, each once.
    fn shapes_among(&self, handles: &[i64]) -> Vec<Handle> {
        let is_shape = |handle: &Handle| {
            self.object(*handle)
                .is_ok_and(|object| object.shape().is_ok())
        };
        let mut met = BTreeSet::new();
        let given = handles.iter().filter_map(|&raw| Handle::from_raw(raw));
        given
            .filter(|handle| is_shape(handle) && met.insert(*handle))
            .collect()
    }

    /// A new object with the given shape and the place, names, flags and children of `old`, whose name from before aliases changes.
    fn replace_shape(&mut self, old: Handle, shape: Shape) -> SceneResult<Handle> {
        let new = self.add_beside(old, shape)?;
        let name = self.object(old)?.old_name().to_owned();
        let given = self.object(new)?.old_name().to_owned();
        self.set_old_name(old, &given)?;
        self.set_old_name(new, &name)?;
        for child in self.object(old)?.children().to_vec() {
            self.set_parent(child, Some(new), true)?;
        }
        Ok(new)
    }

    /// A new object with the given shape and the pose, parent, position among siblings, name and flags of `model`.
    fn add_beside(&mut self, model: Handle, shape: Shape) -> SceneResult<Handle> {
        let source = self.object(model)?;
        let (alias, parent, pose) = (source.alias().to_owned(), source.parent(), source.pose());
        let place = self.place_among_siblings(model)?;
        let new = self.add(&alias, Kind::Shape(Box::new(shape)))?;
        self.set_parent(new, parent, false)?;
        self.set_local_pose(new, pose)?;
        self.set_hierarchy_order(new, place as i64)?;
        let make_alike = settings_of(self.object(model)?);
        self.modify(new, crate::Field::ObjectProperty, make_alike)?;
        Ok(new)
    }

    /// Splits a compound into shapes of its parts, with the aliases they had. None for a simple shape. The original is kept.
    ///
    /// # Errors
    /// When the object is no shape.
    pub fn ungroup_shape(&mut self, handle: Handle) -> SceneResult<Option<Vec<Handle>>> {
        let shape = self.object(handle)?.shape()?.clone();
        if !shape.is_compound() {
            return Ok(None);
        }
        let frame = self.object(handle)?.pose();
        let mut pieces = Vec::new();
        for member in shape.members() {
            pieces.push(match member.as_slice() {
                [part] => self.add_piece(handle, &shape, part, frame)?,
                parts => self.add_group(handle, &shape, parts, frame)?,
            });
        }
        Ok(Some(pieces))
    }

    /// A new object of several parts of `shape`, which the object `handle` is.
    fn add_group(
        &mut self,
        handle: Handle,
        shape: &Shape,
        parts: &[Part],
        frame: Pose,
    ) -> SceneResult<Handle> {
        let own = parts.last().ok_or(SceneError::OperationFailed)?.pose;
        let mut parts = parts.to_vec();
        parts
            .iter_mut()
            .for_each(|part| part.pose = own.inverse() * part.pose);
        let masses: Vec<_> = parts.iter().map(|part| (part.pose, part.mass)).collect();
        let mass = MassProperties::combine(&masses).ok_or(SceneError::OperationFailed)?;
        let bounding_box = box_of(&parts).ok_or(SceneError::OperationFailed)?;
        let group = self.add_beside(
            handle,
            Shape {
                parts,
                bounding_box,
                mass,
                dynamics: shape.dynamics.clone(),
                material: shape.material.clone(),
                soft_form: None,
                ..*shape
            },
        )?;
        self.set_local_pose(group, frame * own)?;
        Ok(group)
    }

    /// A new object of one part of `shape`, which the object `handle` is.
    fn add_piece(
        &mut self,
        handle: Handle,
        shape: &Shape,
        part: &Part,
        frame: Pose,
    ) -> SceneResult<Handle> {
        let mut own = part.clone();
        own.pose = Pose::identity();
        let box_of_part = box_of(std::slice::from_ref(&own)).ok_or(SceneError::OperationFailed)?;
        let pure = own.primitive.is_some();
        let mut piece = Shape::simple(own, box_of_part);
        if !pure {
            piece.fit_box(None);
        }
        piece.dynamics = shape.dynamics.clone();
        piece.material = shape.material.clone();
        let piece = self.add_beside(handle, piece)?;
        if !part.alias.is_empty() {
            self.set_alias(piece, part.alias.as_bytes())?;
        }
        self.set_local_pose(piece, frame * part.pose)?;
        Ok(piece)
    }

    /// Convex decomposition of the shape, and its pose. Mass, flags, material and appearance are those of the original.
    ///
    /// # Errors
    /// When the object is no shape or has no volume.
    pub fn convex_decomposition(&self, handle: Handle) -> SceneResult<(Shape, Pose)> {
        let (pieces, pose) = self.convex_shapes(handle, DecompositionParameters::default())?;
        let parts: Vec<Part> = pieces.into_iter().flat_map(|piece| piece.parts).collect();
        let bounding_box = box_of(&parts).ok_or(SceneError::InvalidData)?;
        Ok((
            Shape {
                parts,
                bounding_box,
                ..self.object(handle)?.shape()?.clone()
            },
            pose,
        ))
    }

    /// Convex pieces of a shape as shapes in its frame, and the pose of that frame, with the appearance of the original.
    ///
    /// # Errors
    /// When the object is no shape or has no volume.
    pub fn convex_shapes(
        &self,
        handle: Handle,
        fineness: DecompositionParameters,
    ) -> SceneResult<(Vec<Shape>, Pose)> {
        let original = self.object(handle)?.shape()?;
        let appearance = original
            .parts
            .first()
            .map_or_else(Shape::mesh_appearance, |part| part.appearance.clone());
        let mut pieces = Vec::new();
        for mesh in original.mesh().convex_pieces(fineness) {
            let mut piece = Shape::from_mesh(mesh, appearance.clone())?;
            piece.parts.iter_mut().for_each(|part| part.convex = true);
            pieces.push(piece);
        }
        if pieces.is_empty() {
            return Err(SceneError::Refused(
                "the shape has no volume to divide.".into(),
            ));
        }
        Ok((pieces, self.world_pose(handle)?))
    }

    /// Splits a mesh into its islands. None when there is only one. The original is kept.
    ///
    /// # Errors
    /// For compounds.
    pub fn divide_shape(&mut self, handle: Handle) -> SceneResult<Option<Vec<Handle>>> {
        let shape = self.object(handle)?.shape()?.clone();
        let [part] = shape.parts.as_slice() else {
            return Err(SceneError::DividesCompound);
        };
        let islands = part.mesh.islands();
        if islands.len() < 2 {
            return Ok(None);
        }
        let mut pieces = Vec::new();
        for triangles in islands {
            let mesh = part.mesh.of_triangles(&triangles);
            let texture = part
                .texture
                .as_ref()
                .map(|texture| Box::new(texture.of_triangles(&triangles)));
            let frame = self.object(handle)?.pose();
            let convex = mesh.is_convex();
            let mass = MassProperties::default();
            let island = Part {
                mesh: Rc::new(mesh),
                primitive: None,
                convex,
                mass,
                texture,
                ..part.clone()
            };
            pieces.push(self.add_piece(handle, &shape, &island, frame)?);
        }
        Ok(Some(pieces))
    }
}

impl Shape {
    /// One shape of several, with their poses in its frame: material and flags of `master`, the mass of all.
    ///
    /// # Errors
    /// When there are none, or they have no extent.
    pub fn from_placed(placed: &[(Pose, &Shape)], master: &Shape) -> SceneResult<Self> {
        grouped(placed, master)
    }
}

/// Gives another object the flags and the lasting values of this one. Its shape, which may have very many parts, is not looked at.
fn settings_of(source: &Object) -> impl FnOnce(&mut Object) + use<> {
    let flags = (source.object_property, source.special_property);
    let (model_property, layer) = (source.model_property, source.layer);
    let (size_factor, movement) = (source.size_factor, source.movement);
    let (inert, custom_data) = (source.inert.clone(), source.custom_data.clone());
    move |object| {
        (object.object_property, object.special_property) = flags;
        (object.model_property, object.layer) = (model_property, layer);
        (object.size_factor, object.movement) = (size_factor, movement);
        (object.inert, object.custom_data) = (inert, custom_data);
    }
}

/// A compound in the master's frame; `placed` are shapes with their poses in it.
fn grouped(placed: &[(Pose, &Shape)], master: &Shape) -> SceneResult<Shape> {
    let pure = placed.iter().all(|(_, shape)| shape.is_pure_solid());
    let mut parts = Vec::new();
    for (number, (pose, shape)) in (0..).zip(placed) {
        for mut part in shape.parts_with_mass() {
            part.pose = pose * part.pose;
            if shape.is_compound() {
                part.group.insert(0, number);
            }
            part.primitive = part.primitive.filter(|_| pure);
            parts.push(part);
        }
    }
    let masses: Vec<_> = placed
        .iter()
        .map(|(pose, shape)| (*pose, shape.mass))
        .collect();
    let mass = MassProperties::combine(&masses).ok_or(SceneError::OperationFailed)?;
    let bounding_box = box_of(&parts).ok_or(SceneError::OperationFailed)?;
    Ok(Shape {
        parts,
        bounding_box,
        mass,
        ..master.clone()
    })
}

/// One mesh in the master's frame, with the master's appearance, texture and mass.
fn merged(placed: &[(Pose, &Shape)], master: &Shape) -> SceneResult<Shape> {
    let mut mesh = Mesh::default();
    placed
        .iter()
        .for_each(|(pose, shape)| mesh.append(&shape.mesh(), pose));
    let appearance = master
        .parts
        .first()
        .map_or_else(Shape::mesh_appearance, |part| part.appearance.clone());
    let mut shape = Shape::from_mesh(mesh, appearance)?;
    shape.fit_box(Some(nalgebra::UnitQuaternion::identity()));
    (shape.mass, shape.parts[0].mass) = (master.mass, master.mass);
    shape.dynamics = master.dynamics.clone();
    shape.material = master.material.clone();
    // A projected texture is kept; coordinates per corner are dropped, since the other meshes have none.
    let projected = master
        .parts
        .first()
        .and_then(|part| part.texture.clone())
        .filter(|t| t.coordinates.is_empty());
    shape.parts[0].texture = projected;
    Ok(shape)
}

#[cfg(test)]
mod tests;
