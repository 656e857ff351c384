//! The native part of the Lua modules `lfs` and `lfsx`: folders, links and what is known of files. `lua/public/lfs.lua` gives it
//! LuaFileSystem's form.
//!
//! These functions return failures, as that library does: nil, the reason, and the system's error number.

mod lock;

use std::fs::{self, FileTimes, Metadata};
use std::io;
use std::path::Path;
use std::time::{Duration, SystemTime};

use api_macro::api;

use super::{ApiFn, Cx, Module, Result, functions};
use lock::system_words;
use permissions::Denied;
use scene::{Data, Key};
use script::{Outside, Results};

/// The module `lfs`.
pub static LFS: Module = Module {
    about: "Files and folders, with the interface of LuaFileSystem.",
    functions: &[("Files", FUNCTIONS), ("Files", lock::FUNCTIONS)],
    inner: &[INNER],
    outside: Outside::AllBut(&[]),
    ..Module::new("lfs")
};

/// The module `lfsx`.
pub static LFSX: Module = Module {
    about: "lfs with functions on paths and folder trees: `require 'lfsx'` adds them to lfs.",
    functions: &[("Paths", PATHS)],
    outside: Outside::AllBut(&[]),
    ..Module::new("lfsx")
};

const FUNCTIONS: &[ApiFn] = functions![current_dir, change_dir, make_dir, remove_dir, link];
/// Behind functions of `lua/public/lfs.lua`.
const INNER: &[ApiFn] = functions![touch, attributes, list];
const PATHS: &[ApiFn] = functions![real_path, temp_dir];

/// True, or nil, reason and number.
fn outcome(result: io::Result<()>) -> Results {
    match result {
        Ok(()) => Results(vec![Data::Bool(true)]),
        Err(error) => failure(&system_words(&error), &error),
    }
}

fn failure(text: &str, error: &io::Error) -> Results {
    let is_denied = error.kind() == io::ErrorKind::PermissionDenied;
    let number = error
        .raw_os_error()
        .unwrap_or(if is_denied { Denied::ERRNO } else { 0 });
    Results(vec![Data::Nil, Data::text(text), Data::Int(number.into())])
}

fn path_text(path: io::Result<std::path::PathBuf>) -> Results {
    match path {
        Ok(path) => Results(vec![Data::text(&path.to_string_lossy())]),
        Err(error) => failure(&system_words(&error), &error),
    }
}

/// The working directory of the process.
#[api("lfs.currentdir")]
fn current_dir(_cx: &Cx) -> Result<Results> {
    Ok(path_text(std::env::current_dir()))
}

/// Changes the working directory of the process.
#[api("lfs.chdir")]
fn change_dir(cx: &Cx, path: String) -> Result<Results> {
    let allowed = cx
        .permissions()
        .check_redirect("changing the working directory");
    Ok(
        match allowed
            .map_err(io::Error::from)
            .and_then(|()| std::env::set_current_dir(&path))
        {
            Ok(()) => outcome(Ok(())),
            Err(error) => failure(
                &format!(
                    "Unable to change working directory to '{path}'\n{}\n",
                    system_words(&error)
                ),
                &error,
            ),
        },
    )
}

/// Makes a folder.
#[api("lfs.mkdir")]
fn make_dir(cx: &Cx, path: String) -> Result<Results> {
    Ok(outcome(
        changed_entry(cx, &path).and_then(|()| fs::create_dir(path)),
    ))
}

/// Removes an empty folder.
#[api("lfs.rmdir")]
fn remove_dir(cx: &Cx, path: String) -> Result<Results> {
    Ok(outcome(
        changed_entry(cx, &path).and_then(|()| fs::remove_dir(path)),
    ))
}

fn changed_entry(cx: &Cx, path: &str) -> io::Result<()> {
    Ok(cx.permissions().check_write_entry(Path::new(path))?)
}

