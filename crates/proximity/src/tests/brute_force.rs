//! Queries through trees against loops over everything, with random, huge and tiny input.

use geometry::Pose;

use super::random::Random;
use crate::items::{Compare, Items};
use crate::placed::Transform;
use crate::primitive::{Triangle, Vector, closest_on_triangle};
use crate::{
    Filter, Geometry, Piece, Placed, PointSet, TriangleMesh, Volume, VoxelGrid, cast_ray,
    closest_in_volume, distance, intersection_segments, intersects,
};

const SIZES: [f64; 4] = [1e-6, 1.0, 1e3, 1e9];

pub struct Things {
    mesh: TriangleMesh,
    grid: VoxelGrid,
    points: PointSet,
}

impl Things {
    pub fn new(random: &mut Random, size: f64) -> Self {
        let cells: Vec<[f64; 3]> = (0..20).map(|_| random.point(size)).collect();
        let points: Vec<[f64; 3]> = (0..30).map(|_| random.point(size)).collect();
        let number = 5 + random.below(40);
        Self {
            mesh: random.mesh(number, size),
            grid: VoxelGrid::new(0.1 * size, cells.into_iter()).expect("cells"),
            points: PointSet::new(&points).expect("points"),
        }
    }

    pub fn geometries(&self) -> [Geometry<'_>; 4] {
        [
            Geometry::Mesh(&self.mesh),
            Geometry::Voxels(&self.grid),
            Geometry::Points(&self.points),
            Geometry::Point,
        ]
    }
}

/// The smallest distance among all pairs, and whether a pair touches.
fn all_pairs<A: Items, B: Items>(a: &A, b: &B, place: &Transform) -> (f64, bool)
where
    A::Item: Compare<B::Item>,
{
    let numbers =
        |tree: &crate::tree::Tree| tree.nodes.iter().map(|node| node.count).sum::<u32>() as usize;
    let mut found = (f64::INFINITY, false);
    for i in 0..numbers(a.tree()) {
        for j in 0..numbers(b.tree()) {
            let other = A::Item::moved(&b.item(j), place);
            let squared = a.item(i).closest(&other).2;
            found = (
                found.0.min(squared.sqrt()),
                found.1 || a.item(i).touches(&other),
            );
        }
    }
    found
}

#[track_caller]
pub fn near(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} is not {b}");
}

#[test]
fn distance_and_intersection_equal_loops() {
    let mut random = Random::new(11);
    for round in 0..160 {
        let size = SIZES[round % 4];
        let (things, others) = (
            Things::new(&mut random, size),
            Things::new(&mut random, size),
        );
        let apart = if round % 3 == 0 { 3.0 } else { 0.5 };
        let (pose, other) = (random.pose(size), random.pose(apart * size));
        let place = Transform::of(&pose.inv_mul(&other));
        let ask = |a: usize, b: usize| {
            let (a, b) = (things.geometries()[a], others.geometries()[b]);
            let (a, b) = (
                Placed { geometry: a, pose },
                Placed {
                    geometry: b,
                    pose: other,
                },
            );
            (
                distance(a, b, f64::INFINITY).expect("no limit"),
                intersects(a, b),
            )
        };
        let cases = [
            (ask(0, 0), all_pairs(&things.mesh, &others.mesh, &place)),
            (ask(0, 1), all_pairs(&things.mesh, &others.grid, &place)),
            (ask(0, 2), all_pairs(&things.mesh, &others.points, &place)),
            (ask(1, 1), all_pairs(&things.grid, &others.grid, &place)),
            (ask(1, 2), all_pairs(&things.grid, &others.points, &place)),
            (ask(2, 2), all_pairs(&things.points, &others.points, &place)),
        ];
        for (i, ((closest, intersect), (expected, touches))) in cases.into_iter().enumerate() {
            near(closest.distance, expected, 1e-12 * size);
            let [p, q] = closest.points.map(Vector::from);
            near((p - q).norm(), expected, 1e-12 * size);
            assert_eq!(
                intersect,
                touches && !matches!(i, 2 | 5),
                "pair {i} of round {round}"
            );
        }
    }
}

