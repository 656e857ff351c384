//! Every planner: paths through narrow passages, checked by other means; the same seed, the same path; shorter with time.

use planning::space::{Bounds, Component, CompoundSpace};
use planning::{
    Algorithm, Goal, Nearness, Problem, Projection, Random, Refusal, Solution, State, StateSpace,
    World, path,
};
use test_support::random;

struct Numbers(random::Random);

impl Numbers {
    fn new(seed: u64) -> Self {
        Self(random::Random::new(seed))
    }
}

impl Random for Numbers {
    fn next(&mut self) -> f64 {
        self.0.unit()
    }
}

/// A world that says how often it was asked.
struct Asked<F> {
    is_valid: F,
    count: u64,
    limit: u64,
}

impl<F: FnMut(&[f64]) -> bool> World for Asked<F> {
    fn is_valid(&mut self, state: &[f64]) -> bool {
        self.count += 1;
        (self.is_valid)(state)
    }

    fn is_over(&mut self) -> bool {
        self.count >= self.limit
    }
}

struct Task {
    space: CompoundSpace,
    is_valid: fn(&[f64]) -> bool,
    start: State,
    goal: State,
    projected: usize,
    iterations: u64,
}

impl Task {
    fn solve(
        &self,
        algorithm: Algorithm,
        seed: u64,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal> {
        let mut world = Asked {
            is_valid: self.is_valid,
            count: 0,
            limit: u64::MAX,
        };
        algorithm.planner().solve(
            &mut self.problem(&mut world, &mut Numbers::new(seed)),
            iterations,
        )
    }

    fn problem<'a>(&'a self, world: &'a mut dyn World, random: &'a mut dyn Random) -> Problem<'a> {
        let projected = self.projected;
        Problem {
            space: &self.space,
            world,
            random,
            starts: vec![self.start.clone()],
            goal: Goal::States(vec![self.goal.clone()]),
            projection: Some(Projection {
                size: projected,
                cell: 0.05,
                project: Box::new(move |state| state[..projected].to_vec()),
            }),
            resolution: 0.01,
        }
    }

    /// Start, goal, and every state on the way, looked at ten times as closely as the planner does.
    fn check(&self, solution: &Solution, what: &str) {
        assert!(solution.is_exact, "{what}");
        assert_eq!(
            (solution.states.first(), solution.states.last()),
            (Some(&self.start), Some(&self.goal)),
            "{what}"
        );
        for pair in solution.states.windows(2) {
            let parts = 10 * self.space.parts(&pair[0], &pair[1], 0.01);
            let invalid = (0..=parts).filter(|&part| {
                let state = self
                    .space
                    .interpolate(&pair[0], &pair[1], part as f64 / parts as f64);
                !(self.is_valid)(&state)
            });
            // Corners may be cut between two checks, by less than the resolution.
            assert!(invalid.count() <= 10, "{what}: {pair:?}");
        }
    }
}

/// A square with a wall that has a gap of a twentieth of its length.
fn wall() -> Task {
    let square = Component::Real(Bounds::new(vec![0.0; 2], vec![1.0; 2]));
    Task {
        space: CompoundSpace::new(vec![(square, 1.0)]),
        is_valid: |state| !(0.45..=0.55).contains(&state[0]) || (0.1..=0.15).contains(&state[1]),
        start: vec![0.1, 0.9],
        goal: vec![0.9, 0.9],
        projected: 2,
        iterations: 20_000,
    }
}

/// The shortest path through the gap: by its two upper corners.
fn shortest_through_wall() -> f64 {
    2.0 * 0.35_f64.hypot(0.75) + 0.1
}

