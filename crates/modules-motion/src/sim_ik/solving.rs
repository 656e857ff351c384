//! `simIK.*`: calculations.

use api_macro::api;
use kinematics::{
    Constraints, Environment, Equations, Flags, JacobianColumn, JacobianRow, KinematicsError,
    ObjectId, Outcome, Revision, Start,
};
use nalgebra::DMatrix;

use super::groups::group;
use super::{ApiFn, Cx, Result, functions, object, optional, refused, transform, with};
use scene::Data;
use script::{Number, ScriptCallback, ScriptFunction};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    handle_groups,
    find_config,
    get_group_tip_target_distance,
    compute_jacobian,
    compute_group_jacobian,
    get_jacobian,
    get_manipulability,
];

/// `simIK.result_*`.
fn result(outcome: &Outcome) -> i64 {
    if outcome.flags.contains(Flags::NOT_PERFORMED) {
        0
    } else if outcome.is_success() {
        1
    } else {
        2
    }
}

/// Moves the joints of groups towards a solution, without the scene. simIK.handleGroups is for scripts.
///
/// @param environmentHandle the environment
/// @param ikGroups the groups, by falling priority
/// @param callback gets a table of rows, cols, jacobian, e, groupIndex and iteration; may return a table of jacobian, e, dq, jacobianPinv (flat lists)
/// @return success simIK.result_*
/// @return flags simIK.calc_*
/// @return precision largest linear (m) and angular (rad) error
#[api("simIK._handleGroups")]
fn handle_groups(
    cx: &mut Cx,
    environment_handle: Number,
    ik_groups: Vec<i64>,
    callback: Option<ScriptFunction>,
) -> Result<(i64, i64, [f64; 2])> {
    let callback = callback.map(|function| ScriptCallback::new(cx, function));
    let outcome = with(cx, environment_handle.0, |held| {
        let groups = ik_groups
            .iter()
            .map(|raw| group(*raw))
            .collect::<kinematics::Result<Vec<_>>>()?;
        match callback {
            None => held.env.handle(&groups),
            Some(callback) => held
                .env
                .handle_with(&groups, &mut |equations, index, iteration| {
                    let results = callback.call(&[description(equations, index, iteration)]);
                    let results =
                        results.map_err(|error| KinematicsError::Callback(error.to_string()))?;
                    revision(results.first())
                }),
        }
    })?;
    Ok((result(&outcome), outcome.flags.0.into(), outcome.precision))
}

/// Equations as a callback gets them.
fn description(equations: &Equations, group: usize, iteration: u32) -> Data {
    let row = |row: &JacobianRow| match row {
        JacobianRow::Constraint {
            element,
            constraint,
        } => Data::map([
            ("constraint", i64::from(constraint.0).into()),
            ("ikElement", element.raw().into()),
        ]),
        JacobianRow::Limit { joint } => {
            Data::map([("constraint", 0.into()), ("joint", joint.raw().into())])
        }
    };
    let column = |column: &JacobianColumn| {
        Data::map([
            ("joint", column.joint.raw().into()),
            ("stage", (column.stage as i64).into()),
        ])
    };
    Data::map([
        (
            "rows",
            Data::Array(equations.rows.iter().map(row).collect()),
        ),
        (
            "cols",
            Data::Array(equations.columns.iter().map(column).collect()),
        ),
        ("jacobian", equations.jacobian.clone().into()),
        ("e", equations.errors.clone().into()),
        ("groupIndex", (group as i64 + 1).into()),
        ("iteration", (i64::from(iteration) + 1).into()),
    ])
}

fn revision(answer: Option<&Data>) -> kinematics::Result<Revision> {
    let field = |name: &str| match answer.and_then(|answer| answer.field(name)) {
        None | Some(Data::Nil) => Ok(None),
        Some(Data::Array(items)) => {
            let numbers: Option<Vec<f64>> = items.iter().map(Data::as_f64).collect();
            numbers.map(Some).ok_or_else(|| not_numbers(name))
        }
        Some(_) => Err(not_numbers(name)),
    };
    Ok(Revision {
        jacobian: field("jacobian")?,
        errors: field("e")?,
        step: field("dq")?,
        inverse: field("jacobianPinv")?,
    })
}

fn not_numbers(name: &str) -> KinematicsError {
    KinematicsError::Callback(format!("the callback's '{name}' is no list of numbers."))
}

/// Searches a posture that satisfies a group, from random starts; all joints stay where they are. simIK.findConfigs is for scripts.
///
/// @param environmentHandle the environment
/// @param ikGroup the group
/// @param joints whose positions are wanted
/// @param iterations at most that many
/// @param fromPresent whether the present posture is the first start
/// @return iterationsLeft of `iterations`
/// @return config positions of the joints; nil if nothing was found
#[api("simIK._findConfig")]
fn find_config(
    cx: &mut Cx,
    environment_handle: Number,
    ik_group: Number,
    joints: Vec<i64>,
    #[default(20_000)] iterations: Number,
    #[default(false)] from_present: bool,
) -> Result<(i64, Option<Vec<f64>>)> {
    let start = if from_present {
        Start::Present
    } else {
        Start::Random
    };
    with(cx, environment_handle.0, |held| {
        let joints = joints
            .iter()
            .map(|raw| object(*raw))
            .collect::<kinematics::Result<Vec<_>>>()?;
        config(&held.env, &joints)?;
        let mut left = iterations.0.clamp(0, i64::from(u32::MAX)) as u32;
        let before = held.env.postures();
        let found = held
            .env
            .find_posture(group(ik_group.0)?, start, &mut left)?;
        let found = found.then(|| config(&held.env, &joints)).transpose();
        held.env.set_postures(&before);
        Ok((left.into(), found?))
    })
}

