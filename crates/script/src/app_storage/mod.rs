//! Persistent data of scripts: `sim.handle_appstorage`, custom data of `sim.handle_app`, persistent data.
//!
//! All of it lies in one file, which is neither read nor written before a script uses it. Changes are visible at once and reach the file
//! at the end of the loop iteration: what was changed here goes into what the file holds by then, so that simulators side by side lose nothing.

mod file;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::log::verbosity;
use file::Failure;
use permissions::Permissions;
use scene::{CustomData, Edit, Edited};

/// Bytes by tag.
pub(crate) type Blocks = BTreeMap<String, Vec<u8>>;

/// The content of the file.
#[derive(Debug, Clone, Default, PartialEq)]
struct Contents {
    /// Properties `customData.*` of the application.
    custom_data: CustomData,
    /// Raw custom data of `sim.handle_appstorage`.
    tags: Blocks,
    /// Data of `sim.persistentDataWrite` that is meant for the file.
    persistent: Blocks,
}

/// A part of the contents that consists of bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum StorageSection {
    /// Custom data of the application, by tag.
    Tags,
    /// Persistent data blocks (`sim.persistentDataWrite`).
    Persistent,
}

/// Changes that are not in the file yet.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Dirty {
    CustomData(String),
    Block(StorageSection, String),
}

/// A line for the log: its level and text.
type Notice = (i64, String);

/// The file as scripts see it.
#[derive(Default)]
pub struct AppStorage {
    folder: Option<PathBuf>,
    loaded: bool,
    contents: Contents,
    dirty: BTreeSet<Dirty>,
    permissions: Permissions,
    /// Saving failed, and nothing was changed since: it would fail again.
    failed: bool,
    /// Warnings for the user.
    pub(crate) notices: Vec<Notice>,
}

impl Contents {
    fn blocks(&self, section: StorageSection) -> &Blocks {
        match section {
            StorageSection::Tags => &self.tags,
            StorageSection::Persistent => &self.persistent,
        }
    }

    fn blocks_mut(&mut self, section: StorageSection) -> &mut Blocks {
        match section {
            StorageSection::Tags => &mut self.tags,
            StorageSection::Persistent => &mut self.persistent,
        }
    }

    /// Takes over one item from `other`: its value, or that it is gone.
    fn copy_item(&mut self, item: &Dirty, other: &Self) {
        match item {
            Dirty::CustomData(name) => {
                let value = other
                    .custom_data
                    .typed(name)
                    .map(|(ty, value)| (ty, value.clone()));
                self.custom_data.edit(Edit::Name(name, value));
            }
            Dirty::Block(section, tag) => {
                let blocks = self.blocks_mut(*section);
                match other.blocks(*section).get(tag) {
                    Some(bytes) => drop(blocks.insert(tag.clone(), bytes.clone())),
                    None => drop(blocks.remove(tag)),
                }
            }
        }
    }
}

impl AppStorage {
    /// Storage in `folder`; None for the folder where the system keeps data of the user's programs.
    pub(crate) fn new(folder: Option<&Path>) -> Self {
        Self {
            folder: folder.map(Path::to_owned).or_else(file::user_folder),
            ..Self::default()
        }
    }

    /// The same with the permissions of the scripts that use it.
    pub(crate) fn restricted(self, permissions: &Permissions) -> Self {
        Self {
            permissions: permissions.clone(),
            ..self
        }
    }

    pub(crate) fn custom_data(&mut self) -> &CustomData {
        self.load();
        &self.contents.custom_data
    }

    pub(crate) fn edit_custom_data<'a>(&mut self, edit: Edit<'a>) -> Edited<'a> {
        self.load();
        let edited = self.contents.custom_data.edit(edit);
        match &edited {
            Edited::Nothing => {}
            Edited::Written(name) | Edited::Removed(name) => {
                self.mark(Dirty::CustomData((*name).to_owned()));
            }
            Edited::Cleared(names) => names
                .iter()
                .for_each(|name| self.mark(Dirty::CustomData(name.clone()))),
        }
        edited
    }

    /// The bytes of a section by tag; reads the file at the first use.
    pub fn blocks(&mut self, section: StorageSection) -> &Blocks {
        self.load();
        self.contents.blocks(section)
    }

    /// Sets the bytes of a tag; None removes it.
    pub fn set_block(&mut self, section: StorageSection, tag: &str, bytes: Option<Vec<u8>>) {
        if self.blocks(section).get(tag) == bytes.as_ref() {
            return;
        }
        let blocks = self.contents.blocks_mut(section);
        match bytes {
            Some(bytes) => drop(blocks.insert(tag.to_owned(), bytes)),
            None => drop(blocks.remove(tag)),
        }
        self.mark(Dirty::Block(section, tag.to_owned()));
    }

    fn mark(&mut self, item: Dirty) {
        self.dirty.insert(item);
        self.failed = false;
    }

    fn load(&mut self) {
        if std::mem::replace(&mut self.loaded, true) {
            return;
        }
        let tape = self.permissions.tape().clone();
        match tape.input("persistent data", || self.read()) {
            Ok(Ok(contents)) => self.contents = contents,
            Ok(Err(notice)) => self.notices.push(notice),
            Err(_) => {}
        }
    }

    fn read(&self) -> Result<Contents, Notice> {
        let Some(folder) = &self.folder else {
            return Ok(Contents::default());
        };
        file::check_read(folder, &self.permissions)
            .and_then(|()| file::read(folder))
            .map_err(|failure| notice_of(&failure))
    }

    /// Brings the file up to date.
    pub(crate) fn save(&mut self) {
        if self.dirty.is_empty() || self.failed {
            return;
        }
        let tape = self.permissions.tape().clone();
        match tape.input("writing persistent data", || self.write()) {
            Ok(Ok((contents, notice))) => {
                self.contents = contents;
                self.dirty.clear();
                self.notices.extend(notice);
            }
            Ok(Err(notice)) => {
                self.failed = true;
                self.notices.push(notice);
            }
            Err(_) => self.failed = true,
        }
    }

    /// What the file holds then, and what was wrong with it before.
    fn write(&self) -> Result<(Contents, Option<Notice>), Notice> {
        let saved = match &self.folder {
            None => Err(Failure::NoFolder),
            Some(folder) => file::check_write(folder, &self.permissions).and_then(|()| {
                file::update(folder, |contents| {
                    self.dirty
                        .iter()
                        .for_each(|item| contents.copy_item(item, &self.contents));
                })
            }),
        };
        saved
            .map(|(contents, failure)| (contents, failure.as_ref().map(notice_of)))
            .map_err(|failure| notice_of(&failure))
    }
}

