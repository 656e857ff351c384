//! `sim.*`: path objects of V-REP (spec: vrep-era 3).

use api_macro::api;
use geometry::pose::euler;
use nalgebra::Translation3;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::path_object::{
    ControlPoint, LengthMethod, LinePoint, PathAttributes, PathMeasures, PathObject, Travel,
    TravelLimits,
};
use scene::{Data, Handle, Kind, Pose, SceneError, special};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    create_path_object,
    get_path_length,
    get_path_position,
    set_path_position,
    get_position_on_path,
    get_orientation_on_path,
    get_data_on_path,
    get_closest_position_on_path,
    set_path_target_nominal_velocity,
    insert_path_ctrl_points,
    cut_path_ctrl_points,
    sim_handle_path,
    sim_reset_path,
    path_pose,
    travel_on_path,
    path_distance,
];

/// Numbers of a control point, without and with auxiliary data.
const POINT_SIZE: usize = 11;
const POINT_SIZE_WITH_DATA: usize = 16;
/// Options of `sim.insertPathCtrlPoints`.
const CLOSED: i64 = 1;
const WITH_DATA: i64 = 2;

/// Reads a path.
fn of_path<R>(cx: &Cx, handle: Handle, read: impl FnOnce(&PathObject) -> R) -> Result<R> {
    Ok(read(cx.scene().object(handle)?.path()?))
}

/// The error of functions that do not distinguish what is no path.
fn check_path(cx: &Cx, handle: Handle) -> Result<()> {
    let scene = cx.scene();
    let found = scene
        .object(handle)
        .and_then(|object| object.path())
        .map(drop);
    found.map_err(|_| ApiError::Other("path does not exist.".into()))
}

fn is_empty() -> ApiError {
    ApiError::Other("path is empty.".into())
}

/// Where on a path a relative position is, in the path's frame. Below -0.5 it is a control point: -1 is the first.
fn pose_on_path(path: &PathObject, relative: f64) -> Result<Pose> {
    if path.control_points().is_empty() {
        return Err(is_empty());
    }
    if relative > -0.5 {
        return path
            .at(relative * path.length())
            .map(|point| point.pose)
            .ok_or_else(is_empty);
    }
    path.control_pose(numbers::index(-relative - 0.5))
        .ok_or_else(|| ApiError::Other("invalid control point.".into()))
}

fn world_pose_on_path(cx: &Cx, handle: Handle, relative: f64) -> Result<Pose> {
    let pose = of_path(cx, handle, |path| pose_on_path(path, relative))??;
    Ok(cx.scene().on_path_in_world(handle, pose)?)
}

/// A new path object of V-REP without points; `sim.createPath` with a number.
///
/// @param attributes sim.pathproperty_*; -1 for the default ones
/// @param intParams width of the line, sim.distcalcmethod_* for the length, reserved
/// @param floatParams size of the points, metres of length per radian, factor of distances on the spot
/// @param color ignored
/// @return pathHandle the path
#[api("sim._createPathObject")]
fn create_path_object(
    cx: &mut Cx,
    attributes: Number,
    #[default(None)] int_params: Option<[f64; 3]>,
    #[default(None)] float_params: Option<[f64; 3]>,
    #[default(Data::Nil)] color: Data,
) -> Result<Handle> {
    let _ = color;
    let attributes = match attributes.0 {
        -1 => PathAttributes::DEFAULT,
        bits => PathAttributes::from_bits_retain(numbers::low_i32(bits)),
    };
    let mut measures = PathMeasures::default();
    let finite = |value: f64, other: f64| if value.is_finite() { value } else { other };
    if let Some([_, method, _]) = int_params {
        measures.length_method = LengthMethod::from_number(numbers::truncated(method))
            .ok_or(SceneError::InvalidArgument)?;
    }
    if let Some([_, angle, on_spot]) = float_params {
        measures.angle_coefficient = finite(angle, measures.angle_coefficient);
        measures.on_spot_coefficient = finite(on_spot, measures.on_spot_coefficient);
    }
    let mut path = PathObject::new(attributes, measures);
    if let Some([width, ..]) = int_params {
        path.line_size = numbers::truncated_i32(width);
    }
    if let Some([size, ..]) = float_params {
        path.point_size = finite(size, path.point_size);
    }
    cx.add_object("path", Kind::Path(Box::new(path)))
}

