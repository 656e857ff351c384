//! `sim.*`: files, serial ports, programs.

pub(in crate::api) mod program;
pub(in crate::api) mod scene_file;
pub(in crate::api) mod semaphores;
pub(in crate::api) mod serial;
