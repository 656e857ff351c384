//! `sim.*`: files, serial ports, programs.

pub(crate) mod program;
pub(crate) mod scene_file;
pub(crate) mod semaphores;
pub(crate) mod serial;
