//! `simOMPL.*`: state spaces.

use api_macro::api;
use planning::space::{Bounds, Component};

use super::objects::{invalid, objects, space_number, task};
use super::{ApiFn, Cx, Result, functions, refused};
use scene::{Frame, Handle, special};
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_state_space,
    destroy_state_space,
    set_dubins_params,
    set_state_space,
    get_state_space_dimension
];

/// `simOMPL.StateSpaceType`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Position2d = 50001,
    Pose2d = 50002,
    Position3d = 50003,
    Pose3d = 50004,
    JointPosition = 50005,
    Dubins = 50006,
    CyclicJointPosition = 50007,
}

/// One component of the states of a task.
#[derive(Debug, Clone)]
pub(super) struct StateSpace {
    pub name: String,
    /// None for a number that is no type: nothing looks at it before the setup.
    pub kind: Option<Kind>,
    /// As the script named it.
    pub object: i64,
    pub low: Vec<f64>,
    pub high: Vec<f64>,
    pub is_projected: bool,
    pub weight: f64,
    pub reference: Option<Handle>,
    turning_radius: f64,
    is_symmetric: bool,
}

impl Kind {
    const ALL: [Self; 7] = [
        Self::Position2d,
        Self::Pose2d,
        Self::Position3d,
        Self::Pose3d,
        Self::JointPosition,
        Self::Dubins,
        Self::CyclicJointPosition,
    ];

    fn from_number(number: i64) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| *kind as i64 == number)
    }

    /// Its name in `simOMPL.StateSpaceType`.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Position2d => "position2d",
            Self::Pose2d => "pose2d",
            Self::Position3d => "position3d",
            Self::Pose3d => "pose3d",
            Self::JointPosition => "joint_position",
            Self::Dubins => "dubins",
            Self::CyclicJointPosition => "cyclic_joint_position",
        }
    }

    /// Numbers of a state.
    fn dimension(self) -> usize {
        match self {
            Self::Position2d => 2,
            Self::Pose2d | Self::Position3d | Self::Dubins => 3,
            Self::Pose3d => 7,
            Self::JointPosition | Self::CyclicJointPosition => 1,
        }
    }

    /// How many of them have bounds.
    fn bounded(self) -> usize {
        match self {
            Self::CyclicJointPosition => 0,
            _ => self.projected(),
        }
    }

    /// How many of them are a projection: the position.
    pub(super) fn projected(self) -> usize {
        match self {
            Self::Position2d | Self::Pose2d | Self::Dubins => 2,
            Self::Position3d | Self::Pose3d => 3,
            Self::JointPosition | Self::CyclicJointPosition => 1,
        }
    }
}

impl StateSpace {
    /// Numbers of a state.
    pub(super) fn dimension(&self) -> usize {
        self.kind.map_or(0, Kind::dimension)
    }

    /// The frame in which the object is placed.
    pub(super) fn frame(&self) -> Frame {
        self.reference.map_or(Frame::World, Frame::Object)
    }

    /// The component for planners.
    ///
    /// # Errors
    /// When the type is unknown, or the bounds are no bounds.
    pub(super) fn component(&self) -> Result<Component> {
        let kind = self
            .kind
            .ok_or_else(|| refused("Invalid state space type."))?;
        if kind == Kind::CyclicJointPosition {
            return Ok(Component::Angle);
        }
        let bounds = self.bounds(kind.bounded())?;
        Ok(match kind {
            Kind::Pose2d => Component::Plane(bounds),
            Kind::Pose3d => Component::Space(bounds),
            Kind::Dubins => Component::Dubins {
                bounds,
                radius: self.turning_radius,
                symmetric: self.is_symmetric,
            },
            _ => Component::Real(bounds),
        })
    }

    fn bounds(&self, expected: usize) -> Result<Bounds> {
        if self.low.len() != expected {
            let found = self.low.len();
            return Err(refused(format!(
                "Bounds do not match dimension of state space: expected dimension {expected} but got dimension {found}"
            )));
        }
        // What is no number is no bound either, and no state can be drawn from an endless range.
        let is_range =
            |(low, high): (&f64, &f64)| low.is_finite() && high.is_finite() && low <= high;
        if !self.low.iter().zip(&self.high).all(is_range) {
            return Err(refused(
                "Bounds for real vector space seem to be incorrect (lower bound must be stricly less than upper bound). Sampling will not be possible",
            ));
        }
        Ok(Bounds::new(self.low.clone(), self.high.clone()))
    }

    /// Whether there are bounds that its type does not need.
    pub(super) fn has_needless_bounds(&self) -> bool {
        self.kind == Some(Kind::CyclicJointPosition) && !self.low.is_empty()
    }
}

