//! Where a path leads: absolute, without links and dots, whether something is there or not.

use std::collections::VecDeque;
use std::ffi::OsString;
use std::io::{Error, ErrorKind, Result};
use std::path::{Component, Path, PathBuf};

/// As many as Linux follows.
const MAX_LINKS: usize = 40;

/// The path that C reads in bytes: they end at a NUL.
pub fn c_path(bytes: &[u8]) -> PathBuf {
    let bytes = bytes.split(|&byte| byte == 0).next().unwrap_or_default();
    #[cfg(unix)]
    return <std::ffi::OsStr as std::os::unix::ffi::OsStrExt>::from_bytes(bytes).into();
    #[cfg(not(unix))]
    return String::from_utf8_lossy(bytes).into_owned().into();
}

/// Where `path` leads. Names that do not exist stand for themselves; a link whose target is missing leads there.
pub(super) fn resolve(path: &Path) -> Result<PathBuf> {
    let mut resolved = PathBuf::new();
    let mut left = parts(&std::path::absolute(path)?);
    let mut links = 0;
    while let Some(part) = left.pop_front() {
        match Path::new(&part).components().next() {
            Some(Component::ParentDir) => drop(resolved.pop()),
            Some(Component::Prefix(_) | Component::RootDir) => resolved.push(part),
            Some(Component::Normal(_)) => {
                resolved.push(part);
                let Ok(target) = std::fs::read_link(&resolved) else {
                    continue;
                };
                links += 1;
                if links > MAX_LINKS {
                    return Err(Error::new(ErrorKind::InvalidInput, "too many links"));
                }
                resolved.pop();
                parts(&target)
                    .into_iter()
                    .rev()
                    .for_each(|part| left.push_front(part));
            }
            _ => {}
        }
    }
    Ok(resolved)
}

/// Where the entry itself is that `path` names, be it a link. A path that ends in a separator or in dots names what a link leads to.
pub(super) fn resolve_entry(path: &Path) -> Result<PathBuf> {
    let ends_in_separator = path
        .as_os_str()
        .as_encoded_bytes()
        .last()
        .is_some_and(|&byte| is_separator(byte));
    let Some(name) = path
        .file_name()
        .filter(|_| !ends_in_separator && !ends_in_dot(path))
    else {
        return resolve(path);
    };
    let folder = path
        .parent()
        .filter(|folder| *folder != Path::new(""))
        .unwrap_or(Path::new("."));
    Ok(resolve(folder)?.join(name))
}

fn is_separator(byte: u8) -> bool {
    std::path::is_separator(byte.into())
}

/// `Path` leaves out a last component `.`.
fn ends_in_dot(path: &Path) -> bool {
    matches!(path.as_os_str().as_encoded_bytes(), [.., separator, b'.'] if is_separator(*separator))
}

fn parts(path: &Path) -> VecDeque<OsString> {
    path.components()
        .map(|part| part.as_os_str().to_owned())
        .collect()
}
