//! `sim.*`: kinematic motion of joints.

use api_macro::api;

use crate::api::{ApiFn, Cx, Result, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![handle_joint_motion];

/// Moves kinematic joints towards their targets by one step. For the main script.
#[api("sim.handleJointMotion")]
fn handle_joint_motion(cx: &mut Cx) -> Result<()> {
    crate::api::scripts::simulation::main_script_only(cx)?;
    cx.handle_joint_motion();
    Ok(())
}
