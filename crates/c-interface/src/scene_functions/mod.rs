//! Functions that scripts have too, but in C with other parameters or results: the count of a list stands elsewhere, lists have the
//! length that another parameter implies, or results are structures.

mod cameras;
mod display;
mod engine;
mod kinematics;
mod meshes;
mod objects;
mod pointers;
mod scripts;
mod settings;
mod stored_data;
mod voxels;

use super::functions::Function;

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: [&[(&str, Function)]; 10] = [
    cameras::FUNCTIONS,
    display::FUNCTIONS,
    engine::FUNCTIONS,
    kinematics::FUNCTIONS,
    meshes::FUNCTIONS,
    objects::FUNCTIONS,
    scripts::FUNCTIONS,
    settings::FUNCTIONS,
    stored_data::FUNCTIONS,
    voxels::FUNCTIONS,
];