#[test]
fn thresholds_are_strict_and_do_not_change_the_answer() {
    let mut random = Random::new(12);
    for _ in 0..100 {
        let (things, others) = (Things::new(&mut random, 1.0), Things::new(&mut random, 1.0));
        let (pose, other) = (random.pose(2.0), random.pose(2.0));
        for (a, b) in [
            (0, 0),
            (0, 1),
            (1, 0),
            (2, 0),
            (3, 0),
            (1, 1),
            (3, 2),
            (3, 3),
        ] {
            let a = Placed {
                geometry: things.geometries()[a],
                pose,
            };
            let b = Placed {
                geometry: others.geometries()[b],
                pose: other,
            };
            let free = distance(a, b, f64::INFINITY).expect("no limit").distance;
            assert_eq!(distance(a, b, free * (1.0 - 1e-12)), None);
            let limited = distance(a, b, free * (1.0 + 1e-9) + 1e-100).expect("within the limit");
            near(limited.distance, free, 1e-12);
        }
    }
}

#[test]
fn rays_hit_what_a_loop_hits() {
    let mut random = Random::new(15);
    for round in 0..400 {
        let size = SIZES[round % 4];
        let mesh = random.mesh(40, size);
        let on = Placed {
            geometry: Geometry::Mesh(&mesh),
            pose: random.pose(size),
        };
        let (sensor, direction) = (random.pose(2.0 * size), random.point(1.0));
        let filter = Filter {
            front: random.below(3) > 0,
            back: random.below(3) > 0,
            max_angle: (random.below(2) == 0).then_some(1.0),
            any: false,
        };
        let hit = cast_ray(on, &sensor, direction, [0.1 * size, 4.0 * size], &filter);
        let expected = mesh
            .triangles
            .iter()
            .filter_map(|t| plain_ray(t, &on, &sensor, direction, size, &filter));
        let expected = expected.fold(f64::INFINITY, f64::min);
        assert_eq!(hit.is_some(), expected.is_finite(), "round {round}");
        if let Some(hit) = hit {
            near(hit.distance, expected, 1e-9 * size);
            let quick = cast_ray(
                on,
                &sensor,
                direction,
                [0.1 * size, 4.0 * size],
                &Filter {
                    any: true,
                    ..filter
                },
            );
            assert!(quick.is_some_and(|quick| quick.distance >= hit.distance));
        }
    }
}

/// Cramer's rule for where a ray meets a triangle.
fn plain_ray(
    t: &Triangle,
    on: &Placed,
    sensor: &Pose,
    way: [f64; 3],
    size: f64,
    filter: &Filter,
) -> Option<f64> {
    let place = Transform::of(&sensor.inv_mul(&on.pose));
    let [a, b, c] = t.map(|p| place.point(&p));
    let direction = Vector::from(way).normalize();
    let matrix = nalgebra::Matrix3::from_columns(&[b - a, c - a, -direction]);
    let solution = matrix.try_inverse()? * -a;
    let (u, v, distance) = (solution.x, solution.y, solution.z);
    let normal = (b - a).cross(&(c - a)).normalize();
    let is_front = normal.dot(&direction) < 0.0;
    let seen = if is_front { filter.front } else { filter.back };
    let steep = filter
        .max_angle
        .is_none_or(|angle| normal.dot(&direction).abs() >= angle.cos());
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    (seen && steep && inside && distance >= 0.1 * size && distance <= 4.0 * size)
        .then_some(distance)
}

#[test]
fn no_ray_passes_through_a_closed_surface() {
    let ball = super::primitive(geometry::PrimitiveKind::Spheroid, 2.0);
    let mut random = Random::new(16);
    for round in 0..2000 {
        let pose = random.pose(3.0);
        let on = Placed {
            geometry: Geometry::Mesh(&ball),
            pose,
        };
        // Through vertices and edge midpoints, from the centre.
        let triangle = ball.triangles[random.below(ball.triangles.len() as u32) as usize];
        let target = if round % 2 == 0 {
            triangle[0]
        } else {
            (triangle[1] + triangle[2]) * 0.5
        };
        let sensor = pose;
        let hit = cast_ray(on, &sensor, target.into(), [0.0, 10.0], &Filter::default());
        assert!(hit.is_some(), "round {round}");
    }
}

