//! The library that plugins open to find the simulator's functions. It is part of the program and lies in the user's cache.

use std::fs::{self, DirBuilder, OpenOptions};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use super::ffi;

const LIBRARY: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/libswanilda_plugin.so"));

/// The path of the library, which is open and calls this process.
///
/// # Errors
/// Why there are no plugins here.
pub(super) fn connected() -> Result<&'static Path, String> {
    static PATH: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    PATH.get_or_init(|| heap::outside(connect))
        .as_deref()
        .map_err(Clone::clone)
}

fn connect() -> Result<PathBuf, String> {
    if LIBRARY.is_empty() {
        return Err("native plugins are not supported on this system".into());
    }
    let path = unpacked()
        .map_err(|error| format!("the library for plugins cannot be unpacked: {error}"))?;
    ffi::connect(&path, ffi::enter)
        .map_err(|error| format!("{} cannot be used: {error}", path.display()))?;
    Ok(path)
}

/// In the user's cache, or where that cannot be written in a folder for temporary files, which then stays there.
fn unpacked() -> io::Result<PathBuf> {
    let cache = directories::ProjectDirs::from("", "", "swanilda")
        .map(|folders| folders.cache_dir().to_owned());
    match cache.map(|folder| unpack_into(&folder)) {
        Some(Ok(path)) => Ok(path),
        _ => unpack_into(
            &tempfile::Builder::new()
                .prefix("swanilda-")
                .tempdir()?
                .keep(),
        ),
    }
}

/// Writes the library unless it is there: what is loaded is compared byte by byte.
fn unpack_into(folder: &Path) -> io::Result<PathBuf> {
    let mut hasher = DefaultHasher::new();
    LIBRARY.hash(&mut hasher);
    let path = folder.join(format!("libswanilda_plugin-{:016x}.so", hasher.finish()));
    if fs::read(&path).is_ok_and(|bytes| bytes == LIBRARY) {
        return Ok(path);
    }
    let (mut make, mut create) = (DirBuilder::new(), OpenOptions::new());
    only_for_user(make.recursive(true), create.write(true).create_new(true));
    make.create(folder)?;
    // Another process may do the same now: each writes its own file and moves it to the place at once.
    let mine = folder.join(format!(".{}-{:016x}", std::process::id(), hasher.finish()));
    let written = create
        .open(&mine)
        .and_then(|mut file| file.write_all(LIBRARY))
        .and_then(|()| fs::rename(&mine, &path));
    if written.is_err() {
        // A file that is left over is harmless.
        let _ = fs::remove_file(&mine);
    }
    written.map(|()| path)
}

#[cfg(unix)]
fn only_for_user(folder: &mut DirBuilder, file: &mut OpenOptions) {
    use std::os::unix::fs::{DirBuilderExt, OpenOptionsExt};
    folder.mode(0o700);
    file.mode(0o700);
}

#[cfg(not(unix))]
fn only_for_user(_: &mut DirBuilder, _: &mut OpenOptions) {}

#[cfg(all(test, unix))]
mod tests {
    use super::{LIBRARY, fs, unpack_into};

    #[test]
    fn a_file_that_was_changed_is_written_again() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let path = unpack_into(&folder.path().join("new")).expect("it is writable");
        fs::write(&path, b"something else").expect("it is writable");
        assert_eq!(
            unpack_into(&folder.path().join("new")).expect("it is writable"),
            path
        );
        assert!(fs::read(&path).expect("it is there") == LIBRARY);
        assert_eq!(
            fs::metadata(&path)
                .expect("it is there")
                .permissions()
                .mode()
                & 0o777,
            0o700
        );
    }
}
