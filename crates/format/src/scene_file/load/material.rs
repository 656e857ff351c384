//! Materials: surface parameters of each physics engine (spec: scene-files 8).

use super::Context;
use crate::ttt::EngineBlock;
use crate::ttt::chunks::{Material as Chunk, MeshNode, Shape as ShapeChunk};
use scene::parameters::engine::Engine;
use scene::parameters::engine_blocks::EngineValues;
use scene::shape::Material;

/// Shapes have had materials of their own since 3.3.3; before, they named one of the file.
const OWN_MATERIAL_SINCE: u16 = 30_303;
/// Since then Bullet has a friction of its own, beside the old one.
const NEW_FRICTION_SINCE: u16 = 30_301;
/// Friction of sticky moving shapes in older files.
const STICKY_FRICTION: f64 = 0.25;
const STICKY: u8 = 0x2;

pub(super) fn of_shape(
    context: &Context<'_>,
    shape: &ShapeChunk,
    root: &MeshNode,
    is_static: bool,
) -> Material {
    let named = || {
        let id = root.dyn_material_id?;
        context
            .file
            .contents
            .materials
            .iter()
            .find(|material| material.id == Some(id))
    };
    let own = shape
        .material
        .as_ref()
        .filter(|_| context.header.version >= OWN_MATERIAL_SINCE);
    match own.or_else(named).or(shape.material.as_ref()) {
        Some(chunk) => material(context, chunk, is_static),
        None => oldest(root),
    }
}

fn material(context: &Context<'_>, chunk: &Chunk, is_static: bool) -> Material {
    let mut material = Material::default();
    if let Some(bullet) = &chunk.bul {
        bullet_of_old(&mut material, bullet.map(f64::from));
    }
    if let Some((contacts, values)) = chunk.od2.as_ref().or(chunk.ode.as_ref()) {
        material.load_engine(Engine::Ode, &values.map(f64::from), &[*contacts]);
    }
    load_all(
        &mut material,
        [
            &chunk.bullet,
            &chunk.ode_values,
            &chunk.vortex,
            &chunk.newton,
            &chunk.mujoco,
        ],
    );
    let sticky = chunk.mvar.unwrap_or(0) & STICKY != 0;
    if context.header.version < NEW_FRICTION_SINCE && sticky {
        let friction = if is_static {
            material.friction
        } else {
            STICKY_FRICTION
        };
        material.set_number(6003, friction);
    }
    material
}

/// The blocks of the engines, in their order.
pub(super) fn load_all(values: &mut impl EngineValues, blocks: [&Option<EngineBlock>; 5]) {
    for (engine, block) in Engine::ALL.into_iter().zip(blocks) {
        if let Some(block) = block {
            values.load_engine(engine, &block.reals, &block.ints);
        }
    }
}

/// Restitution, friction, two dampings, margins: before there were two frictions, the one counted for both.
fn bullet_of_old(
    material: &mut Material,
    [restitution, friction, linear, angular, margins @ ..]: [f64; 6],
) {
    material.load_engine(
        Engine::Bullet,
        &[
            restitution,
            friction,
            friction,
            linear,
            angular,
            margins[0],
            margins[1],
        ],
        &[],
    );
}

/// Materials stored in the node itself, up to 3.0.1.
fn oldest(root: &MeshNode) -> Material {
    let mut material = Material::default();
    if let Some(bullet) = root.bul_v16 {
        let [restitution, friction, linear, angular, margin] = bullet.map(f64::from);
        material.load_engine(
            Engine::Bullet,
            &[restitution, friction, friction, linear, angular, margin],
            &[],
        );
    }
    if let Some((contacts, values)) = root.ode_v16 {
        material.load_engine(Engine::Ode, &values.map(f64::from), &[contacts]);
    }
    material
}
