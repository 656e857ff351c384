//! In place of serial ports, in builds without the feature `serial`: none can be opened.

use std::path::PathBuf;

/// There are none.
pub enum SerialPort {}

impl SerialPort {
    /// Always an error: this build has no serial ports.
    pub fn open(_: &str, _: i64) -> Result<Option<Self>, &'static str> {
        Err("this build has no serial ports: build Swanilda with the feature `serial`.")
    }

    /// The file of a device.
    pub fn file(path: &str) -> PathBuf {
        path.into()
    }

    /// The device as it was given.
    pub fn path(&self) -> &str {
        match *self {}
    }

    /// How many bytes can be read.
    pub fn available(&self) -> Option<usize> {
        match *self {}
    }

    /// At most that many of the bytes that are there.
    pub fn read(&mut self, _: usize) -> Vec<u8> {
        match *self {}
    }

    /// Writes bytes and returns how many the device accepted.
    pub fn write(&mut self, _: &[u8], _: impl Fn() -> bool) -> usize {
        match *self {}
    }
}
