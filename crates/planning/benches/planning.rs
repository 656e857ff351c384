//! How fast planners are, and how much of that is the checking of states:
//!
//!     cargo bench --package swanilda-planning
//!
//! An arm of six joints (UR5, links and ten obstacles of triangles) between random free postures whose straight motion is blocked. Every path is checked
//! again, at the states of its motions. `benches/compare/planning.py` does the same by simOMPL and by OMPL.

#![allow(clippy::disallowed_methods, reason = "a benchmark asks for the time")]

use std::f64::consts::{FRAC_PI_2, PI};
use std::time::{Duration, Instant};

use geometry::primitive::tessellate;
use geometry::{Pose, PrimitiveKind};
use nalgebra::{Translation3, UnitQuaternion, Vector3};
use planning::space::{Bounds, Component, CompoundSpace};
use planning::{
    Algorithm, Goal, Problem, Projection, Random, Solution, State, StateSpace, World, path,
};
use proximity::{Geometry, Placed, TriangleMesh, intersects};

const QUERIES: usize = 50;
const ITERATIONS: u64 = 20_000;
const RESOLUTION: f64 = 0.01;

struct Numbers(u64);

impl Random for Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A mesh, its place, and the box around it there.
struct Part {
    mesh: TriangleMesh,
    place: Pose,
    bounds: proximity::Bounds,
}

impl Part {
    fn ellipsoid(size: [f64; 3], place: Pose) -> Self {
        let mesh = tessellate(PrimitiveKind::Spheroid, size, false).expect("finite extents");
        let mesh = TriangleMesh::new(&mesh.vertices, &mesh.triangles).expect("triangles with area");
        Self {
            bounds: mesh.bounds().transformed(&place),
            mesh,
            place,
        }
    }

    fn at(&self, frame: &Pose) -> Placed<'_> {
        Placed {
            geometry: Geometry::Mesh(&self.mesh),
            pose: frame * self.place,
        }
    }
}

/// Each link: what is between two joints, and its shape.
struct Arm {
    links: Vec<(Pose, Part)>,
    obstacles: Vec<Part>,
    checks: u64,
    checking: Duration,
}

impl Arm {
    fn new() -> Self {
        let rows = [
            (0.089159, 0.0, FRAC_PI_2),
            (0.0, -0.425, 0.0),
            (0.0, -0.39225, 0.0),
            (0.10915, 0.0, FRAC_PI_2),
            (0.09465, 0.0, -FRAC_PI_2),
            (0.0823, 0.0, 0.0),
        ];
        let links = rows.into_iter().map(|(d, a, alpha)| {
            let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), alpha);
            (
                Pose::from_parts(Translation3::new(a, 0.0, d), turn),
                link([a, 0.0, d]),
            )
        });
        let obstacles = (0..10).map(|i| {
            let (angle, radius) = (2.4 * f64::from(i), 0.45 + 0.05 * f64::from(i % 5));
            let place = [
                radius * angle.cos(),
                radius * angle.sin(),
                0.1 + 0.08 * f64::from(i),
            ];
            Part::ellipsoid([0.22; 3], Pose::translation(place[0], place[1], place[2]))
        });
        Self {
            links: links.collect(),
            obstacles: obstacles.collect(),
            checks: 0,
            checking: Duration::ZERO,
        }
    }

    fn is_free(&self, state: &[f64]) -> bool {
        let mut frame = Pose::identity();
        self.links.iter().zip(state).all(|((to_next, part), q)| {
            frame *= Pose::rotation(Vector3::z() * *q);
            let (link, bounds) = (part.at(&frame), part.bounds.transformed(&frame));
            frame *= to_next;
            let mut near = self
                .obstacles
                .iter()
                .filter(|obstacle| obstacle.bounds.overlaps(&bounds));
            !near.any(|obstacle| intersects(link, obstacle.at(&Pose::identity())))
        })
    }
}

/// An ellipsoid from the origin to a point, 8 cm thick.
fn link(end: [f64; 3]) -> Part {
    let end = Vector3::from(end);
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &end)
        .unwrap_or_else(UnitQuaternion::identity);
    let place = Pose::from_parts(Translation3::from(end / 2.0), turn);
    Part::ellipsoid([0.08, 0.08, end.norm() + 0.04], place)
}

