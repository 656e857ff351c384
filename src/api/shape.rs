//! `sim.*`: creating shapes, their meshes and boxes.

use api_macro::api;

use super::{ApiFn, Cx, Result, functions};
use crate::scene::Kind;
use crate::scene::primitive::PrimitiveKind;
use crate::scene::shape::Shape;
use crate::scene::shape_build::PrimitiveOptions;
use crate::script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![create_primitive_shape];

/// A new primitive shape, centred on the world's origin: static and not respondable.
///
/// @param primitiveType sim.primitiveshape_*
/// @param sizes full extents, metres
/// @param options 1: back faces culled, 2: sharp edges, 4: open ends, 8: only a mesh, no primitive for the physics
/// @return shapeHandle the shape, -1 when there is no such primitive
#[api("sim.createPrimitiveShape")]
fn create_primitive_shape(
    cx: &mut Cx,
    primitive_type: Number,
    sizes: [f64; 3],
    #[default(0)] options: Number,
) -> Result<i64> {
    let makeable = |kind: &PrimitiveKind| *kind != PrimitiveKind::Heightfield;
    let Some(kind) = PrimitiveKind::from_code(primitive_type.0).filter(makeable) else { return Ok(-1) };
    let bit = |bit: i64| options.0 & bit != 0;
    let options = PrimitiveOptions { culling: bit(1), sharp_edges: bit(2), open_ends: bit(4), plain_mesh: bit(8) };
    let shape = Shape::primitive(kind, sizes, options)?;
    Ok(cx.sim().clone().add_object(kind.alias(), Kind::Shape(Box::new(shape)))?.raw())
}
