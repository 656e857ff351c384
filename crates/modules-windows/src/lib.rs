//! The module simUI: windows of scripts.

pub mod sim_ui;

use script::{ApiError, ApiFn, ApiResult as Result, Args, Cx, FromScript, Module, functions};
