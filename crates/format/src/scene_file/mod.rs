//! Scenes and models between files and the scene: the implementation of `sim.loadScene`, `sim.loadModel` and saving.
//!
//! [`SceneFile`] puts what a file holds into a scene, [`save`] makes a file of a scene. The scripts of a file are handed on: running them
//! is not known here.

mod load;
mod migrate;
mod read;
pub mod save;
mod write;

#[cfg(test)]
mod bad_input;
#[cfg(test)]
pub(crate) mod tests;

pub use load::SceneFile;
pub use migrate::old_names;
pub use migrate::with_compat;
pub use read::{is_scene, read_file, read_path};
pub use write::write_whole;
pub use write::{WholeFile, is_special, link_target, part_of};

use crate::ttt::{FileResult, container};
use scene::object::script_object::ScriptType;
use scene::{Handle, Scene, SceneResult};

impl SceneFile {
    /// The bytes of a file of this scene, as CoppeliaSim 4.10 writes them. `scripts` are those outside of the tree.
    ///
    /// # Errors
    /// When the tree of the scene is damaged.
    pub fn bytes_of(scene: &Scene, scripts: &[LoadedScript]) -> SceneResult<Vec<u8>> {
        Ok(save::scene(scene, scripts)?.write())
    }

    /// Body of a file: the bytes after its header, uncompressed.
    ///
    /// # Errors
    /// When the header or the compressed data are damaged.
    pub fn body(bytes: &[u8]) -> FileResult<Vec<u8>> {
        Ok(container::unpack(bytes)?.1)
    }
}

/// Objects that a file added to a scene.
#[derive(Debug, Default)]
pub struct Loaded {
    /// The objects, in the order of the file.
    pub objects: Vec<Handle>,
    /// The model: the last object without parent.
    pub root: Option<Handle>,
    /// Scripts outside of the tree: the main script, and those attached to objects.
    pub scripts: Vec<LoadedScript>,
}

/// The text of a script in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ScriptCode {
    /// The path of its object, and what kind it is where it is none itself: `/Robot@simulationScript`.
    pub name: String,
    /// The text, as its bytes are in the file.
    pub code: Vec<u8>,
    /// Such as `lua` or `python`.
    pub language: String,
}

/// A script outside of the tree of objects.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedScript {
    /// Whether it is a main script, simulation script or another one.
    pub script_type: ScriptType,
    /// The object it is attached to; none for the main script.
    pub owner: Option<Handle>,
    /// The text, as its bytes are in the file.
    pub code: Vec<u8>,
    /// The file the text is from, as stack traces name it.
    pub source: Option<String>,
    /// Such as `lua` or `python`.
    pub language: String,
    /// Whether it does not run.
    pub disabled: bool,
    /// -1 before, 0 with, 1 after the others.
    pub exec_order: i64,
}

/// The files that the texts of scripts are from, by the places of objects and of scripts outside of the tree in the file.
#[derive(Debug, Clone, Default)]
pub struct ScriptSources {
    /// For each object that is a script.
    pub objects: Vec<Option<String>>,
    /// For each script outside of the tree.
    pub attached: Vec<Option<String>>,
}
