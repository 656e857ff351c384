//! Detection of points, segments and triangles that are not objects by a proximity sensor.

use nalgebra::Vector3;
use proximity::{Geometry, Hit, Placed, PointSet, TriangleMesh, cast_ray};

use super::Perception;
use super::detection::{DetectionMode, range};
use scene::sensor::volume::VolumeType;
use scene::{Handle, Pose, Scene, SceneError, SceneResult};

type Point = [f64; 3];

/// Points, segments or triangles in the frame of a sensor (m).
#[derive(Debug)]
pub enum Items {
    /// Items without extent or with numbers that are not finite are left out: nothing may be left.
    None,
    /// Points.
    Points(PointSet),
    /// Segments, by their two ends.
    Segments(Vec<[Point; 2]>),
    /// Triangles.
    Triangles(TriangleMesh),
}

impl Items {
    /// `count` items of a type (0 points, 1 segments, 2 triangles) from coordinates.
    ///
    /// # Errors
    /// When there is no such type, or there are not enough coordinates.
    pub fn new(coordinates: &[f64], item_type: i64, count: i64) -> SceneResult<Self> {
        let corners = usize::try_from(item_type)
            .ok()
            .filter(|corners| *corners < 3)
            .ok_or(SceneError::InvalidArgument)?
            + 1;
        let count = usize::try_from(count)
            .ok()
            .and_then(|count| count.checked_mul(corners));
        let points = coordinates.as_chunks::<3>().0;
        let points = count
            .and_then(|count| points.get(..count))
            .ok_or(SceneError::InvalidArgument)?;
        Ok(match corners {
            1 => PointSet::new(points).map_or(Self::None, Self::Points),
            2 => Self::Segments(points.as_chunks().0.to_vec()),
            _ => {
                let triangles: Vec<[u32; 3]> = (0..points.len() as u32 / 3)
                    .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
                    .collect();
                TriangleMesh::new(points, &triangles).map_or(Self::None, Self::Triangles)
            }
        })
    }
}

impl Perception {
    /// Detects items with a sensor. Rays see triangles only.
    ///
    /// # Errors
    /// When there is no such sensor.
    pub fn detect_items(
        &mut self,
        scene: &Scene,
        sensor: Handle,
        items: &Items,
        mode: DetectionMode,
    ) -> SceneResult<Option<Hit>> {
        let data = scene.object(sensor)?.proximity_sensor()?;
        let here = Pose::identity();
        let placed = |geometry| Placed {
            geometry,
            pose: here,
        };
        if data.volume.volume_type == VolumeType::Ray {
            let Items::Triangles(mesh) = items else {
                return Ok(None);
            };
            let range = range(&data.volume, mode.reach);
            return Ok(cast_ray(
                placed(Geometry::Mesh(mesh)),
                &here,
                [0.0, 0.0, 1.0],
                range,
                &mode.filter,
            ));
        }
        let volume = self.search_volume(scene, sensor, &data.volume);
        Ok(match items {
            Items::None => None,
            Items::Points(points) => volume.closest(
                placed(Geometry::Points(points)),
                &here,
                mode.reach,
                &mode.filter,
            ),
            Items::Triangles(mesh) => volume.closest(
                placed(Geometry::Mesh(mesh)),
                &here,
                mode.reach,
                &mode.filter,
            ),
            Items::Segments(segments) => {
                let nearest = segments
                    .iter()
                    .flat_map(|segment| volume.parts_of_segment(segment))
                    .map(nearest);
                let hits = nearest.filter(|hit| hit.distance < mode.reach);
                hits.reduce(|a, b| if b.distance < a.distance { b } else { a })
            }
        })
    }
}

/// The point of a segment that is nearest to the origin; its normal is its direction.
fn nearest([from, to]: [Point; 2]) -> Hit {
    let (from, to) = (Vector3::from(from), Vector3::from(to));
    let along = to - from;
    let length = along.norm_squared();
    let share = if length > 0.0 {
        (-from.dot(&along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let point = from + along * share;
    let normal = point.try_normalize(0.0).unwrap_or_default();
    Hit {
        point: point.into(),
        normal: normal.into(),
        distance: point.norm(),
    }
}
