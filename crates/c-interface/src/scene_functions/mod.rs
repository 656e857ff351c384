//! Functions that scripts have too, but in C with other parameters or results: the count of a list stands elsewhere, lists have the
//! length that another parameter implies, or results are structures.

mod cameras;
mod engine;
mod kinematics;
mod meshes;
mod objects;
mod pointers;
mod scripts;
mod settings;
mod voxels;

use super::functions::Function;

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: [&[(&str, Function)]; 8] = [
    cameras::FUNCTIONS,
    engine::FUNCTIONS,
    kinematics::FUNCTIONS,
    meshes::FUNCTIONS,
    objects::FUNCTIONS,
    scripts::FUNCTIONS,
    settings::FUNCTIONS,
    voxels::FUNCTIONS,
];
