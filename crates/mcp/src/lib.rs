//! The Model Context Protocol, as a server speaks it: JSON-RPC messages, sessions, standard input and output, streamable HTTP on the loopback.
//!
//! It knows no simulator: a [`Service`] has the tools and resources. All calls of a service happen on the thread that serves, one after the
//! other; other threads only read and write bytes.

mod http;
mod message;
mod progress;
mod running;
mod service;
mod session;
mod stdio;

pub use http::{HttpServer, Secret};
pub use message::{Fault, Message, code, parse};
pub use progress::{Notify, Progress};
pub use running::Running;
pub use service::{About, Answer, Content, Contents, NotFound, Resource, Service, Template, Tool};
pub use session::{LATEST, Session, VERSIONS};
pub use stdio::{MAX_LINE, serve};
