//! The folder that programs take for an installation of CoppeliaSim.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::{LIBRARY_41, LIBRARY_410};

/// What programs link against and load.
const FRONT: &str = "libcoppeliaSim.so";
/// The name under which it loads the simulator, from the same folder.
pub const SIMULATOR: &str = "libswanilda_library.so";

/// How programs start the executable by another program than themselves.
const LAUNCHER: &str = r#"#!/bin/sh
# Starts Swanilda with the options of CoppeliaSim's executable.
exec "$(dirname "$(readlink -f "$0")")/swanilda" coppeliasim "$@"
"#;

/// What CoppeliaSim's Python package imports from the folder of Python files: the types in the first lines of functions' descriptions.
const CALLTIP: &str = include_str!("calltip.py");

/// The versions of CoppeliaSim whose library programs load.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Release {
    /// Numbers in single precision: PyRep, RLBench.
    V41,
    /// Numbers in double precision: CoppeliaSim's own Python package.
    V410,
}

impl Release {
    fn front(self) -> &'static [u8] {
        match self {
            Self::V41 => LIBRARY_41,
            Self::V410 => LIBRARY_410,
        }
    }

    /// Whether the library exists for this operating system.
    pub fn is_supported(self) -> bool {
        !self.front().is_empty()
    }
}

/// What a folder consists of.
#[derive(Debug, Clone, Copy)]
pub struct Folder<'a> {
    /// Whose library it has.
    pub release: Release,
    /// The shared library of the simulator, which exports `swanilda_library_call`.
    pub simulator: &'a Path,
    /// The command `swanilda`, with which the folder has launchers too.
    pub command: Option<&'a Path>,
}

impl Folder<'_> {
    /// Writes it; files of an earlier one are replaced, and others are left alone.
    ///
    /// # Errors
    /// When a file cannot be read or written.
    pub fn write(&self, place: &Path) -> io::Result<()> {
        // Programs keep their settings here.
        fs::create_dir_all(place.join("system"))?;
        fs::create_dir_all(place.join("python"))?;
        put(&place.join("python/calltip.py"), 0o644, |file| {
            fs::write(file, CALLTIP)
        })?;
        put(&place.join(FRONT), 0o755, |file| {
            fs::write(file, self.release.front())
        })?;
        for name in ["libcoppeliaSim.so.1", "libcoppeliaSimHeadless.so"] {
            link(FRONT, &place.join(name))?;
        }
        put(&place.join(SIMULATOR), 0o755, |file| {
            fs::copy(self.simulator, file).map(drop)
        })?;
        self.command
            .map_or(Ok(()), |command| put_command(place, command))
    }
}

/// The command, and how other programs start it.
fn put_command(folder: &Path, command: &Path) -> io::Result<()> {
    put(&folder.join("swanilda"), 0o755, |file| {
        fs::copy(command, file).map(drop)
    })?;
    put(&folder.join("coppeliaSim.sh"), 0o755, |file| {
        fs::write(file, LAUNCHER)
    })?;
    for name in ["coppeliaSim", "vrep.sh"] {
        link("coppeliaSim.sh", &folder.join(name))?;
    }
    Ok(())
}
/// Writes a file beside its place and moves it there: programs that have loaded the one before go on with it.
fn put(place: &Path, mode: u32, write: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let mut beside = place.as_os_str().to_owned();
    beside.push(format!(".{}", std::process::id()));
    let beside = PathBuf::from(beside);
    let written = write(&beside)
        .and_then(|()| set_mode(&beside, mode))
        .and_then(|()| fs::rename(&beside, place));
    if written.is_err() {
        // What is left over is harmless.
        let _ = fs::remove_file(&beside);
    }
    written
}

fn link(target: &str, place: &Path) -> io::Result<()> {
    match fs::remove_file(place) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => symlink(target, place),
    }
}

#[cfg(unix)]
fn set_mode(file: &Path, mode: u32) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(file, fs::Permissions::from_mode(mode))
}

#[cfg(unix)]
fn symlink(target: &str, place: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(target, place)
}

#[cfg(not(unix))]
fn set_mode(_: &Path, _: u32) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(not(unix))]
fn symlink(_: &str, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
