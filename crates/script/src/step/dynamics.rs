//! One call of the dynamics: sub-steps, with callbacks of scripts between them (spec: dynamics 2). Callbacks have old names too, from
//! the time of V-REP; both are called.

use std::rc::Rc;

use crate::calls::contacts::CONTACT;
use crate::error::{ApiError, ApiResult};
use crate::host::Sim;
use crate::log::verbosity;
use crate::phases;
use crate::sys_call::SysCall;
use dynamics::{Dynamics, DynamicsCall, JointRequest, ScriptAccess, Trigger, Verdicts};
use scene::joint::Joint;
use scene::{Data, Handle, Scene};

/// The callbacks before and after a sub-step: the old name first.
const DYN: [SysCall; 2] = [SysCall::DynCallback, SysCall::Dyn];

impl Sim {
    /// Advances the dynamics by `time_step` seconds; returns the number of sub-steps.
    ///
    /// # Errors
    /// When called by a script that this very call has called.
    pub(crate) fn handle_dynamics(self: &Rc<Self>, time_step: f64) -> ApiResult<i64> {
        self.run_hooks(|hooks| hooks.before_dynamics);
        phases::physics(|| self.step_dynamics(time_step))
    }

    fn step_dynamics(self: &Rc<Self>, time_step: f64) -> ApiResult<i64> {
        let begun = self.with_dynamics(|dynamics, scene| dynamics.begin(scene, time_step));
        let busy = || ApiError::Other("the dynamics are already being handled.".into());
        let Some(call) = begun.ok_or_else(busy)?.map_err(|_| busy())? else {
            return Ok(self.sub_steps_without_bodies(time_step));
        };
        for number in 1..=call.sub_steps {
            self.dynamics_callback(call, number, false);
            let driven = self.drive_joints(call, number);
            self.run_sub_step(number, driven);
            self.dynamics_callback(call, number, true);
        }
        let triggers = self.with_dynamics(Dynamics::end).unwrap_or_default();
        triggers
            .iter()
            .for_each(|trigger| self.force_sensor_triggered(trigger));
        Ok(i64::from(call.sub_steps))
    }

    /// The number of sub-steps there would be: CoppeliaSim counts them where nothing moves too.
    fn sub_steps_without_bodies(&self, time_step: f64) -> i64 {
        let scene = self.scene.borrow();
        let settings = &scene.settings().dynamics;
        let takes_time = settings.enabled && time_step.is_finite() && time_step > 0.0;
        if takes_time {
            settings.sub_steps(time_step).into()
        } else {
            0
        }
    }

    fn with_dynamics<R>(&self, work: impl FnOnce(&mut Dynamics, &mut Scene) -> R) -> Option<R> {
        let mut dynamics = self.dynamics.borrow_mut();
        dynamics
            .as_mut()
            .map(|dynamics| work(dynamics, &mut self.scene.borrow_mut()))
    }

    fn dynamics_callback(self: &Rc<Self>, call: DynamicsCall, number: u32, after_step: bool) {
        if !self.scripts.may_respond_to_any(&DYN) {
            return;
        }
        let data = Data::map([
            ("passCnt", i64::from(number).into()),
            ("totalPasses", i64::from(call.sub_steps).into()),
            ("dt", call.step.into()),
            ("dynStepSize", call.step.into()),
            ("afterStep", after_step.into()),
        ]);
        for callback in DYN {
            self.broadcast(callback, std::slice::from_ref(&data));
        }
    }

    /// Sets the motors; a script's answer drives a joint in callback control. Returns whether there are such joints.
    fn drive_joints(self: &Rc<Self>, call: DynamicsCall, number: u32) -> bool {
        let requests = self
            .with_dynamics(|dynamics, scene| dynamics.prepare(scene, number))
            .unwrap_or_default();
        for request in &requests {
            let Some(data) = self.joint_data(request, call, number) else {
                continue;
            };
            let answer = self.joint_callback(request.joint, &[data]);
            let field = |names: [&str; 2]| {
                names
                    .into_iter()
                    .find_map(|name| answer.as_ref()?.field(name)?.as_f64())
            };
            let (velocity, force) = (field(["velocity", "vel"]), field(["force", "ctrl"]));
            if velocity.is_some() || force.is_some() {
                self.with_dynamics(|dynamics, _| dynamics.drive(request.joint, velocity, force));
            }
        }
        !requests.is_empty()
    }

