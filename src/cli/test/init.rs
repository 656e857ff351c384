//! `swanilda test --init`: an example test, and a workflow that runs it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

const FILES: [(&str, &str); 2] = [
    ("tests/robot_test.lua", include_str!("init/robot_test.lua")),
    (
        ".github/workflows/robot-tests.yml",
        include_str!("init/workflow.yml"),
    ),
];

/// Writes the files below `folder`; returns what was written. What is there stays as it is.
///
/// # Errors
/// When a file is there already, or cannot be written.
pub(super) fn write(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let files = FILES.map(|(path, text)| (folder.join(path), text));
    if let Some((path, _)) = files.iter().find(|(path, _)| path.exists()) {
        return Err(io::Error::new(
            io::ErrorKind::AlreadyExists,
            format!("{} exists already", path.display()),
        ));
    }
    for (path, text) in &files {
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        fs::write(
            path,
            text.replace("vVERSION", concat!("v", env!("CARGO_PKG_VERSION"))),
        )?;
    }
    Ok(files.map(|(path, _)| path).into())
}