fn config(env: &Environment, joints: &[ObjectId]) -> kinematics::Result<Vec<f64>> {
    joints
        .iter()
        .map(|joint| env.joint(*joint).map(|joint| joint.position))
        .collect()
}

/// How far the tips of a group are from their targets: the sum over its elements.
///
/// @param environmentHandle the environment
/// @param ikGroup the group
/// @param metric factors of x, y, z and the angle
/// @return distance
#[api("simIK.getGroupTipTargetDistance")]
fn get_group_tip_target_distance(
    cx: &Cx,
    environment_handle: Number,
    ik_group: Number,
    #[default([1.0, 1.0, 1.0, 0.1])] metric: [f64; 4],
) -> Result<f64> {
    with(cx, environment_handle.0, |held| {
        held.env.distance(group(ik_group.0)?, metric)
    })
}

fn performed(equations: Option<Equations>) -> Result<Equations> {
    equations.ok_or_else(|| refused("the chain has no joint that moves it, or no target."))
}

/// Jacobian and errors of a chain that belongs to no group.
///
/// @param environmentHandle the environment
/// @param baseObject where the chain begins, -1 for the world
/// @param lastJoint the joint that moves the tip
/// @param constraints simIK.constraint_*: one row each, two for simIK.constraint_alpha_beta
/// @param tipMatrix the tip in the world: a pose, or a matrix of 12 numbers
/// @param targetMatrix the target in the world; the tip without one
/// @param constrBaseMatrix the frame of the constraints in the world; that of the base without one
/// @return jacobian row by row; a column for each joint, from the base to the tip
/// @return errorVector a number for each row
#[api("simIK.computeJacobian")]
#[expect(clippy::too_many_arguments, reason = "CoppeliaSim's signature")]
fn compute_jacobian(
    cx: &Cx,
    environment_handle: Number,
    base_object: Number,
    last_joint: Number,
    constraints: Number,
    tip_matrix: Vec<f64>,
    #[default(None)] target_matrix: Option<Vec<f64>>,
    #[default(None)] constr_base_matrix: Option<Vec<f64>>,
) -> Result<(Vec<f64>, Vec<f64>)> {
    let poses = [Some(tip_matrix), target_matrix, constr_base_matrix];
    let [tip, target, axes] =
        poses.map(|numbers| numbers.map(|numbers| transform(&numbers)).transpose());
    let poses = [tip?, target?, axes?];
    let constraints = Constraints(constraints.0 as u32 & Constraints::POSE.0);
    let equations = with(cx, environment_handle.0, |held| {
        held.env.jacobian_of_chain(
            optional(base_object.0)?,
            object(last_joint.0)?,
            constraints,
            poses,
        )
    })?;
    performed(equations).map(|equations| (equations.jacobian, equations.errors))
}

/// Jacobian and errors of a group.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @return jacobian row by row; columns as in simIK.getGroupJoints
/// @return errorVector a number for each row
#[api("simIK.computeGroupJacobian")]
fn compute_group_jacobian(
    cx: &Cx,
    environment_handle: Number,
    ik_group_handle: Number,
) -> Result<(Vec<f64>, Vec<f64>)> {
    let equations = with(cx, environment_handle.0, |held| {
        held.env.equations(group(ik_group_handle.0)?)
    })?;
    performed(equations).map(|equations| (equations.jacobian, equations.errors))
}

/// Jacobian of a group.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @return jacobian row by row
/// @return matrixSize numbers of columns and rows
#[api("simIK.getJacobian")]
fn get_jacobian(
    cx: &Cx,
    environment_handle: Number,
    ik_group_handle: Number,
) -> Result<(Vec<f64>, Vec<i64>)> {
    let equations = with(cx, environment_handle.0, |held| {
        held.env.equations(group(ik_group_handle.0)?)
    })?;
    let equations = performed(equations)?;
    let size = vec![equations.columns.len() as i64, equations.rows.len() as i64];
    Ok((equations.jacobian, size))
}

/// How far a group is from a singular posture: the root of the determinant of J Jt (T. Yoshikawa, *Manipulability of Robotic
/// Mechanisms*, 1985).
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @return manipulability 0 in a singular posture
#[api("simIK.getManipulability")]
fn get_manipulability(cx: &Cx, environment_handle: Number, ik_group_handle: Number) -> Result<f64> {
    let equations = with(cx, environment_handle.0, |held| {
        held.env.equations(group(ik_group_handle.0)?)
    })?;
    let equations = performed(equations)?;
    let jacobian = DMatrix::from_row_slice(
        equations.rows.len(),
        equations.columns.len(),
        &equations.jacobian,
    );
    Ok((&jacobian * jacobian.transpose())
        .determinant()
        .max(0.0)
        .sqrt())
}
