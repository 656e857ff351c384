//! Results for the scene: after a sub-step and at the end of a call.

#[cfg(test)]
mod tests;

use geometry::pose::euler::wrap_angle;
use nalgebra::UnitQuaternion;
use rapier3d_f64::prelude::RigidBody;

use super::bodies::Body;
use super::convert::{from_pose, from_vector};
use super::links::{Link, Links};
use super::load::Load;
use super::plan::LinkKind;
use super::world::World;
use super::{Dynamics, SubStep};
use scene::joint::Joint;
use scene::pose::placement::is_valid_pose;
use scene::sensor::force_sensor::{ForceFilter, ForceSensor};
use scene::shape::Velocity;
use scene::simulation::dynamics_report::JointReport;
use scene::{DynamicFlags, Field, Handle, Kind, Pose, Scene};

/// A force sensor whose threshold was exceeded often enough.
#[derive(Debug, Clone, PartialEq)]
pub struct Trigger {
    /// The force sensor.
    pub sensor: Handle,
    /// Mean over the sub-steps of the last call: force and torque.
    pub raw: Load,
    /// What the sensor's filter makes of the last readings: force and torque.
    pub filtered: Load,
}

impl Dynamics {
    /// Takes the engine back after a sub-step and tells the scene: joints and force sensors first, then shapes, base-to-tip. Only when
    /// somebody can see them before the next sub-step, or when the engine gave up on a shape.
    pub fn finish_sub_step(&mut self, sub_step: SubStep, scene: &mut Scene) {
        let SubStep {
            mut world,
            gravity,
            step,
            seen,
            is_integrated,
            is_known,
            ..
        } = sub_step;
        if self.call.is_none() {
            return;
        }
        match (is_integrated, is_known) {
            (true, true) => {}
            // Masks do not say all of pairs.
            (true, false) if self.pairs.is_empty() => self.mechanisms.look_around(&world),
            _ => self.mechanisms.forget_surroundings(),
        }
        if is_integrated {
            self.mechanisms.apply_positions(&mut self.links, &mut world);
        } else {
            self.links
                .values_mut()
                .for_each(|link| link.note_turn(&world, step));
            self.mechanisms
                .correct_positions(&mut self.links, &mut world, &mut self.workers);
        }
        let reports = seen || self.follows_scene;
        for (handle, link) in self.links.iter_mut() {
            if let Some(moving_side) = link.after_step(&world, step).filter(|_| reports) {
                report_link(scene, handle, link, moving_side);
            }
        }
        let stopped = if seen || world.has_invalid_bodies() {
            self.report_bodies(&world, scene)
        } else {
            Vec::new()
        };
        if seen {
            self.report_soft_bodies(scene);
        }
        let soft = self.soft_bodies.touches(&world);
        self.contacts
            .add_sub_step(&world, self.mechanisms.contacts(), &soft, step);
        self.particles
            .advance(scene, &self.bodies, &world, gravity, step);
        self.world = Some(world);
        self.stop_bodies(&stopped, scene);
    }

    /// Tells the scene where the bodies are; returns those for which there is no telling.
    fn report_bodies(&mut self, world: &World, scene: &mut Scene) -> Vec<Handle> {
        let mut stopped = Vec::new();
        for (shape, body) in self
            .bodies
            .iter_mut()
            .filter(|(_, body)| body.build.dynamic)
        {
            let sleeps = world
                .bodies
                .get(body.rigid)
                .is_some_and(RigidBody::is_sleeping);
            // Below a parent a sleeper stays where it is when the parent moves, so that its place has to be said again.
            if std::mem::replace(&mut body.slept, sleeps) && sleeps && is_root(scene, shape) {
                continue;
            }
            let Some((pose, velocity)) = state(body, world) else {
                stopped.push(shape);
                continue;
            };
            let pose = (!is_held(&self.links, scene, shape)).then_some(pose);
            // The shape may have been removed in the meantime.
            if let Ok(local) = scene.report_body(shape, pose, velocity) {
                body.local = local;
            }
        }
        stopped
    }

    /// Makes bodies static for which the engine found no next state, at once: nothing shall be solved with them any more.
    fn stop_bodies(&mut self, shapes: &[Handle], scene: &mut Scene) {
        for &shape in shapes {
            // A shape that was removed meanwhile needs no stop.
            let _ = scene.report_body(shape, None, Velocity::default());
            self.frozen.hold(shape, scene);
        }
        if !shapes.is_empty() {
            self.known = None;
            self.update_plan(scene);
        }
    }

