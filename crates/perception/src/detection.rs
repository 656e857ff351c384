//! Detection by a proximity sensor (spec: sensors 1.1, 1.2).
//!
//! Objects are looked at by ascending distance of the boxes around them, and each point found shortens the reach for the others. Points
//! and normals are in the frame of the sensor, distances are from its origin.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::rc::Rc;

use nalgebra::{Translation3, Vector3};
use proximity::{Filter, Hit, cast_ray};

use super::Perception;
use super::entity::{Group, Purpose};
use super::index::{Body, Index};
use super::volume::SearchVolume;
use scene::sensor::volume::{Volume, VolumeType};
use scene::sensor::{Detection, ProximitySensor};
use scene::{Handle, Pose, Scene, SceneResult};

/// How a sensor looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DetectionMode {
    /// Which surfaces count.
    pub filter: Filter,
    /// Nothing farther away is detected, metres.
    pub reach: f64,
}

impl DetectionMode {
    /// As the sensor is set.
    pub fn of(sensor: &ProximitySensor) -> Self {
        let filter = Filter {
            front: sensor.front_faces,
            back: sensor.back_faces,
            max_angle: (sensor.angle_threshold > 0.0).then_some(sensor.angle_threshold),
            any: !sensor.exact,
        };
        Self {
            filter,
            reach: f64::INFINITY,
        }
    }

    /// As the options of `sim.checkProximitySensor` say: 1 front faces, 2 back faces, 4 fast, 8 limited angle (rad).
    pub fn from_options(options: i64, max_angle: f64) -> Self {
        let filter = Filter {
            front: options & 3 != 2,
            back: options & 2 != 0,
            max_angle: (options & 8 != 0).then(|| max_angle.clamp(0.0, FRAC_PI_2)),
            any: options & 4 != 0,
        };
        Self {
            filter,
            reach: f64::INFINITY,
        }
    }

    /// The same up to a distance (m); 0 for no limit.
    pub fn within(self, threshold: f64) -> Self {
        Self {
            reach: if threshold > 0.0 {
                threshold
            } else {
                self.reach
            },
            ..self
        }
    }
}

/// A detected point, and the distance that was measured: of randomised sensors the mean, which is not that of the point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Detected {
    /// The point, its object and its normal.
    pub detection: Detection,
    /// Distance from the sensor, metres.
    pub distance: f64,
}

/// Where a sensor is, and what it looks for.
struct SensorQuery<'a> {
    scene: &'a Scene,
    group: &'a Group,
    pose: Pose,
    mode: DetectionMode,
    /// If there is something nearer, nothing is detected.
    forbidden: f64,
}

/// The result of a search: what is nearest, or that something is too near.
#[derive(Default)]
struct Search {
    nearest: Option<Detected>,
    too_near: bool,
}

impl Perception {
    /// Detects an entity with a sensor.
    ///
    /// # Errors
    /// When there is no such sensor.
    pub fn detect(
        &mut self,
        scene: &Scene,
        sensor: Handle,
        group: &Group,
        mode: DetectionMode,
    ) -> SceneResult<Option<Detected>> {
        let data = scene.object(sensor)?.proximity_sensor()?;
        let pose = scene.world_pose(sensor)?;
        let query = SensorQuery {
            scene,
            group,
            pose,
            mode,
            forbidden: data.volume.close_threshold,
        };
        let search = match data.volume.volume_type {
            VolumeType::Ray if data.randomized => {
                let rays = self.random_rays(data);
                query.with_random_rays(self.index(scene), &rays, data)
            }
            VolumeType::Ray => query.along_ray(self.index(scene), &data.volume),
            _ => {
                let volume = self.search_volume(scene, sensor, &data.volume);
                query.in_volume(self.index(scene), &volume)
            }
        };
        Ok(search.nearest.filter(|_| !search.too_near))
    }

