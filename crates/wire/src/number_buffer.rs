//! Buffers of numbers and pixels: from one format to another (`sim.transformBuffer`).

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers are cut or clamped to the type of the buffer, as C does"
)]

/// Format of one item of a buffer; its number is `sim.buffer_*`. Little-endian.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Unsigned, 8 bits.
    U8,
    /// Signed, 8 bits.
    I8,
    /// Unsigned, 16 bits.
    U16,
    /// Signed, 16 bits.
    I16,
    /// Unsigned, 32 bits.
    U32,
    /// Signed, 32 bits.
    I32,
    /// Float, 32 bits.
    F32,
    /// Float, 64 bits.
    F64,
    /// Pixels: where red, green, blue and alpha stand.
    Rgb,
    /// Pixels of 3 bytes: blue, green, red.
    Bgr,
    /// Pixels of 4 bytes, alpha last.
    Rgba,
    /// Pixels of 4 bytes, alpha first.
    Argb,
}

/// Positions of the channels in a pixel: red, green, blue; alpha.
#[derive(Clone, Copy)]
struct Channels {
    colours: [usize; 3],
    alpha: Option<usize>,
}

const FORMATS: [Format; 12] = {
    use Format::{Argb, Bgr, F32, F64, I8, I16, I32, Rgb, Rgba, U8, U16, U32};
    [U8, I8, U16, I16, U32, I32, F32, F64, Rgb, Bgr, Rgba, Argb]
};

impl Format {
    /// The format with that number.
    pub fn from_number(number: i64) -> Option<Self> {
        FORMATS.get(usize::try_from(number).ok()?).copied()
    }

    /// Bytes of one item.
    pub fn size(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::Rgb | Self::Bgr => 3,
            Self::U32 | Self::I32 | Self::F32 | Self::Rgba | Self::Argb => 4,
            Self::F64 => 8,
        }
    }

    /// The channels of a pixel; None for numbers.
    fn channels(self) -> Option<Channels> {
        match self {
            Self::Rgb => Some(Channels {
                colours: [0, 1, 2],
                alpha: None,
            }),
            Self::Bgr => Some(Channels {
                colours: [2, 1, 0],
                alpha: None,
            }),
            Self::Rgba => Some(Channels {
                colours: [0, 1, 2],
                alpha: Some(3),
            }),
            Self::Argb => Some(Channels {
                colours: [1, 2, 3],
                alpha: Some(0),
            }),
            _ => None,
        }
    }

    fn read(self, item: &[u8]) -> f64 {
        fn array<const N: usize>(item: &[u8]) -> [u8; N] {
            item.try_into()
                .expect("items are cut to the size of their format")
        }
        match self {
            Self::I8 => f64::from(item[0].cast_signed()),
            Self::U16 => f64::from(u16::from_le_bytes(array(item))),
            Self::I16 => f64::from(i16::from_le_bytes(array(item))),
            Self::U32 => f64::from(u32::from_le_bytes(array(item))),
            Self::I32 => f64::from(i32::from_le_bytes(array(item))),
            Self::F32 => f64::from(f32::from_le_bytes(array(item))),
            Self::F64 => f64::from_le_bytes(array(item)),
            Self::U8 | Self::Rgb | Self::Bgr | Self::Rgba | Self::Argb => f64::from(item[0]),
        }
    }

    /// Appends a number: what does not fit is cut to the range, or loses its upper bits as in C.
    fn write(self, number: f64, clamp: bool, out: &mut Vec<u8>) {
        macro_rules! integer {
            ($ty:ty) => {{
                let item = if clamp {
                    number as $ty
                } else {
                    number as i64 as $ty
                };
                out.extend(item.to_le_bytes())
            }};
        }
        match self {
            Self::I8 => integer!(i8),
            Self::U16 => integer!(u16),
            Self::I16 => integer!(i16),
            Self::U32 => integer!(u32),
            Self::I32 => integer!(i32),
            Self::F32 => out.extend((number as f32).to_le_bytes()),
            Self::F64 => out.extend(number.to_le_bytes()),
            Self::U8 | Self::Rgb | Self::Bgr | Self::Rgba | Self::Argb => integer!(u8),
        }
    }

    /// The format of the numbers pixels consist of.
    fn numbers(self) -> Self {
        if self.channels().is_some() {
            Self::U8
        } else {
            self
        }
    }
}

