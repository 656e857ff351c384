//! Geometries as shapes.

use geometry::primitive::PrimitiveKind;
use geometry::{DecompositionParameters, Mesh};
use robot_description::{Geometry, Link, Material};

use super::links::Part;
use super::{Import, RobotFormat, RobotImportOptions};
use scene::shape::Shape;
use scene::{Pose, SceneError, SceneResult};

/// What becomes of a mesh that is not convex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    AsItIs,
    Hull,
    Pieces,
}

/// How much a surface reflects, as simURDF sets it.
const SPECULAR: [f32; 3] = [0.2; 3];
/// Edge and thickness of what stands for an endless plane, metres; the edge of one that is touched in MJCF, where robots run far.
const PLANE: (f64, f64) = (20.0, 0.1);
const WIDE_PLANE: f64 = 1000.0;

/// A ball, a pure shape.
pub(super) fn ball(diameter: f64) -> SceneResult<Shape> {
    Shape::primitive(PrimitiveKind::Spheroid, [diameter; 3], Default::default())
}

/// A cube, a pure shape.
pub(super) fn cube(edge: f64) -> SceneResult<Shape> {
    Shape::primitive(PrimitiveKind::Cuboid, [edge; 3], Default::default())
}

impl Import<'_> {
    /// Shapes of geometries, with their poses in the link's frame. Those that cannot be made are reported.
    pub(super) fn shapes_of<'a>(
        &mut self,
        link: &Link,
        parts: impl Iterator<Item = Part<'a>>,
        form: Form,
        with_textures: bool,
    ) -> Vec<(Pose, Shape)> {
        let mut shapes = Vec::new();
        for (pose, geometry, material, line) in parts {
            match self.shape(geometry, form, with_textures) {
                Ok((offset, mut shape)) => {
                    if let Some(material) = material {
                        paint(&mut shape, material);
                    }
                    shapes.push((pose * offset, shape));
                }
                Err(reason) => {
                    let element = self.format.geometry_element(with_textures);
                    self.message(format!(
                        "line {line}, <{element}>: link '{}': {reason}",
                        link.name
                    ));
                }
            }
        }
        shapes
    }

    /// The shape of a geometry, and where it lies in the geometry's frame.
    fn shape(
        &mut self,
        geometry: &Geometry,
        form: Form,
        with_textures: bool,
    ) -> Result<(Pose, Shape), String> {
        let (kind, size) = match geometry {
            Geometry::Box { size } => (PrimitiveKind::Cuboid, *size),
            Geometry::Sphere { radius } => (PrimitiveKind::Spheroid, [2.0 * radius; 3]),
            Geometry::Cylinder { radius, length } => (
                PrimitiveKind::Cylinder,
                [2.0 * radius, 2.0 * radius, *length],
            ),
            Geometry::Capsule { radius, length } => (
                PrimitiveKind::Capsule,
                [2.0 * radius, 2.0 * radius, length + 2.0 * radius],
            ),
            Geometry::Ellipsoid { radii } => {
                (PrimitiveKind::Spheroid, radii.map(|radius| 2.0 * radius))
            }
            Geometry::Plane { normal } => {
                let is_wide = self.format == RobotFormat::Mjcf && !with_textures;
                let edge = if is_wide { WIDE_PLANE } else { PLANE.0 };
                return plane(*normal, edge).map_err(|error| error.to_string());
            }
            Geometry::Mesh { file, scale } => {
                let shape = self.meshes.shape(file, *scale, self.scene, with_textures)?;
                self.messages.append(&mut self.meshes.take_warnings());
                return formed(shape, form)
                    .map(|shape| (Pose::identity(), shape))
                    .map_err(|error| format!("mesh '{file}': {error}"));
            }
        };
        let shape =
            Shape::primitive(kind, size, Default::default()).map_err(|error| error.to_string())?;
        Ok((Pose::identity(), shape))
    }

    /// One shape of several, in the frame of the first; or in that of the link, if the options say so.
    pub(super) fn joined(&mut self, shapes: Vec<(Pose, Shape)>) -> Option<(Pose, Shape)> {
        let at_joint = self.options.contains(RobotImportOptions::FRAMES_AT_JOINTS);
        let (first_pose, first) = shapes.first()?;
        let frame = if at_joint {
            Pose::identity()
        } else {
            *first_pose
        };
        if shapes.len() == 1 {
            let mut shape = first.clone();
            // The frame of a primitive is that of its form.
            if !at_joint || shape.is_pure() {
                return Some((*first_pose, shape));
            }
            shape.reframe(first_pose);
            return Some((frame, shape));
        }
        let placed: Vec<(Pose, &Shape)> = shapes
            .iter()
            .map(|(pose, shape)| (frame.inverse() * pose, shape))
            .collect();
        match Shape::from_placed(&placed, first) {
            Ok(shape) => Some((frame, shape)),
            Err(error) => {
                self.message(error.to_string());
                Some((*first_pose, first.clone()))
            }
        }
    }
}

/// A flat box whose upper side is the plane.
fn plane(normal: [f64; 3], edge: f64) -> SceneResult<(Pose, Shape)> {
    let thickness = PLANE.1;
    let up = nalgebra::Vector3::z();
    let rotation =
        nalgebra::UnitQuaternion::rotation_between(&up, &normal.into()).unwrap_or_default();
    let offset = rotation * up * (-thickness / 2.0);
    let shape = Shape::primitive(
        PrimitiveKind::Cuboid,
        [edge, edge, thickness],
        Default::default(),
    )?;
    Ok((Pose::from_parts(offset.into(), rotation), shape))
}

fn formed(shape: Shape, form: Form) -> SceneResult<Shape> {
    if form == Form::AsItIs || shape.is_convex() {
        return Ok(shape);
    }
    let whole = shape.mesh();
    let pieces = match form {
        Form::Pieces => whole.convex_pieces(DecompositionParameters::default()),
        _ => Mesh::convex_hull(&whole.vertices).into_iter().collect(),
    };
    let mut shapes = Vec::new();
    for piece in pieces {
        let mut shape = Shape::from_mesh(piece, Shape::mesh_appearance())?;
        shape.parts.iter_mut().for_each(|part| part.convex = true);
        shapes.push(shape);
    }
    match shapes.as_slice() {
        [] => Err(SceneError::Refused("it has no volume".into())),
        [one] => Ok(one.clone()),
        [first, ..] => {
            let placed: Vec<(Pose, &Shape)> = shapes
                .iter()
                .map(|shape| (Pose::identity(), shape))
                .collect();
            Shape::from_placed(&placed, first)
        }
    }
}

fn paint(shape: &mut Shape, material: &Material) {
    let Some([red, green, blue, _]) = material.color else {
        return;
    };
    for part in &mut shape.parts {
        let colour = &mut part.appearance.colour;
        colour.ambient_diffuse =
            [red, green, blue].map(|component| numbers::single(component.clamp(0.0, 1.0)));
        colour.specular = SPECULAR;
    }
}