    /// The scripts of the joint are called by the old name first.
    fn joint_callback(self: &Rc<Self>, joint: Handle, data: &[Data]) -> Option<Data> {
        if self.scripts.may_respond(SysCall::JointCallback)
            && let Some(answer) =
                self.first_answer(&self.scripts_of_object(joint), SysCall::JointCallback, data)
        {
            return Some(answer);
        }
        self.first_answer(&self.joint_chain(joint), SysCall::Joint, data)
    }

    fn joint_data(&self, request: &JointRequest, call: DynamicsCall, number: u32) -> Option<Data> {
        let scene = self.scene.borrow();
        let joint = scene
            .object(request.joint)
            .and_then(|object| object.joint())
            .ok()?;
        Some(joint_data(joint, request, call, number))
    }

    /// One sub-step. Nothing is borrowed while the engine works, because scripts may filter contacts. `driven`: scripts drive joints.
    fn run_sub_step(self: &Rc<Self>, number: u32, driven: bool) {
        let contact_callbacks = self.scripts.may_respond_to_any(&CONTACT);
        let script_access = ScriptAccess {
            possible: driven || contact_callbacks || self.scripts.may_respond_to_any(&DYN),
        };
        let filter = |first: Handle, second: Handle| self.ask_about_contact(first, second);
        let pairs = |dynamics: &mut Dynamics, _: &mut Scene| dynamics.pairs_near();
        let near = if contact_callbacks {
            self.with_dynamics(pairs).unwrap_or_default()
        } else {
            Vec::new()
        };
        let responses = self.ask_about_contacts(&near);
        let verdicts = Verdicts::new(near, responses);
        let started = self.with_dynamics(|dynamics, scene| {
            dynamics.start_sub_step(scene, number, script_access, verdicts)
        });
        let Some(mut sub_step) = started.flatten() else {
            return;
        };
        sub_step.run(contact_callbacks.then_some(&filter));
        let stopped = self.with_dynamics(|dynamics, scene| {
            dynamics.finish_sub_step(sub_step, scene);
            dynamics.take_frozen()
        });
        stopped
            .into_iter()
            .flatten()
            .for_each(|shape| self.warn_of_infinite_motion(shape));
    }

    fn warn_of_infinite_motion(&self, shape: Handle) {
        let path = self.scene.borrow().full_path(shape).unwrap_or_default();
        self.log(
            verbosity::WARNINGS,
            &format!("{path}: its motion has no finite values any more; the physics holds it where it was. Check masses and forces."),
        );
    }

    fn force_sensor_triggered(self: &Rc<Self>, trigger: &Trigger) {
        let data = Data::map([
            ("handle", trigger.sensor.raw().into()),
            ("force", trigger.raw.0.into()),
            ("torque", trigger.raw.1.into()),
            ("filteredForce", trigger.filtered.0.into()),
            ("filteredTorque", trigger.filtered.1.into()),
        ]);
        for script in self.scripts_of_object(trigger.sensor) {
            self.deliver(&script, SysCall::Trigger, std::slice::from_ref(&data));
        }
    }
}

/// The keys of `sysCall_joint` in callback control, as Bullet's.
fn joint_data(joint: &Joint, request: &JointRequest, call: DynamicsCall, number: u32) -> Data {
    let limits = (joint.min, joint.min + joint.range);
    Data::map([
        ("mode", (joint.mode as i64).into()),
        ("first", request.first.into()),
        ("revolute", joint.is_revolute().into()),
        ("cyclic", joint.cyclic.into()),
        ("handle", request.joint.raw().into()),
        ("lowLimit", limits.0.into()),
        ("highLimit", limits.1.into()),
        ("passCnt", i64::from(number).into()),
        ("totalPasses", i64::from(call.sub_steps).into()),
        ("pos", request.position.into()),
        ("currentPos", request.position.into()),
        ("vel", request.velocity.into()),
        ("currentVel", request.velocity.into()),
        ("targetPos", joint.target_position.into()),
        ("error", request.error.into()),
        ("errorValue", request.error.into()),
        ("effort", request.effort.into()),
        ("dt", call.step.into()),
        ("dynStepSize", call.step.into()),
        ("targetVel", joint.target_velocity.into()),
        ("force", joint.target_force.into()),
        ("maxForce", joint.target_force.abs().into()),
        ("maxVel", joint.max_vel.into()),
        ("velUpperLimit", joint.max_vel.into()),
        ("maxAccel", joint.max_accel.into()),
        ("maxJerk", joint.max_jerk.into()),
    ])
}