impl World for Arm {
    fn is_valid(&mut self, state: &[f64]) -> bool {
        let begin = Instant::now();
        let is_free = self.is_free(state);
        self.checking += begin.elapsed();
        self.checks += 1;
        is_free
    }
}

fn space() -> CompoundSpace {
    let joint = || (Component::Real(Bounds::new(vec![-PI], vec![PI])), 1.0);
    CompoundSpace::new((0..6).map(|_| joint()).collect())
}

fn queries(arm: &Arm, space: &CompoundSpace) -> Vec<[State; 2]> {
    let mut random = Numbers(2024);
    let mut found = Vec::new();
    while found.len() < QUERIES {
        let pair = [0, 1].map(|_| space.sample(&mut random));
        let is_blocked = (0..50)
            .any(|i| !arm.is_free(&space.interpolate(&pair[0], &pair[1], f64::from(i) / 50.0)));
        if is_blocked && pair.iter().all(|state| arm.is_free(state)) {
            found.push(pair);
        }
    }
    found
}

fn problem<'a>(
    space: &'a CompoundSpace,
    arm: &'a mut Arm,
    random: &'a mut Numbers,
    [start, goal]: &[State; 2],
) -> Problem<'a> {
    Problem {
        space,
        world: arm,
        random,
        starts: vec![start.clone()],
        goal: Goal::States(vec![goal.clone()]),
        projection: Some(Projection {
            size: 1,
            cell: 0.05,
            project: Box::new(|state| vec![state[0]]),
        }),
        resolution: RESOLUTION,
    }
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn measure(algorithm: Algorithm, space: &CompoundSpace, arm: &mut Arm, queries: &[[State; 2]]) {
    (arm.checks, arm.checking) = (0, Duration::ZERO);
    let (mut times, mut lengths, mut short) = (Vec::new(), Vec::new(), Vec::new());
    let mut total = Duration::ZERO;
    let mut paths: Vec<Solution> = Vec::new();
    for (query, seed) in queries.iter().zip(1..) {
        let begin = Instant::now();
        let found = algorithm.planner().solve(
            &mut problem(space, arm, &mut Numbers(seed), query),
            ITERATIONS,
        );
        let took = begin.elapsed();
        total += took;
        times.push(took.as_secs_f64() * 1e6);
        paths.extend(
            found
                .expect("starts and goals are free")
                .filter(|found| found.is_exact),
        );
    }
    let (checks, checking) = (arm.checks, arm.checking);
    for found in &mut paths {
        lengths.push(path::length(space, &found.states));
        let query = [
            found.states[0].clone(),
            found.states[found.states.len() - 1].clone(),
        ];
        path::simplify(
            &mut problem(space, arm, &mut Numbers(1), &query),
            &mut found.states,
        );
        short.push(path::length(space, &found.states));
        let dense = path::densify(space, &found.states, RESOLUTION);
        assert!(
            dense.iter().all(|state| arm.is_free(state)),
            "{algorithm:?} finds a path through an obstacle"
        );
    }
    let each = checking.as_secs_f64() * 1e6 / checks as f64;
    println!(
        "| {algorithm:?} | {} of {QUERIES} | {:.0} us | {} of {each:.2} us | {:.2} | {:.1} | {:.1} |",
        paths.len(),
        median(&mut times),
        checks / QUERIES as u64,
        total.as_secs_f64() / checking.as_secs_f64(),
        median(&mut lengths),
        median(&mut short),
    );
}

fn main() {
    let (mut arm, space) = (Arm::new(), space());
    let queries = queries(&arm, &space);
    println!(
        "| planner | found | median time | checks | all / checks | length | simplified |\n|---|---|---|---|---|---|---|"
    );
    use Algorithm as A;
    for algorithm in [
        A::RrtConnect,
        A::BiTrrt,
        A::Rrt,
        A::Kpiece1,
        A::Bkpiece1,
        A::Lbkpiece1,
        A::Sbl,
        A::Est,
        A::Prm,
    ] {
        measure(algorithm, &space, &mut arm, &queries);
    }
}