/// A long plate in space that must pass a slit: it has to turn.
fn slit() -> Task {
    let space = Component::Space(Bounds::new(vec![-1.0; 3], vec![1.0; 3]));
    Task {
        space: CompoundSpace::new(vec![(space, 1.0)]),
        is_valid: plate_is_free,
        start: vec![-0.8, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        goal: vec![0.8, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        projected: 3,
        iterations: 30_000,
    }
}

/// Points of a plate, 0.8 long in its y, against a wall at x = 0 with a slit 0.5 high in y and unlimited in z.
fn plate_is_free(state: &[f64]) -> bool {
    let [x, y, z, w] = [state[3], state[4], state[5], state[6]];
    // The plate's y axis in the world.
    let axis = [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z)];
    (-8..=8).all(|step| {
        let along = 0.05 * f64::from(step);
        let point = [state[0] + along * axis[0], state[1] + along * axis[1]];
        point[0].abs() > 0.05 || point[1].abs() < 0.25
    })
}

#[test]
fn every_planner_finds_the_gap() {
    let task = wall();
    for algorithm in Algorithm::ALL {
        for seed in [1, 2] {
            let iterations = if algorithm.is_optimising() {
                2000
            } else {
                task.iterations
            };
            let found = task
                .solve(algorithm, seed, iterations)
                .expect("there is a start and a goal");
            let found =
                found.unwrap_or_else(|| panic!("{algorithm:?} finds nothing with seed {seed}"));
            task.check(&found, &format!("{algorithm:?} with seed {seed}"));
        }
    }
}

#[test]
fn every_planner_turns_a_body_through_a_slit() {
    let task = slit();
    for algorithm in Algorithm::ALL {
        let iterations = if algorithm.is_optimising() {
            1500
        } else {
            task.iterations
        };
        let found = task
            .solve(algorithm, 3, iterations)
            .expect("there is a start and a goal");
        let found = found.unwrap_or_else(|| panic!("{algorithm:?} finds nothing"));
        task.check(&found, &format!("{algorithm:?}"));
    }
}

#[test]
fn the_same_seed_has_the_same_path() {
    let task = wall();
    for algorithm in Algorithm::ALL {
        let solve = |seed| {
            task.solve(algorithm, seed, 1500)
                .expect("there is a start and a goal")
        };
        assert_eq!(solve(7), solve(7), "{algorithm:?}");
    }
    let solve = |seed| {
        task.solve(Algorithm::RrtConnect, seed, 5000)
            .expect("there is a start and a goal")
    };
    assert_ne!(solve(7), solve(8));
}

#[test]
fn optimising_planners_come_near_the_shortest_path() {
    let task = wall();
    // LBTRRT shares the planner of RRTstar, SPARS and SPARStwo that of PRMstar.
    use Algorithm::{BitStar, CForest, LazyPrmStar, PrmStar, RrtStar};
    for algorithm in [BitStar, CForest, LazyPrmStar, PrmStar, RrtStar] {
        let length = |iterations| {
            let found = task
                .solve(algorithm, 5, iterations)
                .expect("there is a start and a goal");
            found
                .filter(|found| found.is_exact)
                .map(|found| path::length(&task.space, &found.states))
        };
        let (early, late) = (length(1000), length(3000).expect("there is a path"));
        assert!(
            early.is_none_or(|early| late <= early + 1e-9),
            "{algorithm:?}: {early:?}, {late}"
        );
        let shortest = shortest_through_wall();
        assert!(
            (shortest - 1e-3..1.12 * shortest).contains(&late),
            "{algorithm:?}: {late}, best {shortest}"
        );
    }
}

#[test]
fn planning_again_goes_on() {
    let task = wall();
    let mut world = Asked {
        is_valid: task.is_valid,
        count: 0,
        limit: u64::MAX,
    };
    let mut numbers = Numbers::new(1);
    let mut problem = task.problem(&mut world, &mut numbers);
    let mut planner = Algorithm::RrtStar.planner();
    let mut last = f64::INFINITY;
    for _ in 0..20 {
        if let Some(found) = planner
            .solve(&mut problem, 300)
            .expect("there is a start")
            .filter(|found| found.is_exact)
        {
            let length = path::length(&task.space, &found.states);
            assert!(length <= last + 1e-9);
            last = length;
        }
    }
    assert!(last < 1.2 * shortest_through_wall());
    let data = planner.data();
    assert!(
        data.states.len() > 100 && data.edges.len() == data.states.len() - 1 && data.starts == [0]
    );
}

#[test]
fn planners_end_when_the_world_has_enough() {
    let task = wall();
    for algorithm in Algorithm::ALL {
        let mut world = Asked {
            is_valid: |_: &[f64]| true,
            count: 0,
            limit: 200,
        };
        let blocked = |state: &[f64]| !(0.45..=0.55).contains(&state[0]);
        let mut blocked = Asked {
            is_valid: blocked,
            count: 0,
            limit: 3000,
        };
        let found = algorithm
            .planner()
            .solve(
                &mut task.problem(&mut blocked, &mut Numbers::new(1)),
                u64::MAX,
            )
            .expect("a start and a goal");
        assert!(found.is_none_or(|found| !found.is_exact), "{algorithm:?}");
        assert!(blocked.count <= 3001, "{algorithm:?}: {}", blocked.count);
        let _ = algorithm.planner().solve(
            &mut task.problem(&mut world, &mut Numbers::new(1)),
            1_000_000,
        );
        assert!(world.count <= 201, "{algorithm:?}: {}", world.count);
    }
}

#[test]
fn a_region_is_reached_or_refused() {
    let task = wall();
    for algorithm in Algorithm::ALL {
        let mut world = Asked {
            is_valid: task.is_valid,
            count: 0,
            limit: u64::MAX,
        };
        let mut numbers = Numbers::new(1);
        let mut problem = task.problem(&mut world, &mut numbers);
        let distance = |state: &[f64]| (0.7 - state[0]).max(0.0);
        problem.goal = Goal::Region(Box::new(move |state| Nearness {
            is_reached: distance(state) <= 0.0,
            distance: distance(state),
        }));
        match algorithm.planner().solve(&mut problem, 5000) {
            Ok(found) => {
                let found = found.unwrap_or_else(|| panic!("{algorithm:?} finds nothing"));
                let end = &found.states[found.states.len() - 1];
                assert!(found.is_exact && end[0] >= 0.7, "{algorithm:?}");
            }
            Err(refusal) => assert_eq!(refusal, Refusal::GoalWithoutStates, "{algorithm:?}"),
        }
    }
    let refuses = |algorithm: Algorithm| {
        let mut world = Asked {
            is_valid: task.is_valid,
            count: 0,
            limit: u64::MAX,
        };
        let mut numbers = Numbers::new(1);
        let mut problem = task.problem(&mut world, &mut numbers);
        problem.goal = Goal::Region(Box::new(|_| Nearness {
            is_reached: true,
            distance: 0.0,
        }));
        algorithm.planner().solve(&mut problem, 10).is_err()
    };
    for algorithm in [
        Algorithm::Rrt,
        Algorithm::Kpiece1,
        Algorithm::Est,
        Algorithm::Pdst,
        Algorithm::LazyRrt,
        Algorithm::RrtStar,
    ] {
        assert!(!refuses(algorithm), "{algorithm:?}");
    }
    for algorithm in [
        Algorithm::RrtConnect,
        Algorithm::Sbl,
        Algorithm::Prm,
        Algorithm::Fmt,
        Algorithm::BitStar,
    ] {
        assert!(refuses(algorithm), "{algorithm:?}");
    }
}

#[test]
fn bad_starts_and_goals_are_refused() {
    let task = wall();
    for algorithm in Algorithm::ALL {
        for (start, goal, expected) in [
            (vec![0.5, 0.5], task.goal.clone(), Refusal::NoValidStart),
            (vec![2.0, 0.5], task.goal.clone(), Refusal::NoValidStart),
            (
                vec![f64::NAN, 0.5],
                task.goal.clone(),
                Refusal::NoValidStart,
            ),
            (vec![0.1], task.goal.clone(), Refusal::StateSize),
        ] {
            let task = Task {
                start,
                goal,
                ..wall()
            };
            assert_eq!(
                task.solve(algorithm, 1, 100),
                Err(expected),
                "{algorithm:?}"
            );
        }
    }
    let task = Task {
        goal: vec![0.5, 0.5],
        ..wall()
    };
    assert_eq!(
        task.solve(Algorithm::RrtConnect, 1, 100),
        Err(Refusal::NoValidGoal)
    );
    let found = task
        .solve(Algorithm::Rrt, 1, 500)
        .expect("there is a start")
        .expect("something near");
    assert!(!found.is_exact && found.difference < 0.5);
}

#[test]
fn a_start_in_the_goal_is_a_path() {
    let task = Task {
        goal: wall().start,
        ..wall()
    };
    for algorithm in Algorithm::ALL {
        let found = task
            .solve(algorithm, 1, 2000)
            .expect("there is a start and a goal")
            .expect("a path");
        assert!(
            found.is_exact && path::length(&task.space, &found.states) < 1e-9,
            "{algorithm:?}: {found:?}"
        );
    }
}

#[test]
fn simplified_paths_are_shorter_and_valid() {
    for task in [wall(), slit()] {
        let mut found = task
            .solve(Algorithm::RrtConnect, 4, 30_000)
            .expect("a start and a goal")
            .expect("a path");
        let before = path::length(&task.space, &found.states);
        let mut world = Asked {
            is_valid: task.is_valid,
            count: 0,
            limit: u64::MAX,
        };
        path::simplify(
            &mut task.problem(&mut world, &mut Numbers::new(1)),
            &mut found.states,
        );
        let after = path::length(&task.space, &found.states);
        assert!(after < 0.95 * before, "{before} to {after}");
        task.check(&found, "simplified");
    }
}

#[test]
fn paths_are_divided() {
    let task = wall();
    let states = vec![vec![0.0, 0.0], vec![0.2, 0.0], vec![1.0, 0.0]];
    let five = path::interpolate(&task.space, &states, 6);
    assert_eq!(five.len(), 6);
    assert!(states.iter().all(|state| five.contains(state)));
    assert_eq!(path::interpolate(&task.space, &states, 2), states);
    let dense = path::densify(&task.space, &states, 0.01);
    let longest = dense
        .windows(2)
        .map(|pair| task.space.distance(&pair[0], &pair[1]))
        .fold(0.0, f64::max);
    assert!(longest <= 0.01 * task.space.extent() + 1e-12 && dense.len() > 70);
}
