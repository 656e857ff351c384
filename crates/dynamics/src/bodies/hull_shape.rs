//! A convex hull that knows its mass properties. rapier asks for the centroid of every convex piece of a fast body in each sub-step, before it searches for what
//! is in the way, and parry would compute it anew from all faces each time.

use std::sync::OnceLock;

use rapier3d_f64::math::{Pose, Vector};
use rapier3d_f64::parry::bounding_volume::{Aabb, BoundingSphere};
use rapier3d_f64::parry::query::{PointProjection, PointQuery, Ray, RayCast, RayIntersection};
use rapier3d_f64::parry::shape::{
    ConvexPolyhedron, FeatureId, PolygonalFeatureMap, Shape, ShapeType, SupportMap, TypedShape,
};
use rapier3d_f64::prelude::{MassProperties, SharedShape, SubShapeId};

/// To parry in all else the convex polyhedron that it contains.
#[derive(Clone)]
struct HullShape {
    polyhedron: ConvexPolyhedron,
    /// At density 1, once they were asked for.
    mass: OnceLock<MassProperties>,
    aabb: Aabb,
    sphere: BoundingSphere,
}

/// The form of a convex polyhedron.
pub(super) fn hull_shape(polyhedron: ConvexPolyhedron) -> SharedShape {
    SharedShape::new(HullShape {
        mass: OnceLock::new(),
        aabb: polyhedron.compute_local_aabb(),
        sphere: polyhedron.compute_local_bounding_sphere(),
        polyhedron,
    })
}

impl Shape for HullShape {
    fn mass_properties(&self, density: f64) -> MassProperties {
        let of = |density| self.polyhedron.mass_properties(density);
        if density == 1.0 {
            *self.mass.get_or_init(|| of(1.0))
        } else {
            of(density)
        }
    }

    fn compute_local_aabb(&self) -> Aabb {
        self.aabb
    }

    fn compute_local_bounding_sphere(&self) -> BoundingSphere {
        self.sphere
    }

    fn compute_aabb(&self, position: &Pose) -> Aabb {
        self.polyhedron.compute_aabb(position)
    }

    fn ccd_thickness(&self) -> f64 {
        self.aabb.half_extents().min_element()
    }

    fn ccd_angular_thickness(&self) -> f64 {
        self.polyhedron.ccd_angular_thickness()
    }

    fn clone_dyn(&self) -> Box<dyn Shape> {
        Box::new(self.clone())
    }

    fn scale_dyn(&self, scale: Vector, num_subdivisions: u32) -> Option<Box<dyn Shape>> {
        self.polyhedron.scale_dyn(scale, num_subdivisions)
    }

    fn shape_type(&self) -> ShapeType {
        self.polyhedron.shape_type()
    }

    fn as_typed_shape(&self) -> TypedShape<'_> {
        self.polyhedron.as_typed_shape()
    }

    fn is_convex(&self) -> bool {
        true
    }

    fn as_support_map(&self) -> Option<&dyn SupportMap> {
        self.polyhedron.as_support_map()
    }

    fn as_polygonal_feature_map(&self) -> Option<(&dyn PolygonalFeatureMap, f64)> {
        self.polyhedron.as_polygonal_feature_map()
    }

    fn feature_normal_at_point(
        &self,
        part: SubShapeId,
        feature: FeatureId,
        point: Vector,
    ) -> Option<Vector> {
        self.polyhedron
            .feature_normal_at_point(part, feature, point)
    }
}

impl RayCast for HullShape {
    fn cast_local_ray_and_get_normal(
        &self,
        ray: &Ray,
        max_time_of_impact: f64,
        solid: bool,
    ) -> Option<RayIntersection> {
        self.polyhedron
            .cast_local_ray_and_get_normal(ray, max_time_of_impact, solid)
    }
}

impl PointQuery for HullShape {
    fn project_local_point(&self, point: Vector, solid: bool) -> PointProjection {
        self.polyhedron.project_local_point(point, solid)
    }

