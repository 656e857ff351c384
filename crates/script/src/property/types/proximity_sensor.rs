//! Properties of proximity sensors and their volumes.

use geometry::Finite;

use super::Vector3;
use super::access::{Accessor, length, object_properties, pair, refused};
use scene::SceneResult;
use scene::sensor::volume::Volume;
use scene::sensor::{Detection, ProximitySensor};

pub(in crate::property) const PROXIMITY_SENSOR: &[Accessor] = object_properties! {
    "sensorPointSize": f64, |o| o.proximity_sensor()?.size,
        Appearance |o, size| o.proximity_sensor_mut()?.size = length(size)?;
    "frontFaceDetection": bool, |o| o.proximity_sensor()?.front_faces,
        Sensor |o, on| o.proximity_sensor_mut()?.front_faces = on;
    "backFaceDetection": bool, |o| o.proximity_sensor()?.back_faces,
        Sensor |o, on| o.proximity_sensor_mut()?.back_faces = on;
    "exactMode": bool, |o| o.proximity_sensor()?.exact, Sensor |o, on| o.proximity_sensor_mut()?.exact = on;
    "explicitHandling": bool, |o| o.proximity_sensor()?.explicit,
        Sensor |o, on| o.proximity_sensor_mut()?.explicit = on;
    "showVolume": bool, |o| o.proximity_sensor()?.show_volume,
        Appearance |o, on| o.proximity_sensor_mut()?.show_volume = on;
    "randomizedDetection": bool, |o| o.proximity_sensor()?.randomized;
    "sensorType": i64, |o| o.proximity_sensor()?.volume.volume_type.code();
    "detectedObjectHandle": i64, |o| detection(o.proximity_sensor()?).map_or(-1, |found| found.object.raw());
    "angleThreshold": f64, |o| o.proximity_sensor()?.angle_threshold,
        Sensor |o, angle| o.proximity_sensor_mut()?.angle_threshold = angle.finite().ok_or_else(refused)?.max(0.0);
    "detectedPoint": Vector3, |o| Vector3(detection(o.proximity_sensor()?).map_or([0.0; 3], |found| found.point));
    "detectedNormal": Vector3, |o| Vector3(detection(o.proximity_sensor()?).map_or([0.0; 3], |found| found.normal));
};

pub(in crate::property) const VOLUME: &[Accessor] = object_properties! {
    "closeThreshold": f64, |o| o.proximity_sensor()?.volume.close_threshold,
        Sensor |o, distance| o.proximity_sensor_mut()?.volume.close_threshold = distance.finite().ok_or_else(refused)?.max(0.0);
    "volume_offset": f64, |o| o.proximity_sensor()?.volume.offset,
        Sensor |o, offset| o.proximity_sensor_mut()?.volume.offset = offset.finite().ok_or_else(refused)?;
    "volume_range": f64, |o| o.proximity_sensor()?.volume.range,
        Sensor |o, range| o.proximity_sensor_mut()?.volume.range = length(range)?;
    "volume_xSize": Vec<f64>, |o| o.proximity_sensor()?.volume.x_size.to_vec(),
        Sensor |o, sizes| o.proximity_sensor_mut()?.volume.x_size = lengths(&sizes)?;
    "volume_ySize": Vec<f64>, |o| o.proximity_sensor()?.volume.y_size.to_vec(),
        Sensor |o, sizes| o.proximity_sensor_mut()?.volume.y_size = lengths(&sizes)?;
    "volume_radius": Vec<f64>, |o| o.proximity_sensor()?.volume.radius.to_vec(),
        Sensor |o, radii| o.proximity_sensor_mut()?.volume.radius = pair(&radii)?.map(|radius| radius.max(0.0));
    "volume_angle": Vec<f64>, |o| { let volume = &o.proximity_sensor()?.volume; vec![volume.angle, volume.inside_gap] },
        Sensor |o, angles| {
            let [angle, gap] = pair(&angles)?;
            let volume = &mut o.proximity_sensor_mut()?.volume;
            (volume.angle, volume.inside_gap) = (angle.max(0.0), gap.clamp(0.0, 1.0));
        };
    "volume_faces": Vec<i64>, |o| o.proximity_sensor()?.volume.faces.to_vec(),
        Sensor |o, faces| o.proximity_sensor_mut()?.volume.faces = counts(&faces, 3)?;
    "volume_subdivisions": Vec<i64>, |o| o.proximity_sensor()?.volume.subdivisions.to_vec(),
        Sensor |o, parts| o.proximity_sensor_mut()?.volume.subdivisions = counts(&parts, 1)?;
    "volume_edges": Vec<f64>, |o| flat(o.proximity_sensor()?.volume.edges());
    "volume_closeEdges": Vec<f64>, |o| flat(o.proximity_sensor()?.volume.close_edges());
};

type Edges = Vec<[[f64; 3]; 2]>;

fn detection(sensor: &ProximitySensor) -> Option<&Detection> {
    sensor.detection.as_ref()
}

fn flat(edges: Edges) -> Vec<f64> {
    edges.as_flattened().as_flattened().to_vec()
}

fn lengths(values: &[f64]) -> SceneResult<[f64; 2]> {
    Ok(pair(values)?.map(|value| value.max(Volume::MIN_SIZE)))
}

/// Near and far numbers of faces or parts, within what can be drawn.
fn counts(values: &[i64], least: i64) -> SceneResult<[i64; 2]> {
    let counts: &[i64; 2] = values.first_chunk().ok_or_else(refused)?;
    Ok(counts.map(|count| count.clamp(least, 512)))
}
