//! `sim.*`: floating views, which pages of the viewer show, and particles, which are not simulated.

use std::cell::RefCell;
use std::rc::Rc;

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::{Data, Handle, SceneError, special};
use script::{ByHandle, Number, Rest};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    floating_view_add,
    floating_view_remove,
    adjust_view,
    add_particle_object,
    add_particle_object_item,
    remove_particle_object,
];

/// Adds a view above the scene. Pages of the viewer show it.
///
/// @param posX of its centre, 0 to 1
/// @param posY of its centre
/// @param sizeX part of the window
/// @param sizeY part of the window
/// @param options bits
/// @return floatingViewHandle its handle
#[api("sim.floatingViewAdd")]
fn floating_view_add(
    cx: &mut Cx,
    pos_x: f64,
    pos_y: f64,
    size_x: f64,
    size_y: f64,
    options: Number,
) -> Result<i64> {
    let _ = options;
    let view = cx.change_ui(|ui| {
        ui.touch();
        ui.views.add([pos_x, pos_y], [size_x, size_y])
    });
    cx.own_view(view);
    Ok(view)
}

/// Removes a view.
///
/// @param floatingViewHandle from sim.floatingViewAdd
/// @return result 1, or 0 when there is no such view
#[api("sim.floatingViewRemove")]
fn floating_view_remove(cx: &mut Cx, floating_view_handle: Number) -> Result<i64> {
    let removed = cx.change_ui(|ui| {
        ui.touch();
        ui.views.remove(floating_view_handle.0)
    });
    Ok(removed.into())
}

/// Shows an object in a view. Views of the page are not changed: in the viewer everybody chooses their own.
///
/// @param viewHandleOrIndex from sim.floatingViewAdd, or the number of a view of the page
/// @param objectHandle a camera, vision sensor or graph, or -1
/// @param options bits
/// @return res 1
#[api("sim.adjustView")]
fn adjust_view(
    cx: &mut Cx,
    view_handle_or_index: Number,
    object_handle: Number,
    options: Number,
    #[name("...")] label: Rest,
) -> Result<i64> {
    let _ = options;
    if object_handle.0 >= 0 {
        object(cx, object_handle)?;
    }
    cx.change_ui(|ui| {
        ui.touch();
        if let Some(view) = ui.views.get_mut(view_handle_or_index.0) {
            view.object = object_handle.0.max(-1);
            if let Some(Data::Text(text)) = label.0.first() {
                view.label = String::from_utf8_lossy(text).into_owned();
            }
        }
    });
    Ok(1)
}

/// A source of particles. They are not simulated, with a warning.
///
/// @param objectType sim.particle_*
/// @param size of a particle
/// @param density of a particle
/// @param params of the physics
/// @param lifeTime in seconds
/// @param maxItemCount more replace old ones
/// @return particleObjectHandle its handle
#[api("sim.addParticleObject")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn add_particle_object(
    cx: &mut Cx,
    object_type: Number,
    size: f64,
    density: f64,
    params: Data,
    life_time: f64,
    max_item_count: Number,
    #[name("...")] colour: Rest,
) -> Result<i64> {
    let _ = (
        object_type,
        size,
        density,
        params,
        life_time,
        max_item_count,
        colour,
    );
    cx.env()
        .warn_once("sim.addParticleObject", "particles are not simulated.");
    Ok(particles(cx).borrow_mut().add(Particles))
}

/// Adds a particle. It is not simulated.
///
/// @param particleObjectHandle from sim.addParticleObject
/// @param itemData position and target position; nil removes all
/// @return result 1
#[api("sim.addParticleObjectItem")]
fn add_particle_object_item(
    cx: &mut Cx,
    particle_object_handle: Number,
    #[default(Data::Nil)] item_data: Data,
) -> Result<i64> {
    let _ = item_data;
    particles(cx)
        .borrow_mut()
        .get_mut(particle_object_handle.0)
        .map(|_| 1)
        .ok_or_else(no_particles)
}

/// Removes a source of particles.
///
/// @param particleObjectHandle from sim.addParticleObject, or sim.handle_all
#[api("sim.removeParticleObject")]
fn remove_particle_object(cx: &mut Cx, particle_object_handle: Number) -> Result<()> {
    remove(
        &mut particles(cx).borrow_mut(),
        particle_object_handle,
        no_particles,
    )
}

/// A source of particles.
struct Particles;

/// Removes one of them, or all.
fn remove<T>(all: &mut ByHandle<T>, handle: Number, missing: fn() -> ApiError) -> Result<()> {
    if handle.0 == special::ALL {
        all.clear();
        return Ok(());
    }
    all.remove(handle.0).map(drop).ok_or_else(missing)
}

fn particles(cx: &Cx) -> Rc<RefCell<ByHandle<Particles>>> {
    cx.script_state()
}

fn object(cx: &Cx, handle: Number) -> Result<Handle> {
    let scene = cx.scene();
    let handle = Handle::from_raw(handle.0).ok_or(SceneError::NoSuchObject)?;
    Ok(scene.object(handle)?.handle())
}

fn no_particles() -> ApiError {
    ApiError::Other("particle object does not exist.".into())
}
