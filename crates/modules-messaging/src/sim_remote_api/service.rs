//! One server: its client, its errors, and whether the simulation waits for it.

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::VecDeque;
use std::io;
use std::net::{SocketAddr, TcpListener};
use std::path::Path;
use std::time::Duration;

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
    listener: TcpListener,
    address: SocketAddr,
    settings: Settings,
    lifetime: Lifetime,
    server: RefCell<SimxServer>,
    synchronous: Cell<Option<Synchronous>>,
    errors: RefCell<VecDeque<String>>,
    /// The auxiliary console of a server that is monitored.
    pub(super) console: Cell<Option<i64>>,
    /// Commands of this server are being executed.
    pub(super) is_executing: Cell<bool>,
    /// Files of the client.
    files: OnceCell<TempDir>,
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
    /// # Errors
    /// When the listener cannot be used.
    pub(super) fn start(
        event_loop: &EventLoop,
        listener: TcpListener,
        settings: Settings,
        lifetime: Lifetime,
        age: Duration,
    ) -> io::Result<Self> {
        let server = run(event_loop, &listener, settings, age)?;
        Ok(Self {
            address: listener.local_addr()?,
            listener,
            settings,
            lifetime,
            server: server.into(),
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
        let server = run(event_loop, &self.listener, self.settings, age)?;
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

    /// The client waits meanwhile.
    pub(super) fn with_session<R>(&self, look: impl FnOnce(&mut Session) -> R) -> R {
        look(&mut self.server.borrow().session())
    }

    /// The simulator is about to take the commands that wait.
    pub(super) fn acknowledge(&self) {
        self.server.borrow().acknowledge();
    }

    /// Results are there.
    pub(super) fn note_executed(&self) {
        self.server.borrow().note_executed();
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
        let connection = self.with_session(|session| session.connection());
        let synchronous = connection.map(|connection| Synchronous {
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
        let connection = self.with_session(|session| session.connection());
        (connection == Some(synchronous.connection)).then_some(synchronous)
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
            return Ok(folder.path());
        }
        let parent = std::env::temp_dir();
        host.options()
            .permissions
            .check_write(&parent)
            .map_err(|denied| Failure::Text(denied.to_string()))?;
        let folder = TempDir::with_prefix("swanilda-remote-api-")
            .map_err(|error| Failure::Text(error.to_string()))?;
        Ok(self.files.get_or_init(|| folder).path())
    }
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
