//! `simVision.*`: laser scanners that turn, made of four vision sensors. Both models are the same. Points are not displayed.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
use std::rc::Rc;

use api_macro::api;
use nalgebra::Point3;

use super::checked::Checked;
use super::composed::{Part, parts, refused};
use super::detection::packet;
use super::images::invalid_handle;
use super::velodyne_cloud::TargetCloud;
use crate::{ApiFn, Cx, Result, functions};
use scene::sensor::VisionReading;
use scene::{Data, Handle, Pose, SceneError};
use script::{Number, Results};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_velodyne_vpl16,
    handle_velodyne_vpl16,
    destroy_velodyne_vpl16,
    create_velodyne_hdl64_e,
    handle_velodyne_hdl64_e,
    destroy_velodyne_hdl64_e,
];

/// `sim.handleflag_codedstring` and `sim.handleflag_abscoords`.
const AS_BUFFER: i64 = 0x40_0000;
const IN_WORLD: i64 = 0x80_0000;
const FLAGS: i64 = AS_BUFFER | IN_WORLD;
/// Options: the point cloud holds the points of the last call only; results are angles and distance.
const CURRENT_ONLY: i64 = 2;
const POLAR: i64 = 4;
/// The part of the range within which points count.
const RANGE: f64 = 0.99;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Model {
    Vpl16,
    Hdl64e,
}

/// How many scanners of each model there were.
#[derive(Default)]
struct Counts([Cell<i64>; 2]);

/// The scanners of a script.
#[derive(Default)]
struct Scanners(RefCell<BTreeMap<(Model, i64), Scanner>>);

/// A scanner.
#[derive(Clone)]
struct Scanner {
    /// Front, left, back, right.
    sensors: [Handle; 4],
    /// Turns per second.
    frequency: f64,
    is_polar: bool,
    cloud: Option<TargetCloud>,
    /// Where it has turned to, rad; 0 is ahead, and it turns to the left.
    angle: f64,
}

/// An arc, from an angle on, rad.
#[derive(Clone, Copy)]
struct Sweep {
    from: f64,
    length: f64,
}

impl Sweep {
    fn contains(self, angle: f64) -> bool {
        (angle - self.from).rem_euclid(TAU) < self.length || self.length >= TAU
    }

    /// Whether some of the quarter around an angle is within.
    fn touches(self, middle: f64) -> bool {
        let begin = middle - FRAC_PI_4;
        self.length > 0.0
            && (self.contains(begin) || (self.from - begin).rem_euclid(TAU) < FRAC_PI_2)
    }
}

/// Points measured by a scanner.
#[derive(Default)]
pub(super) struct Points {
    /// x, y and z of each, or angles and distance.
    coordinates: Vec<f64>,
    /// Each in the frame of the front sensor, metres.
    pub(super) places: Vec<[f64; 3]>,
    /// Red, green and blue of each, when all sensors deliver them.
    pub(super) colours: Vec<u8>,
    is_coloured: bool,
}

fn create(
    cx: &Cx,
    model: Model,
    sensors: &[i64],
    frequency: f64,
    options: i64,
    point_cloud: i64,
) -> Result<i64> {
    let cloud = target_cloud(cx, point_cloud, options)?;
    let sensors: [Part; 4] = parts(cx, sensors, 1)?;
    if !sensors.iter().all(|sensor| sensor.is_explicit) {
        return Err(refused("Vision sensors should be explicitely handled."));
    }
    let counts: Rc<Counts> = cx.module_state();
    let number = counts.0[model as usize].replace(counts.0[model as usize].get() + 1);
    let sensors = sensors.map(|sensor| sensor.handle);
    let scanner = Scanner {
        sensors,
        frequency,
        is_polar: options & POLAR != 0,
        cloud,
        angle: -PI,
    };
    cx.script_state::<Scanners>()
        .0
        .borrow_mut()
        .insert((model, number), scanner);
    Ok(number)
}

/// The point cloud with a handle, none for -1.
fn target_cloud(cx: &Cx, raw: i64, options: i64) -> Result<Option<TargetCloud>> {
    if raw == -1 {
        return Ok(None);
    }
    let handle = Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?;
    cx.scene().object(handle)?.point_cloud()?;
    let is_current_only = options & CURRENT_ONLY != 0;
    Ok(Some(TargetCloud {
        handle,
        is_current_only,
    }))
}

fn destroy(cx: &Cx, model: Model, handle: i64) -> Result<i64> {
    let scanners = cx.script_state::<Scanners>();
    let removed = scanners.0.borrow_mut().remove(&(model, handle));
    removed.map(|_| 1).ok_or_else(invalid_handle)
}

