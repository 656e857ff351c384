//! A piece of planning: states checked in the scene or by callbacks, until the time is used up.
//!
//! Time is counted in checks and iterations, so that runs repeat; the clock only ends what takes longer than it was allowed.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::time::{Duration, Instant};

use planning::{Goal, Nearness, Problem, Projection, State, World};

use super::callbacks::Callback;
use super::goals::TaskGoal;
use super::places::{self, Mover};
use super::setup::{Draws, Setup};
use super::tasks::Task;
use super::{ApiError, Cx, Result};
use perception::collision::CollisionTest;
use perception::entity::Entity;
use scene::{Scene, SceneResult};
use script::wall_clock;

/// Checks and iterations that a second stands for.
const STEPS_PER_SECOND: f64 = 20_000.0;
/// Steps of a search, however short its time limit.
const MIN_STEPS: u64 = 100;
/// Length of a cell of projected states.
const CELL_SIZE: f64 = 0.05;

/// How long planning may take.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limit {
    steps: u64,
    time: Duration,
}

impl Limit {
    pub(super) const NONE: Self = Self {
        steps: u64::MAX,
        time: Duration::MAX,
    };

    /// So many seconds; none for what is no number.
    pub(super) fn seconds(seconds: f64) -> Self {
        let time = Duration::try_from_secs_f64(seconds.max(0.0)).unwrap_or(Duration::MAX);
        Self {
            steps: ((seconds * STEPS_PER_SECOND) as u64).max(MIN_STEPS),
            time,
        }
    }
}

/// Planning in progress. It is shared by all that planners ask.
pub(super) struct Session<'a, 'cx> {
    cx: RefCell<&'a mut Cx<'cx>>,
    task: Rc<RefCell<Task>>,
    setup: Rc<Setup>,
    limit: Limit,
    begun: Instant,
    steps: Cell<u64>,
    /// Made with the first check, and again after each call of a script.
    test: RefCell<Option<CollisionTest>>,
    /// Ends the planning.
    failure: RefCell<Option<ApiError>>,
}

impl<'a, 'cx> Session<'a, 'cx> {
    pub(super) fn new(
        cx: &'a mut Cx<'cx>,
        task: &Rc<RefCell<Task>>,
        setup: &Rc<Setup>,
        limit: Limit,
    ) -> Self {
        Self {
            cx: RefCell::new(cx),
            task: Rc::clone(task),
            setup: Rc::clone(setup),
            limit,
            begun: wall_clock::now(),
            steps: Cell::new(0),
            test: RefCell::default(),
            failure: RefCell::default(),
        }
    }

