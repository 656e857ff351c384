//! In place of serial ports, in builds without the feature `serial`: none can be opened.

use std::path::PathBuf;

/// There are none.
pub enum SerialPort {}

impl SerialPort {
    pub fn open(_: &str, _: i64) -> Result<Option<Self>, &'static str> {
        Err("this build has no serial ports: build Swanilda with the feature `serial`.")
    }

    pub fn file(path: &str) -> PathBuf {
        path.into()
    }

    pub fn path(&self) -> &str {
        match *self {}
    }

    pub fn available(&self) -> Option<usize> {
        match *self {}
    }

    pub fn read(&mut self, _: usize) -> Vec<u8> {
        match *self {}
    }

    pub fn write(&mut self, _: &[u8], _: impl Fn() -> bool) -> usize {
        match *self {}
    }
}