/// Length of a path of V-REP.
///
/// @param pathHandle the path
/// @return length metres
#[api("sim.getPathLength")]
fn get_path_length(cx: &Cx, path_handle: Handle) -> Result<f64> {
    of_path(cx, path_handle, PathObject::length)
}

/// The position that moves along a path of V-REP.
///
/// @param pathHandle the path
/// @return position metres of length from the start
#[api("sim.getPathPosition")]
fn get_path_position(cx: &Cx, path_handle: Handle) -> Result<f64> {
    of_path(cx, path_handle, PathObject::position)
}

/// Moves the position on a path of V-REP, and the dummies that move with it.
///
/// @param pathHandle the path
/// @param position metres of length; wrapped on closed paths, limited on others
/// @return result 1
#[api("sim.setPathPosition")]
fn set_path_position(cx: &mut Cx, path_handle: Handle, position: f64) -> Result<i64> {
    cx.scene_mut().set_path_position(path_handle, position)?;
    Ok(1)
}

/// A point of a path of V-REP in the world.
///
/// @param pathHandle the path
/// @param relativeDistance part of the length, from 0 to 1; -1, -2, ... for control points
/// @return position metres
#[api("sim.getPositionOnPath")]
fn get_position_on_path(cx: &Cx, path_handle: Handle, relative_distance: f64) -> Result<[f64; 3]> {
    Ok(world_pose_on_path(cx, path_handle, relative_distance)?
        .translation
        .vector
        .into())
}

/// Orientation of a point of a path of V-REP in the world.
///
/// @param pathHandle the path
/// @param relativeDistance as in sim.getPositionOnPath
/// @return eulerAngles alpha, beta, gamma, radians
#[api("sim.getOrientationOnPath")]
fn get_orientation_on_path(
    cx: &Cx,
    path_handle: Handle,
    relative_distance: f64,
) -> Result<[f64; 3]> {
    Ok(euler::rotation_to_euler(
        &world_pose_on_path(cx, path_handle, relative_distance)?.rotation,
    ))
}

/// Auxiliary data of a point of a path of V-REP.
///
/// @param pathHandle the path
/// @param relativeDistance part of the length, from 0 to 1
/// @return auxFlags those of the nearer point of the line
/// @return auxChannels four numbers, interpolated
#[api("sim.getDataOnPath")]
fn get_data_on_path(
    cx: &Cx,
    path_handle: Handle,
    relative_distance: f64,
) -> Result<(i64, [f64; 4])> {
    let data = |point: LinePoint| (point.flags.into(), point.channels);
    of_path(cx, path_handle, |path| {
        path.at(relative_distance * path.length()).map(data)
    })?
    .ok_or_else(is_empty)
}

/// The place on a path of V-REP that is closest to a point.
///
/// @param pathHandle the path
/// @param position of the point, in the frame of the path
/// @return relativeDistance part of the length, from 0 to 1
#[api("sim.getClosestPositionOnPath")]
fn get_closest_position_on_path(cx: &Cx, path_handle: Handle, position: [f64; 3]) -> Result<f64> {
    let closest =
        |path: &PathObject| Some((path.closest_position(&position.into())?, path.length()));
    let (position, length) = of_path(cx, path_handle, closest)?.ok_or_else(is_empty)?;
    Ok(if length > 0.0 { position / length } else { 0.0 })
}

