//! One server: its client, its errors, and whether the simulation waits for it.

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::VecDeque;
use std::io;
use std::net::{SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::time::Duration;

use capture::{Recorded, Tape};
use tempfile::TempDir;

use super::call::Failure;
use ::io::{EventLoop, SimxServer};
use script::Host;
use wire::simx::Session;

/// Texts of errors that are kept for the client.
const MAX_ERRORS: usize = 50;

/// When a server ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lifetime {
    /// With the simulator: the original calls it continuous.
    Simulator,
    /// With the simulation.
    Simulation,
    /// When a script ends it.
    Call,
}

/// What does not change.
#[derive(Debug, Clone, Copy)]
pub(super) struct Settings {
    /// Bytes of a packet.
    pub max_packet: usize,
    /// Whether an auxiliary console shows what happens.
    pub is_monitored: bool,
    /// Whether clients may switch to the synchronous mode.
    pub may_synchronize: bool,
}

/// A server at a port.
pub(super) struct Service {
    /// None in a replay.
    listener: Option<TcpListener>,
    address: SocketAddr,
    settings: Settings,
    lifetime: Lifetime,
    server: RefCell<Option<SimxServer>>,
    tape: Tape,
    synchronous: Cell<Option<Synchronous>>,
    errors: RefCell<VecDeque<String>>,
    /// The auxiliary console of a server that is monitored.
    pub(super) console: Cell<Option<i64>>,
    /// Commands of this server are being executed.
    pub(super) is_executing: Cell<bool>,
    /// Files of the client.
    files: OnceCell<Files>,
}

/// The folder for files of the client.
struct Files {
    path: PathBuf,
    /// It is removed with the server; None in a replay, which has no folder.
    _folder: Option<TempDir>,
}

/// The synchronous mode of a client.
#[derive(Debug, Clone, Copy)]
struct Synchronous {
    /// It ends with the connection.
    connection: u64,
    /// How many steps there were when the client allowed the next one; None before it did.
    triggered_at: Option<u64>,
}

impl Service {
    /// A server at a listener that `listen` opens; a replay opens none.
    ///
    /// # Errors
    /// Those of `listen`, and when the listener cannot be used.
    pub(super) fn start(
        event_loop: &EventLoop,
        tape: &Tape,
        listen: impl FnOnce() -> Result<TcpListener, String>,
        settings: Settings,
        lifetime: Lifetime,
        age: Duration,
    ) -> Result<Self, String> {
        let (mut listener, mut server) = (None, None);
        let address = tape.input("the address of the legacy remote API", || {
            let opened = listen()?;
            let address = opened.local_addr();
            let text = |error: io::Error| error.to_string();
            server = Some(run(event_loop, &opened, settings, age).map_err(text)?);
            listener = Some(opened);
            address.map_err(text).map(|address| address.to_string())
        });
        let address = address.map_err(|lost| lost.to_string())??;
        let address = address
            .parse()
            .map_err(|_| format!("'{address}' is no address"))?;
        Ok(Self {
            address,
            listener,
            settings,
            lifetime,
            server: server.into(),
            tape: tape.clone(),
            synchronous: Cell::new(None),
            errors: RefCell::default(),
            console: Cell::new(None),
            is_executing: Cell::new(false),
            files: OnceCell::new(),
        })
    }

    /// The same server without its client and what it wanted.
    ///
    /// # Errors
    /// When the listener cannot be used.
    pub(super) fn reset(&self, event_loop: &EventLoop, age: Duration) -> io::Result<()> {
        let mut server = None;
        let restarted = self.tape.input("a reset of the legacy remote API", || {
            if let Some(listener) = &self.listener {
                server = Some(run(event_loop, listener, self.settings, age)?);
            }
            Ok::<_, io::Error>(())
        });
        restarted??;
        self.synchronous.set(None);
        self.errors.borrow_mut().clear();
        drop(self.server.replace(server));
        Ok(())
    }

    pub(super) fn address(&self) -> SocketAddr {
        self.address
    }

    pub(super) fn port(&self) -> u16 {
        self.address.port()
    }

    pub(super) fn lifetime(&self) -> Lifetime {
        self.lifetime
    }

    pub(super) fn is_monitored(&self) -> bool {
        self.settings.is_monitored
    }

    /// What is known of the client, who waits meanwhile; None in a replay.
    pub(super) fn with_session<R>(&self, look: impl FnOnce(&mut Session) -> R) -> Option<R> {
        let server = self.server.borrow();
        Some(look(&mut server.as_ref()?.session()))
    }

