//! `sim.*`: files, serial ports.

pub(in crate::api) mod scene_file;
pub(in crate::api) mod serial;
