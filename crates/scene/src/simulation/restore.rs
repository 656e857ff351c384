//! The state that is restored when a simulation ends (spec: objects 8, simulation 6).

use std::collections::BTreeSet;

use crate::joint::Joint;
use crate::shape::Velocity;
use crate::{
    DynamicFlags, Field, Handle, Kind, Layers, ModelFlags, Object, ObjectFlags, Pose, Scene,
    SceneResult, Uid,
};

/// The state of one object at simulation start.
#[derive(Debug, Clone)]
pub(crate) struct InitialState {
    parent: Option<Uid>,
    local: Pose,
    world: Pose,
    model_property: ModelFlags,
    layer: Layers,
    kind: InitialKind,
}

/// The stored state of the type of an object.
#[derive(Debug, Clone)]
enum InitialKind {
    Joint(Box<Joint>),
    Shape(Velocity),
    /// Position, nominal and target velocity.
    Path([f64; 3]),
    Other,
}

impl Scene {
    /// Stores the state of every object for the end of the run, except in models with [`ModelFlags::NOT_RESET`]. The flag holds for one
    /// run and is cleared here.
    pub fn store_initial_state(&mut self) {
        self.in_run = true;
        let objects = self.all_breadth_first();
        let unrestored = self.not_reset(&objects);
        for handle in objects {
            let Ok(world) = self.world_pose(handle) else {
                continue;
            };
            let parent = self.uid_of_parent(handle);
            if let Ok(object) = self.object_in_place(handle) {
                if object.is_model() {
                    object.model_property.remove(ModelFlags::NOT_RESET);
                }
                end_suspension(object);
                let stored = !unrestored.contains(&handle);
                object.initial = stored.then(|| Box::new(InitialState::of(object, parent, world)));
                if let Kind::Path(path) = &mut object.kind {
                    path.nominal_velocity = 0.0;
                }
            }
            self.hide_for_simulation(handle);
        }
    }

    /// Stores the first state of a copy made during a run. Other new objects have no stored state and stay as the run leaves them.
    pub(crate) fn store_state_of_copy(&mut self, handle: Handle) -> SceneResult<()> {
        if !self.in_run {
            return Ok(());
        }
        let (world, parent) = (self.world_pose(handle)?, self.uid_of_parent(handle));
        let object = self.object_in_place(handle)?;
        object.initial = Some(Box::new(InitialState::of(object, parent, world)));
        Ok(())
    }

    /// Removes an object from all layers if it has [`ObjectFlags::HIDDEN_FOR_SIMULATION`].
    fn hide_for_simulation(&mut self, handle: Handle) {
        let hidden = self.object(handle).is_ok_and(|object| {
            object
                .object_property
                .contains(ObjectFlags::HIDDEN_FOR_SIMULATION)
                && !object.layer.is_empty()
                && object.initial.is_some()
        });
        if hidden {
            // The handle was just read.
            let _ = self.modify(handle, Field::Layer, |object| {
                object.layer = Layers::empty();
            });
        }
    }

    /// The objects in models with [`ModelFlags::NOT_RESET`].
    fn not_reset(&self, objects: &[Handle]) -> BTreeSet<Handle> {
        objects
            .iter()
            .copied()
            .filter(|&h| {
                self.calculated_model_property(h)
                    .contains(ModelFlags::NOT_RESET)
            })
            .collect()
    }

    fn uid_of_parent(&self, handle: Handle) -> Option<Uid> {
        let parent = self.object(handle).ok()?.parent()?;
        self.object(parent).ok().map(Object::uid)
    }

