//! `sim.*`: particles, which the physics moves (spec: dynamics 12).

use api_macro::api;

use super::drawing::numbers;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::appearance::colour::Colour;
use scene::drawing::particles::ParticleStyle;
use scene::drawing::particles::options::{Parameters, ParticleFlags, ParticleKind};
use scene::{Data, SceneError, special};
use script::{Number, Rest};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    add_particle_object,
    add_particle_object_item,
    remove_particle_object,
];

/// A source of particles: small spheres that fall, are slowed down, collide with shapes and push them while the simulation runs. It ends with the script.
///
/// @param objectType sim.particle_*: how they are drawn, plus flags
/// @param size diameter of a particle, metres
/// @param density of a particle, kg/m³
/// @param params of the physics: how many follow, then number and value of each: 0 friction and 1 restitution with Bullet, 2 friction with ODE, 6 linear and 7 quadratic drag, 8 and 9 the same of
/// particles in water where they are above it, 10 and 11 friction and restitution with Vortex, 17 and 18 with Newton; nil: all 0
/// @param lifeTime of a particle in seconds, 0 for ever
/// @param maxItemCount further ones are refused, or replace the oldest with sim.particle_cyclic
/// @param ... colour: red, green, blue; then nil, and the same of specular and of emitted light
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
    #[name("...")] colours: Rest,
) -> Result<i64> {
    if ![size, density, life_time].iter().all(|x| x.is_finite()) {
        return Err(SceneError::InvalidArgument.into());
    }
    let style = ParticleStyle {
        kind: ParticleKind::from_code(object_type.0).ok_or(SceneError::InvalidArgument)?,
        flags: ParticleFlags::from_bits_truncate(object_type.0),
        size,
        density,
        parameters: Parameters::from_numbers(&numbers(&params)?),
        life_time,
        max_items: usize::try_from(max_item_count.0).unwrap_or(0),
        colour: colour(&colours.0)?,
    };
    let owner = cx.script().id;
    let mut scene = cx.scene_mut();
    Ok(scene.drawings_mut().particles_mut().add(style, owner))
}

/// Colours as they follow the other arguments.
fn colour(values: &[Data]) -> Result<Colour> {
    let part = |number: usize| -> Result<Option<[f32; 3]>> {
        let numbers = numbers(values.get(number).unwrap_or(&Data::Nil))?;
        let parts = numbers.first_chunk::<3>();
        Ok(parts.map(|parts| parts.map(scene::numbers::single)))
    };
    let mut colour = Colour::new(part(0)?.unwrap_or([1.0; 3]));
    colour.specular = part(2)?.unwrap_or(colour.specular);
    colour.emission = part(3)?.unwrap_or(colour.emission);
    Ok(colour)
}

/// Emits a particle: its place and its velocity in the world, then size, density and colour where the type says so.
///
/// @param particleObjectHandle from sim.addParticleObject
/// @param itemData numbers, or a buffer of 32-bit ones; nil removes all particles
/// @return result 1, or 0 if there is no room, or not all numbers
#[api("sim.addParticleObjectItem")]
fn add_particle_object_item(
    cx: &mut Cx,
    particle_object_handle: Number,
    #[default(Data::Nil)] item_data: Data,
) -> Result<i64> {
    let numbers = numbers(&item_data)?;
    let mut scene = cx.scene_mut();
    let particles = scene.drawings_mut().particles_mut();
    let object = particles.get_mut(particle_object_handle.0);
    let object = object.map_err(|_| no_particles())?;
    if item_data == Data::Nil {
        object.clear();
        return Ok(1);
    }
    Ok(object.add(&numbers).into())
}

/// Removes a source of particles, and its particles.
///
/// @param particleObjectHandle from sim.addParticleObject, or sim.handle_all
#[api("sim.removeParticleObject")]
fn remove_particle_object(cx: &mut Cx, particle_object_handle: Number) -> Result<()> {
    let mut scene = cx.scene_mut();
    let drawings = scene.drawings_mut();
    let particles = drawings.particles_mut();
    match particle_object_handle.0 {
        special::ALL => particles.remove_all(),
        handle => particles.remove(handle).map_err(|_| no_particles())?,
    }
    drawings.draw_particles();
    Ok(())
}

fn no_particles() -> ApiError {
    ApiError::Other("particle object does not exist.".into())
}