/// A state space: a part of the states of a task, and the object that shows it. Type, object and dimension of the bounds are checked by simOMPL.setup.
///
/// @param name for simOMPL.printTaskInfo
/// @param type simOMPL.StateSpaceType
/// @param objectHandle the object that is moved, or the joint
/// @param boundsLow least values: x, y of position2d, pose2d and dubins; x, y, z of position3d and pose3d; rad or metres of joint_position; none for cyclic_joint_position
/// @param boundsHigh largest values
/// @param useForProjection 1: the first state space of a task that has it is its projection
/// @param weight factor of its distances
/// @param refObjectHandle the frame of positions; -1 for the world
/// @return stateSpaceHandle ends with the script
#[api("simOMPL.createStateSpace")]
#[expect(clippy::too_many_arguments, reason = "CoppeliaSim's signature")]
fn create_state_space(
    cx: &mut Cx,
    name: String,
    r#type: Number,
    object_handle: Number,
    bounds_low: Vec<f64>,
    bounds_high: Vec<f64>,
    use_for_projection: Number,
    #[default(1.0)] weight: f64,
    #[default(special::WORLD, "sim.handle_world")] ref_object_handle: Number,
) -> Result<String> {
    if bounds_low.len() != bounds_high.len() {
        return Err(refused("Lower and upper bounds must have the same length."));
    }
    if !(weight > 0.0 && weight.is_finite()) {
        return Err(refused("State component weight must be positive."));
    }
    let reference = match ref_object_handle.0 {
        special::WORLD => None,
        raw => Handle::from_raw(raw)
            .filter(|&handle| cx.scene().exists(handle))
            .map(Some)
            .ok_or_else(|| refused("Reference object handle is not valid."))?,
    };
    let space = StateSpace {
        name,
        kind: Kind::from_number(r#type.0),
        object: object_handle.0,
        low: bounds_low,
        high: bounds_high,
        is_projected: use_for_projection.0 > 0,
        weight,
        reference,
        turning_radius: 0.05,
        is_symmetric: false,
    };
    Ok(objects(cx).add_space(cx, space))
}

/// Removes a state space. Tasks that have it cannot be used any more.
///
/// @param stateSpaceHandle the state space
#[api("simOMPL.destroyStateSpace")]
fn destroy_state_space(cx: &mut Cx, state_space_handle: String) -> Result<()> {
    let number = space_number(&state_space_handle)?;
    objects(cx)
        .spaces
        .borrow_mut()
        .remove(&number)
        .map(drop)
        .ok_or_else(invalid)
}

/// Sets how a state space of type dubins turns. It counts from the next simOMPL.setup on.
///
/// @param stateSpaceHandle the state space
/// @param turningRadius metres
/// @param isSymmetric whether the car may also drive backwards, all the way
#[api("simOMPL.setDubinsParams")]
fn set_dubins_params(
    cx: &mut Cx,
    state_space_handle: String,
    turning_radius: f64,
    is_symmetric: bool,
) -> Result<()> {
    let number = space_number(&state_space_handle)?;
    if !(turning_radius > 0.0 && turning_radius.is_finite()) {
        return Err(refused("Turning radius must be positive."));
    }
    let objects = objects(cx);
    let mut spaces = objects.spaces.borrow_mut();
    let space = spaces.get_mut(&number).ok_or_else(invalid)?;
    (space.turning_radius, space.is_symmetric) = (turning_radius, is_symmetric);
    Ok(())
}

/// Sets what the states of a task consist of.
///
/// @param taskHandle the task
/// @param stateSpaceHandles the state spaces, in the order of their numbers in a state
#[api("simOMPL.setStateSpace")]
fn set_state_space(
    cx: &mut Cx,
    task_handle: String,
    state_space_handles: Vec<String>,
) -> Result<()> {
    let task = task(cx, &task_handle)?;
    let invalid = |_| refused("Invalid state space handle.");
    let numbers = state_space_handles
        .iter()
        .map(|handle| space_number(handle))
        .collect::<Result<Vec<_>>>();
    let numbers = numbers.map_err(invalid)?;
    let spaces = objects(cx).spaces(&numbers).map_err(invalid)?;
    let mut task = task.borrow_mut();
    task.dimension = spaces.iter().map(StateSpace::dimension).sum();
    task.spaces = numbers;
    Ok(())
}

/// Numbers of a state of a task; 0 before simOMPL.setStateSpace.
///
/// @param taskHandle the task
/// @return dim
#[api("simOMPL.getStateSpaceDimension")]
fn get_state_space_dimension(cx: &Cx, task_handle: String) -> Result<i64> {
    let task = task(cx, &task_handle)?;
    let spaces = objects(cx).spaces(&task.borrow().spaces)?;
    Ok(spaces.iter().map(StateSpace::dimension).sum::<usize>() as i64)
}
