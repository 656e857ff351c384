//! The modules simUI and simQML: windows of scripts.

pub mod sim_qml;
pub mod sim_ui;

use script::{ApiError, ApiFn, ApiResult as Result, Args, Cx, FromScript, Module, functions};