/// Makes a hard link, or a symbolic one.
#[api("lfs.link")]
fn link(cx: &Cx, old: String, new: String, #[default(false)] symbolic: bool) -> Result<Results> {
    let allowed = if symbolic {
        cx.permissions().check_redirect("making symbolic links")
    } else {
        // Writes through the new name change the file under its old one, too.
        let (old, new) = (Path::new(&old), Path::new(&new));
        cx.permissions().check_rename(old, new)
    };
    let allowed = allowed.map_err(io::Error::from);
    Ok(outcome(allowed.and_then(|()| {
        if symbolic {
            symbolic_link(&old, &new)
        } else {
            fs::hard_link(old, new)
        }
    })))
}

#[cfg(unix)]
fn symbolic_link(old: &str, new: &str) -> io::Result<()> {
    std::os::unix::fs::symlink(old, new)
}

#[cfg(windows)]
fn symbolic_link(old: &str, new: &str) -> io::Result<()> {
    if Path::new(old).is_dir() {
        std::os::windows::fs::symlink_dir(old, new)
    } else {
        std::os::windows::fs::symlink_file(old, new)
    }
}

/// Sets the times of access and change, in seconds since 1970.
#[api("lfs.touch")]
fn touch(cx: &Cx, path: String, access: f64, modification: f64) -> Result<Results> {
    let set = || {
        cx.permissions().check_write(Path::new(&path))?;
        let times = FileTimes::new()
            .set_accessed(time(access)?)
            .set_modified(time(modification)?);
        fs::File::open(&path)?.set_times(times)
    };
    Ok(outcome(set()))
}

fn time(seconds: f64) -> io::Result<SystemTime> {
    let after = Duration::try_from_secs_f64(seconds).ok();
    let time = after.and_then(|after| SystemTime::UNIX_EPOCH.checked_add(after));
    time.ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "Invalid argument"))
}

/// File attributes as a table; of a link itself unless `follow`.
#[api("lfs.attributes")]
fn attributes(cx: &Cx, path: String, follow: bool) -> Result<Results> {
    let known = if follow {
        followed(cx, Path::new(&path))
    } else {
        not_followed(cx, Path::new(&path))
    };
    Ok(match known {
        Ok(metadata) => Results(vec![Data::Map(fields(&path, &metadata))]),
        Err(error) => failure(
            &format!(
                "cannot obtain information from file '{path}': {}",
                system_words(&error)
            ),
            &error,
        ),
    })
}

fn followed(cx: &Cx, path: &Path) -> io::Result<Metadata> {
    cx.permissions().check_inspect(path)?;
    fs::metadata(path)
}

fn not_followed(cx: &Cx, path: &Path) -> io::Result<Metadata> {
    cx.permissions().check_inspect_link(path)?;
    fs::symlink_metadata(path)
}

fn fields(path: &str, metadata: &Metadata) -> Vec<(Key, Data)> {
    let mut fields = system_fields(metadata);
    fields.push(("size", Data::Int(metadata.len().cast_signed())));
    let times = [
        ("access", metadata.accessed()),
        ("modification", metadata.modified()),
    ];
    fields.extend(
        times
            .into_iter()
            .filter_map(|(name, time)| Some((name, Data::Int(seconds(time.ok()?))))),
    );
    if metadata.is_symlink() {
        let target = fs::read_link(path).map(|target| Data::text(&target.to_string_lossy()));
        fields.extend(target.ok().map(|target| ("target", target)));
    }
    fields
        .into_iter()
        .map(|(name, value)| (Key::Text(name.into()), value))
        .collect()
}

fn seconds(time: SystemTime) -> i64 {
    match time.duration_since(SystemTime::UNIX_EPOCH) {
        Ok(after) => after.as_secs().cast_signed(),
        Err(before) => -before.duration().as_secs().cast_signed(),
    }
}

