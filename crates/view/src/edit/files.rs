//! Files: what pages drop, and where the scene is saved.

use std::collections::BTreeMap;
use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use serde_json::{Value, json};

use format::gltf_file::GltfFile;
use format::scene_file::{SceneFile, write_whole};
use format::scene_folder::{self, Edits};
use format::scene_input::SceneInput;
use format::scene_outline::{Outline, differences};
use format::ttt::File;
use permissions::Permissions;
use scene::Data;
use simulator::{ScriptKind, Simulator};

use super::Editor;
use crate::request::Action;

/// Bytes of all files of one page that wait to be loaded.
const MAX_UPLOAD: usize = 512 << 20;
/// Files of one page.
const MAX_FILES: usize = 10_000;
/// Lines of the list of changes.
const MAX_CHANGES: usize = 2000;

/// Files by their paths below the folder that was dropped.
pub(crate) type Files = BTreeMap<String, Vec<u8>>;

/// Files that a page sends, piece by piece, before it loads one of them.
#[derive(Default)]
pub(crate) struct Uploads {
    files: Files,
    size: usize,
}

impl Uploads {
    /// Adds a piece to the end of a file.
    ///
    /// # Errors
    /// When the name leads out of the folder, or there is too much; nothing is kept then.
    pub(crate) fn add(&mut self, name: &str, piece: &[u8]) -> Result<(), String> {
        let is_new = !self.files.contains_key(name);
        self.size += piece.len();
        let reason = if !is_below(name) {
            Some(format!(
                "{name} is no path below the folder that was dropped"
            ))
        } else if self.size > MAX_UPLOAD || (is_new && self.files.len() >= MAX_FILES) {
            Some(format!(
                "at most {MAX_FILES} files with {} MB can be dropped at once",
                MAX_UPLOAD >> 20
            ))
        } else {
            None
        };
        if let Some(reason) = reason {
            *self = Self::default();
            return Err(reason);
        }
        self.files
            .entry(name.to_owned())
            .or_default()
            .extend_from_slice(piece);
        Ok(())
    }

    /// All files; there are none then.
    pub(crate) fn take(&mut self) -> Arc<Files> {
        Arc::new(std::mem::take(self).files)
    }
}

/// Whether a path stays below the folder that it begins in.
fn is_below(name: &str) -> bool {
    let parts = Path::new(name).components();
    !name.is_empty()
        && parts
            .into_iter()
            .all(|part| matches!(part, Component::Normal(_)))
}

/// The scene as a file of CoppeliaSim.
pub(super) fn bytes_of(sim: &mut Simulator) -> Result<Vec<u8>, String> {
    let saved = sim
        .call_api("sim.saveScene", &[])
        .map_err(|error| error.to_string())?;
    match saved.into_iter().next() {
        Some(Data::Buffer(bytes) | Data::Text(bytes)) => Ok(bytes),
        _ => Err("the scene has no bytes".into()),
    }
}

impl Editor {
    /// Loads one of the files that a page has sent: a scene takes the place of the present one, everything else comes into it, at a place
    /// (`position`) if there is one.
    pub(crate) fn load(
        &mut self,
        sim: &mut Simulator,
        action: &Action,
        (main, files): (&str, &Files),
        position: &Value,
    ) -> Result<Value, String> {
        if !files.contains_key(main) {
            return Err(format!("there is no file {main}"));
        }
        super::need_stopped(sim)?;
        let folder =
            unpacked(files).map_err(|error| format!("the files cannot be kept: {error}"))?;
        self.record(sim, action, |editor, sim| {
            let before = roots(sim);
            let messages = read(editor, sim, &folder.path().join(main))?;
            let new: Vec<i64> = roots(sim)
                .into_iter()
                .filter(|root| !before.contains(root))
                .collect();
            let arguments = json!({ "handles": new, "position": position, "name": main });
            let done = editor.call(sim, "loaded", &arguments)?;
            let mut result = done.result;
            result["messages"] = messages.into();
            Ok((done.label, result))
        })
    }

    /// Saves the scene, or a model (the handle of its base): the ending of the name says in which format, without one it becomes a folder.
    /// Where something is already, `exists` is true in the result, and nothing is written without `may_overwrite`.
    pub(crate) fn save(
        &mut self,
        sim: &mut Simulator,
        path: &str,
        model: Option<i64>,
        may_overwrite: bool,
    ) -> Result<Value, String> {
        super::need_stopped(sim)?;
        let path = absolute(sim, path)?;
        sim.permissions()
            .check_write(&path)
            .map_err(|denied| denied.to_string())?;
        if path.exists() && !may_overwrite {
            return Ok(json!({ "path": path, "exists": true }));
        }
        match model {
            Some(base) => save_model(sim, &path, base)?,
            None => self.save_scene(sim, &path)?,
        }
        Ok(json!({ "path": path, "exists": false }))
    }

