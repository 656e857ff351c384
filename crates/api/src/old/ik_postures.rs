//! `sim.*`: what groups of inverse kinematics of V-REP are asked without moving their joints: results, postures, paths, Jacobians (spec: kinematics 7).

use std::cell::Cell;
use std::path::Path;

use api_macro::api;
use geometry::pose::interpolate;

use super::ik_groups::group;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use format::scene_file::write_whole;
use ik::groups::{GroupCopy, IkResult, export};
use perception::entity::Entity;
use scene::numbers;
use scene::tree::ik_groups::Jacobian;
use scene::{Handle, Scene, SceneError};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    check_ik_group,
    get_config_for_tip_pose,
    generate_ik_path,
    compute_jacobian,
    get_ik_group_matrix,
    export_ik,
];

/// Time limits of searches count iterations, so that runs repeat.
const ITERATIONS_PER_MILLISECOND: u32 = 100;
/// A check for collisions counts as that many.
const ITERATIONS_PER_CHECK: u32 = 100;
/// Longest time limit of a search, ms.
const MAX_SEARCH_MS: u32 = 600_000;
/// Most postures of a path.
const MAX_POINTS: i64 = 100_000;

/// Searches of a simulator, so that each begins elsewhere.
#[derive(Default)]
struct Searches(Cell<u64>);

/// A group of the scene, some of its joints, and what must not collide.
struct Task {
    copy: GroupCopy,
    /// As it is in the scene.
    original: GroupCopy,
    joints: Vec<Handle>,
    pairs: Vec<[Entity; 2]>,
}

impl Task {
    /// The joints move in whatever mode they are; others of the group stay.
    ///
    /// # Errors
    /// When something does not exist, or the group cannot be copied.
    fn new(cx: &Cx, handle: Number, joints: &[i64], pairs: &[i64]) -> Result<Self> {
        let scene = cx.scene();
        let searches = cx.module_state::<Searches>();
        searches.0.set(searches.0.get().wrapping_add(1));
        let seed = (u64::from(cx.options().seed) << 32) | (searches.0.get() & 0xffff_ffff);
        let joints = joints
            .iter()
            .map(|raw| Handle::from_raw(*raw).ok_or(SceneError::NoSuchObject));
        let joints = joints.collect::<std::result::Result<Vec<_>, _>>()?;
        let copy = GroupCopy::moving(&scene, group(&scene, handle)?, seed, &joints)?;
        copy.config(&scene, &joints)?;
        let pairs = pairs
            .chunks_exact(2)
            .map(|pair| entities(&scene, [pair[0], pair[1]]));
        let pairs = pairs.collect::<Result<Vec<_>>>()?;
        Ok(Self {
            original: copy.clone(),
            copy,
            joints,
            pairs,
        })
    }

    fn config(&self, cx: &Cx) -> Result<Vec<f64>> {
        Ok(self.copy.config(&cx.scene(), &self.joints)?)
    }

    /// Whether a pair of entities collides where the copy is. The joints of the scene move there and back.
    fn collides(&self, cx: &mut Cx) -> Result<bool> {
        if self.pairs.is_empty() {
            return Ok(false);
        }
        self.copy.apply(&mut cx.scene_mut(), |_| false)?;
        let collide = |entities: &[Entity; 2]| {
            cx.query(|perception, scene| perception.collision(scene, *entities))
        };
        let found = self.pairs.iter().any(|pair| collide(pair).is_some());
        self.original.apply(&mut cx.scene_mut(), |_| false)?;
        Ok(found)
    }
}

fn entities(scene: &Scene, [first, second]: [i64; 2]) -> Result<[Entity; 2]> {
    Ok([
        Entity::named(scene, first)?,
        Entity::named_or_all(scene, second)?,
    ])
}

/// An optional list with a number for each joint.
fn for_joints<T>(list: Option<Vec<T>>, joints: &[i64]) -> Result<Option<Vec<T>>> {
    match list {
        Some(list) if list.len() < joints.len() => Err(ApiError::TableSize),
        list => Ok(list),
    }
}

