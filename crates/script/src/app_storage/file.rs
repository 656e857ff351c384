//! The file of the app storage: a CBOR map with a version, replaced as a whole.
//!
//! Writers take turns by a lock file beside it. A reader needs none: it sees the file before or after a change, never in between.

use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use capture::{Input, Recorded};
use fs4::{FileExt, TryLockError};

use super::{Blocks, Contents};
use crate::wall_clock;
use format::scene_file::part_of;
use permissions::{Denied, Permissions};
use scene::{CustomData, Data, Edit, Key};
use wire::cbor;

const NAME: &str = "app-storage.cbor";
const LOCK: &str = "app-storage.lock";
const VERSION: i64 = 1;
/// Longest wait for the lock of another process. A writer holds it for milliseconds, unless the disk is very slow.
const LOCK_TIMEOUT: Duration = Duration::from_secs(5);

/// Why the file is not what it should be.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    #[error("the app storage {} is corrupt: it was set aside as {} and a new one begun.", path.display(), aside.display())]
    Corrupt { path: PathBuf, aside: PathBuf },
    #[error("the app storage {} was written by a newer version of Swanilda: it is left alone.", .0.display())]
    TooNew(PathBuf),
    #[error("the app storage {} cannot be used: {error}.", path.display())]
    Unusable {
        path: PathBuf,
        error: std::io::Error,
    },
    #[error("the app storage cannot be used: {0}")]
    Denied(#[from] Denied),
    #[error("there is no folder for the app storage: name one (--data-dir).")]
    NoFolder,
}

/// The system's folder for application data of the user.
pub(super) fn user_folder() -> Option<PathBuf> {
    Some(
        directories::ProjectDirs::from("", "", "swanilda")?
            .data_dir()
            .to_owned(),
    )
}

/// # Errors
/// When scripts may not read the file in `folder`.
pub(super) fn check_read(folder: &Path, permissions: &Permissions) -> Result<(), Failure> {
    Ok(permissions.check_read(&folder.join(NAME))?)
}

/// # Errors
/// When scripts may not change the file in `folder`.
pub(super) fn check_write(folder: &Path, permissions: &Permissions) -> Result<(), Failure> {
    check_read(folder, permissions)?;
    Ok(permissions.check_write(&folder.join(NAME))?)
}

/// The content of the file in `folder`; empty for a missing file.
///
/// # Errors
/// When it cannot be read. A corrupt file has another name then.
pub(super) fn read(folder: &Path) -> Result<Contents, Failure> {
    let path = folder.join(NAME);
    let bytes = match fs::read(&path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Contents::default()),
        Err(error) => return Err(Failure::Unusable { path, error }),
        Ok(bytes) => bytes,
    };
    let data = cbor::decode(&bytes).unwrap_or(Data::Nil);
    match (data.field("version"), decode(&data)) {
        (Some(&Data::Int(version)), _) if version > VERSION => Err(Failure::TooNew(path)),
        (Some(&Data::Int(VERSION)), Some(contents)) => Ok(contents),
        _ => Err(set_aside(path)),
    }
}

/// Changes the file in `folder`; returns what it holds then, and what was wrong with it before.
///
/// # Errors
/// When it cannot be read or written; it is as it was then.
pub(super) fn update(
    folder: &Path,
    change: impl FnOnce(&mut Contents),
) -> Result<(Contents, Option<Failure>), Failure> {
    let unusable = |error| Failure::Unusable {
        path: folder.join(NAME),
        error,
    };
    fs::create_dir_all(folder).map_err(unusable)?;
    let lock = File::options()
        .create(true)
        .truncate(false)
        .write(true)
        .open(folder.join(LOCK))
        .map_err(unusable)?;
    wait_for_lock(&lock, LOCK_TIMEOUT).map_err(unusable)?;
    let (mut contents, failure) = match read(folder) {
        Ok(contents) => (contents, None),
        Err(corrupt @ Failure::Corrupt { .. }) => (Contents::default(), Some(corrupt)),
        Err(failure) => return Err(failure),
    };
    change(&mut contents);
    replace(folder, &cbor::encode(&encode(&contents))).map_err(unusable)?;
    Ok((contents, failure))
}

