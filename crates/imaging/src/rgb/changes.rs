//! Pixels that became brighter or darker, as event cameras report them.

use super::{RgbImage, mean};

/// A pixel that changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Change {
    /// Whether the brightness rose; else it fell.
    pub is_brighter: bool,
    /// Column of the pixel, from the left.
    pub column: usize,
    /// Row of the pixel, from the bottom.
    pub row: usize,
}

/// Stands for the brightness of black, so that a change can be relative to it.
const OF_BLACK: f64 = 0.001;

impl RgbImage {
    /// The pixels whose brightness differs from that of `reference` by at least `threshold` times it. The reference takes their value;
    /// here they become white or black, and all others grey.
    pub fn detect_changes(&mut self, reference: &mut Self, threshold: f64) -> Vec<Change> {
        debug_assert_eq!(self.size(), reference.size());
        let width = self.width;
        let mut changes = Vec::new();
        for (at, (pixel, old)) in self
            .pixels
            .iter_mut()
            .zip(&mut reference.pixels)
            .enumerate()
        {
            let (now, before) = (mean(*pixel), mean(*old));
            let difference = now - before;
            let base = if before == 0.0 { OF_BLACK } else { before };
            let is_changed = difference.abs() / base >= threshold;
            if !is_changed {
                *pixel = [0.5; 3];
                continue;
            }
            let is_brighter = difference > 0.0;
            *old = [now; 3];
            *pixel = [if is_brighter { 1.0 } else { 0.0 }; 3];
            changes.push(Change {
                is_brighter,
                column: at % width,
                row: at / width,
            });
        }
        changes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_reported_once() {
        let mut reference = RgbImage::uniform([4, 4], [0.5; 3]);
        let mut image = reference.clone();
        image.pixels[11] = [1.0; 3];
        let next = image.clone();
        assert_eq!(
            image.detect_changes(&mut reference, 0.1),
            [Change {
                is_brighter: true,
                column: 3,
                row: 2
            }]
        );
        assert_eq!(
            (image.get(3, 2), image.get(0, 0)),
            (Some([1.0; 3]), Some([0.5; 3]))
        );
        assert_eq!(reference, next);
        assert_eq!(next.clone().detect_changes(&mut reference, 0.1), []);
    }

    #[test]
    fn black_has_a_brightness() {
        let mut reference = RgbImage::uniform([1, 1], [0.0; 3]);
        assert_eq!(
            RgbImage::uniform([1, 1], [0.0005; 3]).detect_changes(&mut reference, 1.0),
            []
        );
        assert_eq!(
            RgbImage::uniform([1, 1], [0.001; 3])
                .detect_changes(&mut reference, 1.0)
                .len(),
            1
        );
    }
}
