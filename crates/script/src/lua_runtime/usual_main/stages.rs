//! What the callbacks of the usual main script call: the same as in `lua/library/defaultMainScript.lua`, in the same order.

use crate::binding::registry::{FunctionId, Member, Registry};
use crate::host::{Env, ScriptError};
use crate::sys_call::SysCall;
use scene::{Data, special};

/// The callbacks that the text defines.
const DEFINED: [SysCall; 8] = [
    SysCall::Init,
    SysCall::Actuation,
    SysCall::Sensing,
    SysCall::Cleanup,
    SysCall::Suspend,
    SysCall::Suspended,
    SysCall::Resume,
    SysCall::Joint,
];

/// Whether the text defines a callback.
pub(super) fn defines(call: SysCall) -> bool {
    DEFINED.contains(&call)
}

/// Whether what a callback does is known here.
pub(super) fn are_known(call: SysCall) -> bool {
    defines(call) && call != SysCall::Joint
}

/// The functions that the callbacks call.
pub(super) struct Stages {
    embedded: FunctionId,
    add_ons: FunctionId,
    sandbox: FunctionId,
    simulation: FunctionId,
    start: FunctionId,
    joint_motion: FunctionId,
    path: FunctionId,
    dynamics: FunctionId,
    sensing_start: FunctionId,
    sensors: FunctionId,
    reset_proximity: FunctionId,
    reset_vision: FunctionId,
}

/// Objects that no script handles itself.
const NOT_EXPLICIT: Data = Data::Int(special::ALL_EXCEPT_EXPLICIT);

impl Stages {
    /// The functions of a simulator; None where one of them is not there, or in Lua.
    pub(super) fn of(registry: &Registry) -> Option<Self> {
        let native = |name| match registry.find(name)? {
            Member::Native(id) => Some(id),
            _ => None,
        };
        Some(Self {
            embedded: native("sim.handleEmbeddedScripts")?,
            add_ons: native("sim.handleAddOnScripts")?,
            sandbox: native("sim.handleSandboxScript")?,
            simulation: native("sim.handleSimulationScripts")?,
            start: native("sim.handleSimulationStart")?,
            joint_motion: native("sim.handleJointMotion")?,
            path: native("simHandlePath")?,
            dynamics: native("sim.handleDynamics")?,
            sensing_start: native("sim.handleSensingStart")?,
            sensors: native("sim._handleSensors")?,
            reset_proximity: native("sim.resetProximitySensor")?,
            reset_vision: native("sim.resetVisionSensor")?,
        })
    }

    /// Does what a callback does.
    pub(super) fn run(&self, env: &Env, call: SysCall) -> Result<(), ScriptError> {
        let do_call = |function, args: &[Data]| do_call(env, function, args);
        match call {
            SysCall::Init => do_call(self.start, &[]),
            SysCall::Actuation => self.actuate(env),
            SysCall::Sensing => {
                do_call(self.sensing_start, &[NOT_EXPLICIT])?;
                do_call(self.sensors, &[])?;
                self.notify(env, call)
            }
            SysCall::Cleanup => {
                do_call(self.simulation, &[Data::Int(call as i64)])?;
                do_call(self.reset_proximity, &[NOT_EXPLICIT])?;
                do_call(self.reset_vision, &[NOT_EXPLICIT])
            }
            _ => self.notify(env, call),
        }
    }

    fn actuate(&self, env: &Env) -> Result<(), ScriptError> {
        self.notify(env, SysCall::Actuation)?;
        do_call(env, self.joint_motion, &[])?;
        let sim = env.sim.upgrade();
        let dt = Data::Float(sim.map_or(0.0, |sim| sim.scene.borrow().settings().time_step));
        do_call(env, self.path, &[NOT_EXPLICIT, dt.clone()])?;
        do_call(env, self.dynamics, &[dt, NOT_EXPLICIT])
    }

    /// Calls a callback of all other scripts.
    fn notify(&self, env: &Env, call: SysCall) -> Result<(), ScriptError> {
        for function in [self.embedded, self.add_ons, self.sandbox] {
            do_call(env, function, &[Data::Int(call as i64)])?;
        }
        Ok(())
    }
}

/// Calls a function in the name of the main script.
fn do_call(env: &Env, function: FunctionId, args: &[Data]) -> Result<(), ScriptError> {
    let bound = env.registry.bound(function);
    match env.call_native(bound, args) {
        Ok(_) => Ok(()),
        // No line of the script calls.
        Err(error) => Err(ScriptError::new(format!("-1: in {}: {error}", bound.name))),
    }
}
