//! Handling of proximity sensors: what they detect is stored, and scripts are called (spec: sensors 1.2).

use std::rc::Rc;

use crate::host::Sim;
use crate::phases;
use crate::sys_call::SysCall;
use perception::detection::{Detected, DetectionMode};
use perception::entity::{Entity, Group, Purpose};
use scene::sensor::Detection;
use scene::{Data, Handle, Scene, SceneError, SceneResult};

impl Sim {
    /// Handles one sensor, which must be tagged for that.
    ///
    /// # Errors
    /// When there is no such sensor, or it is not tagged for explicit handling.
    pub(crate) fn handle_proximity_sensor(
        self: &Rc<Self>,
        sensor: Handle,
    ) -> SceneResult<Option<Detection>> {
        if !self
            .scene
            .borrow()
            .object(sensor)?
            .proximity_sensor()?
            .explicit
        {
            return Err(SceneError::NotExplicit);
        }
        self.sense(sensor)
    }

    /// Handles all sensors, or those that are not tagged for explicit handling; returns the nearest detection.
    pub(crate) fn handle_proximity_sensors(
        self: &Rc<Self>,
        with_explicit: bool,
    ) -> Option<Detection> {
        if !self.scene.borrow().has_sensors() {
            return None;
        }
        let sensors = self.scene.borrow().proximity_sensors(with_explicit);
        // A script that is called may remove a sensor whose turn has not come.
        let detections = sensors
            .into_iter()
            .filter_map(|sensor| self.sense(sensor).ok().flatten());
        detections.reduce(|a, b| if b.distance() < a.distance() { b } else { a })
    }

    /// Detects, calls the scripts of the sensor, and stores the result.
    fn sense(self: &Rc<Self>, sensor: Handle) -> SceneResult<Option<Detection>> {
        let uid = self.scene.borrow().object(sensor)?.uid();
        let detected = phases::sensors(|| self.detect_as_set(sensor))?;
        let detected = detected.map(|detected| detected.detection);
        let detection = detected.filter(|detection| self.trigger(sensor, detection));
        let mut scene = self.scene.borrow_mut();
        // Scripts may have removed any object.
        let detection = detection.filter(|found| scene.exists(found.object));
        if scene.object(sensor).is_ok_and(|object| object.uid() == uid) {
            scene.set_detection(sensor, true, detection)?;
        }
        Ok(detection)
    }

    /// Detects the sensor's own entity. Here the flag of a single object counts, too.
    fn detect_as_set(&self, sensor: Handle) -> SceneResult<Option<Detected>> {
        let scene = self.scene.borrow();
        let data = scene.object(sensor)?.proximity_sensor()?;
        if !scene.settings().calculations.proximity_sensors {
            return Ok(None);
        }
        let group = match data.entity {
            scene::sensor::Entity::ALL => Entity::All.group(&scene, Purpose::Detection),
            entity => match Entity::named(&scene, entity.raw()) {
                Ok(entity) => with_flag(entity.group(&scene, Purpose::Detection), entity, &scene),
                Err(_) => return Ok(None),
            },
        };
        self.perception
            .borrow_mut()
            .detect(&scene, sensor, &group, DetectionMode::of(data))
    }

    /// Calls the scripts of a sensor in turn until one says whether this is a detection; without an answer it is.
    fn trigger(self: &Rc<Self>, sensor: Handle, detection: &Detection) -> bool {
        if !self.scripts.may_respond(SysCall::Trigger) {
            return true;
        }
        let data = trigger_data(sensor, detection);
        let ask = |script| {
            self.deliver(script, SysCall::Trigger, std::slice::from_ref(&data))
                .value
        };
        let scripts = self.scripts_of_object(sensor);
        let answer = scripts
            .iter()
            .find_map(|script| ask(script)?.field("trigger").cloned());
        answer.is_none_or(|trigger| trigger.truthy())
    }
}

fn with_flag(group: Group, entity: Entity, scene: &Scene) -> Group {
    match (group, entity) {
        (Group::List(mut list), Entity::Object(_)) => {
            list.retain(|&object| {
                scene
                    .object(object)
                    .is_ok_and(|o| Purpose::Detection.includes(scene, o))
            });
            Group::List(list)
        }
        (group, _) => group,
    }
}

/// The argument of `sysCall_trigger`, with the names of old versions too.
fn trigger_data(sensor: Handle, detection: &Detection) -> Data {
    let Detection {
        object,
        point,
        normal,
    } = *detection;
    Data::map([
        ("proximitySensor", sensor.raw().into()),
        ("object", object.raw().into()),
        ("point", point.into()),
        ("normal", normal.into()),
        ("handle", sensor.raw().into()),
        ("detectedObjectHandle", object.raw().into()),
        ("detectedPoint", point.into()),
        ("normalVector", normal.into()),
    ])
}
