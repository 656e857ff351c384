//! The native part of `simEigen` (`lua/modules/simEigen.lua`): matrices and quaternions of scripts, by handles. The numbers are nalgebra's; indices are from 0.

mod elementwise;
mod linear;
mod matrices;
mod quaternions;
mod reductions;
mod store;

use super::Module;

/// The module `simEigen`.
pub static MODULE: Module = Module {
    functions: &[
        ("Matrices", matrices::FUNCTIONS),
        ("Element by element", elementwise::FUNCTIONS),
        ("Numbers of matrices", reductions::FUNCTIONS),
        ("Linear algebra", linear::FUNCTIONS),
        ("Quaternions", quaternions::FUNCTIONS),
    ],
    constants: include_str!("constants.tsv"),
    reference: "unittest\tTests\t\tsimEigen.unittest()\n",
    ..Module::new("simEigen")
};
