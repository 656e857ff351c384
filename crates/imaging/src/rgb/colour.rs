//! Filters of colours: HSL, false colours, selection, scale and offset.

use super::{BLACK, Rgb, RgbImage, mean};

/// The components that a colour filter looks at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// Red, green and blue.
    Rgb,
    /// Hue, saturation and lightness, each 0 to 1.
    Hsl,
}

impl Component {
    fn of(self, colour: Rgb) -> [f64; 3] {
        match self {
            Self::Rgb => colour,
            Self::Hsl => hsl_from_rgb(colour),
        }
    }

    fn to_rgb(self, components: [f64; 3]) -> Rgb {
        match self {
            Self::Rgb => components,
            Self::Hsl => rgb_from_hsl(components),
        }
    }
}

/// Hue, saturation and lightness, each 0 to 1; grey has hue 0.
pub fn hsl_from_rgb(colour: Rgb) -> [f64; 3] {
    let [red, green, blue] = colour;
    let (largest, smallest) = (red.max(green).max(blue), red.min(green).min(blue));
    let (sum, difference) = (largest + smallest, largest - smallest);
    let lightness = sum / 2.0;
    if difference == 0.0 {
        return [0.0, 0.0, lightness];
    }
    let saturation = difference / if lightness <= 0.5 { sum } else { 2.0 - sum };
    let sixths = if largest == red {
        (green - blue) / difference
    } else if largest == green {
        2.0 + (blue - red) / difference
    } else {
        4.0 + (red - green) / difference
    };
    [(sixths / 6.0).rem_euclid(1.0), saturation, lightness]
}

/// The colour of a hue, saturation and lightness.
pub fn rgb_from_hsl([hue, saturation, lightness]: [f64; 3]) -> Rgb {
    let chroma = (1.0 - (2.0 * lightness - 1.0).abs()) * saturation;
    let sixths = hue.rem_euclid(1.0) * 6.0;
    let second = chroma * (1.0 - (sixths % 2.0 - 1.0).abs());
    let base = lightness - chroma / 2.0;
    let parts = match numbers::truncated_u32(sixths) {
        0 => [chroma, second, 0.0],
        1 => [second, chroma, 0.0],
        2 => [0.0, chroma, second],
        3 => [0.0, second, chroma],
        4 => [second, 0.0, chroma],
        _ => [chroma, 0.0, second],
    };
    parts.map(|part| part + base)
}

/// The false colour of an intensity of 0 to 1: from black over blue and red to yellow.
fn false_colour(intensity: f64) -> Rgb {
    let thirds = intensity.clamp(0.0, 1.0) * 3.0;
    match thirds {
        t if t < 1.0 => [0.0, 0.0, t],
        t if t < 2.0 => [t - 1.0, 0.0, 2.0 - t],
        t => [1.0, t - 2.0, 0.0],
    }
}

impl RgbImage {
    /// Maps intensities of 0 to 1 to `start` to `end`, as grey or as false colours.
    pub fn scale_intensity(&mut self, start: f64, end: f64, grey: bool) {
        for pixel in &mut self.pixels {
            let intensity = start + (end - start) * mean(*pixel);
            *pixel = if grey {
                [intensity; 3]
            } else {
                false_colour(intensity)
            };
        }
    }

    /// Blackens the pixels outside of `colour` ± `tolerance`, or with `keep` false those inside; returns what was removed, on black.
    pub fn select_colour(
        &mut self,
        colour: [f64; 3],
        tolerance: [f64; 3],
        by: Component,
        keep: bool,
    ) -> Self {
        let mut removed = Self::uniform(self.size(), BLACK);
        for (pixel, removed) in self.pixels.iter_mut().zip(&mut removed.pixels) {
            if is_within(by, by.of(*pixel), colour, tolerance) != keep {
                *removed = std::mem::replace(pixel, BLACK);
            }
        }
        removed
    }

