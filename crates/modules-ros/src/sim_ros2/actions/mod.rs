//! Actions: goals that take time, with feedback and a result. An action is three services and two topics.

mod client;
mod goal;
mod server;
mod server_functions;

pub(super) use client::{ActionClient, FUNCTIONS as CLIENT_FUNCTIONS};
pub(super) use server::ActionServer;
pub(super) use server_functions::FUNCTIONS as SERVER_FUNCTIONS;