/// An error of the file as it is logged; a corrupt one has been renamed by then, and is replaced by an empty one.
fn notice_of(failure: &Failure) -> Notice {
    let level = if matches!(failure, Failure::Corrupt { .. }) {
        verbosity::WARNINGS
    } else {
        verbosity::ERRORS
    };
    (level, failure.to_string())
}

#[cfg(test)]
mod tests {
    use super::{AppStorage, Edit, StorageSection};
    use scene::{Data, ValueType};

    fn number(name: &str, n: i64) -> Edit<'_> {
        Edit::Name(name, Some((ValueType::Int, Data::Int(n))))
    }

    #[test]
    fn nothing_is_touched_before_it_is_used() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let storage_folder = folder.path().join("deep/inside");
        AppStorage::new(Some(&storage_folder)).save();
        assert!(!storage_folder.exists());
    }

    #[test]
    fn what_is_saved_is_there_again() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let mut storage = AppStorage::new(Some(folder.path()));
        storage.edit_custom_data(number("n", 7));
        storage.set_block(StorageSection::Tags, "&int&.n", Some(vec![0, 255]));
        storage.save();
        let mut again = AppStorage::new(Some(folder.path()));
        assert_eq!(
            again.custom_data().typed("n"),
            Some((ValueType::Int, &Data::Int(7)))
        );
        assert_eq!(
            again.blocks(StorageSection::Tags).get("&int&.n"),
            Some(&vec![0, 255])
        );
        assert!(again.blocks(StorageSection::Persistent).is_empty() && again.notices.is_empty());
    }

    #[test]
    fn two_simulators_do_not_undo_each_other() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let [mut a, mut b] = [(); 2].map(|()| AppStorage::new(Some(folder.path())));
        assert!(a.custom_data().typed("a").is_none() && b.custom_data().typed("b").is_none());
        a.edit_custom_data(number("a", 1));
        a.save();
        b.edit_custom_data(number("b", 2));
        b.save();
        assert_eq!(
            b.custom_data().typed("a"),
            Some((ValueType::Int, &Data::Int(1)))
        );
        assert_eq!(
            AppStorage::new(Some(folder.path()))
                .custom_data()
                .tags()
                .count(),
            2
        );
    }

    #[test]
    fn a_corrupt_file_is_set_aside() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        for n in 1..=2 {
            std::fs::write(folder.path().join("app-storage.cbor"), b"nonsense")
                .expect("our own folder is writable");
            let mut storage = AppStorage::new(Some(folder.path()));
            assert_eq!(storage.custom_data().tags().count(), 0);
            assert!(
                storage.notices[0]
                    .1
                    .contains(&format!("app-storage.cbor.corrupt-{n}")),
                "{:?}",
                storage.notices
            );
            let aside = folder.path().join(format!("app-storage.cbor.corrupt-{n}"));
            assert_eq!(std::fs::read(aside).ok().as_deref(), Some(&b"nonsense"[..]));
        }
    }

    #[test]
    fn a_failure_to_save_is_logged_once_and_the_data_stay() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let no_folder = folder.path().join("file");
        std::fs::write(&no_folder, b"").expect("our own folder is writable");
        let mut storage = AppStorage::new(Some(&no_folder));
        storage.set_block(StorageSection::Persistent, "t", Some(vec![1]));
        storage.notices.clear();
        storage.save();
        storage.save();
        assert_eq!(storage.notices.len(), 1, "{:?}", storage.notices);
        assert_eq!(
            storage.blocks(StorageSection::Persistent).get("t"),
            Some(&vec![1])
        );
    }
}
