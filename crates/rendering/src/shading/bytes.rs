//! Colours as red, green and blue in 8 bits: 0 to 1 becomes 0 to 255, rounded.

use wide::{f32x8, i32x8};

use crate::shading::lighting::Vectors;

/// Pixels of one colour that are written together.
const PATTERN: usize = 16;

/// The colours of eight pixels: red in the lowest byte of each number, then green and blue.
fn packed(colours: Vectors) -> [i32; 8] {
    let [r, g, b] = colours.map(level);
    (r | (g << 8i32) | (b << 16i32)).to_array()
}

/// What is not a number becomes 0.
fn level(part: f32x8) -> i32x8 {
    let limited = part.fast_max(f32x8::ZERO).fast_min(f32x8::ONE);
    (limited * 255.0 + 0.5).fast_trunc_int()
}

/// Fills pixels with a colour.
pub fn fill(pixels: &mut [u8], colour: [f32; 3]) {
    let [r, g, b, _] = packed(colour.map(f32x8::splat))[0].to_le_bytes();
    let pattern = [[r, g, b]; PATTERN];
    let pattern = pattern.as_flattened();
    let (blocks, rest) = pixels.as_chunks_mut::<{ 3 * PATTERN }>();
    blocks
        .iter_mut()
        .for_each(|block| block.copy_from_slice(pattern));
    rest.copy_from_slice(&pattern[..rest.len()]);
}

/// Writes up to eight pixels.
pub fn write(pixels: &mut [u8], colours: Vectors) {
    let colours = packed(colours);
    if let Some(pixels) = pixels.first_chunk_mut::<{ 3 * 8 }>() {
        return write_eight(pixels, colours);
    }
    for (pixel, colour) in pixels.chunks_exact_mut(3).zip(colours) {
        pixel.copy_from_slice(&colour.to_le_bytes()[..3]);
    }
}

/// Four bytes are written at a time; the fourth is the first one of the next pixel, which comes after it.
fn write_eight(pixels: &mut [u8; 3 * 8], colours: [i32; 8]) {
    for (lane, colour) in colours.into_iter().enumerate().take(7) {
        pixels[3 * lane..3 * lane + 4].copy_from_slice(&colour.to_le_bytes());
    }
    pixels[3 * 7..].copy_from_slice(&colours[7].to_le_bytes()[..3]);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eight colours; some are beyond the limits or no numbers.
    const RED: [f32; 8] = [-1.0, 0.0, 0.5, 1.0, 7.0, f32::NAN, f32::INFINITY, 0.25];
    const RED_BYTES: [u8; 8] = [0, 0, 128, 255, 255, 0, 255, 64];

    #[test]
    fn colours_are_limited_and_rounded() {
        for count in 1..=8 {
            let mut pixels = vec![9; 3 * count];
            write(
                &mut pixels,
                [f32x8::new(RED), f32x8::ONE, f32x8::splat(0.2)],
            );
            let expected: Vec<u8> = RED_BYTES[..count]
                .iter()
                .flat_map(|red| [*red, 255, 51])
                .collect();
            assert_eq!(pixels, expected);
        }
    }

    #[test]
    fn pixels_are_filled_to_the_last() {
        for count in [0, 1, PATTERN - 1, PATTERN, 2 * PATTERN + 1] {
            let mut pixels = vec![9; 3 * count];
            fill(&mut pixels, [1.0, 0.0, 0.2]);
            assert_eq!(pixels, [255, 0, 51].repeat(count));
        }
    }
}