/// Computes a group of inverse kinematics of V-REP without moving its joints. Its Jacobian is that of sim.getIkGroupMatrix then.
///
/// @param ikGroupHandle the group
/// @param jointHandles joints that move, in whatever mode they are; the others stay, but those that depend on joints
/// @param jointOptions of no use: dependent joints are recognised
/// @return ikCalculationResult 0 if it was not performed, 1 if it succeeded, 2 if it failed
/// @return jointValues where the joints would go
#[api("sim.checkIkGroup")]
fn check_ik_group(
    cx: &mut Cx,
    ik_group_handle: Number,
    joint_handles: Vec<i64>,
    #[default(None)] joint_options: Option<Vec<i64>>,
) -> Result<(i64, Vec<f64>)> {
    for_joints(joint_options, &joint_handles)?;
    let mut task = Task::new(cx, ik_group_handle, &joint_handles, &[])?;
    let result = task.copy.solve()?;
    let jacobian = task.copy.jacobian(false)?;
    store(&mut cx.scene_mut(), ik_group_handle, jacobian)?;
    Ok((result as i64, task.config(cx)?))
}

/// Searches a posture that brings the tips of a group of inverse kinematics of V-REP to their targets. The joints stay where they are.
///
/// @param ikGroupHandle the group
/// @param jointHandles joints that move, in whatever mode they are; the others stay, but those that depend on joints
/// @param distanceThreshold not used: starts are not limited
/// @param maxTimeInMs counted as 100 iterations each, as is a check for collisions
/// @param metric not used
/// @param collisionPairs entities, two by two, that must not collide; the second may be sim.handle_all
/// @param jointOptions of no use: dependent joints are recognised
/// @param lowLimits of the joints, for the search
/// @param ranges of the joints; 0 for their own limits
/// @return jointPositions nothing if none was found
#[api("sim.getConfigForTipPose")]
#[expect(clippy::too_many_arguments, reason = "CoppeliaSim's signature")]
fn get_config_for_tip_pose(
    cx: &mut Cx,
    ik_group_handle: Number,
    joint_handles: Vec<i64>,
    distance_threshold: f64,
    max_time_in_ms: Number,
    #[default(None)] metric: Option<[f64; 4]>,
    #[default(None)] collision_pairs: Option<Vec<i64>>,
    #[default(None)] joint_options: Option<Vec<i64>>,
    #[default(None)] low_limits: Option<Vec<f64>>,
    #[default(None)] ranges: Option<Vec<f64>>,
) -> Result<Option<Vec<f64>>> {
    let _ = (distance_threshold, metric);
    for_joints(joint_options, &joint_handles)?;
    let low_limits = for_joints(low_limits, &joint_handles)?;
    let ranges = for_joints(ranges, &joint_handles)?;
    let mut task = Task::new(
        cx,
        ik_group_handle,
        &joint_handles,
        &collision_pairs.unwrap_or_default(),
    )?;
    for (i, joint) in task.joints.iter().enumerate() {
        if let (Some(low), Some(range)) = (&low_limits, &ranges)
            && (low[i].is_finite() && range[i].is_finite() && range[i] > 0.0)
        {
            task.copy.limit(*joint, low[i], range[i])?;
        }
    }
    let milliseconds = u32::try_from(max_time_in_ms.0.unsigned_abs())
        .unwrap_or(MAX_SEARCH_MS)
        .clamp(1, MAX_SEARCH_MS);
    search(cx, &mut task, milliseconds * ITERATIONS_PER_MILLISECOND)
}

fn search(cx: &mut Cx, task: &mut Task, iterations: u32) -> Result<Option<Vec<f64>>> {
    let mut left = iterations;
    while left > 0 {
        if !task.copy.find(&mut left)? {
            break;
        }
        if !task.collides(cx)? {
            return task.config(cx).map(Some);
        }
        left = left.saturating_sub(ITERATIONS_PER_CHECK);
    }
    Ok(None)
}

