//! The setup of a task: what planning goes by until the next one.

use std::cell::{Ref, RefCell};

use kinematics::Random;
use planning::space::CompoundSpace;
use planning::{Algorithm, Planner, Solution, State};

use super::goals::TaskGoal;
use super::objects::{new_generator, objects};
use super::spaces::StateSpace;
use super::tasks::Task;
use super::{Cx, Result, refused};
use script::log::verbosity;

/// A task as it was at the setup, and what planning has found.
pub(super) struct Setup {
    pub spaces: Vec<StateSpace>,
    pub space: CompoundSpace,
    pub resolution: f64,
    pub algorithm: Algorithm,
    pub goal: TaskGoal,
    start: RefCell<State>,
    progress: RefCell<Option<Progress>>,
    pub solution: RefCell<Option<Solution>>,
}

/// What goes on with each solve. It is taken out meanwhile.
pub(super) struct Progress {
    pub planner: Box<dyn Planner>,
    pub random: Draws,
}

/// Random numbers for planners.
pub(super) struct Draws(Random);

impl planning::Random for Draws {
    fn next(&mut self) -> f64 {
        self.0.uniform()
    }
}

impl Setup {
    /// # Errors
    /// When something is missing, or does not fit.
    pub(super) fn new(cx: &Cx, task: &Task) -> Result<Self> {
        let spaces = objects(cx).spaces(&task.spaces)?;
        let space = compound(cx, &spaces)?;
        if !(task.resolution > 0.0 && task.resolution < 1.0) {
            return Err(refused(
                "The fraction of the extent must be larger than 0 and less than 1",
            ));
        }
        task.check_size("Start state", &task.start)?;
        check_goal(task)?;
        let algorithm = Algorithm::from_number(task.algorithm);
        let algorithm = algorithm.ok_or_else(|| refused("Invalid motion planning algorithm."))?;
        Ok(Self {
            spaces,
            space,
            resolution: task.resolution,
            algorithm,
            goal: task.goal.clone(),
            start: RefCell::new(task.start.clone()),
            progress: RefCell::new(Some(Progress {
                planner: algorithm.planner(),
                random: Draws(new_generator(cx)),
            })),
            solution: RefCell::default(),
        })
    }

    pub(super) fn start(&self) -> State {
        self.start.borrow().clone()
    }

    /// Plans from another start; what the planner knows stays.
    pub(super) fn start_elsewhere(&self, start: &[f64]) {
        self.start.replace(start.to_vec());
        self.solution.replace(None);
        if let Some(progress) = &mut *self.progress.borrow_mut() {
            progress.planner.clear_query();
        }
    }

    /// Works with the planner.
    ///
    /// # Errors
    /// When a callback asks for it while it works.
    pub(super) fn with_progress<R>(&self, work: impl FnOnce(&mut Progress) -> R) -> Result<R> {
        let progress = self.progress.borrow_mut().take();
        let mut progress = progress.ok_or_else(|| refused("the task is being solved."))?;
        let result = work(&mut progress);
        self.progress.replace(Some(progress));
        Ok(result)
    }

    /// The path found.
    ///
    /// # Errors
    /// When there is none.
    pub(super) fn path(&self) -> Result<Ref<'_, Solution>> {
        Ref::filter_map(self.solution.borrow(), Option::as_ref).map_err(|_| refused("no solution"))
    }
}

fn compound(cx: &Cx, spaces: &[StateSpace]) -> Result<CompoundSpace> {
    let mut components = Vec::with_capacity(spaces.len());
    for space in spaces {
        components.push((space.component()?, space.weight));
        if space.has_needless_bounds() {
            cx.env().log(
                verbosity::SCRIPT_WARNINGS,
                "cyclic_joint_position state space has no bounds",
            );
        }
    }
    Ok(CompoundSpace::new(components))
}

fn check_goal(task: &Task) -> Result<()> {
    let TaskGoal::States(states) = &task.goal else {
        return Ok(());
    };
    if states.is_empty() {
        return Err(refused("No goal state specified."));
    }
    states
        .iter()
        .try_for_each(|state| task.check_size("Goal state", state))
}
