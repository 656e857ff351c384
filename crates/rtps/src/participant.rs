//! A core with sockets and a thread that serves them.

use std::hash::{BuildHasher, RandomState};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use heap::resource::Resource;
use rustix::event::{PollFd, PollFlags, Timespec, poll};

use crate::Limits;
use crate::core::{Core, CoreSettings};
use crate::guid::Prefix;
use crate::network::{Discovery, Network, OpenError, Range, Sockets};

/// How long the thread sleeps at most, so that an end is noticed.
const MAX_SLEEP: Duration = Duration::from_millis(100);
/// Datagrams are read in batches, so that the program can get in between.
const BATCH: usize = 64;

/// A participant of a domain. It ends when it is dropped, and says so to the others.
pub struct Participant {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
    _resource: Resource,
}

struct Shared {
    core: Mutex<Core>,
    /// Something was received.
    arrived: Condvar,
    sockets: Sockets,
    started: Instant,
    is_ended: AtomicBool,
}

impl Participant {
    /// Joins a domain. `name` is for people, `user_data` for programs.
    ///
    /// # Errors
    /// There is no such domain, or the system has no socket for it.
    pub fn new(
        domain: u32,
        network: Network,
        discovery: &Discovery,
        name: &str,
        user_data: &[u8],
    ) -> Result<Self, OpenError> {
        let sockets = Sockets::open(domain, network, discovery.range)?;
        let settings = CoreSettings {
            prefix: new_prefix(),
            domain,
            unicast: sockets.address,
            announce_to: sockets.announce_to(domain, discovery),
            has_multicast: sockets.multicast().is_some(),
            is_alone: discovery.range == Range::Off,
            name: name.to_string(),
            user_data: user_data.to_vec(),
            is_loopback_only: sockets.is_loopback_only,
            limits: Limits::default(),
        };
        let (core, arrived) = (Mutex::new(Core::new(settings)), Condvar::new());
        let shared = Arc::new(Shared {
            core,
            arrived,
            sockets,
            started: now(),
            is_ended: AtomicBool::new(false),
        });
        let of_thread = shared.clone();
        let thread = std::thread::Builder::new()
            .name("rtps".into())
            .spawn(move || of_thread.serve());
        let refused = |error| OpenError::Socket {
            domain,
            address: *shared.sockets.address.ip(),
            error,
        };
        Ok(Self {
            thread: Some(thread.map_err(refused)?),
            shared,
            _resource: Resource::new(|| "the node of ROS 2".to_owned()),
        })
    }

    /// Why announcements by multicast are neither sent nor received, though they should be.
    pub fn multicast_error(&self) -> Option<String> {
        let error = self.shared.sockets.multicast.as_ref().err();
        error.map(std::io::Error::to_string)
    }

    /// Does something with the core, and sends what that leads to.
    pub fn with<T>(&self, action: impl FnOnce(&mut Core) -> T) -> T {
        let mut core = self.shared.lock();
        let result = action(&mut core);
        self.shared.send(core);
        result
    }

    /// Waits until something is received, or the time is over.
    pub fn wait(&self, timeout: Duration) {
        let core = self.shared.lock();
        drop(self.shared.arrived.wait_timeout(core, timeout));
    }
}

impl Drop for Participant {
    fn drop(&mut self) {
        self.with(Core::leave);
        self.shared.is_ended.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // The thread returns nothing; a panic in it would have ended only the participant.
            thread.join().ok();
        }
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Core> {
        self.core.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn send(&self, mut core: MutexGuard<Core>) {
        let outgoing = core.take_outgoing();
        // In order, so before another thread can send.
        outgoing
            .iter()
            .for_each(|datagram| self.sockets.send(datagram.to, &datagram.bytes));
    }

    fn serve(&self) {
        let mut buffer = vec![0; 65536];
        while !self.is_ended.load(Ordering::Relaxed) {
            let mut core = self.lock();
            let time = self.time();
            let sleep = core.tick(time).saturating_sub(time).min(MAX_SLEEP);
            self.send(core);
            self.sleep(sleep);
            self.read(&self.sockets.unicast, &mut buffer);
            if let Some(multicast) = self.sockets.multicast() {
                self.read(multicast, &mut buffer);
            }
        }
    }

    fn time(&self) -> Duration {
        now().saturating_duration_since(self.started)
    }

    /// Sleeps until something can be read.
    fn sleep(&self, time: Duration) {
        let sockets = [&self.sockets.unicast].into_iter();
        let sockets = sockets.chain(self.sockets.multicast());
        let mut sockets: Vec<_> = sockets
            .map(|socket| PollFd::new(socket, PollFlags::IN))
            .collect();
        let timeout = Timespec {
            tv_sec: time.as_secs() as i64,
            tv_nsec: i64::from(time.subsec_nanos()),
        };
        // An interrupted wait is treated as one that has timed out.
        poll(&mut sockets, Some(&timeout)).ok();
    }

    fn read(&self, socket: &std::net::UdpSocket, buffer: &mut [u8]) {
        let mut core = self.lock();
        let mut count = 0;
        while count < BATCH
            && let Some((length, from)) = self.sockets.receive(socket, buffer)
        {
            core.receive(&buffer[..length], from, self.time());
            count += 1;
        }
        self.send(core);
        if count > 0 {
            self.arrived.notify_all();
        }
    }
}

#[expect(
    clippy::disallowed_methods,
    reason = "the protocol is about time; no result of a simulation comes from here but what peers send"
)]
fn now() -> Instant {
    Instant::now()
}

/// A name that no other participant has: from the system's random numbers, and different within the process.
fn new_prefix() -> Prefix {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    let random = RandomState::new().hash_one((std::process::id(), count));
    let mut prefix = [0; 12];
    // The first two bytes are the vendor identifier, 0 for an unknown vendor.
    prefix[2..10].copy_from_slice(&random.to_be_bytes());
    prefix[10..].copy_from_slice(&(count as u16).to_be_bytes());
    prefix
}