fn handle(cx: &mut Cx, model: Model, flagged: i64, dt: f64) -> Result<Results> {
    let key = (model, flagged & !FLAGS);
    let scanners = cx.script_state::<Scanners>();
    let scanner = scanners
        .0
        .borrow()
        .get(&key)
        .cloned()
        .ok_or_else(invalid_handle)?;
    let turns = scanner.frequency * dt;
    let sweep = Sweep {
        from: scanner.angle,
        length: if turns > 0.0 {
            (turns * TAU).min(TAU)
        } else {
            0.0
        },
    };
    let turned = (sweep.from + sweep.length + PI).rem_euclid(TAU) - PI;
    scanners
        .0
        .borrow_mut()
        .entry(key)
        .and_modify(|scanner| scanner.angle = turned);
    let Some(points) = scan(cx, &scanner, sweep, flagged & IN_WORLD != 0)? else {
        return Ok(Results(Vec::new()));
    };
    if let Some(cloud) = scanner.cloud {
        let front = cx.scene().world_pose(scanner.sensors[0])?;
        cloud.fill(cx, &front, &points)?;
    }
    let coordinates = match flagged & AS_BUFFER {
        0 => points.coordinates.into(),
        _ => Data::Buffer(packet(points.coordinates).0),
    };
    let colours = points.is_coloured.then_some(Data::Buffer(points.colours));
    Ok(Results(
        std::iter::once(coordinates).chain(colours).collect(),
    ))
}

/// The points within a sweep; None when a sensor delivers none.
fn scan(cx: &mut Cx, scanner: &Scanner, sweep: Sweep, in_world: bool) -> Result<Option<Points>> {
    const MIDDLES: [f64; 4] = [0.0, FRAC_PI_2, PI, -FRAC_PI_2];
    let mut points = Points {
        is_coloured: true,
        ..Points::default()
    };
    for (sensor, middle) in scanner.sensors.into_iter().zip(MIDDLES) {
        if !sweep.touches(middle) {
            continue;
        }
        let reading = cx.handle_vision_sensor(sensor)?;
        let scene = cx.scene();
        let front = scene.world_pose(scanner.sensors[0])?;
        let frames = Frames {
            to_front: front.inverse() * scene.world_pose(sensor)?,
            to_result: if in_world { front } else { Pose::identity() },
            range: RANGE * scene.object(sensor)?.vision_sensor()?.view.clipping[1],
            is_polar: scanner.is_polar,
        };
        if !points.add(&reading, &frames, sweep) {
            return Ok(None);
        }
    }
    points.is_coloured &= !points.colours.is_empty();
    Ok(Some(points))
}

/// How the points of a sensor become results.
struct Frames {
    to_front: Pose,
    to_result: Pose,
    range: f64,
    is_polar: bool,
}

impl Points {
    /// Adds the points of a sensor; false when its scripts delivered none.
    fn add(&mut self, reading: &VisionReading, frames: &Frames, sweep: Sweep) -> bool {
        let Some(packet) = reading.packets.get(1).filter(|packet| packet.len() >= 2) else {
            return false;
        };
        let colours: Option<Vec<u8>> = reading.packets.get(2).map(|packet| {
            packet
                .iter()
                .flat_map(|value| value.to_le_bytes())
                .collect()
        });
        self.is_coloured &= colours.is_some();
        for (n, point) in packet[2..].as_chunks::<4>().0.iter().enumerate() {
            let [x, y, z, _] = point.map(f64::from);
            let place = frames.to_front * Point3::new(x, y, z);
            let angle = libm::atan2(place.x, place.z);
            let distance = place.coords.norm();
            let is_seen = distance < frames.range && sweep.contains(angle);
            if !is_seen {
                continue;
            }
            self.places.push(place.into());
            self.coordinates.extend(match frames.is_polar {
                true => [angle, FRAC_PI_2 - libm::asin(place.y / distance), distance],
                false => (frames.to_result * place).into(),
            });
            let colour = colours
                .as_ref()
                .and_then(|colours| colours.as_chunks::<3>().0.get(n));
            self.colours.extend(colour.copied().unwrap_or_default());
        }
        true
    }
}