    /// Ends the call: clears forces, averages readings, sets the dynamic flags. Returns the force sensors that trigger.
    pub fn end(&mut self, scene: &mut Scene) -> Vec<Trigger> {
        self.call = None;
        let forced: Vec<Handle> = scene
            .objects()
            .filter(|o| is_forced(o))
            .map(|o| o.handle())
            .collect();
        for shape in forced {
            let _ = scene.try_modify(shape, Field::Pose, |object| {
                let shape = object.shape_mut()?;
                (shape.force, shape.torque) = ([0.0; 3], [0.0; 3]);
                Ok(())
            });
        }
        let triggers = self
            .links
            .iter()
            .filter_map(|(handle, link)| read(scene, handle, link))
            .collect();
        scene.drawings_mut().draw_particles();
        self.write_flags(scene);
        triggers
    }

    fn write_flags(&self, scene: &mut Scene) {
        let changes: Vec<(Handle, DynamicFlags)> = scene
            .objects()
            .map(|object| {
                (
                    object.handle(),
                    self.flag_of(object.handle(), &object.kind),
                    object.dynamic_flag,
                )
            })
            .filter(|(_, flag, old)| flag != old)
            .map(|(handle, flag, _)| (handle, flag))
            .collect();
        for (handle, flag) in changes {
            // The flag follows from what takes part; it does not change it.
            let _ = scene.modify(handle, Field::Measured, |object| {
                object.dynamic_flag = flag;
                if let Ok(shape) = object.shape_mut()
                    && !flag.contains(DynamicFlags::DYNAMIC)
                {
                    // Nothing moves it any more.
                    shape.velocity = Velocity::default();
                }
            });
        }
    }

    fn flag_of(&self, handle: Handle, kind: &Kind) -> DynamicFlags {
        match kind {
            Kind::Shape(_) => self
                .bodies
                .get(handle)
                .map_or(DynamicFlags::empty(), |body| {
                    let mut flags = DynamicFlags::empty();
                    flags.set(DynamicFlags::RESPONDABLE, body.build.respondable);
                    flags.set(DynamicFlags::DYNAMIC, body.build.dynamic);
                    flags
                }),
            Kind::Joint(_) if self.links.contains(handle) => DynamicFlags::JOINT,
            Kind::ForceSensor(_) if self.links.contains(handle) => DynamicFlags::FORCE_SENSOR,
            Kind::Dummy(dummy)
                if [Some(handle), dummy.link]
                    .iter()
                    .flatten()
                    .any(|&end| self.links.contains(end)) =>
            {
                DynamicFlags::DUMMY
            }
            _ => DynamicFlags::empty(),
        }
    }
}

fn is_root(scene: &Scene, shape: Handle) -> bool {
    scene
        .object(shape)
        .is_ok_and(|object| object.parent().is_none())
}

/// Whether the shape hangs on a link that is its parent, so that its place in the scene follows from the link.
fn is_held(links: &Links, scene: &Scene, shape: Handle) -> bool {
    let parent = scene.object(shape).ok().and_then(|object| object.parent());
    parent
        .and_then(|parent| links.get(parent))
        .is_some_and(|link| link.plan.second_is_child && link.plan.second == shape)
}

/// Where a body is and how it moves; None when that cannot be said in numbers. rapier disables such a body.
fn state(body: &Body, world: &World) -> Option<(Pose, Velocity)> {
    let rigid = world
        .bodies
        .get(body.rigid)
        .filter(|rigid| rigid.is_enabled())?;
    let velocity = Velocity {
        linear: from_vector(rigid.linvel()),
        angular: from_vector(rigid.angvel()),
    };
    let pose = from_pose(rigid.position());
    (is_valid_pose(&pose) && rigid.vels().is_finite()).then_some((pose, velocity))
}

