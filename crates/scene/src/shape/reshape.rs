//! Geometry of shapes: their mesh as a whole, frames, bounding boxes, size, mass from density.

use std::rc::Rc;

use geometry::BoundingBox;
use geometry::MAX_COORDINATE;
use geometry::Mesh;
use geometry::PrimitiveKind;
use geometry::mass::compute_mass_and_inertia;
use nalgebra::UnitQuaternion;

use super::{Part, Shape};
use crate::{Field, Handle, Pose, Scene, SceneError, SceneResult};

impl Part {
    /// Turns the mesh inside out; what physics takes for a solid is the same.
    pub fn flip_faces(&mut self) {
        Rc::make_mut(&mut self.mesh).flip();
        if let Some(texture) = &mut self.texture {
            texture.flip();
        }
    }
}

impl Shape {
    /// All meshes as one, in the shape frame.
    pub fn mesh(&self) -> Mesh {
        let mut mesh = Mesh::default();
        self.parts
            .iter()
            .for_each(|part| mesh.append(&part.mesh, &part.pose));
        mesh
    }

    /// Whether the shape, scaled by `factor`, would still be small enough for a file.
    ///
    /// # Errors
    /// When it would not be.
    pub fn check_extent(&self, factor: f64) -> SceneResult<()> {
        let centre = self.bounding_box.pose.translation.vector;
        let lengths = self.bounding_box.size.iter().chain(centre.as_slice());
        let places = self
            .parts
            .iter()
            .flat_map(|part| part.pose.translation.vector.as_slice());
        let fits = lengths
            .chain(places)
            .all(|length| (length * factor).abs() <= MAX_COORDINATE);
        if fits { Ok(()) } else { Err(too_large()) }
    }

    /// Whether this is one primitive whose frame cannot be moved within it.
    fn is_fixed_primitive(&self) -> bool {
        !self.is_compound() && self.is_pure()
    }

    /// Turns the bounding box; None: the tightest, smallest extent along its x, largest along its z.
    pub fn fit_box(&mut self, orientation: Option<UnitQuaternion<f64>>) {
        let mesh = self.mesh();
        let fitted = orientation.map_or_else(
            || mesh.oriented_box(),
            |orientation| mesh.bounding_box(&orientation),
        );
        if let Some(fitted) = fitted {
            self.bounding_box = fitted;
        }
    }

    /// Expresses the same body in another frame, in which the old shape frame has the pose `old_in_new`.
    pub fn reframe(&mut self, old_in_new: &Pose) {
        let compound = self.is_compound();
        for part in &mut self.parts {
            let pose = old_in_new * part.pose;
            if compound || part.primitive.is_some() {
                part.pose = pose;
            } else {
                // A simple mesh keeps its frame at the shape frame: that is what it has when it is ungrouped later.
                Rc::make_mut(&mut part.mesh).transform(&pose);
                part.mass = part.mass.reexpressed(&pose);
                part.pose = Pose::identity();
            }
        }
        self.mass = self.mass.reexpressed(old_in_new);
        self.bounding_box.pose = old_in_new * self.bounding_box.pose;
    }

    /// Scales the geometry along the axes of the bounding box as the primitive allows; mass and inertia stay.
    ///
    /// # Errors
    /// For compounds that would be scaled by more than one factor.
    pub fn stretch(&mut self, factors: [f64; 3]) -> SceneResult<()> {
        let [x, y, z] = factors.map(|f| {
            if f.is_finite() {
                f.abs().max(1e-4)
            } else {
                1.0
            }
        });
        let uniform = x == y && y == z;
        if self.is_compound() && !uniform {
            return Err(SceneError::InvalidArgument);
        }
        let kind = self
            .parts
            .first()
            .and_then(|part| part.primitive.as_ref())
            .map(|primitive| primitive.kind);
        let factors = match kind.filter(|_| !self.is_compound()) {
            Some(kind) => allowed_factors(kind, [x, y, z]),
            None => [x, y, z],
        };
        let box_frame = self.bounding_box.pose;
        self.parts
            .iter_mut()
            .for_each(|part| stretch_part(part, &box_frame, factors));
        for (extent, factor) in self.bounding_box.size.iter_mut().zip(factors) {
            *extent *= factor;
        }
        self.bounding_box.pose.translation.vector *= if uniform { x } else { 1.0 };
        Ok(())
    }

    /// Sets mass, centre and inertia from a density (kg/m3); false when the shape has no volume.
    pub fn set_mass_from_density(&mut self, density: f64) -> bool {
        let primitive = match self.parts.as_slice() {
            [part] => part
                .primitive
                .as_ref()
                .map(|primitive| (primitive.kind, primitive.size)),
            _ => None,
        };
        match compute_mass_and_inertia(primitive, &self.mesh().vertices, density) {
            Some(mass) => {
                self.mass = mass;
                true
            }
            None => false,
        }
    }
}

