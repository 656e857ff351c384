//! Which lights reach a point, by rays to the lights.

use geometry::Finite;
use nalgebra::{Matrix3, Vector3};
use wide::f32x8;

use crate::mesh::tree::{Bounds, Ray, Tree};
use crate::projection::view::View;
use crate::shading::lighting::Vectors;
use crate::{Instance, Mesh, World};

/// How far from a surface its rays begin, metres, and how much more for each metre of depth: more than positions are rounded by.
const RAY_OFFSET: [f32; 2] = [1e-4, 2e-4];

/// The opaque meshes of a world, in the camera's axes.
#[derive(Debug)]
pub struct Shadows<'a> {
    casters: Vec<Caster<'a>>,
    tree: Tree,
}

#[derive(Debug)]
struct Caster<'a> {
    mesh: &'a Mesh,
    /// From the camera's axes to the mesh's frame, after the translation is subtracted.
    rotation: Matrix3<f32>,
    translation: Vector3<f32>,
}

/// Where light comes from.
#[derive(Debug, Clone, Copy)]
pub enum Source {
    /// In this direction.
    Direction([f32; 3]),
    /// At this point.
    Point([f32; 3]),
}

impl<'a> Shadows<'a> {
    /// Transparent surfaces and wire frames cast no shadow.
    pub fn new(world: &World<'a>, view: &View) -> Self {
        let opaque = |instance: &&Instance| {
            let is_transparent = instance.material.opacity < 1.0;
            instance.pose.is_finite() && !instance.material.wireframe && !is_transparent
        };
        let casters = world
            .instances
            .iter()
            .filter(opaque)
            .map(|instance| Caster::new(instance, view));
        let casters: Vec<Caster> = casters.collect();
        let bounds: Vec<Bounds> = casters.iter().map(Caster::bounds).collect();
        Self {
            casters,
            tree: Tree::new(&bounds),
        }
    }

    /// 1 for those of the first `count` of eight points that a light reaches, 0 for the others.
    pub fn reach(&self, source: Source, points: Vectors, normals: Vectors, count: usize) -> f32x8 {
        let [points, normals] = [points, normals].map(|vectors| vectors.map(wide::f32x8::to_array));
        let mut reached = [0.0; 8];
        for (lane, reached) in reached.iter_mut().enumerate().take(count) {
            let at = |parts: &[[f32; 8]; 3]| {
                Vector3::new(parts[0][lane], parts[1][lane], parts[2][lane])
            };
            let (point, normal) = (at(&points), at(&normals));
            let origin = point + normal * (RAY_OFFSET[0] + RAY_OFFSET[1] * point.z);
            let (direction, limit) = match source {
                Source::Direction(direction) => (Vector3::from(direction), f32::INFINITY),
                Source::Point(light) => (Vector3::from(light) - origin, 1.0),
            };
            let is_lit_side = normal.dot(&direction) > 0.0;
            *reached = f32::from(u8::from(
                is_lit_side
                    && !self.is_blocked(&Ray {
                        origin,
                        direction,
                        limit,
                    }),
            ));
        }
        f32x8::new(reached)
    }

    fn is_blocked(&self, ray: &Ray) -> bool {
        self.tree
            .is_hit(ray, |caster| self.casters[caster].is_hit(ray))
    }
}

impl<'a> Caster<'a> {
    fn new(instance: &Instance<'a>, view: &View) -> Self {
        let transform = view.transform(&instance.pose);
        let columns = [0, 1, 2].map(|axis| view.in_metres(transform.rotation.column(axis).into()));
        Self {
            mesh: instance.mesh,
            rotation: Matrix3::from_columns(&columns).transpose().cast(),
            translation: view.in_metres(transform.translation).cast(),
        }
    }

    fn bounds(&self) -> Bounds {
        let ball = &self.mesh.ball;
        let centre =
            self.translation + self.rotation.transpose() * Vector3::from(ball.centre).cast::<f32>();
        let radius = Vector3::repeat(numbers::single(ball.radius) * (1.0 + 1e-5));
        Bounds {
            low: centre - radius,
            high: centre + radius,
        }
    }

    fn is_hit(&self, ray: &Ray) -> bool {
        let origin = self.rotation * (ray.origin - self.translation);
        self.mesh.tree().is_hit(&Ray {
            origin,
            direction: self.rotation * ray.direction,
            limit: ray.limit,
        })
    }
}