/// Postures on the straight line from the tips of a group of inverse kinematics of V-REP to their targets. The joints stay where they are.
///
/// @param ikGroupHandle the group
/// @param jointHandles joints that move, in whatever mode they are; the others stay, but those that depend on joints
/// @param ptCnt how many postures, both ends among them
/// @param collisionPairs entities, two by two, that must not collide; the second may be sim.handle_all
/// @param jointOptions of no use: dependent joints are recognised
/// @return path a flat list; nothing if a posture could not be found or collides
#[api("sim.generateIkPath")]
fn generate_ik_path(
    cx: &mut Cx,
    ik_group_handle: Number,
    joint_handles: Vec<i64>,
    pt_cnt: Number,
    #[default(None)] collision_pairs: Option<Vec<i64>>,
    #[default(None)] joint_options: Option<Vec<i64>>,
) -> Result<Option<Vec<f64>>> {
    for_joints(joint_options, &joint_handles)?;
    if !(2..=MAX_POINTS).contains(&pt_cnt.0) {
        return Err(SceneError::InvalidArgument.into());
    }
    let mut task = Task::new(
        cx,
        ik_group_handle,
        &joint_handles,
        &collision_pairs.unwrap_or_default(),
    )?;
    // Without targets there is nothing to compute.
    if !task.copy.is_complete() {
        return Ok(None);
    }
    let ends = task.original.ends()?;
    let mut path = Vec::new();
    for i in 0..pt_cnt.0 {
        let share = i as f64 / (pt_cnt.0 - 1) as f64;
        task.copy.set_targets(
            ends.iter()
                .map(|[tip, target]| interpolate(tip, target, share)),
        )?;
        if task.copy.solve()? != IkResult::Success || task.collides(cx)? {
            return Ok(None);
        }
        path.extend(task.config(cx)?);
    }
    Ok(Some(path))
}

/// Computes the Jacobian of a group of inverse kinematics of V-REP, for sim.getIkGroupMatrix.
///
/// @param ikGroupHandle the group
/// @param options bit 0: each column is multiplied by the weight of its joint
/// @return result 1, or 0 if the group cannot be computed
#[api("sim.computeJacobian")]
fn compute_jacobian(cx: &mut Cx, ik_group_handle: Number, options: Number) -> Result<i64> {
    let jacobian = {
        let scene = cx.scene();
        GroupCopy::new(&scene, group(&scene, ik_group_handle)?, 0)?.jacobian(options.0 & 1 == 1)?
    };
    let is_computed = jacobian.is_some().into();
    store(&mut cx.scene_mut(), ik_group_handle, jacobian)?;
    Ok(is_computed)
}

/// Keeps a Jacobian for `sim.getIkGroupMatrix`.
fn store(scene: &mut Scene, group: Number, jacobian: Option<Jacobian>) -> Result<()> {
    let groups = scene.ik_groups_mut();
    let group = groups.get_mut(group.0).ok_or(SceneError::NoSuchIkGroup)?;
    group.jacobian = jacobian;
    Ok(())
}

/// The Jacobian of a group of inverse kinematics of V-REP, of the last sim.computeJacobian, sim.checkIkGroup or sim.handleIkGroup.
///
/// @param ikGroupHandle the group
/// @param options 0
/// @return jacobian row by row, x, y, z, alpha, beta, gamma as far as they are constrained; a column for each joint, from the base to the tip. Nothing if
/// it was not computed
/// @return jacobianSize numbers of columns and rows
#[api("sim.getIkGroupMatrix")]
#[expect(clippy::type_complexity, reason = "CoppeliaSim's signature")]
fn get_ik_group_matrix(
    cx: &Cx,
    ik_group_handle: Number,
    options: Number,
) -> Result<(Option<Vec<f64>>, Option<Vec<i64>>)> {
    if options.0 != 0 {
        return Err(SceneError::InvalidArgument.into());
    }
    let scene = cx.scene();
    let jacobian = group(&scene, ik_group_handle)?.jacobian.clone();
    let size = jacobian.as_ref().map(|jacobian| {
        vec![
            numbers::count(jacobian.columns),
            numbers::count(jacobian.rows),
        ]
    });
    Ok((jacobian.map(|jacobian| jacobian.values), size))
}

/// Writes the groups of inverse kinematics of V-REP with their chains to a file, which simIK.load reads. Objects have their old names.
///
/// @param pathAndFilename the file
/// @return result 1
#[api("sim.exportIk")]
fn export_ik(cx: &Cx, path_and_filename: String) -> Result<i64> {
    let path = Path::new(&path_and_filename);
    cx.permissions().check_write(path)?;
    let bytes = export(&cx.scene())?;
    let failed = |error| ApiError::Other(format!("cannot write {path_and_filename}: {error}."));
    let written = cx.permissions().write(path, || write_whole(path, &bytes));
    written.map_err(failed)?;
    Ok(1)
}