    /// `after + (value + before) scale` of each component, limited to 0 and 1.
    pub fn scale_and_offset(
        &mut self,
        before: [f64; 3],
        scale: [f64; 3],
        after: [f64; 3],
        by: Component,
    ) {
        for pixel in &mut self.pixels {
            let components = by.of(*pixel);
            let scaled =
                |i: usize| (after[i] + (components[i] + before[i]) * scale[i]).clamp(0.0, 1.0);
            *pixel = by.to_rgb([0, 1, 2].map(scaled));
        }
    }
}

/// Hue is cyclic, and any hue is within a tolerance of one half.
fn is_within(by: Component, components: [f64; 3], colour: [f64; 3], tolerance: [f64; 3]) -> bool {
    (0..3).all(|i| {
        let difference = (components[i] - colour[i]).abs();
        if by == Component::Hsl && i == 0 {
            let around = difference.rem_euclid(1.0);
            return 2.0 * tolerance[0] >= 1.0 || around.min(1.0 - around) <= tolerance[0];
        }
        difference <= tolerance[i]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Rgb = [1.0, 0.0, 0.0];
    const BLUE: Rgb = [0.0, 0.0, 1.0];

    #[test]
    fn hsl_and_back() {
        assert_eq!(hsl_from_rgb(RED), [0.0, 1.0, 0.5]);
        assert_eq!(hsl_from_rgb([0.5; 3]), [0.0, 0.0, 0.5]);
        for colour in [
            RED,
            BLUE,
            [0.0, 1.0, 0.0],
            [0.25, 0.5, 0.75],
            [0.9, 0.1, 0.2],
            [1.0; 3],
            BLACK,
        ] {
            let back = rgb_from_hsl(hsl_from_rgb(colour));
            assert!(
                colour.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-12),
                "{colour:?} {back:?}"
            );
        }
    }

    #[test]
    fn intensities_become_false_colours() {
        let shown = |intensity: f64| {
            let mut image = RgbImage::uniform([1, 1], [intensity; 3]);
            image.scale_intensity(0.0, 1.0, false);
            image.to_bytes()
        };
        assert_eq!(shown(0.0), [0, 0, 0]);
        assert_eq!(shown(0.5), [127, 0, 127]);
        assert_eq!(shown(0.75), [255, 63, 0]);
        assert_eq!(shown(1.0), [255, 255, 0]);
        let mut image = RgbImage::uniform([1, 1], [0.5; 3]);
        image.scale_intensity(1.0, 3.0, true);
        assert_eq!(image.pixels(), [[2.0; 3]]);
    }

    #[test]
    fn a_colour_is_selected_by_its_hue() {
        let mut image = RgbImage {
            width: 2,
            height: 1,
            pixels: vec![RED, BLUE],
        };
        let removed = image.select_colour([0.0, 0.5, 0.5], [0.05, 0.5, 0.5], Component::Hsl, true);
        assert_eq!(
            (image.pixels(), removed.pixels()),
            (&[RED, BLACK][..], &[BLACK, BLUE][..])
        );
        // The hue beyond 1 is the same as the one above 0.
        let mut image = RgbImage::uniform([1, 1], rgb_from_hsl([0.98, 1.0, 0.5]));
        image.select_colour([0.0, 0.5, 0.5], [0.05, 0.5, 0.5], Component::Hsl, false);
        assert_eq!(image.pixels(), [BLACK]);
    }

    #[test]
    fn components_are_scaled_within_limits() {
        let mut image = RgbImage::uniform([1, 1], [0.25, 0.5, 1.0]);
        image.scale_and_offset(
            [0.25, 0.0, 0.0],
            [1.0, 2.0, -1.0],
            [0.0, 0.0, 0.5],
            Component::Rgb,
        );
        assert_eq!(image.pixels(), [[0.5, 1.0, 0.0]]);
        let mut image = RgbImage::uniform([1, 1], RED);
        image.scale_and_offset([2.0 / 3.0, 0.0, 0.0], [1.0; 3], [0.0; 3], Component::Hsl);
        assert_eq!(image.to_bytes(), [0, 0, 255]);
    }
}