/// `number * multiplier + offset` for every number of a buffer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mapping {
    /// Factor of every number.
    pub multiplier: f64,
    /// Added after the multiplication.
    pub offset: f64,
    /// Results outside of the range of their format become its ends.
    pub clamp: bool,
}

/// `bytes` in another format. Between pixels, colours are mapped and keep their meaning; alpha is kept, or opaque when it is new.
/// None if the bytes are no whole number of items.
pub fn transform(bytes: &[u8], from: Format, mapping: Mapping, to: Format) -> Option<Vec<u8>> {
    if !bytes.len().is_multiple_of(from.size()) {
        return None;
    }
    let items = bytes.len() / from.size();
    let mut out = Vec::with_capacity(items * to.size());
    match (from.channels(), to.channels()) {
        (Some(channels), Some(places)) => {
            for pixel in bytes.chunks_exact(from.size()) {
                let start = out.len();
                out.resize(start + to.size(), 0);
                write_pixel((pixel, channels), (&mut out[start..], places), mapping);
            }
        }
        _ => {
            let (from, to) = (from.numbers(), to.numbers());
            for item in bytes.chunks_exact(from.size()) {
                to.write(
                    from.read(item) * mapping.multiplier + mapping.offset,
                    mapping.clamp,
                    &mut out,
                );
            }
        }
    }
    Some(out)
}

fn write_pixel(
    (from, channels): (&[u8], Channels),
    (to, places): (&mut [u8], Channels),
    mapping: Mapping,
) {
    for (channel, place) in channels.colours.into_iter().zip(places.colours) {
        to[place] = mapped_byte(from[channel], mapping);
    }
    if let Some(place) = places.alpha {
        to[place] = channels.alpha.map_or(u8::MAX, |channel| from[channel]);
    }
}

fn mapped_byte(byte: u8, mapping: Mapping) -> u8 {
    let number = f64::from(byte) * mapping.multiplier + mapping.offset;
    if mapping.clamp {
        number as u8
    } else {
        number as i64 as u8
    }
}

#[cfg(test)]
mod tests {
    use super::{Format, Mapping, transform};

    const SAME: Mapping = Mapping {
        multiplier: 1.0,
        offset: 0.0,
        clamp: false,
    };

    #[test]
    fn numbers_are_mapped_and_cut_or_clamped() {
        let half = Mapping {
            multiplier: 0.5,
            ..SAME
        };
        assert_eq!(
            transform(&[2, 255], Format::U8, half, Format::F32),
            Some([1.0_f32, 127.5].map(f32::to_le_bytes).concat())
        );
        let more = Mapping {
            offset: 10.0,
            ..SAME
        };
        assert_eq!(
            transform(&[250], Format::U8, more, Format::U8),
            Some(vec![4])
        );
        assert_eq!(
            transform(
                &[250],
                Format::U8,
                Mapping {
                    clamp: true,
                    ..more
                },
                Format::U8
            ),
            Some(vec![255])
        );
        assert_eq!(
            transform(&[0xff], Format::I8, SAME, Format::I16),
            Some(vec![0xff, 0xff])
        );
    }

    #[test]
    fn pixels_keep_their_colours() {
        assert_eq!(
            transform(&[1, 2, 3], Format::Rgb, SAME, Format::Argb),
            Some(vec![255, 1, 2, 3])
        );
        assert_eq!(
            transform(&[9, 1, 2, 3], Format::Argb, SAME, Format::Bgr),
            Some(vec![3, 2, 1])
        );
        assert_eq!(
            transform(&[1, 2, 3, 9], Format::Rgba, SAME, Format::Argb),
            Some(vec![9, 1, 2, 3])
        );
    }

    #[test]
    fn parts_of_items_are_refused() {
        assert_eq!(transform(&[1, 2], Format::Rgb, SAME, Format::Rgb), None);
        assert_eq!(
            transform(&[], Format::F64, SAME, Format::U8),
            Some(Vec::new())
        );
        assert_eq!(Format::from_number(12), None);
    }
}
