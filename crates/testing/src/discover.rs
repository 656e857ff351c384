//! Which files hold tests.

use std::io;
use std::path::{Path, PathBuf};

/// Deeper folders are not looked into: links may go in circles.
const MAX_DEPTH: usize = 32;

/// The test files at `paths`, sorted, each once. A file counts whatever its name; in a folder, `*_test.lua` and `test_*.lua` do, in the folders
/// below as well. Hidden folders and `target` and `node_modules` are left out.
///
/// # Errors
/// When a path does not exist or cannot be read.
pub fn find_files(paths: &[PathBuf]) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for path in paths {
        let about =
            |error: io::Error| io::Error::new(error.kind(), format!("{}: {error}", path.display()));
        if std::fs::metadata(path).map_err(about)?.is_dir() {
            search(path, 0, &mut files).map_err(about)?;
        } else {
            files.push(path.clone());
        }
    }
    files.sort();
    files.dedup();
    Ok(files)
}

fn search(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = if folder == Path::new(".") {
            PathBuf::from(&name)
        } else {
            entry.path()
        };
        if path.is_dir() {
            if depth < MAX_DEPTH
                && !name.starts_with('.')
                && name != "target"
                && name != "node_modules"
            {
                search(&path, depth + 1, files)?;
            }
        } else if is_test(&name) {
            files.push(path);
        }
    }
    Ok(())
}

fn is_test(name: &str) -> bool {
    name.strip_suffix(".lua")
        .is_some_and(|stem| stem.ends_with("_test") || stem.starts_with("test_"))
}

#[cfg(test)]
mod tests {
    use super::{find_files, is_test};

    #[test]
    fn tests_are_found_by_their_names() {
        assert!(is_test("drive_test.lua") && is_test("test_drive.lua"));
        assert!(
            !is_test("drive.lua")
                && !is_test("test_drive.py")
                && !is_test("contest.lua")
                && !is_test("tests.lua")
        );
    }

    #[test]
    fn folders_are_searched_and_files_are_taken_as_they_are() {
        let dir = tempfile::tempdir().expect("a folder");
        let path = |name: &str| dir.path().join(name);
        std::fs::create_dir_all(path("a/.git")).expect("folders");
        for name in [
            "b_test.lua",
            "a/test_x.lua",
            "a/.git/y_test.lua",
            "other.lua",
        ] {
            std::fs::write(path(name), "").expect("a file");
        }
        let found = find_files(&[dir.path().to_owned(), path("other.lua"), path("b_test.lua")])
            .expect("readable");
        assert_eq!(
            found,
            [path("a/test_x.lua"), path("b_test.lua"), path("other.lua")]
        );
        assert!(find_files(&[path("missing")]).is_err());
    }
}
