//! The rows: a bumpy ball of 1 m, of 20 000 and of 200 000 triangles, and 1000 boxes.

mod models;
mod parry;

use std::hint::black_box;

use criterion::{Criterion, criterion_group};
use geometry::Pose;
use proximity::{
    Bounds, BoundsTree, Filter, Geometry, Placed, TriangleMesh, Volume, cast_ray,
    closest_in_volume, distance, intersects,
};

use models::{Boxes, Poses, cone, pyramid};

criterion_group!(group, meshes, boxes, build);

/// How many triangles the meshes have, by the names of the rows.
const SIZES: [(&str, usize); 2] = [("20k", 20_000), ("200k", 200_000)];
const EVERYWHERE: f64 = f64::INFINITY;

/// Bumps of the ball, metres. Many triangles are almost equally near to what is outside, which is the hardest case for distances.
const BUMPS: f64 = 0.01;
/// Those of a ball with clear summits.
const SUMMITS: f64 = 0.05;

fn mesh(triangles: usize, bumps: f64) -> TriangleMesh {
    let (vertices, indices) = models::ball(triangles, bumps);
    TriangleMesh::new(&vertices, &indices).expect("triangles with area")
}

fn at(mesh: &TriangleMesh, pose: Pose) -> Placed<'_> {
    Placed {
        geometry: Geometry::Mesh(mesh),
        pose,
    }
}

fn meshes(criterion: &mut Criterion) {
    for (name, triangles) in SIZES {
        let ball = mesh(triangles, BUMPS);
        sensors(criterion, name, &ball);
        distances(criterion, name, &ball);
        collisions(criterion, name, &ball);
        parry::rows(criterion, name, triangles);
        distance_to_summits(criterion, name, triangles);
    }
}

fn sensors(criterion: &mut Criterion, name: &str, ball: &TriangleMesh) {
    let filter = Filter::default();
    let mut poses = Poses::around(1.0);
    criterion.bench_function(&format!("{name}/ray"), |bench| {
        bench.iter(|| {
            cast_ray(
                at(ball, Pose::identity()),
                &poses.next(),
                [0.0, 0.0, 1.0],
                [0.0, 5.0],
                &filter,
            )
        });
    });
    for (volume, shape) in [("cone", cone()), ("pyramid", pyramid())] {
        let mut poses = Poses::around(1.0);
        criterion.bench_function(&format!("{name}/{volume}"), |bench| {
            bench.iter(|| {
                closest_in_volume(
                    at(ball, Pose::identity()),
                    &poses.next(),
                    &shape,
                    EVERYWHERE,
                    &filter,
                )
            });
        });
    }
}

fn distances(criterion: &mut Criterion, name: &str, ball: &TriangleMesh) {
    let cuboid = models::cuboid([0.1; 3]);
    for (other, mesh) in [("box", &cuboid), ("mesh", ball)] {
        for (limit, below) in [("", EVERYWHERE), (" below 5 cm", 0.05)] {
            let mut poses = Poses::apart(if other == "box" { 0.6 } else { 1.0 });
            criterion.bench_function(&format!("{name}/distance to {other}{limit}"), |bench| {
                bench.iter(|| {
                    distance(
                        at(ball, Pose::identity()),
                        at(mesh, poses.next()),
                        black_box(below),
                    )
                });
            });
        }
    }
}

fn distance_to_summits(criterion: &mut Criterion, name: &str, triangles: usize) {
    let (ball, cuboid, mut poses) = (
        mesh(triangles, SUMMITS),
        models::cuboid([0.1; 3]),
        Poses::apart(0.6),
    );
    criterion.bench_function(&format!("{name}/distance of summits to box"), |bench| {
        bench.iter(|| {
            distance(
                at(&ball, Pose::identity()),
                at(&cuboid, poses.next()),
                black_box(EVERYWHERE),
            )
        });
    });
    parry::distance_to_box(
        criterion,
        &format!("{name}/parry, distance of summits to box"),
        &parry::mesh(triangles, SUMMITS),
    );
}

fn collisions(criterion: &mut Criterion, name: &str, ball: &TriangleMesh) {
    for (kind, gap) in [("near miss", 1.02), ("overlap", 0.6)] {
        let mut poses = Poses::apart_by(gap);
        criterion.bench_function(&format!("{name}/collision, {kind}"), |bench| {
            bench.iter(|| intersects(at(ball, Pose::identity()), at(ball, poses.next())));
        });
    }
}

fn boxes(criterion: &mut Criterion) {
    let Boxes { cuboid, poses } = Boxes::new(1000);
    let mut index = BoundsTree::default();
    for (key, pose) in poses.iter().enumerate() {
        index.insert(key as u32, &at(&cuboid, *pose).bounds());
    }
    let filter = Filter::default();
    let mut sensors = Poses::around(6.0);
    criterion.bench_function("1000 boxes/ray", |bench| {
        bench.iter(|| {
            let sensor = sensors.next();
            let mut best = None;
            let origin = sensor.translation.vector.into();
            let direction = (sensor.rotation * nalgebra::Vector3::z()).into();
            index.along_ray(origin, direction, [0.0, 20.0], |key, limit| {
                let on = at(&cuboid, poses[key as usize]);
                let hit = cast_ray(on, &sensor, [0.0, 0.0, 1.0], [0.0, limit], &filter);
                best = hit.or(best);
                hit.map_or(limit, |hit| hit.distance)
            });
            best
        });
    });
    for (volume, shape) in [("cone", cone()), ("pyramid", pyramid())] {
        let mut sensors = Poses::around(6.0);
        criterion.bench_function(&format!("1000 boxes/{volume}"), |bench| {
            bench.iter(|| nearest_box(&index, &cuboid, &poses, &sensors.next(), &shape));
        });
    }
}

/// The distance of the nearest box in a volume, which has a range of 1 m.
fn nearest_box(
    index: &BoundsTree,
    cuboid: &TriangleMesh,
    poses: &[Pose],
    sensor: &Pose,
    shape: &Volume,
) -> f64 {
    let origin: [f64; 3] = sensor.translation.vector.into();
    let mut best = f64::INFINITY;
    let bound = |bounds: &Bounds| bounds.distance_to_point(&origin);
    index.nearest_first(bound, 1.0, |key, _, limit| {
        let on = at(cuboid, poses[key as usize]);
        match closest_in_volume(on, sensor, shape, limit, &Filter::default()) {
            Some(hit) => {
                best = hit.distance;
                hit.distance
            }
            None => limit,
        }
    });
    best
}

fn build(criterion: &mut Criterion) {
    let (vertices, indices) = models::ball(200_000, BUMPS);
    let mut group = criterion.benchmark_group("200k");
    group.sample_size(10);
    group.bench_function("build", |bench| {
        bench.iter(|| TriangleMesh::new(&vertices, &indices));
    });
    group.finish();
}
