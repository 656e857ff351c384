//! Callbacks for pictures of vision sensors: `sysCall_vision` and `sysCall_trigger` (spec: sensors 3).

use std::rc::Rc;

use crate::host::{Script, Sim};
use crate::phases;
use crate::sys_call::SysCall;
use perception::vision::SensorPicture;
use scene::sensor::{Entity, VisionReading, VisionSensor};
use scene::{Data, Field, Handle, SceneResult};

impl Sim {
    /// Takes a picture with a sensor and lets its scripts look at it. Where the pictures come from scripts, these are the results of the
    /// last one.
    ///
    /// # Errors
    /// When `sensor` is no vision sensor.
    pub(crate) fn handle_vision_sensor(
        self: &Rc<Self>,
        sensor: Handle,
    ) -> SceneResult<VisionReading> {
        let external = {
            let scene = self.scene.borrow();
            let sensor = scene.object(sensor)?.vision_sensor()?;
            sensor
                .external_image
                .then(|| sensor.reading.clone().unwrap_or_default())
        };
        if let Some(reading) = external {
            return Ok(reading);
        }
        let reading = self.take_picture(sensor, None)?;
        self.scene
            .borrow_mut()
            .set_vision_reading(sensor, Some(reading.clone()));
        Ok(reading)
    }

    /// The same with an entity of the caller's choice; the sensor is as before afterwards. Returns the picture too, as the scripts left it.
    ///
    /// # Errors
    /// When `sensor` is no vision sensor.
    pub(crate) fn check_vision_sensor(
        self: &Rc<Self>,
        sensor: Handle,
        entity: Entity,
    ) -> SceneResult<(VisionReading, VisionSensor)> {
        let before = self.scene.borrow().object(sensor)?.vision_sensor()?.clone();
        let reading = self.take_picture(sensor, Some(entity))?;
        let mut scene = self.scene.borrow_mut();
        let Ok(seen) = scene
            .object(sensor)
            .and_then(|object| object.vision_sensor().cloned())
        else {
            // Its scripts have removed it: nothing was seen.
            return Ok((
                reading,
                VisionSensor {
                    image: Vec::new(),
                    depth: Vec::new(),
                    ..before
                },
            ));
        };
        scene.try_modify(sensor, Field::Measured, |object| {
            let sensor = object.vision_sensor_mut()?;
            if sensor.view.resolution == before.view.resolution {
                (sensor.image, sensor.depth) = (before.image, before.depth);
            }
            sensor.reading = before.reading;
            Ok(())
        })?;
        Ok((reading, seen))
    }

    fn take_picture(
        self: &Rc<Self>,
        sensor: Handle,
        entity: Option<Entity>,
    ) -> SceneResult<VisionReading> {
        let first = phases::sensors(|| {
            let picture = self.perception.borrow_mut().vision.sensor_picture(
                &self.scene.borrow(),
                sensor,
                entity,
            )?;
            self.show_picture(sensor, picture)
        })?;
        self.evaluate_picture(sensor, first)
    }

    /// Gives a picture to a sensor; returns its first packet.
    fn show_picture(&self, sensor: Handle, picture: SensorPicture) -> SceneResult<Vec<f32>> {
        let (mut image, mut depth) = (picture.image, picture.depth);
        let first = self
            .scene
            .borrow_mut()
            .try_modify(sensor, Field::Measured, |object| {
                let sensor = object.vision_sensor_mut()?;
                if let Some(image) = &mut image {
                    std::mem::swap(image, &mut sensor.image);
                }
                if let Some(depth) = &mut depth {
                    std::mem::swap(depth, &mut sensor.depth);
                }
                let handles =
                    |seen: Vec<Handle>| seen.into_iter().map(|handle| handle.0 as f32).collect();
                Ok(picture.seen.map_or_else(|| sensor.first_packet(), handles))
            })?;
        let (image, depth) = (image.unwrap_or_default(), depth.unwrap_or_default());
        self.perception.borrow_mut().vision.reuse(image, depth);
        Ok(first)
    }

