//! What a simulator shows of itself: to pages of the viewer, and to recordings (docs/VIEW_PROTOCOL.md).
//!
//! Data flow in one direction. On the simulation's thread an [`Observer`](observe::Observer) reads the journal of the scene and returns an
//! [`Observation`](observe::Observation): only what changed. A [`Mirror`](mirror::Mirror) keeps the present state of all that is shown, each entry with the number of its last
//! change, and answers what changed since any number. So a reader may be as slow as it likes: it gets less often what is newer.
//! Pages are readers on the thread of a server; a recorder is one on the simulation's own.
//!
//! Requests of pages are checked on the server's thread ([`request`]) and carried out by the simulation's between two iterations ([`Viewer`]).
//! Those that change the scene are in [`edit`], with undo and redo; those about code that stands still are answered by [`debugging`].

pub(crate) mod blobs;
mod busy;
mod debugging;
mod edit;
mod hash;
mod images;
pub mod mcap;
pub(crate) mod mirror;
pub(crate) mod observe;
mod perform;
mod question;
pub mod recording;
pub(crate) mod request;
mod sample;
mod server;
mod viewer;

pub use busy::BusySign;
pub use debugging::Debugging;
pub use server::page_file;
pub use viewer::CaptureViewer;
pub use viewer::RecordedViewer;
pub use viewer::ReplayedRequests;
pub use viewer::Viewer;