macro_rules! scanner {
    ($model:expr, $create:literal $create_name:ident, $handle:literal $handle_name:ident, $destroy:literal $destroy_name:ident) => {
        /// Creates a laser scanner of four vision sensors, whose scripts return the packets of simVision.velodyneDataFromWorkImg. Points
        /// are not displayed.
        ///
        /// @param visionSensorHandles front, left, back, right; they are handled explicitly
        /// @param frequency turns per second
        /// @param options 2: the point cloud holds the points of the last call only, 4: results are angles and distance; others are of the display
        /// @param pointSize without effect
        /// @param coloring_closeFarDist without effect
        /// @param displayScalingFactor without effect
        /// @param pointCloud a point cloud that takes the points, or -1
        /// @return velodyneHandle
        #[api($create)]
        #[expect(clippy::too_many_arguments, reason = "the reference has them")]
        fn $create_name(
            cx: &Cx,
            vision_sensor_handles: Checked<Vec<i64>>,
            frequency: Checked<f64>,
            #[default(0)] options: Number,
            #[default(2)] point_size: Number,
            #[default([1.0, 5.0])]
            #[name("coloring_closeFarDist")]
            coloring_close_far_dist: [f64; 2],
            #[default(1.0)] display_scaling_factor: f64,
            #[default(-1)] point_cloud: Number,
        ) -> Result<i64> {
            let _ = (point_size, coloring_close_far_dist, display_scaling_factor);
            create(
                cx,
                $model,
                &vision_sensor_handles.0,
                frequency.0,
                options.0,
                point_cloud.0,
            )
        }

        /// Turns a laser scanner and returns the points it sees meanwhile, in the frame of its front sensor; nothing at all when a sensor
        /// delivers no packet.
        ///
        /// @param velodyneHandle the scanner; with sim.handleflag_codedstring points are 32-bit floats, with sim.handleflag_abscoords in the frame of the world
        /// @param dt seconds
        /// @return points, colorData coordinates of the points; their red, green and blue as bytes, if the sensors deliver colours
        #[api($handle)]
        fn $handle_name(
            cx: &mut Cx,
            velodyne_handle: Checked<Number>,
            dt: Checked<f64>,
        ) -> Result<Results> {
            handle(cx, $model, velodyne_handle.0.0, dt.0)
        }

        /// Removes a laser scanner.
        ///
        /// @param velodyneHandle the scanner
        /// @return result 1
        #[api($destroy)]
        fn $destroy_name(cx: &Cx, velodyne_handle: Checked<Number>) -> Result<i64> {
            destroy(cx, $model, velodyne_handle.0.0)
        }
    };
}

scanner!(
    Model::Vpl16,
    "simVision.createVelodyneVPL16" create_velodyne_vpl16,
    "simVision.handleVelodyneVPL16" handle_velodyne_vpl16,
    "simVision.destroyVelodyneVPL16" destroy_velodyne_vpl16
);
scanner!(
    Model::Hdl64e,
    "simVision.createVelodyneHDL64E" create_velodyne_hdl64_e,
    "simVision.handleVelodyneHDL64E" handle_velodyne_hdl64_e,
    "simVision.destroyVelodyneHDL64E" destroy_velodyne_hdl64_e
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_are_touched() {
        let sweep = Sweep {
            from: -PI,
            length: 0.1,
        };
        assert_eq!(
            [0.0, FRAC_PI_2, PI, -FRAC_PI_2].map(|middle| sweep.touches(middle)),
            [false, false, true, false]
        );
        let sweep = Sweep {
            from: -0.1,
            length: 1.0,
        };
        assert_eq!(
            [0.0, FRAC_PI_2, PI, -FRAC_PI_2].map(|middle| sweep.touches(middle)),
            [true, true, false, false]
        );
        let whole = Sweep {
            from: 1.0,
            length: TAU,
        };
        assert!(
            [0.0, FRAC_PI_2, PI, -FRAC_PI_2]
                .iter()
                .all(|middle| whole.touches(*middle))
        );
        assert!(
            !Sweep {
                from: 0.0,
                length: 0.0
            }
            .touches(0.0)
        );
    }

    #[test]
    fn points_are_kept_by_angle_and_range() {
        let point = |x: f32, z: f32| [x, 0.0, z, x.hypot(z)];
        let packet = [
            vec![2.0, 2.0],
            [point(0.0, 1.0), point(1.0, 1.0), point(0.0, 9.95)].concat(),
        ]
        .concat();
        let reading = VisionReading {
            triggered: false,
            packets: vec![Vec::new(), packet],
        };
        let frames = Frames {
            to_front: Pose::identity(),
            to_result: Pose::identity(),
            range: 9.9,
            is_polar: false,
        };
        let mut points = Points::default();
        assert!(points.add(
            &reading,
            &frames,
            Sweep {
                from: -0.1,
                length: 0.5
            }
        ));
        assert_eq!(points.coordinates, [0.0, 0.0, 1.0]);
        assert!(!points.add(
            &VisionReading::default(),
            &frames,
            Sweep {
                from: 0.0,
                length: TAU
            }
        ));
        let mut points = Points::default();
        let polar = Frames {
            is_polar: true,
            ..frames
        };
        assert!(points.add(
            &reading,
            &polar,
            Sweep {
                from: 0.5,
                length: 0.5
            }
        ));
        assert_eq!(points.coordinates, [FRAC_PI_4, FRAC_PI_2, 2f64.sqrt()]);
    }
}