    fn save_scene(&mut self, sim: &mut Simulator, path: &Path) -> Result<(), String> {
        let failed =
            |error: &dyn std::fmt::Display| format!("cannot write {}: {error}", path.display());
        if GltfFile::has_name_of(path) {
            let file = GltfFile::of_scene(&sim.scene()).map_err(|error| failed(&error))?;
            return file.write(path).map_err(|error| failed(&error));
        }
        if path.extension().is_some() {
            let name = Data::text(&path.to_string_lossy());
            sim.call_api("sim.saveScene", &[name])
                .map_err(|error| failed(&error))?;
        } else {
            let file = File::read(&bytes_of(sim)?).map_err(|error| failed(&error))?;
            scene_folder::unpack(&file, path, Edits::Keep).map_err(|error| failed(&error))?;
        }
        self.history.saved();
        self.base = Some(bytes_of(sim)?);
        Ok(())
    }

    /// What is different from the scene that was loaded or saved the last time, line by line.
    pub(crate) fn changes(&self, sim: &mut Simulator) -> Result<Value, String> {
        let Some(base) = &self.base else {
            return Ok(json!({ "text": "" }));
        };
        let report = differences(&outline(base)?, &outline(&bytes_of(sim)?)?);
        let lines: Vec<&str> = report.lines().take(MAX_CHANGES).collect();
        Ok(json!({ "text": lines.join("\n") }))
    }
}

fn outline(bytes: &[u8]) -> Result<Outline, String> {
    let file = File::read(bytes).map_err(|error| error.to_string())?;
    let file = SceneFile::new(file).map_err(|error| error.to_string())?;
    Outline::new(file)
}

fn save_model(sim: &mut Simulator, path: &Path, base: i64) -> Result<(), String> {
    let arguments = [Data::Int(base), Data::text(&path.to_string_lossy())];
    let saved = sim.call_api("sim.saveModel", &arguments);
    saved
        .map(drop)
        .map_err(|error| format!("cannot write {}: {error}", path.display()))
}

/// A path as people write it: from the folder of the scene, if that has one.
fn absolute(sim: &Simulator, path: &str) -> Result<PathBuf, String> {
    let path = path.trim();
    if path.is_empty() {
        return Err("a file needs a name".into());
    }
    let scene = PathBuf::from(&sim.scene().settings().path);
    let joined = scene
        .parent()
        .map_or_else(|| PathBuf::from(path), |folder| folder.join(path));
    std::path::absolute(&joined).map_err(|error| error.to_string())
}

fn roots(sim: &Simulator) -> Vec<i64> {
    sim.scene()
        .roots()
        .iter()
        .map(|handle| handle.raw())
        .collect()
}

fn unpacked(files: &Files) -> io::Result<tempfile::TempDir> {
    let folder = tempfile::tempdir()?;
    for (name, bytes) in files {
        let path = folder.path().join(name);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent)?;
        }
        write_whole(&path, bytes)?;
    }
    Ok(folder)
}

/// Brings a file into the scene; what was guessed or left out, a line each.
fn read(editor: &Editor, sim: &mut Simulator, path: &Path) -> Result<String, String> {
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    if ["stl", "obj", "ply", "dae", "3ds", "dxf", "off"]
        .iter()
        .any(|mesh| ending == *mesh)
    {
        let arguments = json!({ "path": path });
        return editor
            .function(sim, "importMesh", &arguments)
            .map(|_| String::new());
    }
    // The page sent it: what scripts may read has nothing to do with it.
    match SceneInput::read(path, &Permissions::all())? {
        SceneInput::Script(code) => {
            let name = path
                .file_stem()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            let added = sim.add_script(ScriptKind::Customization, &name, &code);
            added
                .map(|_| String::new())
                .map_err(|error| error.to_string())
        }
        SceneInput::File(file) => {
            let messages = file.messages().join("\n");
            let file = file.scene().map_err(|error| error.to_string())?;
            if !file.is_model() {
                sim.clear_scene();
            }
            sim.load(file).map_err(|error| error.to_string())?;
            Ok(messages)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_below_the_folder() {
        let mut uploads = Uploads::default();
        for name in ["", "/etc/passwd", "../a", "a/../../b", "./a"] {
            assert!(uploads.add(name, b"x").is_err(), "{name}");
        }
        assert_eq!(uploads.add("meshes/a.stl", b"so"), Ok(()));
        assert_eq!(uploads.add("meshes/a.stl", b"lid"), Ok(()));
        assert_eq!(uploads.take()["meshes/a.stl"], b"solid");
        assert!(uploads.take().is_empty());
    }

    #[test]
    fn too_much_is_refused_whole() {
        let mut uploads = Uploads {
            size: MAX_UPLOAD,
            ..Uploads::default()
        };
        assert!(uploads.add("a", b"x").is_err());
        assert_eq!(uploads.add("a", b"x"), Ok(()), "nothing was kept");
        for number in 1..MAX_FILES {
            uploads.add(&number.to_string(), b"").unwrap();
        }
        assert!(uploads.add("one more", b"").is_err());
    }
}
