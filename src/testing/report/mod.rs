//! Reports for other programs and for browsers: texts made from outcomes. Nothing here writes to a file or a terminal.
//!
//! `json` and `tap` have a text for each moment of a run, `junit` and `html` one for the whole of it. What tests and scripts said
//! may be anything, so each report quotes all of it.

pub mod html;
pub mod json;
pub mod junit;
mod parts;
pub mod tap;

pub use parts::{console_line, files, moment};
