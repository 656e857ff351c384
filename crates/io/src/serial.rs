//! Serial ports: bytes to and from a device at a rate, with 8 data bits, no parity and one stop bit.
//!
//! Handles, and input that scripts have not read yet, are in `api`.

use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use heap::resource::Resource;
use serialport::ClearBuffer;

/// The baud rates of CoppeliaSim.
const BAUD_RATES: &[u32] = &[
    50, 75, 110, 134, 150, 200, 300, 600, 1200, 1800, 2400, 4800, 9600, 19_200, 38_400, 57_600,
    115_200, 230_400,
];

/// A device that is ready accepts that many bytes without blocking the writer.
const CHUNK: usize = 256;
/// The duration of one wait for the device.
const SLICE: Duration = Duration::from_millis(50);
const SLICES_PER_SECOND: u32 = 20;
/// Start bit, data bits, stop bit.
const BITS_PER_BYTE: u32 = 10;

/// An open port. Closed when dropped.
pub struct SerialPort {
    path: String,
    device: Box<dyn serialport::SerialPort>,
    /// Slices without progress after which a write ends.
    max_idle_slices: u32,
    _resource: Resource,
}

impl SerialPort {
    /// Opens a device in raw mode; None at an unknown rate, and when it cannot be opened.
    ///
    /// # Errors
    /// When this build has no serial ports.
    pub fn open(path: &str, baud_rate: i64) -> Result<Option<Self>, &'static str> {
        Ok(Self::opened(path, baud_rate))
    }

    fn opened(path: &str, baud_rate: i64) -> Option<Self> {
        let baud_rate = *BAUD_RATES
            .iter()
            .find(|&&known| i64::from(known) == baud_rate)?;
        let builder = serialport::new(path, baud_rate).timeout(SLICE);
        // As in CoppeliaSim, other programs may open the device too.
        #[cfg(unix)]
        let builder = builder.exclusive(false);
        let device = builder.open().ok()?;
        // If clearing fails, the device has received nothing yet.
        let _ = device.clear(ClearBuffer::Input);
        Some(Self {
            path: path.to_owned(),
            device,
            max_idle_slices: max_idle_slices(baud_rate),
            _resource: Resource::new(|| format!("the serial port {path}")),
        })
    }

    /// The file of a device.
    pub fn file(path: &str) -> PathBuf {
        // Windows names ports in a folder of devices.
        if cfg!(windows) {
            Path::new(r"\\.").join(path)
        } else {
            path.into()
        }
    }

    /// The device as it was given.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// How many bytes can be read; None when the device is gone.
    pub fn available(&self) -> Option<usize> {
        self.device.bytes_to_read().ok().map(|count| count as usize)
    }

    /// At most `wanted` of the bytes that are there, without waiting.
    pub fn read(&mut self, wanted: usize) -> Vec<u8> {
        let mut bytes = vec![0; wanted.min(self.available().unwrap_or(0))];
        let count = if bytes.is_empty() {
            0
        } else {
            self.device.read(&mut bytes).unwrap_or(0)
        };
        bytes.truncate(count);
        bytes
    }

    /// Writes bytes and returns how many the device accepted: fewer when it is gone, when it accepts none for longer than its rate
    /// explains, or when `stop` returns true.
    pub fn write(&mut self, bytes: &[u8], stop: impl Fn() -> bool) -> usize {
        let (mut written, mut idle) = (0, 0);
        while written < bytes.len() && idle < self.max_idle_slices && !stop() {
            let end = bytes.len().min(written + CHUNK);
            match self.device.write(&bytes[written..end]) {
                Ok(count) => {
                    written += count;
                    idle = if count == 0 { idle + 1 } else { 0 };
                }
                Err(error)
                    if matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::Interrupted) =>
                {
                    idle += 1;
                }
                Err(_) => break,
            }
        }
        written
    }
}

/// A second, and the time two chunks take.
fn max_idle_slices(baud_rate: u32) -> u32 {
    SLICES_PER_SECOND + SLICES_PER_SECOND * BITS_PER_BYTE * 2 * CHUNK as u32 / baud_rate
}

#[cfg(test)]
mod tests {
    use super::max_idle_slices;

    #[test]
    fn slow_devices_are_given_time() {
        assert_eq!(max_idle_slices(230_400), 20);
        assert!(
            max_idle_slices(50) > 100 * 20,
            "256 bytes at 50 baud take 51 seconds"
        );
    }
}
