//! Where the simulator keeps what takes long to compute, for itself and for others.

use std::num::NonZero;
use std::path::PathBuf;
use std::thread::available_parallelism;

use dynamics::FormMaker;
use file_cache::FileCache;
use permissions::Permissions;

use super::Options;

/// Bytes that convex pieces of meshes may take in files: some hundred robots.
const MAX_PIECES: u64 = 256 << 20;

/// A folder with what takes long to compute, such as the convex pieces of meshes. Results do not depend on it, and it may be removed at any time.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum CacheFolder {
    /// Where the system keeps the caches of the user.
    #[default]
    User,
    /// This one.
    Folder(PathBuf),
    /// Nothing is kept in files.
    None,
}

impl CacheFolder {
    fn path(&self) -> Option<PathBuf> {
        match self {
            Self::User => {
                let folders = directories::ProjectDirs::from("", "", "swanilda")?;
                Some(folders.cache_dir().to_owned())
            }
            Self::Folder(folder) => Some(folder.clone()),
            Self::None => None,
        }
    }
}

impl Options {
    /// How forms are made of meshes. Scenes that are not trusted leave nothing in files.
    pub(crate) fn form_maker(&self) -> FormMaker {
        let folder = self.cache.path();
        let kept = folder.map(|folder| FileCache::new(folder.join("convex-pieces"), MAX_PIECES));
        let is_trusted = self.permissions == Permissions::all();
        FormMaker {
            threads: self
                .render_threads
                .or_else(|| available_parallelism().ok())
                .unwrap_or(NonZero::<usize>::MIN),
            kept: kept.map(|kept| if is_trusted { kept } else { kept.read_only() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use file_cache::Key;

    fn keeps(options: &Options) -> bool {
        let key = Key::of(&[b"test"]);
        let kept = options.form_maker().kept;
        kept.is_some_and(|kept| {
            kept.put(&[(key, Vec::new())]);
            kept.get(&key).is_some()
        })
    }

    #[test]
    fn what_is_not_trusted_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut options = Options {
            cache: CacheFolder::Folder(folder.path().to_owned()),
            permissions: Permissions::strict(),
            ..Options::default()
        };
        assert!(!keeps(&options));
        assert_eq!(folder.path().read_dir().unwrap().count(), 0);
        options.permissions = Permissions::all();
        assert!(keeps(&options));
        // But what others have kept is of use.
        options.permissions = Permissions::none();
        assert!(keeps(&options));
        options.cache = CacheFolder::None;
        assert!(options.form_maker().kept.is_none());
    }
}