    /// Restores the state that every object had at the start of the run, except in models with [`ModelFlags::NOT_RESET`]. Copies made
    /// during the run return to their first state; other new objects stay as they are.
    pub fn restore_initial_state(&mut self) {
        self.in_run = false;
        self.drawings.clear_particles();
        let objects = self.all_breadth_first();
        let unrestored = self.not_reset(&objects);
        self.objects.moves_mut().measurements.forget();
        let mut restored = Vec::with_capacity(objects.len());
        for handle in objects {
            let Ok(object) = self.object_in_place(handle) else {
                continue;
            };
            object.measured = crate::MeasuredVelocity::default();
            (object.dynamic_flag, object.dynamics_reset) = (DynamicFlags::empty(), false);
            end_suspension(object);
            match object
                .initial
                .take()
                .filter(|_| !unrestored.contains(&handle))
            {
                Some(initial) => restored.push((handle, initial)),
                // The handle was just read.
                None => {
                    drop(self.modify(handle, Field::Other, |object| forget_run(&mut object.kind)));
                }
            }
        }
        self.restore_parents(&restored);
        for (handle, initial) in restored {
            // The handles were just read from the tree.
            let _ = self.restore_object(handle, &initial);
        }
        self.restore_soft();
    }

    /// What is soft is where it began.
    fn restore_soft(&mut self) {
        let is_moved = |object: &&Object| {
            let shape = object.shape();
            shape.is_ok_and(|shape| shape.soft_form.is_some())
        };
        let moved = self.objects().filter(is_moved).map(Object::handle);
        for handle in moved.collect::<Vec<_>>() {
            let soft = self.object(handle).ok().and_then(Object::soft);
            let is_restored =
                soft.is_some_and(|soft| self.report_soft_form(handle, &soft, None).is_ok());
            if !is_restored {
                // It is not soft any more, and keeps the form it was given.
                let _ = self.modify(handle, Field::Geometry, |object| {
                    object.shape_mut().map(|shape| shape.soft_form = None)
                });
            }
        }
    }

    /// Restores the tree. All moved objects are detached first, so that no order of attaching closes a circle.
    fn restore_parents(&mut self, restored: &[(Handle, Box<InitialState>)]) {
        let mut moved = Vec::new();
        for (handle, initial) in restored {
            let parent = initial.parent.and_then(|uid| self.by_uid(uid));
            let lost = initial.parent.is_some() && parent.is_none();
            if !lost
                && self
                    .object(*handle)
                    .is_ok_and(|object| object.parent() != parent)
            {
                moved.push((*handle, parent));
            }
        }
        for &(handle, _) in &moved {
            let _ = self.set_parent(handle, None, true);
        }
        for (handle, parent) in moved {
            // Refused only if the parent is below `handle` now, by way of an object that keeps its state.
            let _ = self.set_parent(handle, parent, true);
        }
    }

    fn restore_object(&mut self, handle: Handle, initial: &InitialState) -> SceneResult<()> {
        if self.uid_of_parent(handle) == initial.parent {
            self.set_local_pose(handle, initial.local)?;
        } else {
            self.set_world_pose(handle, initial.world)?;
        }
        if self.object(handle)?.model_property != initial.model_property {
            self.modify(handle, Field::ModelProperty, |object| {
                object.model_property = initial.model_property;
            })?;
        }
        let object = self.object(handle)?;
        if object
            .object_property
            .contains(ObjectFlags::HIDDEN_FOR_SIMULATION)
            && object.layer != initial.layer
        {
            self.modify(handle, Field::Layer, |object| object.layer = initial.layer)?;
        }
        self.modify(handle, Field::Other, |object| {
            initial.restore_kind(&mut object.kind);
        })
    }
}

/// Ends a suspension of collisions, which lasts no longer than a run.
fn end_suspension(object: &mut Object) {
    if let Kind::Shape(shape) = &mut object.kind {
        shape.dynamics.respondable_suspend_count = 0;
    }
}

impl InitialState {
    fn of(object: &Object, parent: Option<Uid>, world: Pose) -> Self {
        let kind = match &object.kind {
            Kind::Joint(joint) => InitialKind::Joint(joint.clone()),
            Kind::Shape(shape) => InitialKind::Shape(shape.dynamics.initial_velocity),
            Kind::Path(path) => InitialKind::Path(path.motion()),
            _ => InitialKind::Other,
        };
        let (model_property, layer) = (object.model_property, object.layer);
        Self {
            parent,
            local: object.pose(),
            world,
            model_property,
            layer,
            kind,
        }
    }