    /// The same, captured and replayed.
    pub(super) fn ask<R: Recorded + Default>(
        &self,
        what: &str,
        look: impl FnOnce(&mut Session) -> R,
    ) -> R {
        let answer = self
            .tape
            .input(what, || self.with_session(look).unwrap_or_default());
        answer.unwrap_or_default()
    }

    /// The simulator is about to take the commands that wait.
    pub(super) fn acknowledge(&self) {
        if let Some(server) = &*self.server.borrow() {
            server.acknowledge();
        }
    }

    /// Results are there.
    pub(super) fn note_executed(&self) {
        if let Some(server) = &*self.server.borrow() {
            server.note_executed();
        }
    }

    fn connection(&self) -> Option<u64> {
        self.ask("a client of the legacy remote API", |session| {
            session.connection()
        })
    }

    /// Switches the synchronous mode on or off.
    ///
    /// # Errors
    /// When the server does not allow it.
    pub(super) fn synchronize(&self, on: bool) -> Result<(), Failure> {
        if !self.settings.may_synchronize {
            return Err(Failure::Text(
                "the synchronous mode is not enabled for this server.".into(),
            ));
        }
        let synchronous = self.connection().map(|connection| Synchronous {
            connection,
            triggered_at: None,
        });
        self.synchronous.set(synchronous.filter(|_| on));
        Ok(())
    }

    /// The simulation need not wait for this client any more.
    pub(super) fn end_synchronous_mode(&self) {
        self.synchronous.set(None);
    }

    /// Allows the step after so many.
    ///
    /// # Errors
    /// When the mode is not synchronous.
    pub(super) fn trigger(&self, steps: u64) -> Result<(), Failure> {
        let Some(synchronous) = self.present_synchronous() else {
            return Err(Failure::Text("the synchronous mode is off.".into()));
        };
        self.synchronous.set(Some(Synchronous {
            triggered_at: Some(steps),
            ..synchronous
        }));
        Ok(())
    }

    /// Whether the client must allow the step after so many.
    pub(super) fn is_waiting(&self, steps: u64) -> bool {
        self.present_synchronous()
            .is_some_and(|synchronous| synchronous.triggered_at != Some(steps))
    }

    /// The mode of the client that is connected.
    fn present_synchronous(&self) -> Option<Synchronous> {
        let synchronous = self.synchronous.get()?;
        (self.connection() == Some(synchronous.connection)).then_some(synchronous)
    }

    /// Remembers why a command failed.
    pub(super) fn note_error(&self, text: String) {
        let mut errors = self.errors.borrow_mut();
        if errors.len() >= MAX_ERRORS {
            errors.pop_front();
        }
        errors.push_back(text);
    }

    /// Why commands have failed since the last time.
    pub(super) fn take_errors(&self) -> Vec<String> {
        self.errors.borrow_mut().drain(..).collect()
    }

    /// The folder for the files of clients, which is made by the first call and removed with the server.
    ///
    /// # Errors
    /// When it cannot be made.
    pub(super) fn folder(&self, host: &Host<'_>) -> Result<&Path, Failure> {
        if let Some(folder) = self.files.get() {
            return Ok(&folder.path);
        }
        let mut made = None;
        let path = self.tape.input("a folder of the legacy remote API", || {
            let folder = temporary_folder(host)?;
            let path = folder.path().to_string_lossy().into_owned();
            made = Some(folder);
            Ok(path)
        });
        let path = path.map_err(|lost| Failure::Text(lost.to_string()))?;
        let folder = Files {
            path: path.map_err(Failure::Text)?.into(),
            _folder: made,
        };
        Ok(&self.files.get_or_init(|| folder).path)
    }
}

fn temporary_folder(host: &Host<'_>) -> Result<TempDir, String> {
    let permissions = &host.options().permissions;
    permissions
        .check_write(&std::env::temp_dir())
        .map_err(|denied| denied.to_string())?;
    TempDir::with_prefix("swanilda-remote-api-").map_err(|error| error.to_string())
}

fn run(
    event_loop: &EventLoop,
    listener: &TcpListener,
    settings: Settings,
    age: Duration,
) -> io::Result<SimxServer> {
    let session = Session::new(settings.is_monitored);
    SimxServer::start(
        event_loop,
        listener.try_clone()?,
        settings.max_packet,
        session,
        age,
    )
}