    /// Solves or changes a path.
    ///
    /// # Errors
    /// When a callback fails, or an object of a state space is gone.
    pub(super) fn run<R>(
        &self,
        random: &mut Draws,
        work: impl FnOnce(&mut Problem<'_>) -> R,
    ) -> Result<R> {
        let size = self.projection_size();
        let mut world = self;
        let mut problem = Problem {
            space: &self.setup.space,
            world: &mut world,
            random,
            starts: vec![self.setup.start()],
            goal: match &self.setup.goal {
                TaskGoal::States(states) => Goal::States(states.clone()),
                _ => Goal::Region(Box::new(|state| {
                    self.or_end(self.nearness(state), nowhere())
                })),
            },
            projection: Some(Projection {
                size,
                cell: CELL_SIZE,
                project: Box::new(move |state| self.or_end(self.project(state), vec![0.0; size])),
            }),
            resolution: self.setup.resolution,
        };
        let result = work(&mut problem);
        drop(problem);
        self.failure.take().map_or(Ok(result), Err)
    }

    /// The value; an error ends the planning, which goes on with `instead` until it notices.
    fn or_end<R>(&self, result: Result<R>, instead: R) -> R {
        result.unwrap_or_else(|error| {
            self.failure.borrow_mut().get_or_insert(error);
            instead
        })
    }

    /// Calls a function of the script, which may change the scene.
    fn ask<R>(&self, call: impl FnOnce(&script::Env) -> Result<R>) -> Result<R> {
        let env = self.cx.borrow().env();
        let result = call(env);
        self.test.replace(None);
        result
    }

    /// Whether a state is valid: as the script's function says, or without collisions.
    ///
    /// # Errors
    /// When that fails.
    pub(super) fn is_valid(&self, state: &[f64]) -> Result<bool> {
        if !state.iter().all(|number| number.is_finite()) {
            return Ok(false);
        }
        let callback = self.task.borrow().callbacks.validation.clone();
        match callback {
            Some(callback) => self.ask(|env| callback.is_valid(env, state)),
            None => self.is_collision_free(state),
        }
    }

    fn is_collision_free(&self, state: &[f64]) -> Result<bool> {
        let task = self.task.borrow();
        if task.collision_pairs.is_empty() {
            return Ok(true);
        }
        let mut cx = self.cx.borrow_mut();
        let mut test = self.test.borrow_mut();
        cx.query_displaced(|perception, scene| {
            let mut displaced = scene.displace();
            places::write(&self.setup.spaces, &mut displaced, state)?;
            let scene = Mover::scene(&displaced);
            let test = match &mut *test {
                Some(test) => test,
                none => {
                    let pairs = entities(scene, &task.collision_pairs)?;
                    none.insert(perception.collision_test(scene, &pairs, displaced.moved()))
                }
            };
            Ok(!perception.collides(scene, test))
        })
    }

    fn nearness(&self, state: &[f64]) -> Result<Nearness> {
        let nearness = match &self.setup.goal {
            TaskGoal::States(_) => nowhere(),
            TaskGoal::Callback(callback) => self.ask(|env| callback.nearness(env, state))?,
            TaskGoal::Dummies(dummies) => self.cx.borrow_mut().query_displaced(|_, scene| {
                let mut displaced = scene.displace();
                places::write(&self.setup.spaces, &mut displaced, state)?;
                dummies.nearness(Mover::scene(&displaced))
            })?,
        };
        // NaN is not an estimate.
        let distance = if nearness.distance.is_nan() {
            f64::INFINITY
        } else {
            nearness.distance
        };
        Ok(Nearness {
            distance,
            ..nearness
        })
    }

    /// Numbers of a projected state.
    pub(super) fn projection_size(&self) -> usize {
        if let Some((_, size)) = &self.task.borrow().callbacks.projection {
            return *size;
        }
        match &self.setup.goal {
            TaskGoal::Dummies(dummies) => dummies.axes().count(),
            _ => self.projected_numbers().len(),
        }
    }

    /// Which numbers of a state are its projection: the position of the first state space that is used for it.
    fn projected_numbers(&self) -> std::ops::Range<usize> {
        let mut first = 0;
        for space in &self.setup.spaces {
            if let Some(kind) = space.kind.filter(|_| space.is_projected) {
                return first..first + kind.projected();
            }
            first += space.dimension();
        }
        0..0
    }

    /// The projection of a state. With dummies as the goal, that of the present one.
    ///
    /// # Errors
    /// When the script's function fails, or the dummy is gone.
    pub(super) fn project(&self, state: &[f64]) -> Result<Vec<f64>> {
        let callback = self.task.borrow().callbacks.projection.clone();
        match (callback, &self.setup.goal) {
            (Some((callback, size)), _) => {
                self.ask(|env| callback.numbers(env, &[state.to_vec().into()], size))
            }
            (None, TaskGoal::Dummies(dummies)) => dummies.projection(&self.cx.borrow().scene()),
            _ => Ok(state[self.projected_numbers()].to_vec()),
        }
    }

    fn sampler(&self, which: usize) -> Option<Callback> {
        self.task
            .borrow()
            .callbacks
            .samplers
            .as_ref()
            .map(|samplers| samplers[which].clone())
    }
}

impl World for &Session<'_, '_> {
    fn is_valid(&mut self, state: &[f64]) -> bool {
        self.or_end(Session::is_valid(self, state), false)
    }

    fn is_over(&mut self) -> bool {
        let steps = self.steps.get();
        self.steps.set(steps + 1);
        if self.cx.borrow().is_interrupted() {
            self.or_end(Err(ApiError::Interrupted), ());
        }
        let is_late = || steps >= MIN_STEPS && self.begun.elapsed() > self.limit.time;
        self.failure.borrow().is_some() || steps >= self.limit.steps || is_late()
    }

    fn sample(&mut self) -> Option<State> {
        let callback = self.sampler(0)?;
        let dimension = self.setup.start().len();
        let state = self.ask(|env| callback.numbers(env, &[], dimension));
        Some(self.or_end(state, self.setup.start()))
    }

    fn sample_near(&mut self, near: &[f64], distance: f64) -> Option<State> {
        let callback = self.sampler(1)?;
        let state = self
            .ask(|env| callback.numbers(env, &[near.to_vec().into(), distance.into()], near.len()));
        Some(self.or_end(state, near.to_vec()))
    }
}

/// The distance where there is none.
fn nowhere() -> Nearness {
    Nearness {
        is_reached: false,
        distance: f64::INFINITY,
    }
}

/// The pairs of a list of handles. A pair whose first handle is negative is left out, as is an odd last handle.
fn entities(scene: &Scene, handles: &[i64]) -> SceneResult<Vec<[Entity; 2]>> {
    if !scene.settings().calculations.collision {
        return Ok(Vec::new());
    }
    let pairs = handles
        .as_chunks::<2>()
        .0
        .iter()
        .filter(|[first, _]| *first >= 0);
    pairs
        .map(|&[first, second]| {
            Ok([
                Entity::named(scene, first)?,
                Entity::named_or_all(scene, second)?,
            ])
        })
        .collect()
}
