//! The markers of the original ArUco library: 1024 numbers in five rows of five bits.

use crate::matrix::{Depth, Matrix, MatrixError, MatrixResult, PixelFormat};

/// Two bits of the number as a row of the marker, a Hamming code (Munoz-Salinas, ArUco).
const ROWS: [u32; 4] = [0b10000, 0b10111, 0b01001, 0b01110];

/// Bits of markers, by number; white is 1, row by row from the upper left, the last bit is the lowest.
#[derive(Debug, Clone, PartialEq)]
pub struct Dictionary {
    side: usize,
    markers: Vec<u64>,
}

impl Dictionary {
    /// The dictionary of the original ArUco library.
    pub fn aruco_original() -> Self {
        let row = |id: u32, n: u32| u64::from(ROWS[(id >> (8 - 2 * n) & 3) as usize]);
        let marker = |id: u32| (0..5).fold(0, |bits, n| bits << 5 | row(id, n));
        Self {
            side: 5,
            markers: (0..1024).map(marker).collect(),
        }
    }

    /// Bits of a side.
    pub fn side(&self) -> usize {
        self.side
    }

    /// Number of a marker whose bits were read from any of its sides, and how many corners later its upper left one comes.
    pub(super) fn identify(&self, bits: &[bool]) -> Option<(usize, usize)> {
        let mut bits = bits.to_vec();
        for turns in 0..4 {
            let read = bits.iter().fold(0, |all, bit| all << 1 | u64::from(*bit));
            if let Some(id) = self.markers.iter().position(|marker| *marker == read) {
                return Some((id, turns));
            }
            bits = self.turned(&bits);
        }
        None
    }

    /// The bits as they are read from the next corner.
    fn turned(&self, bits: &[bool]) -> Vec<bool> {
        let side = self.side;
        (0..side * side)
            .map(|at| bits[(at % side) * side + side - 1 - at / side])
            .collect()
    }

    /// A picture of a marker with a black border of some bits.
    ///
    /// # Errors
    /// When there is no such marker, when it has no border, or when a bit is smaller than a pixel.
    pub fn draw(&self, id: usize, size: usize, border: usize) -> MatrixResult<Matrix> {
        let marker = *self
            .markers
            .get(id)
            .ok_or(MatrixError::Range("the number of a marker"))?;
        let cells = border
            .checked_mul(2)
            .and_then(|both| both.checked_add(self.side));
        let cells = cells
            .filter(|cells| border > 0 && *cells <= size)
            .ok_or(MatrixError::Range("the size of a marker"))?;
        let mut image = Matrix::new([size, size], PixelFormat::new(Depth::Byte, 1), 0.0)?;
        let cell = |at: usize| {
            (at * cells / size)
                .checked_sub(border)
                .filter(|cell| *cell < self.side)
        };
        for at in 0..size * size {
            let place = cell(at % size).zip(cell(at / size));
            let bit =
                place.map(|(column, row)| self.side * self.side - 1 - (row * self.side + column));
            if bit.is_some_and(|bit| marker >> bit & 1 == 1) {
                image.set_value(at, 255.0);
            }
        }
        Ok(image)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rows() {
        let dictionary = Dictionary::aruco_original();
        let image = dictionary.draw(0b00_01_10_11_00, 7, 1).unwrap();
        let white = |row: usize| {
            (0..7)
                .map(|column| u32::from(image.value(row * 7 + column) == Some(255.0)))
                .collect::<Vec<_>>()
        };
        assert_eq!(white(0), [0; 7]);
        assert_eq!(white(1), [0, 1, 0, 0, 0, 0, 0]);
        assert_eq!(white(2), [0, 1, 0, 1, 1, 1, 0]);
        assert_eq!(white(3), [0, 0, 1, 0, 0, 1, 0]);
        assert_eq!(white(4), [0, 0, 1, 1, 1, 0, 0]);
    }

    #[test]
    fn impossible_pictures_are_refused() {
        let dictionary = Dictionary::aruco_original();
        for (id, size, border) in [
            (1024, 70, 1),
            (0, 6, 1),
            (0, 70, 0),
            (0, 70, usize::MAX),
            (0, usize::MAX, 1),
        ] {
            assert!(dictionary.draw(id, size, border).is_err());
        }
    }

    #[test]
    fn a_turn_is_found() {
        let dictionary = Dictionary::aruco_original();
        let bits: Vec<bool> = (0..25)
            .rev()
            .map(|bit| dictionary.markers[33] >> bit & 1 == 1)
            .collect();
        assert_eq!(dictionary.identify(&bits), Some((33, 0)));
        assert_eq!(
            dictionary.identify(&dictionary.turned(&bits)),
            Some((33, 3))
        );
        assert_eq!(dictionary.identify(&[true; 25]), None);
    }
}
