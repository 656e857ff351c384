//! The work images of a script: one for each vision sensor, with two buffers.

use std::cell::RefCell;
use std::collections::BTreeMap;

use imaging::rgb::{BLACK, RgbImage};

use super::checked::Checked;
use crate::{ApiError, Cx, Result};
use scene::sensor::VisionSensor;
use scene::{Handle, special};
use script::Number;

/// A vision sensor as scripts pass it; sim.handle_self is the object of the calling script.
pub(super) type SensorArgument = Checked<Number>;

/// Work images of a script, by sensor. They are dropped with the script's state.
#[derive(Default)]
pub(super) struct WorkImages(RefCell<BTreeMap<Handle, ImageSet>>);

/// A work image and its buffers, which exist once something was put there.
pub(super) struct ImageSet {
    pub work: RgbImage,
    pub buffer_1: Option<RgbImage>,
    pub buffer_2: Option<RgbImage>,
}

impl ImageSet {
    /// The work image and the first buffer, which is black when nothing was put there.
    pub fn with_buffer_1(&mut self) -> (&mut RgbImage, &mut RgbImage) {
        let size = self.work.size();
        (
            &mut self.work,
            self.buffer_1
                .get_or_insert_with(|| RgbImage::uniform(size, BLACK)),
        )
    }

    /// The work image and the second buffer, which is black when nothing was put there.
    pub fn with_buffer_2(&mut self) -> (&mut RgbImage, &mut RgbImage) {
        let size = self.work.size();
        (
            &mut self.work,
            self.buffer_2
                .get_or_insert_with(|| RgbImage::uniform(size, BLACK)),
        )
    }
}

/// The handle a script means. Flags are no part of it.
pub(super) fn handle_of(cx: &Cx, sensor: SensorArgument) -> Option<Handle> {
    if sensor.0.0 != special::SELF {
        return Handle::from_raw(sensor.0.0);
    }
    let script = cx.script();
    let parent = script
        .object
        .and_then(|object| cx.scene().object(object).ok()?.parent());
    script.owner().or(parent)
}

/// Columns and rows.
pub(super) fn size_of(sensor: &VisionSensor) -> [usize; 2] {
    sensor.view.resolution.map(|side| side as usize)
}

/// A value of a vision sensor.
///
/// # Errors
/// When the object is none.
pub(super) fn of_sensor<T>(
    cx: &Cx,
    sensor: SensorArgument,
    read: impl FnOnce(&VisionSensor) -> Option<T>,
) -> Result<(Handle, T)> {
    let handle = handle_of(cx, sensor).ok_or_else(invalid_handle)?;
    let scene = cx.scene();
    let sensor = scene
        .object(handle)
        .and_then(|object| object.vision_sensor())
        .map_err(|_| invalid_handle())?;
    Ok((handle, read(sensor).ok_or_else(invalid_handle)?))
}

/// Makes an image the work image of a sensor. Buffers of another size begin anew.
pub(super) fn set_work_image(cx: &Cx, handle: Handle, work: RgbImage) {
    let images = cx.script_state::<WorkImages>();
    let mut sets = images.0.borrow_mut();
    let old = sets.remove(&handle);
    let size = work.size();
    let fitting = |buffer: Option<RgbImage>| {
        buffer.map(|buffer| {
            if buffer.size() == size {
                buffer
            } else {
                RgbImage::uniform(size, BLACK)
            }
        })
    };
    let (buffer_1, buffer_2) = old.map_or((None, None), |old| {
        (fitting(old.buffer_1), fitting(old.buffer_2))
    });
    sets.insert(
        handle,
        ImageSet {
            work,
            buffer_1,
            buffer_2,
        },
    );
}

/// Works on the image and the buffers of a sensor.
///
/// # Errors
/// When it has none, when it is gone, or when its resolution is another now.
pub(super) fn with_images<T>(
    cx: &Cx,
    sensor: SensorArgument,
    work: impl FnOnce(&mut ImageSet) -> T,
) -> Result<T> {
    with_handle(cx, sensor, |_, set| work(set))
}

/// As [`with_images`], for who needs the handle.
pub(super) fn with_handle<T>(
    cx: &Cx,
    sensor: SensorArgument,
    work: impl FnOnce(Handle, &mut ImageSet) -> T,
) -> Result<T> {
    let handle = handle_of(cx, sensor).ok_or_else(not_initialized)?;
    let size = {
        let scene = cx.scene();
        let sensor = scene
            .object(handle)
            .and_then(|object| object.vision_sensor())
            .map_err(|_| not_initialized())?;
        size_of(sensor)
    };
    let images = cx.script_state::<WorkImages>();
    let mut sets = images.0.borrow_mut();
    let set = sets.get_mut(&handle).ok_or_else(not_initialized)?;
    if set.work.size() != size {
        return Err(ApiError::Other("Resolution mismatch.".into()));
    }
    Ok(work(handle, set))
}

/// Removes the images of a sensor, unless something is in a buffer.
pub(super) fn remove_unbuffered(cx: &Cx, handle: Handle) {
    let images = cx.script_state::<WorkImages>();
    let mut sets = images.0.borrow_mut();
    if sets
        .get(&handle)
        .is_some_and(|set| set.buffer_1.is_none() && set.buffer_2.is_none())
    {
        sets.remove(&handle);
    }
}

pub(super) fn invalid_handle() -> ApiError {
    ApiError::Other("Invalid handle.".into())
}

/// The error for a sensor without a work image.
pub(super) fn not_initialized() -> ApiError {
    ApiError::Other("Invalid handle or work image not initialized.".into())
}