fn random_volume(random: &mut Random, size: f64) -> Volume {
    let planes = |random: &mut Random| {
        let count = 1 + random.below(6);
        let plane = |_| {
            [
                random.number(),
                random.number(),
                random.number(),
                0.5 * size * random.number(),
            ]
        };
        (0..count).map(plane).collect::<Vec<_>>()
    };
    let piece = |random: &mut Random| Piece {
        planes: planes(random),
        holes: (0..random.below(3)).map(|_| planes(random)).collect(),
    };
    Volume {
        pieces: (0..1 + random.below(3)).map(|_| piece(random)).collect(),
    }
}

#[test]
fn volumes_see_the_nearest_of_many_points_on_triangles() {
    let mut random = Random::new(17);
    for round in 0..120 {
        let size = SIZES[round % 4];
        let mesh = random.mesh(20, size);
        let on = Placed {
            geometry: Geometry::Mesh(&mesh),
            pose: random.pose(size),
        };
        let (sensor, volume) = (random.pose(size), random_volume(&mut random, size));
        let place = sensor.inv_mul(&on.pose);
        let hit = closest_in_volume(on, &sensor, &volume, f64::INFINITY, &Filter::default());
        let mut expected = f64::INFINITY;
        for triangle in &mesh.triangles {
            for i in 0..=40 {
                for j in 0..=40 - i {
                    let (u, v) = (f64::from(i) / 40.0, f64::from(j) / 40.0);
                    let p = triangle[0]
                        + (triangle[1] - triangle[0]) * u
                        + (triangle[2] - triangle[0]) * v;
                    let p = (place * nalgebra::Point3::from(p)).coords;
                    if is_inside(&volume, &p, 0.0) {
                        expected = expected.min(p.norm());
                    }
                }
            }
        }
        match hit {
            Some(hit) => {
                let p = Vector::from(hit.point);
                near(p.norm(), hit.distance, 1e-9 * size);
                assert!(is_inside(&volume, &p, 1e-9 * size), "round {round}");
                assert!(hit.distance <= expected + 1e-9 * size, "round {round}");
                let back = (place.inverse() * nalgebra::Point3::from(p)).coords;
                let off = mesh
                    .triangles
                    .iter()
                    .map(|t| (closest_on_triangle(&back, t) - back).norm());
                near(off.fold(f64::INFINITY, f64::min), 0.0, 1e-9 * size);
            }
            None => assert_eq!(expected, f64::INFINITY, "round {round}"),
        }
    }
}

fn is_inside(volume: &Volume, p: &Vector, tolerance: f64) -> bool {
    let height = |[x, y, z, d]: &[f64; 4]| x * p.x + y * p.y + z * p.z + d;
    let is_in_hole = |hole: &Vec<[f64; 4]>| hole.iter().all(|plane| height(plane) < -tolerance);
    volume.pieces.iter().any(|piece| {
        piece.planes.iter().all(|plane| height(plane) <= tolerance)
            && !piece.holes.iter().any(is_in_hole)
    })
}

#[test]
fn contours_are_on_both_meshes() {
    let mut random = Random::new(18);
    for _ in 0..40 {
        let (mesh, other) = (random.mesh(30, 1.0), random.mesh(30, 1.0));
        let a = Placed {
            geometry: Geometry::Mesh(&mesh),
            pose: random.pose(0.3),
        };
        let b = Placed {
            geometry: Geometry::Mesh(&other),
            pose: random.pose(0.3),
        };
        let segments = intersection_segments(a, b);
        assert_eq!(!segments.is_empty(), intersects(a, b));
        for end in segments.as_flattened() {
            let p = Placed {
                geometry: Geometry::Point,
                pose: Pose::translation(end[0], end[1], end[2]),
            };
            for on in [a, b] {
                near(
                    distance(on, p, f64::INFINITY).expect("no limit").distance,
                    0.0,
                    1e-9,
                );
            }
        }
    }
}