/// The velocity that the position on a path of V-REP shall have.
///
/// @param pathHandle the path
/// @param velocity m/s, limited to 1000
/// @return result 1
#[api("sim.setPathTargetNominalVelocity")]
fn set_path_target_nominal_velocity(
    cx: &mut Cx,
    path_handle: Handle,
    velocity: f64,
) -> Result<i64> {
    if velocity.is_nan() {
        return Err(SceneError::InvalidArgument.into());
    }
    cx.scene_mut()
        .modify_path(path_handle, |path| path.set_target_velocity(velocity))?;
    Ok(1)
}

/// Inserts control points into a path of V-REP, and opens or closes it.
///
/// @param pathHandle the path
/// @param options 1: closed; 2: with auxiliary data
/// @param startIndex the first new point will have this index, from 0
/// @param ptCnt number of points
/// @param ptData 11 numbers each: x, y, z, alpha, beta, gamma, relative velocity, distance on the spot, number of Bezier points, Bezier factors before and after; with option 2 also flags and 4 channels
/// @return result 1
#[api("sim.insertPathCtrlPoints")]
fn insert_path_ctrl_points(
    cx: &mut Cx,
    path_handle: Handle,
    options: Number,
    start_index: Number,
    pt_cnt: Number,
    pt_data: Vec<f64>,
) -> Result<i64> {
    check_path(cx, path_handle)?;
    let size = if options.0 & WITH_DATA != 0 {
        POINT_SIZE_WITH_DATA
    } else {
        POINT_SIZE
    };
    let count = usize::try_from(pt_cnt.0).map_err(|_| SceneError::InvalidArgument)?;
    if count > pt_data.len() / size {
        return Err(ApiError::TableSize);
    }
    let points = pt_data
        .chunks_exact(size)
        .take(count)
        .map(control_point)
        .collect::<Result<Vec<_>>>()?;
    let index = usize::try_from(start_index.0).unwrap_or(0);
    cx.scene_mut().modify_path(path_handle, |path| {
        path.insert(index, points, options.0 & CLOSED != 0)
    })??;
    Ok(1)
}

fn control_point(numbers: &[f64]) -> Result<ControlPoint> {
    let &[
        x,
        y,
        z,
        alpha,
        beta,
        gamma,
        velocity,
        on_spot,
        count,
        before,
        after,
        ref data @ ..,
    ] = numbers
    else {
        return Err(ApiError::TableSize);
    };
    if ![x, y, z, alpha, beta, gamma]
        .iter()
        .all(|number| number.is_finite())
    {
        return Err(SceneError::InvalidData.into());
    }
    let (flags, channels) = match *data {
        [flags, a, b, c, d] => {
            let flags = numbers::truncated(flags).clamp(0, u16::MAX.into());
            (u16::try_from(flags).unwrap_or_default(), [a, b, c, d])
        }
        _ => (0, [0.0; 4]),
    };
    let pose = Pose::from_parts(
        Translation3::new(x, y, z),
        euler::rotation_from_euler(&[alpha, beta, gamma]),
    );
    Ok(ControlPoint {
        pose,
        before,
        after,
        count: numbers::index(count),
        velocity,
        on_spot,
        flags,
        channels,
    }
    .limited())
}

/// Removes control points of a path of V-REP.
///
/// @param pathHandle the path
/// @param startIndex the first one, from 0; negative: all
/// @param ptCnt how many; negative: all
/// @return result 1
#[api("sim.cutPathCtrlPoints")]
fn cut_path_ctrl_points(
    cx: &mut Cx,
    path_handle: Handle,
    start_index: Number,
    pt_cnt: Number,
) -> Result<i64> {
    check_path(cx, path_handle)?;
    let range =
        usize::try_from(start_index.0).and_then(|start| Ok((start, usize::try_from(pt_cnt.0)?)));
    let (start, count) = range.unwrap_or((0, usize::MAX));
    cx.scene_mut()
        .modify_path(path_handle, |path| path.cut(start, count))?;
    Ok(1)
}