    /// Evaluates a picture that was set by a script, unless the scripts of the sensor are doing so already. That a script found something is
    /// not kept: only pictures of the scene trigger.
    ///
    /// # Errors
    /// When `sensor` is no vision sensor.
    pub(crate) fn evaluate_set_picture(self: &Rc<Self>, sensor: Handle) -> SceneResult<()> {
        if self.scripts.examined_sensors.borrow().contains(&sensor) {
            return Ok(());
        }
        let packet = self
            .scene
            .borrow()
            .object(sensor)?
            .vision_sensor()?
            .first_packet();
        let reading = VisionReading {
            triggered: false,
            ..self.evaluate_picture(sensor, packet)?
        };
        self.scene
            .borrow_mut()
            .set_vision_reading(sensor, Some(reading));
        Ok(())
    }

    /// Runs the scripts of a sensor on its picture and returns all packets. `first`: the packet of the simulator.
    ///
    /// # Errors
    /// When `sensor` is no vision sensor.
    pub(crate) fn evaluate_picture(
        self: &Rc<Self>,
        sensor: Handle,
        first: Vec<f32>,
    ) -> SceneResult<VisionReading> {
        let mut reading = VisionReading {
            triggered: false,
            packets: vec![first],
        };
        if !self
            .scripts
            .may_respond_to_any(&[SysCall::Vision, SysCall::Trigger])
        {
            return Ok(reading);
        }
        let (scripts, picture) = (self.sensor_scripts(sensor), self.picture_data(sensor)?);
        if self.scripts.examined_sensors.borrow_mut().insert(sensor) {
            self.collect_findings(&scripts, &picture, &mut reading);
            self.scripts.examined_sensors.borrow_mut().remove(&sensor);
        }
        if reading.triggered {
            self.trigger_vision(&scripts, sensor, &mut reading);
        }
        Ok(reading)
    }

    fn collect_findings(
        self: &Rc<Self>,
        scripts: &[Rc<Script>],
        picture: &Data,
        reading: &mut VisionReading,
    ) {
        for script in scripts {
            let Some(found) = self
                .deliver(script, SysCall::Vision, std::slice::from_ref(picture))
                .value
            else {
                continue;
            };
            if let Some(&Data::Bool(triggered)) = found.field("trigger") {
                reading.triggered = triggered;
            }
            if let Some(Data::Array(packets)) = found.field("packedPackets") {
                reading.packets.extend(packets.iter().filter_map(unpack));
            }
        }
    }

    /// Notifies the scripts of what was found; they may decide otherwise.
    fn trigger_vision(
        self: &Rc<Self>,
        scripts: &[Rc<Script>],
        sensor: Handle,
        reading: &mut VisionReading,
    ) {
        let packets: Vec<Data> = reading.packets.iter().map(|packet| pack(packet)).collect();
        let data = Data::map([
            ("handle", sensor.raw().into()),
            ("visionSensor", sensor.raw().into()),
            ("packedPackets", packets.into()),
        ]);
        for script in scripts {
            let answer = self
                .deliver(script, SysCall::Trigger, std::slice::from_ref(&data))
                .value;
            if let Some(&Data::Bool(triggered)) =
                answer.as_ref().and_then(|answer| answer.field("trigger"))
            {
                reading.triggered = triggered;
            }
        }
    }

    /// The argument of `sysCall_vision`.
    fn picture_data(&self, sensor: Handle) -> SceneResult<Data> {
        let scene = self.scene.borrow();
        let view = &scene.object(sensor)?.vision_sensor()?.view;
        Ok(Data::map([
            ("handle", sensor.raw().into()),
            ("visionSensor", sensor.raw().into()),
            ("resolution", view.resolution.map(i64::from).into()),
            ("clippingPlanes", view.clipping.into()),
            ("viewAngle", view.angle.into()),
            ("orthoSize", view.ortho_size.into()),
            ("perspectiveOperation", view.perspective.into()),
        ]))
    }
}

/// A packet of numbers as scripts exchange it: 32-bit floats in a buffer.
fn pack(packet: &[f32]) -> Data {
    Data::Buffer(
        packet
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect(),
    )
}

/// The numbers in a string or buffer of 32-bit floats; None for other values. Zeros fill the last number up: colours come as bytes, and those
/// of the last point must not get lost.
fn unpack(packet: &Data) -> Option<Vec<f32>> {
    let (Data::Text(bytes) | Data::Buffer(bytes)) = packet else {
        return None;
    };
    let numbers = bytes.chunks(4).map(|chunk| {
        let mut bytes = [0; 4];
        bytes[..chunk.len()].copy_from_slice(chunk);
        f32::from_le_bytes(bytes)
    });
    Some(numbers.collect())
}
