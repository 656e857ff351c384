//! Reports for other programs and for browsers: texts made from outcomes. Nothing here writes to a file or a terminal.
//!
//! `json` and `tap` write as tests finish, `junit` and `html` after the whole run. What tests and scripts printed
//! may be anything, so each report quotes all of it.

pub mod html;
pub mod json;
pub mod junit;
mod parts;
pub mod tap;

pub use parts::{console_line, files, moment};
