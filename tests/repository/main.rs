//! What must hold for the files of the repository: who imports what, pages that are generated, references of the documentation.

mod architecture;
mod called_functions;
mod generated;
mod spec_references;
