//! Scenes and models between files and the scene: what `sim.loadScene`, `sim.loadModel` and their savers do.
//!
//! `load` puts what a file holds into a scene. The scripts of a file are handed on: running them is not known here.

pub(crate) mod load;

use crate::format::ttt::FileError;
use crate::scene::script_object::ScriptType;
use crate::scene::{Handle, SceneError};

/// What a file has brought into a scene.
#[derive(Debug, Default)]
pub struct Loaded {
    /// The objects, in the order of the file.
    pub objects: Vec<Handle>,
    /// The model: the last object without parent.
    pub root: Option<Handle>,
    /// Scripts outside of the tree: the main script, and those attached to objects.
    pub scripts: Vec<LoadedScript>,
}

/// A script outside of the tree of objects.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedScript {
    pub script_type: ScriptType,
    /// The object it is attached to; none for the main script.
    pub owner: Option<Handle>,
    pub code: Vec<u8>,
    pub language: String,
    pub disabled: bool,
    /// -1 before, 0 with, 1 after the others.
    pub exec_order: i64,
}

/// Why a file could not be brought into a scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LoadError {
    #[error(transparent)]
    File(#[from] FileError),
    #[error(transparent)]
    Scene(#[from] SceneError),
}
