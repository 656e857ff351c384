//! Files beside a scene: pixels and arrays that were too large for its text. Names lead into the folder of the scene, never out of it.

use std::path::{Component, Path};

use permissions::Permissions;

/// Those of one scene.
#[derive(Debug, Clone, Copy)]
pub(super) struct SideFiles<'a> {
    /// The folder of the scene; none for a scene out of a buffer.
    pub folder: Option<&'a Path>,
    /// Links may lead out of it.
    pub permissions: &'a Permissions,
}

impl SideFiles<'_> {
    /// # Errors
    /// In words.
    pub(super) fn read(self, name: &str) -> Result<Vec<u8>, String> {
        let folder = self
            .folder
            .ok_or_else(|| format!("the file '{name}' beside the scene is not in the buffer"))?;
        let path = Path::new(name);
        if name.is_empty()
            || !path
                .components()
                .all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
        {
            return Err(format!(
                "the file '{name}' is not in the folder of the scene"
            ));
        }
        let read = self.permissions.read_file(&folder.join(path));
        read.map_err(|error| format!("the file '{name}' cannot be read: {error}"))
    }
}

/// Bytes that are taken from the front. Lengths are checked before anything is made of them.
pub(super) struct Bytes<'a>(pub &'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (taken, rest) = self
            .0
            .split_at_checked(count)
            .ok_or("the file is too short for what it announces")?;
        self.0 = rest;
        Ok(taken)
    }

    pub(super) fn int(&mut self) -> Result<i32, String> {
        let bytes = self.take(4)?;
        Ok(i32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
    }

    /// As many items of a size as a number before them says.
    pub(super) fn counted<const SIZE: usize>(&mut self) -> Result<&'a [[u8; SIZE]], String> {
        let count = usize::try_from(self.int()?).map_err(|_| "a length is negative")?;
        let bytes = count.checked_mul(SIZE).ok_or("a length is too large")?;
        Ok(self.take(bytes)?.as_chunks().0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_outside_of_the_folder_is_read() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("inner")).unwrap();
        std::fs::write(folder.path().join("mesh.bin"), "x").unwrap();
        let all = Permissions::all();
        let of = |folder| SideFiles {
            folder,
            permissions: &all,
        };
        assert_eq!(of(Some(folder.path())).read("./mesh.bin").unwrap(), b"x");
        let inner = folder.path().join("inner");
        for name in ["../mesh.bin", "", "/etc/passwd", "a/../../mesh.bin"] {
            assert!(
                of(Some(&inner))
                    .read(name)
                    .unwrap_err()
                    .contains("not in the folder"),
                "{name}"
            );
        }
        assert!(of(None).read("mesh.bin").is_err());
        let none = SideFiles {
            folder: Some(folder.path()),
            permissions: &Permissions::none(),
        };
        assert!(none.read("mesh.bin").unwrap_err().contains("--allow-read"));
    }

    #[test]
    fn lengths_that_lie_are_errors() {
        for length in [i32::MAX, -1, 2] {
            assert!(
                Bytes(&[&length.to_le_bytes()[..], &[0; 7]].concat())
                    .counted::<4>()
                    .is_err()
            );
        }
        assert_eq!(Bytes(&[1, 0, 0, 0, 7]).counted::<1>().unwrap(), [[7]]);
    }
}
