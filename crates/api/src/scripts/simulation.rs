//! `sim.*`: running the simulation, and what the main script calls.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::object::script_object::ScriptType;
use scene::special;
use script::{Number, Rest, ScriptGroup, SysCall};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    start_simulation,
    pause_simulation,
    request_stop,
    get_simulation_state,
    get_simulation_time,
    get_simulation_time_step,
    handle_simulation_start,
    handle_sensing_start,
    handle_embedded_scripts,
    handle_simulation_scripts,
    handle_customization_scripts,
    handle_add_on_scripts,
    handle_sandbox_script,
    handle_dynamics,
];

/// Starts the simulation, or resumes a paused one.
#[api("sim.startSimulation")]
fn start_simulation(cx: &mut Cx) -> Result<()> {
    cx.start_simulation();
    Ok(())
}

/// Asks for a pause. Nothing happens when the simulation is not running or is about to stop.
#[api("sim.pauseSimulation")]
fn pause_simulation(cx: &mut Cx) -> Result<()> {
    cx.pause_simulation();
    Ok(())
}

/// Asks for the end of the simulation.
#[api("sim._stopSimulation")]
fn request_stop(cx: &mut Cx) -> Result<()> {
    cx.stop_simulation();
    Ok(())
}

/// State of the simulation.
///
/// @return state one of sim.simulation_*
#[api("sim.getSimulationState")]
fn get_simulation_state(cx: &Cx) -> Result<i64> {
    Ok(cx.clock().state() as i64)
}

/// Simulated time since the start.
///
/// @return time seconds
#[api("sim.getSimulationTime")]
fn get_simulation_time(cx: &Cx) -> Result<f64> {
    Ok(cx.clock().time())
}

/// Length of a simulation step.
///
/// @return timeStep seconds
#[api("sim.getSimulationTimeStep")]
fn get_simulation_time_step(cx: &Cx) -> Result<f64> {
    Ok(cx.scene().settings().time_step)
}

pub(crate) fn main_script_only(cx: &Cx) -> Result<()> {
    if cx.script().script_type == ScriptType::Main {
        Ok(())
    } else {
        Err(ApiError::MainScriptOnly)
    }
}

/// Result of functions that have nothing to tell.
const NOTHING: i64 = -1;

/// Begins a run: primes the measurement of velocities. For the main script.
///
/// @return result -1
#[api("sim.handleSimulationStart")]
fn handle_simulation_start(cx: &mut Cx) -> Result<i64> {
    main_script_only(cx)?;
    cx.scene_mut().measure_velocities(None);
    Ok(NOTHING)
}

/// Begins the sensing part of a step: measures the velocities of objects. For the main script.
///
/// @param calculationObjects sim.handle_all_except_explicit: collision and distance objects of old scenes are handled too, as the usual main
/// script does
/// @return result -1
#[api("sim.handleSensingStart")]
fn handle_sensing_start(
    cx: &mut Cx,
    #[default(Number(0))] calculation_objects: Number,
) -> Result<i64> {
    main_script_only(cx)?;
    // No time has passed before the sensing part of the first step.
    let dt = (cx.clock().steps() > 0).then(|| cx.scene().settings().time_step);
    cx.scene_mut().measure_velocities(dt);
    if calculation_objects.0 == special::ALL_EXCEPT_EXPLICIT {
        cx.handle_collision_objects(false);
        cx.handle_distance_objects(false);
    }
    Ok(NOTHING)
}

/// The callback with that number, `sim.syscb_*`.
fn callback(number: i64) -> Result<SysCall> {
    let known = SysCall::ALL
        .iter()
        .copied()
        .find(|call| *call as i64 == number);
    known.ok_or_else(|| ApiError::Other("invalid callback.".into()))
}

/// Calls a callback of all simulation scripts, then of the customization scripts there were before. For the main script.
///
/// @param callType sim.syscb_*
/// @return count how many scripts ran it
#[api("sim.handleEmbeddedScripts")]
fn handle_embedded_scripts(
    cx: &mut Cx,
    call_type: i64,
    #[name("...")] arguments: Rest,
) -> Result<i64> {
    main_script_only(cx)?;
    Ok(cx.call_embedded(callback(call_type)?, &arguments.0))
}

/// Calls a callback of all simulation scripts. For the main script; others get -1.
///
/// @param callType sim.syscb_*
/// @return count how many scripts ran it
#[api("sim.handleSimulationScripts")]
fn handle_simulation_scripts(
    cx: &mut Cx,
    call_type: i64,
    #[name("...")] arguments: Rest,
) -> Result<i64> {
    if main_script_only(cx).is_err() {
        return Ok(-1);
    }
    call_group(cx, ScriptGroup::Simulation, call_type, &arguments)
}

/// Calls a callback of all customization scripts. For the main script.
///
/// @param callType sim.syscb_*
/// @return count how many scripts ran it
#[api("sim.handleCustomizationScripts")]
fn handle_customization_scripts(
    cx: &mut Cx,
    call_type: i64,
    #[name("...")] arguments: Rest,
) -> Result<i64> {
    main_script_only(cx)?;
    call_group(cx, ScriptGroup::Customization, call_type, &arguments)
}

/// Calls a callback of all add-ons. For the main script.
///
/// @param callType sim.syscb_*
/// @return count how many add-ons ran it
#[api("sim.handleAddOnScripts")]
fn handle_add_on_scripts(
    cx: &mut Cx,
    call_type: i64,
    #[name("...")] arguments: Rest,
) -> Result<i64> {
    main_script_only(cx)?;
    call_group(cx, ScriptGroup::AddOn, call_type, &arguments)
}

/// Calls a callback of the sandbox. For the main script.
///
/// @param callType sim.syscb_*
#[api("sim.handleSandboxScript")]
fn handle_sandbox_script(
    cx: &mut Cx,
    call_type: i64,
    #[name("...")] arguments: Rest,
) -> Result<()> {
    main_script_only(cx)?;
    call_group(cx, ScriptGroup::Sandbox, call_type, &arguments).map(drop)
}

fn call_group(cx: &mut Cx, group: ScriptGroup, call_type: i64, arguments: &Rest) -> Result<i64> {
    Ok(cx.call_group(group, callback(call_type)?, &arguments.0))
}

/// Advances the physics. For the main script or a simulation script.
///
/// @param deltaTime seconds
/// @param ikGroups sim.handle_all_except_explicit: first computes the groups of inverse kinematics of old scenes that are not handled explicitly
/// @return passes number of sub-steps
#[api("sim.handleDynamics")]
fn handle_dynamics(cx: &mut Cx, delta_time: f64, #[default(0)] ik_groups: Number) -> Result<i64> {
    if !matches!(
        cx.script().script_type,
        ScriptType::Main | ScriptType::Simulation
    ) {
        return Err(ApiError::MainOrSimulationScriptOnly);
    }
    if ik_groups.0 == special::ALL_EXCEPT_EXPLICIT && cx.scene().ik_groups().iter().next().is_some()
    {
        crate::old::ik_groups::handle_ik_groups(cx, false)?;
    }
    cx.handle_dynamics(delta_time)
}
