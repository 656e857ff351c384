//! The native part of `simUI` (`lua/modules/simUI.lua`): windows of scripts. Windows and widgets are in the crate `ui`; pages draw them.

mod arguments;
mod boxes;
mod dialogs;
mod headers;
mod pictures;
mod plots;
mod properties;
mod scene3d;
mod tables;
mod trees;
mod values;
mod windows;

use super::Module;

/// The module `simUI`.
pub static MODULE: Module = Module {
    about: "Windows with buttons, sliders, tables and plots.",
    functions: &[
        ("Windows", windows::FUNCTIONS),
        ("Buttons, numbers and texts", values::FUNCTIONS),
        ("Choices", boxes::FUNCTIONS),
        ("Tables", tables::FUNCTIONS),
        ("Columns of tables and trees", headers::FUNCTIONS),
        ("Trees", trees::FUNCTIONS),
        ("Plots", plots::FUNCTIONS),
        ("Pictures", pictures::FUNCTIONS),
        ("Properties", properties::FUNCTIONS),
        ("Scenes in windows", scene3d::FUNCTIONS),
        ("Dialogs", dialogs::FUNCTIONS),
    ],
    inner: &[windows::INNER],
    constants: include_str!("constants.tsv"),
    plugin_errors: true,
    ..Module::new("simUI")
};
