//! Colours, in the present model and in that before 3.1.4, which current versions write as well.

use crate::ttt::chunks::Colour as Chunk;
use scene::appearance::colour::Colour;

const OPAQUE: u8 = 0x4;
/// The diffuse light every colour had before ambient and diffuse became one.
const OLD_DIFFUSE: f32 = 0.25;

pub(super) fn colour(colour: &Colour) -> Chunk {
    chunk(colour, colour.ambient_diffuse, [0.0; 3])
}

/// Emitted light is the second group of a colour.
pub(super) fn emitted(colour: &Colour) -> Chunk {
    chunk(colour, [0.0; 3], colour.ambient_diffuse)
}

fn chunk(colour: &Colour, first: [f32; 3], second: [f32; 3]) -> Chunk {
    let ambient = first.map(|c| 0.85 * c - OLD_DIFFUSE / 2.0);
    let rest = [colour.specular, colour.emission, colour.auxiliary];
    let translucent = colour.opacity < 1.0;
    Chunk {
        old_values: Some(groups(ambient, [OLD_DIFFUSE; 3], rest)),
        values: Some(groups(first, second, rest)),
        shininess_sh2: Some(48),
        opacity: Some(if translucent { colour.opacity } else { 0.5 }),
        flags: Some(if translucent { 0 } else { OPAQUE }),
        flash: Some([2.0, 0.5, 0.0]),
        name: Some("".into()),
        extension_string: Some("".into()),
        ..Chunk::default()
    }
}

fn groups(
    first: [f32; 3],
    second: [f32; 3],
    [specular, emission, auxiliary]: [[f32; 3]; 3],
) -> [f32; 15] {
    let all = [first, second, specular, emission, auxiliary];
    std::array::from_fn(|i| all[i / 3][i % 3])
}
