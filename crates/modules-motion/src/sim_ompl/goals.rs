//! `simOMPL.*`: where paths begin and end.

use api_macro::api;
use planning::{Nearness, State};

use super::callbacks::Callback;
use super::objects::task;
use super::{ApiFn, Cx, Result, functions};
use scene::{Frame, Handle, Pose, Scene, SceneError, special};
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] =
    functions![set_start_state, set_goal_state, add_goal_state, set_goal];

/// Where a path may end.
#[derive(Clone)]
pub(super) enum TaskGoal {
    States(Vec<State>),
    Dummies(DummyPair),
    Callback(Callback),
}

/// A dummy of the robot that is to come to another one.
#[derive(Debug, Clone, Copy)]
pub(super) struct DummyPair {
    pub robot: i64,
    pub goal: i64,
    pub tolerance: f64,
    /// Factors of x, y, z and the angle.
    pub metric: [f64; 4],
    /// The frame of x, y and z; -1 for the world.
    pub reference: i64,
}

impl DummyPair {
    fn frame(&self) -> Result<Frame> {
        if self.reference == special::WORLD {
            Ok(Frame::World)
        } else {
            object(self.reference).map(Frame::Object)
        }
    }

    /// How near the robot is in a scene.
    ///
    /// # Errors
    /// When a dummy is gone.
    pub(super) fn nearness(&self, scene: &Scene) -> Result<Nearness> {
        let frame = self.frame()?;
        let pose = |raw: i64| -> Result<Pose> { Ok(scene.pose_in(object(raw)?, frame, false)?) };
        let (robot, goal) = (pose(self.robot)?, pose(self.goal)?);
        let apart = goal.translation.vector - robot.translation.vector;
        let angle = robot.rotation.angle_to(&goal.rotation);
        let parts = [apart.x, apart.y, apart.z, angle];
        let distance = parts
            .iter()
            .zip(self.metric)
            .map(|(part, factor)| (part * factor) * (part * factor))
            .sum::<f64>()
            .sqrt();
        Ok(Nearness {
            is_reached: distance <= self.tolerance,
            distance,
        })
    }

    /// The axes that count.
    pub(super) fn axes(&self) -> impl Iterator<Item = usize> + '_ {
        (0..3).filter(|&axis| self.metric[axis] != 0.0)
    }

    /// Where the robot is on the axes that count.
    ///
    /// # Errors
    /// When the dummy is gone.
    pub(super) fn projection(&self, scene: &Scene) -> Result<Vec<f64>> {
        let position = scene
            .pose_in(object(self.robot)?, self.frame()?, false)?
            .translation
            .vector;
        Ok(self.axes().map(|axis| position[axis]).collect())
    }
}

fn object(raw: i64) -> Result<Handle> {
    Ok(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?)
}

/// Sets the state in which paths begin. It counts from the next simOMPL.setup on; with PRM and PRMstar at once, and their roadmap stays.
///
/// @param taskHandle the task
/// @param state numbers of all state spaces
#[api("simOMPL.setStartState")]
fn set_start_state(cx: &mut Cx, task_handle: String, state: Vec<f64>) -> Result<()> {
    let task = task(cx, &task_handle)?;
    let mut task = task.borrow_mut();
    task.check_size("State", &state)?;
    if let Some(setup) = task
        .setup
        .as_ref()
        .filter(|setup| setup.algorithm.keeps_roadmap())
    {
        setup.start_elsewhere(&state);
    }
    task.start = state;
    Ok(())
}

/// Sets the state in which paths end, instead of all goals so far.
///
/// @param taskHandle the task
/// @param state numbers of all state spaces
#[api("simOMPL.setGoalState")]
fn set_goal_state(cx: &mut Cx, task_handle: String, state: Vec<f64>) -> Result<()> {
    let task = task(cx, &task_handle)?;
    task.borrow().check_size("State", &state)?;
    task.borrow_mut().goal = TaskGoal::States(vec![state]);
    Ok(())
}

/// Adds a state in which paths may end.
///
/// @param taskHandle the task
/// @param state numbers of all state spaces
#[api("simOMPL.addGoalState")]
fn add_goal_state(cx: &mut Cx, task_handle: String, state: Vec<f64>) -> Result<()> {
    let task = task(cx, &task_handle)?;
    task.borrow().check_size("State", &state)?;
    match &mut task.borrow_mut().goal {
        TaskGoal::States(states) => states.push(state),
        goal => *goal = TaskGoal::States(vec![state]),
    }
    Ok(())
}

/// Sets a pose as the goal: a dummy of the robot is to come to another one. Planners that begin at the goal as well refuse it.
///
/// @param taskHandle the task
/// @param robotDummy the dummy of the robot
/// @param goalDummy where it is to come to
/// @param tolerance at most so far away, in the metric
/// @param metric factors of x, y, z and the angle between both; an angle with 0 does not count
/// @param refDummy the frame of x, y and z; -1 for the world
#[api("simOMPL.setGoal")]
fn set_goal(
    cx: &mut Cx,
    task_handle: String,
    robot_dummy: Number,
    goal_dummy: Number,
    #[default(0.001)] tolerance: f64,
    #[default([1.0, 1.0, 1.0, 0.1])] metric: [f64; 4],
    #[default(special::WORLD, "sim.handle_world")] ref_dummy: Number,
) -> Result<()> {
    let (robot, goal, reference) = (robot_dummy.0, goal_dummy.0, ref_dummy.0);
    task(cx, &task_handle)?.borrow_mut().goal = TaskGoal::Dummies(DummyPair {
        robot,
        goal,
        tolerance,
        metric,
        reference,
    });
    Ok(())
}