    fn project_local_point_and_get_feature(&self, point: Vector) -> (PointProjection, FeatureId) {
        self.polyhedron.project_local_point_and_get_feature(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_shape_is_its_polyhedron() {
        let points = [
            [0.0; 3],
            [2.0, 0.0, 0.0],
            [0.0, 3.0, 0.0],
            [0.0, 0.5, 4.0],
            [1.0; 3],
        ];
        let points = points.map(|[x, y, z]| Vector::new(x, y, z));
        let polyhedron = ConvexPolyhedron::from_convex_hull(&points).expect("they span a volume");
        let shape = hull_shape(polyhedron.clone());
        for density in [1.0, 2.5, 1.0] {
            let expected = polyhedron.mass_properties(density);
            assert_eq!(shape.mass_properties(density), expected);
        }
        assert_eq!(shape.compute_local_aabb(), polyhedron.compute_local_aabb());
        assert_eq!(shape.ccd_thickness(), polyhedron.ccd_thickness());
        let angle = shape.ccd_angular_thickness();
        assert!(angle > 0.0 && angle == polyhedron.ccd_angular_thickness());
        let (sphere, expected) = (
            shape.compute_local_bounding_sphere(),
            polyhedron.compute_local_bounding_sphere(),
        );
        assert_eq!(
            (sphere.center, sphere.radius),
            (expected.center, expected.radius)
        );
        assert!(
            matches!(shape.as_typed_shape(), TypedShape::ConvexPolyhedron(of) if of.points() == polyhedron.points())
        );
    }

    /// A cube of 2 m as a hull, of which all answers are known.
    #[test]
    fn rays_and_points_find_the_surface_of_a_hull() {
        let sign = |i: usize, axis: usize| if i >> axis & 1 == 1 { 1.0 } else { -1.0 };
        let corners = (0..8).map(|i| Vector::new(sign(i, 0), sign(i, 1), sign(i, 2)));
        let corners: Vec<Vector> = corners.collect();
        let polyhedron = ConvexPolyhedron::from_convex_hull(&corners).expect("a cube has a hull");
        let shape = hull_shape(polyhedron);
        assert!(shape.is_convex());
        let ray = Ray::new(Vector::new(-4.0, 0.2, 0.3), Vector::new(2.0, 0.0, 0.0));
        let hit = shape.cast_local_ray_and_get_normal(&ray, 10.0, true);
        let hit = hit.expect("the ray hits the cube");
        assert!((hit.time_of_impact - 1.5).abs() < 1e-9, "{hit:?}");
        assert!((hit.normal + Vector::X).length() < 1e-9, "{hit:?}");
        let beside = Vector::new(0.5, -3.0, 0.25);
        for found in [
            shape.project_local_point(beside, true),
            shape.project_local_point_and_get_feature(beside).0,
        ] {
            let expected = Vector::new(0.5, -1.0, 0.25);
            assert!(!found.is_inside && (found.point - expected).length() < 1e-9);
        }
        assert!(
            shape
                .project_local_point(Vector::splat(0.5), true)
                .is_inside
        );
        let wide = shape.scale_dyn(Vector::new(3.0, 1.0, 1.0), 0);
        let wide = wide.expect("hulls can be scaled").compute_local_aabb();
        assert_eq!(wide.maxs, Vector::new(3.0, 1.0, 1.0));
        let (map, border) = shape.as_polygonal_feature_map().expect("it has faces");
        assert_eq!(border, 0.0);
        assert_eq!(
            map.local_support_point(Vector::new(1.0, 2.0, 3.0)),
            Vector::ONE
        );
        let placed = shape.compute_aabb(&Pose::from_translation(Vector::splat(5.0)));
        assert_eq!(
            (placed.mins, placed.maxs),
            (Vector::splat(4.0), Vector::splat(6.0))
        );
    }
}
