//! Groups of inverse kinematics of V-REP, motion profiles, control points of paths.

use scene::{Data, numbers};

use super::pointers::{numbers_of, singles};
use crate::dispatch::{Call, integer};
use crate::functions::{Answer, Function};

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("ik.check", check),
    ("ik.configuration", configuration),
    ("ik.path", path),
    ("rml.position", |call| begin(call, "sim.rmlPos", 3, 2)),
    ("rml.velocity", |call| begin(call, "sim.rmlVel", 2, 1)),
    ("rml.step", |call| step(call, "sim.rmlStep")),
    ("rml.position_at_once", |call| {
        at_once(call, begin(call, "sim.rmlPos", 3, 2)?)
    }),
    ("rml.velocity_at_once", |call| {
        at_once(call, begin(call, "sim.rmlVel", 2, 1)?)
    }),
    ("ruckig.position", |call| {
        let more = minima(call, MIN_VELOCITY) + minima(call, MIN_ACCELERATION);
        begin(call, "sim.ruckigPos", 3 + more, 2)
    }),
    ("ruckig.velocity", |call| {
        let more = minima(call, MIN_ACCELERATION);
        begin(call, "sim.ruckigVel", 2 + more, 1)
    }),
    ("ruckig.step", |call| step(call, "sim.ruckigStep")),
    ("path.insert", insert_points),
];

/// `sim.ruckig_minvel`: the limits are followed by the smallest velocities.
const MIN_VELOCITY: i64 = 256;
/// `sim.ruckig_minaccel`: the limits are followed by the smallest accelerations.
const MIN_ACCELERATION: i64 = 512;

/// Parameters: group, count of joints, joints, their values, options of joints.
fn check(call: &Call<'_>) -> Answer {
    let joints = call.count_at(1)?;
    let args = [
        Data::Int(call.integer_at(0)),
        call.integers_at(2, joints)?,
        call.optional_integers_at(4, joints)?,
    ];
    let results = call.frame.host().call("sim.checkIkGroup", &args)?;
    if let Some(values) = results.get(1) {
        call.write_at(3, &singles(values));
    }
    Ok(results.into_iter().take(1).collect())
}

/// Parameters: group, count of joints, joints, threshold, milliseconds, values, metric, count of pairs, pairs, options, limits, ranges.
fn configuration(call: &Call<'_>) -> Answer {
    let joints = call.count_at(1)?;
    let args = [
        Data::Int(call.integer_at(0)),
        call.integers_at(2, joints)?,
        Data::Float(call.number_at(3)),
        Data::Int(call.integer_at(4)),
        call.optional_numbers_at(6, 4)?,
        pairs(call, 7)?,
        call.optional_integers_at(9, joints)?,
        call.optional_numbers_at(10, joints)?,
        call.optional_numbers_at(11, joints)?,
    ];
    let results = call.frame.host().call("sim.getConfigForTipPose", &args)?;
    let values = results.first().map(singles).unwrap_or_default();
    call.write_at(5, &values);
    Ok(vec![Data::Bool(!values.is_empty())])
}

/// Parameters: group, count of joints, joints, count of postures, count of pairs, pairs, options.
fn path(call: &Call<'_>) -> Answer {
    let joints = call.count_at(1)?;
    let args = [
        Data::Int(call.integer_at(0)),
        call.integers_at(2, joints)?,
        Data::Int(call.integer_at(3)),
        pairs(call, 4)?,
        call.optional_integers_at(6, joints)?,
    ];
    call.frame.host().call("sim.generateIkPath", &args)
}

/// Pairs of entities that must not collide: their count is the parameter before them.
fn pairs(call: &Call<'_>, count: usize) -> Result<Data, String> {
    let entities = call.count_at(count)?.saturating_mul(2);
    call.optional_integers_at(count + 1, entities)
}

