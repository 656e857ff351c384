//! Modules for messages and the world outside: sockets, files, programs, remote APIs.

pub mod cbor;
pub mod lfs;
pub mod mime;
pub mod remote;
pub mod sim_remote_api;
pub mod sim_subprocess;
pub mod sim_ws;
pub mod sim_zmq;
pub mod socket;

use script::{
    ApiError, ApiFn, ApiResult as Result, Args, Cx, FromScript, Module, Param, functions,
};
