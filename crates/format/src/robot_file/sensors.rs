//! Sensors of a description.

use nalgebra::{UnitQuaternion, Vector3};
use robot_description::{Sensor, SensorKind};

use super::Import;
use scene::sensor::options::{ProximityOptions, VisionOptions};
use scene::sensor::volume::VolumeType;
use scene::sensor::{ProximitySensor, VisionSensor};
use scene::{Field, Kind, ObjectFlags, Pose, SceneResult};

/// The angle of a camera, whatever the file says (spec: import 1).
const CAMERA_ANGLE: f64 = std::f64::consts::FRAC_PI_3;
/// The cone that stands for a ray or a scanner: range and radius in metres, angle in radians.
const CONE: [f64; 3] = [0.48, 0.02, std::f64::consts::FRAC_PI_6];
/// For display, metres.
const SIZE: f64 = 0.01;

impl Import<'_> {
    /// Adds the sensors below the links that they are on.
    pub(super) fn add_sensors(&mut self) -> SceneResult<()> {
        for sensor in &self.robot.sensors {
            match &sensor.kind {
                SensorKind::Camera {
                    resolution, clip, ..
                } => self.add_sensor(sensor, camera(*resolution, *clip))?,
                SensorKind::Ray => self.add_sensor(sensor, cone())?,
                SensorKind::Other(kind) => {
                    self.message(format!(
                        "line {}: sensor '{}' of type '{kind}' is not imported",
                        sensor.line, sensor.name
                    ));
                }
            }
        }
        Ok(())
    }

    fn add_sensor(&mut self, sensor: &Sensor, kind: Kind) -> SceneResult<()> {
        let half_turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI);
        let pose = self.placed[sensor.link]
            * sensor.pose
            * Pose::from_parts(Default::default(), half_turn);
        let parent = self.nodes[sensor.link].carrier;
        let handle = self.add(&sensor.name, kind, pose, parent)?;
        self.scene.modify(handle, Field::ObjectProperty, |object| {
            object.object_property |= ObjectFlags::HIDE_FROM_MODEL_BOX;
        })
    }
}

fn camera(resolution: [u32; 2], [near, far]: [f64; 2]) -> Kind {
    let options = VisionOptions::EXPLICIT_HANDLING | VisionOptions::PERSPECTIVE;
    let near = near.max(1e-4);
    let floats = [
        near,
        far.max(near * 1.01),
        CAMERA_ANGLE,
        SIZE,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    ];
    Kind::VisionSensor(Box::new(VisionSensor::new(
        options,
        resolution.map(i64::from),
        Some(floats),
    )))
}

fn cone() -> Kind {
    let [range, radius, angle] = CONE;
    let floats = [
        0.0, range, 0.0, 0.0, 0.0, 0.0, 0.0, radius, 0.0, angle, 0.0, 0.0, SIZE, 0.0, 0.0,
    ];
    let sensor = ProximitySensor::new(
        VolumeType::Cone,
        ProximityOptions::empty(),
        ProximitySensor::INTEGERS,
        Some(floats),
    );
    Kind::ProximitySensor(Box::new(sensor))
}