/// The paths that a number means: all, or one, which must be tagged for explicit handling.
fn handled_paths(cx: &Cx, number: i64) -> Result<Vec<Handle>> {
    let scene = cx.scene();
    let all = scene.paths().into_iter();
    Ok(match number {
        special::ALL => all.collect(),
        special::ALL_EXCEPT_EXPLICIT => all
            .filter(|path| scene.explicit_path(*path).is_err())
            .collect(),
        _ => {
            let path = Handle::from_raw(number).ok_or(SceneError::NoSuchObject)?;
            scene.explicit_path(path)?;
            vec![path]
        }
    })
}

/// Moves positions along their paths. The default main script does it for those that are not tagged for explicit handling.
///
/// @param pathHandle a path of V-REP that is tagged for explicit handling, sim.handle_all or sim.handle_all_except_explicit
/// @param deltaTime seconds
/// @return result 1
#[api("simHandlePath")]
fn sim_handle_path(cx: &mut Cx, path_handle: Number, delta_time: f64) -> Result<i64> {
    if !delta_time.is_finite() {
        return Err(SceneError::InvalidArgument.into());
    }
    for path in handled_paths(cx, path_handle.0)? {
        cx.scene_mut().handle_path(path, delta_time)?;
    }
    Ok(1)
}

/// Puts paths back to their positions and velocities at the start of the simulation.
///
/// @param pathHandle as for simHandlePath
/// @return result 1
#[api("simResetPath")]
fn sim_reset_path(cx: &mut Cx, path_handle: Number) -> Result<i64> {
    for path in handled_paths(cx, path_handle.0)? {
        cx.scene_mut().reset_path(path)?;
    }
    Ok(1)
}

/// World pose of a path of V-REP at a position.
///
/// @param pathHandle the path
/// @param position metres of length
/// @return pose position and quaternion; nothing without points
#[api("sim._getPathPose")]
fn path_pose(cx: &Cx, path_handle: Handle, position: f64) -> Result<Vec<f64>> {
    let Some(point) = of_path(cx, path_handle, |path| path.at(position))? else {
        return Ok(Vec::new());
    };
    let pose = cx.scene().on_path_in_world(path_handle, point.pose)?;
    Ok(geometry::pose::pose_to_array(&pose).to_vec())
}

/// Where a motion along a path of V-REP is after some time; the position of the path itself stays.
///
/// @param pathHandle the path
/// @param position metres of length
/// @param velocity where the relative velocity is 1, m/s
/// @param targetVelocity m/s
/// @param acceleration m/s^2; nil: the target velocity is reached at once
/// @param deltaTime seconds
/// @return newPosition metres of length
/// @return newVelocity m/s
#[api("sim._travelOnPath")]
fn travel_on_path(
    cx: &Cx,
    path_handle: Handle,
    position: f64,
    velocity: f64,
    target_velocity: f64,
    acceleration: Option<f64>,
    delta_time: f64,
) -> Result<(f64, f64)> {
    let start = Travel {
        position,
        nominal_velocity: velocity,
        target_velocity,
    };
    let limits = TravelLimits {
        acceleration,
        inverts_at_ends: false,
    };
    let end = of_path(cx, path_handle, |path| {
        path.travel(start, limits, delta_time)
    })?;
    Ok((end.position, end.nominal_velocity))
}

/// Length of the way between two poses, as paths of V-REP measure it.
///
/// @param from position and quaternion
/// @param to position and quaternion
/// @param method sim.distcalcmethod_*
/// @param angleCoefficient metres per radian
/// @return length metres
#[api("sim._getPathDistance")]
fn path_distance(
    _cx: &Cx,
    from: [f64; 7],
    to: [f64; 7],
    method: Number,
    angle_coefficient: f64,
) -> Result<f64> {
    let method = LengthMethod::from_number(method.0).ok_or(SceneError::InvalidArgument)?;
    let [from, to] = [from, to].map(|pose| geometry::pose::pose_from_array(&pose));
    Ok(method.length(&from, &to, angle_coefficient))
}
