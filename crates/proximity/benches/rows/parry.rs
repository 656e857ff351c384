//! The same queries by parry alone, as far as it has them.

use criterion::Criterion;
use geometry::Pose;
use parry3d_f64::math::{Pose as Isometry, Rotation, Vector};
use parry3d_f64::query::{self, Ray, RayCast};
use parry3d_f64::shape::{Cuboid, TriMesh};

use super::models::{self, Poses};

pub fn rows(criterion: &mut Criterion, name: &str, triangles: usize) {
    let ball = mesh(triangles, super::BUMPS);
    let mut poses = Poses::around(1.0);
    criterion.bench_function(&format!("{name}/parry, ray"), |bench| {
        bench.iter(|| {
            let sensor = converted(&poses.next());
            let ray = Ray::new(
                sensor.translation,
                sensor.rotation * Vector::new(0.0, 0.0, 1.0),
            );
            ball.cast_local_ray_and_get_normal(&ray, 5.0, false)
        });
    });
    distance_to_box(criterion, &format!("{name}/parry, distance to box"), &ball);
    for (kind, gap) in [("near miss", 1.02), ("overlap", 0.6)] {
        let mut poses = Poses::apart_by(gap);
        criterion.bench_function(&format!("{name}/parry, collision, {kind}"), |bench| {
            bench.iter(|| {
                query::intersection_test(
                    &Isometry::IDENTITY,
                    &ball,
                    &converted(&poses.next()),
                    &ball,
                )
            });
        });
    }
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10);
    let mut poses = Poses::apart(1.0);
    group.bench_function("parry, distance to mesh", |bench| {
        bench
            .iter(|| query::distance(&Isometry::IDENTITY, &ball, &converted(&poses.next()), &ball));
    });
    group.bench_function("parry, build", |bench| {
        bench.iter(|| mesh(triangles, super::BUMPS));
    });
    group.finish();
}

/// The distance to a box that lies in another place each time.
pub fn distance_to_box(criterion: &mut Criterion, name: &str, ball: &TriMesh) {
    let (cuboid, mut poses) = (Cuboid::new(Vector::splat(0.05)), Poses::apart(0.6));
    criterion.bench_function(name, |bench| {
        bench.iter(|| {
            query::distance(
                &Isometry::IDENTITY,
                ball,
                &converted(&poses.next()),
                &cuboid,
            )
        });
    });
}

pub fn mesh(triangles: usize, bumps: f64) -> TriMesh {
    let (vertices, indices) = models::ball(triangles, bumps);
    let vertices = vertices
        .into_iter()
        .map(|[x, y, z]| Vector::new(x, y, z))
        .collect();
    TriMesh::new(vertices, indices).expect("indices within range")
}

fn converted(pose: &Pose) -> Isometry {
    let (p, q) = (pose.translation.vector, pose.rotation);
    Isometry {
        translation: Vector::new(p.x, p.y, p.z),
        rotation: Rotation::from_xyzw(q.i, q.j, q.k, q.w),
    }
}