    /// Position, nominal and target velocity of a path.
    pub(crate) fn path_motion(&self) -> Option<[f64; 3]> {
        match self.kind {
            InitialKind::Path(motion) => Some(motion),
            _ => None,
        }
    }

    fn restore_kind(&self, kind: &mut Kind) {
        match (&mut *kind, &self.kind) {
            (Kind::Joint(joint), InitialKind::Joint(initial)) => restore_joint(joint, initial),
            (Kind::Shape(shape), InitialKind::Shape(initial)) => {
                shape.dynamics.initial_velocity = *initial;
            }
            (Kind::Path(path), InitialKind::Path(motion)) => path.restore_motion(*motion),
            _ => {}
        }
        forget_run(kind);
    }
}

/// Forgets what was measured, and what has no meaning beyond the run.
fn forget_run(kind: &mut Kind) {
    match kind {
        Kind::Joint(joint) => {
            (joint.velocity, joint.accel, joint.motion) = (0.0, 0.0, None);
            (joint.error, joint.force, joint.raw_force) = (None, None, None);
        }
        Kind::Shape(shape) => {
            shape.velocity = Velocity::default();
            (shape.force, shape.torque) = ([0.0; 3], [0.0; 3]);
        }
        Kind::ForceSensor(sensor) => {
            sensor.samples.clear();
            (sensor.raw, sensor.filtered, sensor.error) = (None, None, None);
            sensor.violations = 0;
        }
        Kind::VisionSensor(sensor) => sensor.reading = None,
        Kind::ProximitySensor(sensor) => sensor.reset(),
        _ => {}
    }
}

/// Puts a joint back. Switching a changed mode or way of control back has its usual side effects on the targets, and comes after
/// them as in the original.
fn restore_joint(joint: &mut Joint, initial: &Joint) {
    joint.position = initial.position;
    joint.spherical = initial.spherical;
    joint.target_position = initial.target_position;
    joint.target_velocity = initial.target_velocity;
    if joint.mode != initial.mode {
        joint.set_mode(initial.mode);
    }
    if joint.control != initial.control {
        joint.set_control(initial.control);
    }
    joint.velocity_profile = initial.velocity_profile;
    joint.position_profile = initial.position_profile;
    joint.motor_lock = initial.motor_lock;
    joint.target_force = initial.target_force;
    joint.spring = initial.spring;
    (joint.max_vel, joint.max_accel, joint.max_jerk) =
        (initial.max_vel, initial.max_accel, initial.max_jerk);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::object::dummy::Dummy;

    #[test]
    fn a_tree_turned_upside_down_comes_back() {
        let mut scene = Scene::new();
        let dummies: Vec<Handle> = (0..3)
            .map(|_| {
                scene
                    .add("d", Kind::Dummy(Dummy::new(0.01)))
                    .expect("there is room")
            })
            .collect();
        let [a, b, c] = dummies[..] else {
            unreachable!()
        };
        scene.set_parent(b, Some(a), true).unwrap();
        scene.set_parent(c, Some(b), true).unwrap();
        scene
            .set_world_pose(c, Pose::translation(1.0, 2.0, 3.0))
            .unwrap();
        scene.store_initial_state();
        scene.set_parent(c, None, true).unwrap();
        scene.set_parent(a, Some(c), true).unwrap();
        scene
            .set_world_pose(c, Pose::translation(0.0, 0.0, 9.0))
            .unwrap();
        scene.restore_initial_state();
        assert_eq!(scene.object(c).unwrap().parent(), Some(b));
        assert_eq!(scene.object(a).unwrap().parent(), None);
        assert_eq!(
            scene.world_pose(c).unwrap(),
            Pose::translation(1.0, 2.0, 3.0)
        );
    }
}