fn report_link(scene: &mut Scene, handle: Handle, link: &Link, moving_side: Pose) {
    // The joint may have been removed in the meantime.
    let _ = match link.plan.kind {
        LinkKind::Weld => Ok(()),
        LinkKind::Sensor => scene.report_sensor(handle, moving_side),
        kind => {
            let shown = |joint: &Joint| shown_position(joint, kind, link.motion.position);
            let position = scene
                .object(handle)
                .and_then(|object| object.joint().map(shown));
            let report = JointReport {
                position: position.unwrap_or(link.motion.position),
                rotation: if kind == LinkKind::Spherical {
                    moving_side.rotation
                } else {
                    UnitQuaternion::identity()
                },
                velocity: link.motion.velocity,
                moving_side,
                effort: link.efforts.last().copied().unwrap_or(0.0),
            };
            scene.report_joint(handle, &report)
        }
    };
}

/// The position scripts read: a turn of cyclic joints, within the interval where limits are enforced.
fn shown_position(joint: &Joint, kind: LinkKind, position: f64) -> f64 {
    match kind {
        LinkKind::Revolute if joint.cyclic => wrap_angle(position),
        _ if joint.enforce_limits && !joint.cyclic => position.max(joint.min).min(joint.max()),
        _ => position,
    }
}

fn is_forced(object: &scene::Object) -> bool {
    object
        .shape()
        .is_ok_and(|shape| shape.force != [0.0; 3] || shape.torque != [0.0; 3])
}

/// Averages what a link measured over the call.
fn read(scene: &mut Scene, handle: Handle, link: &Link) -> Option<Trigger> {
    match link.plan.kind {
        LinkKind::Sensor => {
            let load = mean(&link.loads)?;
            let latest = *link.loads.last()?;
            let fired = scene.try_modify(handle, Field::Measured, |object| {
                let sensor = object.force_sensor_mut()?;
                sensor.raw = Some(latest);
                Ok(take_sample(sensor, load))
            });
            fired.ok().flatten().map(|filtered| Trigger {
                sensor: handle,
                raw: load,
                filtered,
            })
        }
        LinkKind::Revolute | LinkKind::Prismatic => {
            let mean = link.efforts.iter().sum::<f64>() / link.efforts.len().max(1) as f64;
            let _ = scene.try_modify(handle, Field::JointPosition, |object| {
                object.joint_mut()?.force = Some(mean);
                Ok(())
            });
            None
        }
        LinkKind::Spherical | LinkKind::Weld => None,
    }
}

fn mean(loads: &[Load]) -> Option<Load> {
    let sum = |part: fn(&Load) -> [f64; 3]| {
        [0, 1, 2]
            .map(|axis| loads.iter().map(|load| part(load)[axis]).sum::<f64>() / loads.len() as f64)
    };
    (!loads.is_empty()).then(|| (sum(|load| load.0), sum(|load| load.1)))
}

/// Puts a value into the filter; returns the filtered value when the sensor triggers.
fn take_sample(sensor: &mut ForceSensor, load: Load) -> Option<Load> {
    let size = sensor.sample_size.max(1);
    sensor.samples.push_back(load);
    while sensor.samples.len() > size {
        sensor.samples.pop_front();
    }
    if sensor.samples.len() < size {
        return None;
    }
    let filtered = filter(sensor.filter, sensor.samples.make_contiguous())?;
    sensor.filtered = Some(filtered);
    let exceeds = |vector: [f64; 3], threshold: f64| {
        vector.iter().map(|x| x * x).sum::<f64>().sqrt() >= threshold
    };
    let violated = sensor.force_threshold_enabled && exceeds(filtered.0, sensor.force_threshold)
        || sensor.torque_threshold_enabled && exceeds(filtered.1, sensor.torque_threshold);
    sensor.violations = if violated { sensor.violations + 1 } else { 0 };
    if sensor.violations < sensor.consecutive_violations.max(1) {
        return None;
    }
    sensor.violations = 0;
    Some(filtered)
}

fn filter(kind: ForceFilter, samples: &[Load]) -> Option<Load> {
    match kind {
        ForceFilter::Average => mean(samples),
        ForceFilter::Median => {
            let median = |part: fn(&Load) -> [f64; 3]| {
                [0, 1, 2].map(|axis| {
                    let mut values: Vec<f64> =
                        samples.iter().map(|load| part(load)[axis]).collect();
                    values.sort_by(f64::total_cmp);
                    values[values.len() / 2]
                })
            };
            (!samples.is_empty()).then(|| (median(|load| load.0), median(|load| load.1)))
        }
    }
}