    pub(super) fn search_volume(
        &mut self,
        scene: &Scene,
        sensor: Handle,
        volume: &Volume,
    ) -> Rc<SearchVolume> {
        if let Some(known) = self
            .volumes
            .get(&sensor)
            .filter(|known| known.source == *volume)
        {
            return Rc::clone(known);
        }
        self.volumes.retain(|&handle, _| {
            scene
                .object(handle)
                .is_ok_and(|object| object.proximity_sensor().is_ok())
        });
        let new = Rc::new(SearchVolume::new(volume));
        self.volumes.insert(sensor, Rc::clone(&new));
        new
    }

    /// Directions within the opening angle, equally likely.
    fn random_rays(&mut self, sensor: &ProximitySensor) -> Vec<[f64; 3]> {
        const MAX_RAYS: i64 = 10_000;
        let lowest = libm::cos((0.5 * sensor.volume.angle).clamp(0.0, std::f64::consts::PI));
        let ray = |_| {
            let z = 1.0 - self.random() * (1.0 - lowest);
            let (sin, cos) = libm::sincos(TAU * self.random());
            let across = (1.0 - z * z).max(0.0).sqrt();
            [across * cos, across * sin, z]
        };
        (0..sensor.samples.clamp(1, MAX_RAYS)).map(ray).collect()
    }
}

/// The stretch of a ray that counts.
pub(super) fn range(volume: &Volume, reach: f64) -> [f64; 2] {
    [volume.offset, (volume.offset + volume.range).min(reach)]
}

impl SensorQuery<'_> {
    fn purpose(&self) -> (&Scene, Purpose) {
        (self.scene, Purpose::Detection)
    }

    fn along_ray(&self, index: &Index, volume: &Volume) -> Search {
        let range = range(volume, self.mode.reach);
        let ray = (
            self.pose.translation.vector.into(),
            (self.pose.rotation * Vector3::z()).into(),
        );
        let mut search = Search::default();
        index.along_ray(
            self.group,
            self.purpose(),
            ray,
            range,
            |handle, body, to| {
                for (part, _) in body.parts() {
                    let to = search.nearest.map_or(to, |nearest| nearest.distance);
                    let hit = cast_ray(
                        part,
                        &self.pose,
                        [0.0, 0.0, 1.0],
                        [range[0], to],
                        &self.mode.filter,
                    );
                    if let Some(hit) = hit {
                        search.offer(handle, hit);
                    }
                }
                search.nearest.map_or(to, |nearest| nearest.distance)
            },
        );
        search.too_near = search
            .nearest
            .is_some_and(|nearest| nearest.distance < self.forbidden)
            || self.mode.filter.any && self.is_near_on_ray(index, ray, range);
        search
    }

    /// Whether there is something on the ray that is too near.
    fn is_near_on_ray(&self, index: &Index, ray: ([f64; 3], [f64; 3]), range: [f64; 2]) -> bool {
        let range = [range[0], range[1].min(self.forbidden)];
        let mut found = false;
        index.along_ray(self.group, self.purpose(), ray, range, |_, body, to| {
            let cast = |part| cast_ray(part, &self.pose, [0.0, 0.0, 1.0], range, &self.mode.filter);
            found |= body
                .parts()
                .filter_map(|(part, _)| cast(part))
                .any(|hit| hit.distance < self.forbidden);
            if found { f64::NEG_INFINITY } else { to }
        });
        found
    }

    fn in_volume(&self, index: &Index, volume: &SearchVolume) -> Search {
        let (origin, region) = (
            self.pose.translation.vector.into(),
            volume.bounds.transformed(&self.pose),
        );
        let bound = |bounds: &proximity::Bounds| {
            if bounds.overlaps(&region) {
                bounds.distance_to_point(&origin)
            } else {
                f64::INFINITY
            }
        };
        let mut search = Search::default();
        index.nearest_first(
            self.group,
            self.purpose(),
            bound,
            self.mode.reach,
            |handle, body, limit| {
                let mut limit = limit;
                search.too_near |= self.is_too_near(body, volume);
                for (part, bounds) in body.parts() {
                    if search.too_near || bound(bounds) >= limit {
                        continue;
                    }
                    if let Some(hit) = volume.closest(part, &self.pose, limit, &self.mode.filter) {
                        (search.nearest, limit) = (Some(detected(handle, hit)), hit.distance);
                    }
                }
                if search.too_near {
                    f64::NEG_INFINITY
                } else {
                    limit
                }
            },
        );
        search
    }

    /// Whether a body reaches into the forbidden part of the volume: dummies with a distance that equals the limit too.
    fn is_too_near(&self, body: &Body, volume: &SearchVolume) -> bool {
        if self.forbidden <= 0.0 {
            return false;
        }
        let below = if body.is_point() {
            self.forbidden.next_up()
        } else {
            self.forbidden
        };
        let filter = Filter {
            any: true,
            ..self.mode.filter
        };
        body.parts()
            .any(|(part, _)| volume.closest(part, &self.pose, below, &filter).is_some())
    }

    /// Rays from the point at the offset, within the radii. Each object that enough of them meet is detected at the mean.
    fn with_random_rays(
        &self,
        index: &Index,
        rays: &[[f64; 3]],
        sensor: &ProximitySensor,
    ) -> Search {
        let Volume {
            offset,
            radius,
            range,
            ..
        } = sensor.volume;
        let eye = self.pose * Translation3::new(0.0, 0.0, offset);
        let origin = self.pose.translation.vector.into();
        let reach = self.mode.reach.min(offset.abs() + radius[0] + range);
        let mut search = Search::default();
        let bound = |bounds: &proximity::Bounds| bounds.distance_to_point(&origin);
        index.nearest_first(
            self.group,
            self.purpose(),
            bound,
            reach.next_up(),
            |handle, body, limit| {
                let cast = |ray: &[f64; 3]| {
                    let cast = |part| {
                        cast_ray(
                            part,
                            &eye,
                            *ray,
                            [radius[0], radius[0] + range],
                            &self.mode.filter,
                        )
                    };
                    let hits = body.parts().filter_map(|(part, _)| cast(part));
                    let hit = hits.reduce(|a, b| if b.distance < a.distance { b } else { a })?;
                    Some(raised(hit, offset)).filter(|hit| hit.distance < limit)
                };
                let hits: Vec<Hit> = rays.iter().filter_map(cast).collect();
                search.too_near |= hits.iter().any(|hit| hit.distance < self.forbidden);
                if (hits.len() as i64) < sensor.required_samples {
                    return limit;
                }
                let mean = mean(&hits);
                search.nearest = Some(detected(handle, mean));
                mean.distance
            },
        );
        search
    }
}

