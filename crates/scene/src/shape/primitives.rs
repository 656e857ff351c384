//! Primitive shapes, and the meshes that equal ones share.

use std::rc::{Rc, Weak};

use geometry::primitive::{PrimitiveKind, bounding_size, clamp_size, has_pure_size, tessellate};
use geometry::{BoundingBox, MassProperties, Mesh};

use super::options::PrimitiveOptions;
use super::{Appearance, Material, Part, Primitive, Shape};
use crate::{Pose, Scene, SceneError, SceneResult};

/// Density of new primitives, kg/m3.
const DENSITY: f64 = 500.0;
/// Thickness that flat primitives report, metres.
const FLAT_THICKNESS: f64 = 1e-4;
/// So many of the meshes made last are shared.
const SHARED: usize = 32;

/// What decides the mesh of a primitive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PrimitiveForm {
    kind: PrimitiveKind,
    size: [f64; 3],
    open_ends: bool,
    shading_angle: f64,
}

impl PrimitiveForm {
    /// A form of the given full extents, metres.
    pub(super) fn new(kind: PrimitiveKind, size: [f64; 3], options: PrimitiveOptions) -> Self {
        let has_ends = matches!(kind, PrimitiveKind::Cylinder | PrimitiveKind::Cone);
        Self {
            kind,
            size: clamp_size(kind, size),
            open_ends: has_ends && options.contains(PrimitiveOptions::OPEN_ENDS),
            shading_angle: appearance(options).shading_angle,
        }
    }

    pub(super) fn mesh(&self) -> SceneResult<Mesh> {
        let mesh = tessellate(self.kind, self.size, self.open_ends);
        let mut mesh = mesh.ok_or(SceneError::InvalidArgument)?;
        mesh.compute_normals(self.shading_angle);
        Ok(mesh)
    }

    /// The shape with the mesh of this form.
    pub(super) fn shape(&self, mesh: Rc<Mesh>, options: PrimitiveOptions) -> Shape {
        let part = Part {
            uid: 0,
            mesh,
            pose: Pose::identity(),
            primitive: self.analytic(options),
            convex: self.kind.is_convex() && !self.open_ends,
            mass: MassProperties::of_primitive_at_creation(self.kind, self.size, DENSITY),
            alias: String::new(),
            group: Vec::new(),
            appearance: appearance(options),
            texture: None,
        };
        let bounding_box = BoundingBox {
            size: bounding_size(self.kind, self.size),
            pose: Pose::identity(),
        };
        let mut shape = Shape::simple(part, bounding_box);
        shape.material = Material::rest_stack_grasp();
        shape
    }

    fn analytic(&self, options: PrimitiveOptions) -> Option<Primitive> {
        let pure = !options.contains(PrimitiveOptions::PLAIN_MESH)
            && !self.open_ends
            && has_pure_size(self.kind, self.size);
        let flat = matches!(self.kind, PrimitiveKind::Plane | PrimitiveKind::Disc);
        let [x, y, z] = self.size;
        pure.then_some(Primitive {
            kind: self.kind,
            size: [x, y, if flat { FLAT_THICKNESS } else { z }],
            heights: None,
        })
    }
}

fn appearance(options: PrimitiveOptions) -> Appearance {
    let mut appearance = Appearance::new([1.0; 3]);
    appearance.culling = options.contains(PrimitiveOptions::CULLING);
    if options.contains(PrimitiveOptions::SHARP_EDGES) {
        (appearance.shading_angle, appearance.edge_angle) = (0.0, 0.0);
    }
    appearance
}

/// The meshes of the primitives that were made last, as long as shapes have them. A shape whose mesh changes gets one of its own then.
#[derive(Debug, Default)]
pub(crate) struct PrimitiveMeshes(Vec<(PrimitiveForm, Weak<Mesh>)>);

impl PrimitiveMeshes {
    fn mesh(&mut self, form: PrimitiveForm) -> SceneResult<Rc<Mesh>> {
        let known = self.0.iter().find(|(known, _)| *known == form);
        if let Some(mesh) = known.and_then(|(_, mesh)| mesh.upgrade()) {
            return Ok(mesh);
        }
        let mesh = Rc::new(form.mesh()?);
        self.0.retain(|(_, mesh)| mesh.strong_count() > 0);
        if self.0.len() == SHARED {
            self.0.remove(0);
        }
        self.0.push((form, Rc::downgrade(&mesh)));
        Ok(mesh)
    }
}

impl Scene {
    /// A primitive of the given full extents (m), centred on its frame, for this scene: equal ones share a mesh.
    ///
    /// # Errors
    /// For height fields, which need heights.
    pub fn primitive(
        &mut self,
        kind: PrimitiveKind,
        size: [f64; 3],
        options: PrimitiveOptions,
    ) -> SceneResult<Shape> {
        let form = PrimitiveForm::new(kind, size, options);
        Ok(form.shape(self.primitive_meshes.mesh(form)?, options))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;

    fn ball(scene: &mut Scene, size: f64) -> crate::Handle {
        let ball = scene
            .primitive(PrimitiveKind::Spheroid, [size; 3], Default::default())
            .unwrap();
        scene.add("ball", Kind::Shape(Box::new(ball))).unwrap()
    }

    fn mesh(scene: &Scene, ball: crate::Handle) -> &Rc<Mesh> {
        &scene.object(ball).unwrap().shape().unwrap().parts[0].mesh
    }

    #[test]
    fn equal_primitives_share_a_mesh_until_one_changes() {
        let mut scene = Scene::new();
        let [a, b, other] = [0.1, 0.1, 0.2].map(|size| ball(&mut scene, size));
        assert!(Rc::ptr_eq(mesh(&scene, a), mesh(&scene, b)));
        assert!(!Rc::ptr_eq(mesh(&scene, a), mesh(&scene, other)));
        let alone = Shape::primitive(PrimitiveKind::Spheroid, [0.1; 3], Default::default());
        let alone = alone.unwrap().parts[0].mesh.clone();
        assert_eq!(**mesh(&scene, b), *alone);
        scene.scale_objects(&[a], 2.0, false).unwrap();
        assert_eq!(**mesh(&scene, b), *alone);
        assert_ne!(**mesh(&scene, a), *alone);
        assert!(!Rc::ptr_eq(mesh(&scene, a), mesh(&scene, other)));
    }

    #[test]
    fn meshes_that_no_shape_has_are_not_kept() {
        let mut scene = Scene::new();
        let all: Vec<_> = (1..100).map(|i| ball(&mut scene, f64::from(i))).collect();
        assert_eq!(scene.primitive_meshes.0.len(), SHARED);
        scene.remove(&all).unwrap();
        ball(&mut scene, 0.5);
        assert_eq!(scene.primitive_meshes.0.len(), 1);
    }
}
