//! Cameras and lights.

use std::f64::consts::FRAC_PI_4;

use serde_json::Value;

use super::{
    Camera, Extent, Light, LightKind, Reader, integer, item, list, numbers, refused, string,
};
use crate::error::Result;

impl Reader<'_, '_> {
    pub(super) fn camera(&self, index: usize) -> Result<Camera> {
        let camera = item(self.root, "cameras", index)?;
        let element = format!("camera {index}");
        let positive = |view: &Value, name: &str| {
            let number = view
                .get(name)
                .and_then(Value::as_f64)
                .filter(|x| x.is_finite() && *x > 0.0);
            number.ok_or_else(|| refused(&element, format!("{name} must be a positive number")))
        };
        let kind = string(camera, "type").unwrap_or("");
        let view = camera
            .get(kind)
            .ok_or_else(|| refused(&element, format!("no projection {kind:?}")))?;
        let (extent, aspect_ratio) = match kind {
            "perspective" => (
                Extent::Angle(positive(view, "yfov")?),
                positive(view, "aspectRatio").unwrap_or(1.0),
            ),
            "orthographic" => {
                let height = positive(view, "ymag")?;
                (
                    Extent::Height(2.0 * height),
                    positive(view, "xmag")? / height,
                )
            }
            _ => return Err(refused(&element, format!("unknown projection {kind:?}"))),
        };
        let near = view
            .get("znear")
            .and_then(Value::as_f64)
            .filter(|x| x.is_finite() && *x >= 0.0)
            .unwrap_or(0.0);
        // A perspective camera without an end sees everything.
        let far = positive(view, "zfar").unwrap_or(f64::MAX);
        Ok(Camera {
            extent,
            aspect_ratio,
            clipping: [near, far],
        })
    }

    /// The light of a node, if it has one.
    pub(super) fn light_of(&self, node: &Value, element: &str) -> Result<Option<Light>> {
        let Some(own) = extension(node) else {
            return Ok(None);
        };
        let Some(index) = integer(own, "light", element)? else {
            return Ok(None);
        };
        let all = extension(self.root).map_or(&[][..], |extension| list(extension, "lights"));
        let light = all
            .get(index)
            .ok_or_else(|| refused(element, format!("no light {index}")))?;
        let element = format!("light {index}");
        let color = numbers(light, "color", &element)?
            .unwrap_or([1.0; 3])
            .map(|x: f64| x.clamp(0.0, 1.0));
        let number = |value: &Value, name: &str| {
            value
                .get(name)
                .and_then(Value::as_f64)
                .filter(|x| x.is_finite() && *x >= 0.0)
        };
        let kind = match string(light, "type").unwrap_or("") {
            "point" => LightKind::Point,
            "directional" => LightKind::Directional,
            "spot" => LightKind::Spot(
                light
                    .get("spot")
                    .and_then(|spot| number(spot, "outerConeAngle"))
                    .unwrap_or(FRAC_PI_4),
            ),
            kind => return Err(refused(element, format!("unknown type {kind:?}"))),
        };
        Ok(Some(Light {
            kind,
            color,
            intensity: number(light, "intensity").unwrap_or(1.0),
        }))
    }
}

fn extension(value: &Value) -> Option<&Value> {
    value.get("extensions")?.get("KHR_lights_punctual")
}
