//! `simVision.distort`: images of lenses, by a map of pixels.

use std::cell::RefCell;
use std::collections::BTreeMap;

use api_macro::api;

use super::images::{SensorArgument, of_sensor};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::Handle;
use scene::sensor::VisionSensor;

pub(super) const FUNCTIONS: &[ApiFn] = functions![distort];

/// The maps of a script, by sensor.
#[derive(Default)]
struct Maps(RefCell<BTreeMap<Handle, Map>>);

/// For each pixel the index of the one that is shown there, and how much longer its ray is.
struct Map {
    pixels: Vec<usize>,
    scalings: Option<Vec<f64>>,
}

/// Moves the pixels of a vision sensor's image, and its depths, as a lens does. The first call has the map, further ones need none.
///
/// @param visionSensorHandle the sensor
/// @param pixelMap for each pixel the index, from 0, of the one that is shown there
/// @param depthScalings of each pixel, factors of metres; nothing leaves the depths as they are
/// @return result 1
#[api("simVision.distort")]
fn distort(
    cx: &mut Cx,
    vision_sensor_handle: SensorArgument,
    pixel_map: Option<Vec<i64>>,
    depth_scalings: Option<Vec<f64>>,
) -> Result<i64> {
    let (handle, count) = of_sensor(cx, vision_sensor_handle, |sensor| Some(sensor.pixels()))
        .map_err(|_| refused("Invalid vision sensor handle."))?;
    if let Some(pixels) = pixel_map {
        initialize(
            cx,
            handle,
            Map::new(&pixels, depth_scalings, count).ok_or_else(invalid)?,
        );
    }
    let (image, depth) = {
        let maps = cx.script_state::<Maps>();
        let maps = maps.0.borrow();
        let map = maps
            .get(&handle)
            .ok_or_else(|| refused("Mapping was not yet initialized."))?;
        if map.pixels.len() != count {
            return Err(invalid());
        }
        let scene = cx.scene();
        let sensor = scene.object(handle)?.vision_sensor()?;
        (map.image(sensor), map.depth(sensor))
    };
    if let Some(depth) = depth {
        cx.set_vision_depth(handle, depth)?;
    }
    cx.set_vision_image(handle, image)?;
    Ok(1)
}

fn initialize(cx: &Cx, handle: Handle, map: Map) {
    let maps = cx.script_state::<Maps>();
    if maps.0.borrow_mut().insert(handle, map).is_some() {
        let warning = "Mapping was already initialized, constantly handing over mapping arguments will slow down operation.";
        cx.env().warn_once("simVision.distort", warning);
    }
}

impl Map {
    /// None unless there is an index of a pixel, and a factor if there are any, for each pixel.
    fn new(pixels: &[i64], mut scalings: Option<Vec<f64>>, count: usize) -> Option<Self> {
        let index = |pixel: &i64| usize::try_from(*pixel).ok().filter(|pixel| *pixel < count);
        let pixels: Vec<usize> = pixels
            .get(..count)?
            .iter()
            .map(index)
            .collect::<Option<_>>()?;
        if let Some(scalings) = &mut scalings {
            scalings.truncate(count);
            scalings.get(..count)?;
        }
        Some(Self { pixels, scalings })
    }

    fn image(&self, sensor: &VisionSensor) -> Vec<u8> {
        let image = sensor.image();
        let (colours, _) = image.as_chunks::<3>();
        self.pixels
            .iter()
            .flat_map(|pixel| colours.get(*pixel).copied().unwrap_or_default())
            .collect()
    }

    fn depth(&self, sensor: &VisionSensor) -> Option<Vec<f32>> {
        let (depth, [near, far]) = (sensor.depth(), sensor.view.clipping);
        let scaled = |(pixel, scaling): (&usize, &f64)| {
            let metres = (near
                + f64::from(depth.get(*pixel).copied().unwrap_or(1.0)) * (far - near))
                * scaling;
            ((metres - near) / (far - near)) as f32
        };
        let scalings = self.scalings.as_ref()?;
        Some(self.pixels.iter().zip(scalings).map(scaled).collect())
    }
}

fn invalid() -> ApiError {
    refused("Invalid argument(s).")
}

fn refused(why: &str) -> ApiError {
    ApiError::Other(why.into())
}
