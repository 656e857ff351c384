//! Groups of inverse kinematics of V-REP, and motion profiles.

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
    ("rml.step", step),
];

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

/// Parameters: handle, step, new values.
fn step(call: &Call<'_>) -> Answer {
    let args = [
        Data::Int(call.integer_at(0)),
        Data::Float(call.number_at(1)),
    ];
    let results = call.frame.host().call("sim.rmlStep", &args)?;
    if let Some(values) = results.get(1) {
        call.write_at(2, &numbers_of(values));
    }
    Ok(vec![Data::Int(results.first().map_or(-1, integer))])
}
