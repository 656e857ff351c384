//! `sim.*`: banners, which are not shown, and cameras that look at objects.

use std::cell::RefCell;
use std::collections::BTreeSet;

use api_macro::api;
use nalgebra::{Point3, Vector3};

use crate::{ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::{Data, Handle, Pose, Scene, SceneError, flag, special};
use script::{Number, Rest};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![add_banner, remove_banner, camera_fit_to_view];

/// Added to a handle: it is a camera, not the number of a view.
const IS_CAMERA: i64 = 0x0040_0000;
/// Radius of what is shown where nothing has an extent, metres.
const MIN_RADIUS: f64 = 0.001;

/// The banners that were added.
#[derive(Default)]
struct Banners(RefCell<BTreeSet<i64>>);

/// Adds a banner, which is not shown.
///
/// @param text on it
/// @param size of the letters
/// @param options bits
/// @return bannerID the smallest free number from 1
#[api("sim.addBanner")]
fn add_banner(
    cx: &mut Cx,
    text: String,
    size: f64,
    options: Number,
    #[name("...")] further: Rest,
) -> Result<i64> {
    let _ = (text, size, options, further);
    let state = cx.module_state::<Banners>();
    let mut banners = state.0.borrow_mut();
    let free = (1..).find(|id| !banners.contains(id)).unwrap_or(1);
    banners.insert(free);
    Ok(free)
}

/// Removes a banner.
///
/// @param bannerID from sim.addBanner, or sim.handle_all
/// @return result 1
#[api("sim.removeBanner")]
fn remove_banner(cx: &mut Cx, #[name("bannerID")] banner_id: Number) -> Result<i64> {
    let state = cx.module_state::<Banners>();
    let mut banners = state.0.borrow_mut();
    let is_silent = banner_id.0 & flag::SILENT_ERROR != 0;
    if banner_id.0 == special::ALL {
        banners.clear();
    } else if !banners.remove(&(banner_id.0 & !flag::SILENT_ERROR)) && !is_silent {
        return Err(SceneError::NoSuchObject.into());
    }
    Ok(1)
}

/// Moves a camera along its line of sight, and sideways, until it shows objects.
///
/// @param viewHandleOrIndex a camera with 0x00400000 added; the number of a view has no camera here
/// @param objectHandles what is shown; nil: all objects
/// @param options ignored
/// @param scaling how much of the picture they fill
/// @return result 1; 0 for a view without a camera
#[api("sim.cameraFitToView")]
fn camera_fit_to_view(
    cx: &mut Cx,
    view_handle_or_index: Number,
    #[default(Data::Nil)] object_handles: Data,
    #[default(0)] options: Number,
    #[default(1.0)] scaling: f64,
) -> Result<i64> {
    let _ = options;
    if view_handle_or_index.0 & IS_CAMERA == 0 {
        return Ok(0);
    }
    let camera =
        Handle::from_raw(view_handle_or_index.0 & !IS_CAMERA).ok_or(SceneError::NoSuchObject)?;
    let pose = {
        let scene = cx.scene();
        let view = scene.object(camera)?.camera()?.view.clone();
        let (centre, radius) = ball_around(&scene, &shown(&scene, camera, &object_handles)?)?;
        let scaling = if scaling.is_finite() && scaling > 0.0 {
            scaling
        } else {
            1.0
        };
        let distance = radius / scaling / libm::sin(0.5 * view.angle.clamp(0.01, 3.0));
        let rotation = scene.world_pose(camera)?.rotation;
        Pose::from_parts(
            (centre.coords - rotation * Vector3::z() * distance).into(),
            rotation,
        )
    };
    cx.scene_mut().set_world_pose(camera, pose)?;
    Ok(1)
}

fn shown(scene: &Scene, camera: Handle, handles: &Data) -> Result<Vec<Handle>> {
    let all = || {
        scene
            .objects()
            .map(scene::Object::handle)
            .filter(|handle| *handle != camera)
            .collect()
    };
    let Data::Array(list) = handles else {
        return Ok(all());
    };
    let one = |value: &Data| {
        let raw = value
            .as_f64()
            .map(numbers::truncated)
            .and_then(Handle::from_raw);
        Ok(scene.object(raw.ok_or(SceneError::NoSuchObject)?)?.handle())
    };
    let listed = list.iter().map(one).collect::<Result<Vec<_>>>()?;
    Ok(if listed.is_empty() { all() } else { listed })
}

/// A ball around the bounding boxes of objects.
fn ball_around(scene: &Scene, objects: &[Handle]) -> Result<(Point3<f64>, f64)> {
    let mut bounds: Option<(Point3<f64>, Point3<f64>)> = None;
    for &handle in objects {
        let bounding_box = scene.object(handle)?.bounding_box();
        let pose = scene.world_pose(handle)? * bounding_box.pose;
        let half = Vector3::from(bounding_box.size) / 2.0;
        for corner in 0..8 {
            let sign = |axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
            let point =
                pose * Point3::from(half.component_mul(&Vector3::new(sign(0), sign(1), sign(2))));
            bounds = Some(bounds.map_or((point, point), |(low, high)| {
                (low.inf(&point), high.sup(&point))
            }));
        }
    }
    let Some((low, high)) = bounds else {
        return Ok((Point3::origin(), 1.0));
    };
    Ok((
        nalgebra::center(&low, &high),
        (nalgebra::distance(&low, &high) / 2.0).max(MIN_RADIUS),
    ))
}
