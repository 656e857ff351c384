//! Modules for images and points: filters, markers, registration, surfaces.

pub mod sim_icp;
pub mod sim_im;
pub mod sim_surf_rec;
pub mod sim_vision;

use script::{ApiError, ApiFn, ApiResult as Result, Args, Cx, FromScript, Module, functions};