/// Parameters: degrees of freedom, smallest step, flags, current values, limits, selection, targets. `limits` and `targets` are how many
/// there are for each degree of freedom.
fn begin(call: &Call<'_>, function: &str, limits: usize, targets: usize) -> Answer {
    let dofs = call.count_at(0)?;
    let list = |place, each: usize| -> Result<Data, String> {
        let values = call.list_at::<f64>(place, dofs.saturating_mul(each))?;
        Ok(values.into())
    };
    let selection = call.list_at::<u8>(5, dofs)?.into_iter().map(i64::from);
    let args = [
        Data::Int(numbers::count(dofs)),
        Data::Float(call.number_at(1)),
        Data::Int(call.integer_at(2)),
        list(3, 3)?,
        list(4, limits)?,
        selection.collect::<Vec<_>>().into(),
        list(6, targets)?,
    ];
    call.frame.host().call(function, &args)
}

/// How many further limits follow a flag.
fn minima(call: &Call<'_>, flag: i64) -> usize {
    let flags = call.integer_at(2);
    // -1 are the usual flags.
    usize::from(flags != -1 && flags & flag != 0)
}

/// Parameters: handle, step, new values, where the time that is left goes.
fn step(call: &Call<'_>, function: &str) -> Answer {
    let args = [
        Data::Int(call.integer_at(0)),
        Data::Float(call.number_at(1)),
    ];
    let results = call.frame.host().call(function, &args)?;
    if let Some(values) = results.get(1) {
        call.write_at(2, &numbers_of(values));
    }
    if let Some(left) = results.get(2).and_then(Data::as_f64) {
        call.write_at(3, &[left]);
    }
    Ok(vec![Data::Int(results.first().map_or(-1, integer))])
}

/// The first step of a profile that has begun, which ends with it: the eighth parameter gets the new values.
fn at_once(call: &Call<'_>, profile: Vec<Data>) -> Answer {
    let profile = profile.into_iter().next().ok_or("there is no profile")?;
    let host = call.frame.host();
    let step = [profile.clone(), Data::Float(call.number_at(1))];
    let results = host.call("sim.rmlStep", &step);
    host.call("sim.rmlRemove", &[profile])?;
    let results = results?;
    if let Some(values) = results.get(1) {
        call.write_at(7, &numbers_of(values));
    }
    Ok(vec![Data::Int(results.first().map_or(-1, integer))])
}

/// Numbers of a control point, without and with auxiliary data.
const POINT: usize = 11;
const POINT_WITH_DATA: usize = 16;
/// Option of control points: with auxiliary data.
const WITH_DATA: i64 = 2;
/// The places of the integers of a control point: how many Bezier points it has, and its flags.
const INTEGERS: [usize; 2] = [8, 11];

/// Parameters: path, options, first index, count of points, points of 4-byte floats and integers.
fn insert_points(call: &Call<'_>) -> Answer {
    let size = if call.integer_at(1) & WITH_DATA == 0 {
        POINT
    } else {
        POINT_WITH_DATA
    };
    let words = call.list_at::<i32>(4, call.count_at(3)?.saturating_mul(size))?;
    let points = words.chunks_exact(size).flat_map(|point| {
        let words = point.iter().enumerate();
        words.map(|(place, &word)| number_of_word(word, INTEGERS.contains(&place)))
    });
    let mut args = call.args[..4].to_vec();
    args.push(points.collect::<Vec<f64>>().into());
    call.frame.host().call("sim.insertPathCtrlPoints", &args)
}

/// Programs pass some of the integers as floats. These are so large as integers that nobody means them.
fn number_of_word(word: i32, is_integer: bool) -> f64 {
    if is_integer && word.unsigned_abs() < 1 << 24 {
        return word.into();
    }
    f32::from_bits(word.cast_unsigned()).into()
}

#[cfg(test)]
mod tests {
    use super::number_of_word;

    #[test]
    fn counts_of_control_points_are_integers_or_floats() {
        let float = |number: f32| number.to_bits().cast_signed();
        assert_eq!(number_of_word(20, true), 20.0);
        assert_eq!(number_of_word(float(20.0), true), 20.0);
        assert_eq!(number_of_word(float(-1.5), false), -1.5);
        // The bits of an integer, as a float.
        assert!(number_of_word(20, false) < 1e-40);
    }
}