impl Search {
    /// Keeps the nearer one; of two that are equally near the one whose object came first.
    fn offer(&mut self, object: Handle, hit: Hit) {
        let is_nearer = |nearest: Detected| {
            (hit.distance, object) < (nearest.distance, nearest.detection.object)
        };
        if self.nearest.is_none_or(is_nearer) {
            self.nearest = Some(detected(object, hit));
        }
    }
}

fn detected(object: Handle, hit: Hit) -> Detected {
    let [point, normal] = [hit.point, hit.normal].map(|numbers| numbers.map(unsigned));
    Detected {
        detection: Detection {
            object,
            point,
            normal,
        },
        distance: hit.distance,
    }
}

/// The same number; zero without a sign, which scripts would print.
fn unsigned(number: f64) -> f64 {
    number + 0.0
}

/// A hit seen from a frame whose origin is `offset` below along z.
fn raised(hit: Hit, offset: f64) -> Hit {
    let [x, y, z] = hit.point;
    let point = Vector3::new(x, y, z + offset);
    Hit {
        point: point.into(),
        distance: point.norm(),
        ..hit
    }
}

fn mean(hits: &[Hit]) -> Hit {
    let count = hits.len().max(1) as f64;
    let sum = |of: fn(&Hit) -> [f64; 3]| {
        hits.iter()
            .map(|hit| Vector3::from(of(hit)))
            .sum::<Vector3<f64>>()
    };
    let normal = sum(|hit| hit.normal).try_normalize(0.0).unwrap_or_default();
    Hit {
        point: (sum(|hit| hit.point) / count).into(),
        normal: normal.into(),
        distance: hits.iter().map(|hit| hit.distance).sum::<f64>() / count,
    }
}