#[cfg(unix)]
fn system_fields(metadata: &Metadata) -> Vec<(&'static str, Data)> {
    use std::os::unix::fs::MetadataExt;
    let numbers = [
        ("dev", metadata.dev()),
        ("ino", metadata.ino()),
        ("nlink", metadata.nlink()),
        ("uid", metadata.uid().into()),
        ("gid", metadata.gid().into()),
        ("rdev", metadata.rdev()),
        ("blocks", metadata.blocks()),
        ("blksize", metadata.blksize()),
    ];
    let mut fields = vec![
        ("mode", Data::text(kind_word(metadata.file_type()))),
        ("permissions", Data::text(&permissions(metadata.mode()))),
        ("change", Data::Int(metadata.ctime())),
    ];
    fields.extend(numbers.map(|(name, number)| (name, Data::Int(number.cast_signed()))));
    fields
}

#[cfg(unix)]
fn kind_word(kind: fs::FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    match () {
        () if kind.is_file() => "file",
        () if kind.is_dir() => "directory",
        () if kind.is_symlink() => "link",
        () if kind.is_socket() => "socket",
        () if kind.is_fifo() => "named pipe",
        () if kind.is_char_device() => "char device",
        () if kind.is_block_device() => "block device",
        () => "other",
    }
}

#[cfg(not(unix))]
fn system_fields(metadata: &Metadata) -> Vec<(&'static str, Data)> {
    let kind = metadata.file_type();
    let mode = match () {
        () if kind.is_dir() => "directory",
        () if kind.is_symlink() => "link",
        () => "file",
    };
    let bits = if metadata.permissions().readonly() {
        0o555
    } else {
        0o777
    };
    let created = metadata.created().map_or(0, seconds);
    vec![
        ("mode", Data::text(mode)),
        ("permissions", Data::text(&permissions(bits))),
        ("change", Data::Int(created)),
        ("nlink", Data::Int(1)),
    ]
}

/// `rwxr-xr-x`.
fn permissions(mode: u32) -> String {
    let letters = ['x', 'w', 'r'];
    (0..9)
        .rev()
        .map(|bit| {
            if mode >> bit & 1 == 1 {
                letters[bit % 3]
            } else {
                '-'
            }
        })
        .collect()
}

/// The names in a folder, sorted, beginning with `.` and `..`.
#[api("lfs.list")]
fn list(cx: &Cx, path: String) -> Result<Results> {
    let allowed = cx
        .permissions()
        .check_inspect(Path::new(&path))
        .map_err(io::Error::from);
    let names = allowed
        .and_then(|()| fs::read_dir(&path))
        .and_then(|entries| {
            entries
                .map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()))
                .collect::<io::Result<Vec<_>>>()
        });
    Ok(match names {
        Ok(mut names) => {
            names.extend([".".to_owned(), "..".to_owned()]);
            names.sort();
            Results(vec![Data::Array(
                names.iter().map(|name| Data::text(name)).collect(),
            )])
        }
        Err(error) => failure(
            &format!("cannot open {path}: {}", system_words(&error)),
            &error,
        ),
    })
}

/// The absolute path without links and dots.
#[api("lfs.realpath")]
fn real_path(cx: &Cx, path: String) -> Result<Results> {
    let allowed = cx
        .permissions()
        .check_inspect(Path::new(&path))
        .map_err(io::Error::from);
    Ok(path_text(
        allowed.and_then(|()| Path::new(&path).canonicalize()),
    ))
}

/// The folder for temporary files.
#[api("lfs.gettempdir")]
fn temp_dir(_cx: &Cx) -> Result<Results> {
    Ok(path_text(Ok(std::env::temp_dir())))
}

#[cfg(test)]
mod tests {
    use super::permissions;

    #[test]
    fn permissions_read_as_ls_shows_them() {
        assert_eq!(permissions(0o100_644), "rw-r--r--");
        assert_eq!(permissions(0o40_755), "rwxr-xr-x");
        assert_eq!(permissions(0), "---------");
    }
}