/// The factors a primitive takes when it is scaled without becoming a mesh.
fn allowed_factors(kind: PrimitiveKind, [x, y, z]: [f64; 3]) -> [f64; 3] {
    match kind {
        PrimitiveKind::Plane => [x, y, 1.0],
        PrimitiveKind::Disc => [x, x, 1.0],
        PrimitiveKind::Cylinder | PrimitiveKind::Cone | PrimitiveKind::Heightfield => [x, x, z],
        PrimitiveKind::Spheroid | PrimitiveKind::Capsule => [x, x, x],
        PrimitiveKind::Cuboid => [x, y, z],
    }
}

/// Scales one part about the shape frame (uniformly) or about the box (a simple shape, along the box's axes).
fn stretch_part(part: &mut Part, box_frame: &Pose, factors: [f64; 3]) {
    let [x, y, z] = factors;
    if x == y && y == z {
        Rc::make_mut(&mut part.mesh).scale(factors);
        part.pose.translation.vector *= x;
    } else {
        let to_box = box_frame.inverse() * part.pose;
        let mesh = Rc::make_mut(&mut part.mesh);
        mesh.transform(&to_box);
        mesh.scale(factors);
        mesh.transform(&to_box.inverse());
    }
    if let Some(primitive) = &mut part.primitive {
        primitive
            .size
            .iter_mut()
            .zip(factors)
            .for_each(|(extent, factor)| *extent *= factor);
        if let Some(heights) = &mut primitive.heights {
            Rc::make_mut(heights)
                .heights
                .iter_mut()
                .for_each(|height| *height *= z);
        }
    }
}

pub(crate) fn too_large() -> SceneError {
    SceneError::Refused(format!(
        "the object would be larger than {MAX_COORDINATE:e} m, which scene files cannot hold."
    ))
}

impl Scene {
    /// Changes the geometry of a shape; the physics rebuilds its body.
    ///
    /// # Errors
    /// When the object is no shape, `change` refuses, or the shape became larger than files can hold. The shape stays as it was then.
    pub fn reshape<R>(
        &mut self,
        handle: Handle,
        change: impl FnOnce(&mut Shape) -> SceneResult<R>,
    ) -> SceneResult<R> {
        self.try_modify(handle, Field::Geometry, |object| {
            let shape = object.shape_mut()?;
            let before = shape.clone();
            let result = change(shape).and_then(|result| shape.check_extent(1.0).map(|()| result));
            match &result {
                Ok(_) => object.dynamics_reset = true,
                Err(_) => *shape = before,
            }
            result
        })
    }

    /// Moves the frame of a shape to `world` (None: to its bounding box); geometry and children stay where they are in the world.
    /// Refused for a single primitive: false.
    pub fn relocate_shape_frame(
        &mut self,
        handle: Handle,
        world: Option<Pose>,
    ) -> SceneResult<bool> {
        let shape = self.object(handle)?.shape()?;
        if shape.is_fixed_primitive() {
            return Ok(false);
        }
        let old = self.world_pose(handle)?;
        let new = world.unwrap_or(old * shape.bounding_box.pose);
        let old_in_new = new.inverse() * old;
        self.reshape(handle, |shape| {
            shape.reframe(&old_in_new);
            Ok(())
        })?;
        self.set_world_pose(handle, new)?;
        for child in self.object(handle)?.children().to_vec() {
            let pose = old_in_new * self.object(child)?.pose();
            self.set_local_pose(child, pose)?;
        }
        Ok(true)
    }

    /// Turns the bounding box of a shape to a world orientation (None: to the tightest). Refused for a single primitive: false.
    pub fn align_shape_box(
        &mut self,
        handle: Handle,
        world: Option<UnitQuaternion<f64>>,
    ) -> SceneResult<bool> {
        if self.object(handle)?.shape()?.is_fixed_primitive() {
            return Ok(false);
        }
        let frame = self.world_pose(handle)?.rotation;
        self.try_modify(handle, Field::Geometry, |object| {
            object
                .shape_mut()?
                .fit_box(world.map(|world| frame.inverse() * world));
            Ok(true)
        })
    }
}

/// A box along the axes of the frame around parts.
pub fn box_of(parts: &[Part]) -> Option<BoundingBox> {
    let mut mesh = Mesh::default();
    parts
        .iter()
        .for_each(|part| mesh.append(&part.mesh, &part.pose));
    mesh.bounding_box(&UnitQuaternion::identity())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_stays_a_ball() {
        let mut shape =
            Shape::primitive(PrimitiveKind::Spheroid, [0.2; 3], Default::default()).unwrap();
        shape.stretch([2.0, 3.0, 4.0]).unwrap();
        assert_eq!(shape.parts[0].primitive.as_ref().unwrap().size, [0.4; 3]);
        assert_eq!(shape.bounding_box.size, [0.4; 3]);
    }

    #[test]
    fn a_primitive_keeps_its_frame() {
        let mut scene = Scene::new();
        let shape = Shape::primitive(PrimitiveKind::Cuboid, [0.2; 3], Default::default()).unwrap();
        let handle = scene.add("s", crate::Kind::Shape(Box::new(shape))).unwrap();
        assert_eq!(scene.relocate_shape_frame(handle, None), Ok(false));
    }
}
