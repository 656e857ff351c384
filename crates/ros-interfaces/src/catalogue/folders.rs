//! Files of interfaces in folders.

use std::collections::VecDeque;
use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use crate::{InterfaceError, InterfaceKind, TypeName, limits};

/// The most folders that one search looks into.
const SEARCHED: usize = 20_000;

/// Where types are searched.
#[derive(Clone, Default)]
pub(super) struct Folders {
    roots: Vec<PathBuf>,
}

impl Folders {
    pub(super) fn add(&mut self, folder: PathBuf) {
        if !self.roots.contains(&folder) {
            self.roots.push(folder);
        }
    }

    /// The path and the text of an interface's file. None if there is none.
    pub(super) fn read(&self, name: &TypeName) -> Result<Option<(String, String)>, InterfaceError> {
        let file = Path::new(name.kind.word()).join(format!("{}.{}", name.name, name.kind.word()));
        for root in &self.roots {
            if let Some(package) = package_folder(root, &name.package, &file) {
                return read_text(&package.join(&file)).map(Some);
            }
        }
        Ok(None)
    }

    /// The names of all files.
    pub(super) fn names(&self) -> impl Iterator<Item = TypeName> {
        self.roots
            .iter()
            .flat_map(|root| packages(root))
            .flat_map(|package| names_in(&package))
    }
}

/// The package's folder below `root` that has this file.
fn package_folder(root: &Path, package: &str, file: &Path) -> Option<PathBuf> {
    let itself = root
        .file_name()
        .is_some_and(|name| name == package)
        .then(|| root.to_path_buf());
    let direct = itself
        .into_iter()
        .chain([root.join("share").join(package), root.join(package)]);
    let mut candidates = direct
        .chain(packages(root).filter(|folder| folder.file_name().is_some_and(|n| n == package)));
    candidates.find(|folder| folder.join(file).is_file())
}

/// The folders below `root`, itself included, that have a folder of interfaces.
fn packages(root: &Path) -> impl Iterator<Item = PathBuf> {
    let mut waiting = VecDeque::from([(root.to_path_buf(), 0)]);
    let mut searched = 0;
    std::iter::from_fn(move || {
        while let Some((folder, depth)) = waiting.pop_front() {
            searched += 1;
            if depth < limits::FOLDERS && searched + waiting.len() < SEARCHED {
                waiting.extend(
                    folders_in(&folder)
                        .into_iter()
                        .map(|inner| (inner, depth + 1)),
                );
            }
            if InterfaceKind::ALL
                .iter()
                .any(|kind| folder.join(kind.word()).is_dir())
            {
                return Some(folder);
            }
        }
        None
    })
}

/// In order, so that the same type is found on every machine. Links are left out, which may lead in circles.
fn folders_in(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let folders = entries
        .flatten()
        .filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()));
    let mut folders: Vec<PathBuf> = folders.map(|entry| entry.path()).collect();
    folders.sort();
    folders
}

fn names_in(package: &Path) -> Vec<TypeName> {
    let Some(name) = package.file_name().and_then(|name| name.to_str()) else {
        return Vec::new();
    };
    let of_kind = |kind: InterfaceKind| {
        let entries = fs::read_dir(package.join(kind.word()))
            .into_iter()
            .flatten()
            .flatten();
        entries.filter_map(move |entry| {
            let path = entry.path();
            let fits = path
                .extension()
                .is_some_and(|extension| extension == kind.word());
            TypeName::new(name, kind, path.file_stem()?.to_str()?)
                .ok()
                .filter(|_| fits)
        })
    };
    InterfaceKind::ALL.into_iter().flat_map(of_kind).collect()
}

fn read_text(path: &Path) -> Result<(String, String), InterfaceError> {
    let error = |problem: std::io::Error| InterfaceError::File {
        file: path.display().to_string(),
        problem: match problem.kind() {
            ErrorKind::InvalidData => "not UTF-8".into(),
            _ => problem.to_string(),
        },
    };
    let mut text = String::new();
    let file = fs::File::open(path).map_err(error)?;
    // One byte more than allowed is read, so that the parser reports the size.
    file.take(limits::TEXT as u64 + 1)
        .read_to_string(&mut text)
        .map_err(error)?;
    Ok((path.display().to_string(), text))
}