/// Waits for other writers, but not for one that hangs.
fn wait_for_lock(lock: &File, longest: Duration) -> std::io::Result<()> {
    let deadline = wall_clock::now() + longest;
    loop {
        match FileExt::try_lock(lock) {
            Ok(()) => return Ok(()),
            Err(TryLockError::Error(error)) => return Err(error),
            Err(TryLockError::WouldBlock) if wall_clock::now() > deadline => {
                return Err(std::io::Error::new(
                    ErrorKind::TimedOut,
                    "another program holds its lock",
                ));
            }
            Err(TryLockError::WouldBlock) => wall_clock::pause(Duration::from_millis(1)),
        }
    }
}

/// The new file is complete and on disk before it replaces the old one.
fn replace(folder: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let path = folder.join(NAME);
    let mut file = part_of(&path)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path)?;
    // The folder itself, so that the new name outlives a loss of power; not every system can.
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
    Ok(())
}

/// Gives a corrupt file the first free of the names `*.corrupt-N`.
fn set_aside(path: PathBuf) -> Failure {
    let named = |n: u32| path.with_file_name(format!("{NAME}.corrupt-{n}"));
    let aside = (1..u32::MAX)
        .map(named)
        .find(|aside| !aside.exists())
        .unwrap_or_else(|| named(u32::MAX));
    match fs::rename(&path, &aside) {
        Ok(()) => Failure::Corrupt { path, aside },
        Err(error) => Failure::Unusable { path, error },
    }
}

/// As in the file.
impl Recorded for Contents {
    fn write(&self, out: &mut Vec<u8>) {
        cbor::encode(&encode(self)).write(out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        decode(&cbor::decode(input.bytes()?).ok()?)
    }
}

fn encode(contents: &Contents) -> Data {
    let values = |data: &CustomData| {
        let pairs = data
            .tags()
            .filter_map(|tag| Some(Data::Array(vec![Data::text(&tag), data.get(&tag)?.clone()])));
        Data::Array(pairs.collect())
    };
    Data::map([
        ("version", VERSION.into()),
        ("customData", values(&contents.custom_data)),
        ("tags", encode_blocks(&contents.tags)),
        ("persistent", encode_blocks(&contents.persistent)),
    ])
}

fn encode_blocks(blocks: &Blocks) -> Data {
    let entry = |(tag, bytes): (&String, &Vec<u8>)| {
        (
            Key::Text(tag.clone().into_bytes()),
            Data::Buffer(bytes.clone()),
        )
    };
    Data::Map(blocks.iter().map(entry).collect())
}

fn decode(data: &Data) -> Option<Contents> {
    let mut contents = Contents {
        custom_data: CustomData::default(),
        tags: decode_blocks(data.field("tags")?)?,
        persistent: decode_blocks(data.field("persistent")?)?,
    };
    let Data::Array(pairs) = data.field("customData")? else {
        return None;
    };
    for pair in pairs {
        let Data::Array(pair) = pair else { return None };
        let [Data::Text(tag), value] = pair.as_slice() else {
            return None;
        };
        contents.custom_data.edit(Edit::Tag(
            std::str::from_utf8(tag).ok()?,
            Some(value.clone()),
        ));
    }
    Some(contents)
}

fn decode_blocks(data: &Data) -> Option<Blocks> {
    let Data::Map(entries) = data else {
        return None;
    };
    let entry = |(key, value): &(Key, Data)| match (key, value) {
        (Key::Text(tag), Data::Buffer(bytes)) => {
            Some((String::from_utf8(tag.clone()).ok()?, bytes.clone()))
        }
        _ => None,
    };
    entries.iter().map(entry).collect()
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use fs4::FileExt;

    use super::wait_for_lock;

    #[test]
    fn a_writer_that_hangs_is_not_waited_for() {
        let file = tempfile::NamedTempFile::new().expect("a temporary file can be made");
        let other = file.reopen().expect("it can be opened again");
        FileExt::lock(&other).expect("nobody else has it");
        let error =
            wait_for_lock(file.as_file(), Duration::from_millis(5)).expect_err("the other has it");
        assert_eq!(error.kind(), std::io::ErrorKind::TimedOut);
        drop(other);
        wait_for_lock(file.as_file(), Duration::ZERO).expect("the other has gone");
    }
}
