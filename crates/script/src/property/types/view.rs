//! Properties of cameras and vision sensors.

use geometry::Finite;

use super::access::{Accessor, length, object_properties, pair, placed_properties, refused};
use super::{Color, IntPair, Vector3};
use crate::binding::args::Bytes;
use scene::sensor::RenderMode;
use scene::{Handle, Kind, SceneResult};

/// Angles of view, rad.
const ANGLES: (f64, f64) = (0.001, 3.1);

pub(in crate::property) const VIEWABLE: &[Accessor] = object_properties! {
    "viewAngle": f64, |o| o.view()?.angle,
        Sensor |o, angle| o.view_mut()?.angle = angle.finite().ok_or_else(refused)?.clamp(ANGLES.0, ANGLES.1);
    "viewSize": f64, |o| o.view()?.ortho_size, Sensor |o, size| o.view_mut()?.ortho_size = length(size)?;
    "clippingPlanes": Vec<f64>, |o| o.view()?.clipping.to_vec(),
        Sensor |o, planes| o.view_mut()?.clipping = clipping(&planes)?;
    "perspective": bool, |o| o.view()?.perspective;
    "showFrustum": bool, |o| o.view()?.show_frustum, Appearance |o, on| o.view_mut()?.show_frustum = on;
    "frustumCornerNear": Vector3, |o| { let view = o.view()?; Vector3(view.frustum_corner(view.clipping[0])) };
    "frustumCornerFar": Vector3, |o| { let view = o.view()?; Vector3(view.frustum_corner(view.clipping[1])) };
    "resolution": IntPair, |o| IntPair(o.view()?.resolution.map(i64::from)),
        Sensor |o, resolution| match &mut o.kind {
            Kind::VisionSensor(sensor) => sensor.set_resolution(resolution.0),
            _ => o.view_mut()?.set_resolution(resolution.0),
        };
};

pub(in crate::property) const VISION_SENSOR: &[Accessor] = object_properties! {
    "sensorSize": f64, |o| o.vision_sensor()?.size, Appearance |o, size| o.vision_sensor_mut()?.size = length(size)?;
    "backgroundColor": Color, |o| Color::from_f32(o.vision_sensor()?.background),
        Sensor |o, colour| o.vision_sensor_mut()?.background = colour.to_f32();
    "renderMode": i64, |o| o.vision_sensor()?.render_mode.0,
        Sensor |o, mode| o.vision_sensor_mut()?.render_mode = RenderMode(mode);
    "backgroundColorFromEnvironment": bool, |o| o.vision_sensor()?.background_from_environment,
        Sensor |o, on| o.vision_sensor_mut()?.background_from_environment = on;
    "explicitHandling": bool, |o| o.vision_sensor()?.explicit, Sensor |o, on| o.vision_sensor_mut()?.explicit = on;
    "useExtImage": bool, |o| o.vision_sensor()?.external_image,
        Sensor |o, on| o.vision_sensor_mut()?.external_image = on;
    "ignoreImageInfo": bool, |o| o.vision_sensor()?.ignore_image,
        Sensor |o, on| o.vision_sensor_mut()?.ignore_image = on;
    "ignoreDepthInfo": bool, |o| o.vision_sensor()?.ignore_depth,
        Sensor |o, on| o.vision_sensor_mut()?.ignore_depth = on;
    "omitPacket1": bool, |o| o.vision_sensor()?.omit_statistics,
        Sensor |o, on| o.vision_sensor_mut()?.omit_statistics = on;
    "imageBuffer": Bytes, |o| Bytes(o.vision_sensor()?.image().into_owned()), Sensor |o, image| {
        let sensor = o.vision_sensor_mut()?;
        if !image.0.is_empty() && image.0.len() != sensor.image_len() {
            return Err(refused());
        }
        sensor.image = image.0;
    };
    "depthBuffer": Vec<f64>, |o| o.vision_sensor()?.depth().iter().map(|&depth| depth.into()).collect();
};

pub(in crate::property) const CAMERA: &[Accessor] = object_properties! {
    "cameraSize": f64, |o| o.camera()?.size, Appearance |o, size| o.camera_mut()?.size = length(size)?;
};

pub(in crate::property) const TRACKED: &[Accessor] = placed_properties! {
    "trackedObjectHandle": i64, |s, h| s.object(h)?.camera()?.tracked.map_or(-1, Handle::raw),
        |s, h, tracked| s.track(h, tracked)?;
};

/// Near and far plane, the far one behind the near one.
fn clipping(planes: &[f64]) -> SceneResult<[f64; 2]> {
    let [near, far] = pair(planes)?;
    let near = length(near)?;
    Ok([near, far.max(near + 1e-4)])
}
