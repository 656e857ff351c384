//! Threads that run tests, and the watch over them.
//!
//! A test that takes too long is asked to stop, which ends Lua code wherever it is. One that does not, since it is inside a function written in
//! C, is given up with its thread: another thread takes its place, and the process ends without it.
#![allow(
    clippy::disallowed_methods,
    reason = "how long tests take is watched by the wall clock"
)]

mod worker;

use std::collections::{HashMap, HashSet, VecDeque};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::Config;
use super::batch;
use super::case::{Outcome, Status, TestCase};
use super::plan::{Collection, Job};
use search::Found;
use simulator::Simulator;
use worker::Worker;

/// How often the clock is looked at.
const TICK: Duration = Duration::from_millis(20);
/// Time for a test to stop on request.
const STOP_TIME: Duration = Duration::from_secs(2);
/// The same when the user waits for the end.
const STOP_TIME_OF_USER: Duration = Duration::from_millis(500);
/// Time for a process of a test to start, and to give the test up itself.
const FOR_PROCESS: Duration = Duration::from_secs(5);

/// A piece of work.
#[derive(Debug, Clone)]
pub(super) enum Task {
    /// Learn what tests a file has.
    Collect(PathBuf),
    Run(Job),
    /// A run of a batch.
    Simulate(batch::Job),
}

/// Result of a task.
pub(super) enum Message {
    Collected(Box<Collection>),
    Finished(Box<Outcome>),
    /// The search of a property goes on.
    Progress(Arc<TestCase>, Box<Found>),
}

enum WorkerEvent {
    /// A worker begins with something that takes time, and can be asked to stop it.
    Started(Running),
    /// A case of it is over: the next one has the time of a test.
    NextCase,
    Ready(Message),
    /// A worker has nothing left to do.
    Gone,
}

struct Running {
    test: Arc<TestCase>,
    /// Remaining tests, for another worker if this one is abandoned.
    rest: Job,
    stop: Arc<AtomicBool>,
    started: Instant,
    /// When its last case began; when it started itself, without cases.
    case_started: Instant,
}

/// Remaining tasks.
struct Queue {
    tasks: VecDeque<Task>,
    /// Workers that get nothing any more.
    abandoned: HashSet<usize>,
}

/// State shared by all threads.
struct Shared {
    config: Config,
    queue: Mutex<Queue>,
    /// Nothing new is to be started.
    cancelled: AtomicBool,
}

impl Shared {
    fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    fn next_task(&self, worker: usize) -> Option<Task> {
        let mut queue = self.queue();
        let ends = self.cancelled.load(Ordering::Relaxed) || queue.abandoned.contains(&worker);
        if ends { None } else { queue.tasks.pop_front() }
    }
}

/// The threads, by number, with what they are at.
struct Watch<'a> {
    shared: Arc<Shared>,
    workers: HashMap<usize, Option<Running>>,
    next: usize,
    sender: Sender<(usize, WorkerEvent)>,
    events: Receiver<(usize, WorkerEvent)>,
    receive: &'a mut dyn FnMut(Message) -> bool,
    /// When the user wanted an end.
    interrupted: Option<Instant>,
}

/// Does the tasks on `config.jobs` threads and hands over what comes back, until all is done or `receive` wants no more to be started.
pub(super) fn work(config: &Config, tasks: Vec<Task>, receive: &mut dyn FnMut(Message) -> bool) {
    let count = config.jobs.clamp(1, tasks.len().max(1));
    let queue = Mutex::new(Queue {
        tasks: tasks.into(),
        abandoned: HashSet::new(),
    });
    let shared = Arc::new(Shared {
        config: config.clone(),
        queue,
        cancelled: AtomicBool::new(false),
    });
    let (sender, events) = mpsc::channel();
    let mut watch = Watch {
        shared,
        workers: HashMap::new(),
        next: 0,
        sender,
        events,
        receive,
        interrupted: None,
    };
    for _ in 0..count {
        watch.spawn();
    }
    while !watch.workers.is_empty() {
        if let Ok((worker, event)) = watch.events.recv_timeout(TICK) {
            watch.receive(worker, event);
        }
        watch.look_after();
    }
}

impl Watch<'_> {
    fn spawn(&mut self) {
        let (id, shared, sender) = (self.next, Arc::clone(&self.shared), self.sender.clone());
        self.next += 1;
        let thread = std::thread::Builder::new()
            .name(format!("tests {id}"))
            .stack_size(Simulator::STACK_SIZE);
        let worker = Worker { id, shared, sender };
        thread
            .spawn(move || worker.work())
            .expect("the system has a thread for the tests");
        self.workers.insert(id, None);
    }

    fn receive(&mut self, worker: usize, event: WorkerEvent) {
        // Messages of workers that were given up are ignored.
        let Some(running) = self.workers.get_mut(&worker) else {
            return;
        };
        match event {
            WorkerEvent::Started(started) => *running = Some(started),
            WorkerEvent::NextCase => {
                if let Some(running) = running {
                    running.case_started = Instant::now();
                }
            }
            WorkerEvent::Ready(message @ Message::Progress(..)) => self.take(message, None),
            WorkerEvent::Ready(message) => {
                let running = running.take();
                self.take(message, running);
            }
            WorkerEvent::Gone => drop(self.workers.remove(&worker)),
        }
    }

    fn take(&mut self, mut message: Message, running: Option<Running>) {
        if let (Message::Finished(outcome), Some(running)) = (&mut message, running) {
            outcome.wall = running.started.elapsed();
            if running.stop.load(Ordering::Relaxed) {
                outcome.status = Status::Error;
                outcome.message = too_long(self.shared.config.allowance.wall);
                if let Some(place) = outcome.stopped_at.take() {
                    outcome.message += &format!("\nIt was at {place}");
                }
                if let Some(property) = &outcome.property {
                    outcome.message += &property.unfinished;
                }
            }
        }
        // An interrupted test has no outcome.
        if self.is_interrupted() || !(self.receive)(message) {
            self.shared.cancel();
        }
    }

    fn is_interrupted(&self) -> bool {
        self.shared.config.interrupted.load(Ordering::Relaxed)
    }

    /// Stops what takes too long, and everything when the user wants an end.
    fn look_after(&mut self) {
        let interrupted = self.is_interrupted();
        if interrupted {
            self.shared.cancel();
            if self.interrupted.get_or_insert_with(Instant::now).elapsed() > STOP_TIME_OF_USER {
                // Workers that are still running end with the process.
                return self.workers.clear();
            }
        }
        let config = &self.shared.config;
        let limit = config.allowance.wall
            + if config.isolate.is_some() {
                FOR_PROCESS
            } else {
                Duration::ZERO
            };
        let mut stuck = Vec::new();
        for (&worker, running) in &self.workers {
            let Some(running) = running else { continue };
            let wall = running.case_started.elapsed();
            if interrupted || wall > limit {
                running.stop.store(true, Ordering::Relaxed);
            }
            if wall > limit + STOP_TIME {
                stuck.push(worker);
            }
        }
        stuck.into_iter().for_each(|worker| self.abandon(worker));
    }

    fn abandon(&mut self, worker: usize) {
        let mut queue = self.shared.queue();
        // A worker reports a test before it takes the next: with the queue locked and no event waiting, it is still at this one.
        if let Ok((sender, event)) = self.events.try_recv() {
            drop(queue);
            return self.receive(sender, event);
        }
        queue.abandoned.insert(worker);
        drop(queue);
        let Some(Some(running)) = self.workers.remove(&worker) else {
            return;
        };
        let message = too_long(self.shared.config.allowance.wall)
            + " It could not be ended: it is in a finalizer (__gc), or in a function that is not written in Lua.";
        let mut outcome = Outcome::new(Arc::clone(&running.test), Status::Error, message);
        outcome.wall = running.started.elapsed();
        let message = if running.test.index == 0 {
            Message::Collected(Box::new(Collection::broken(outcome)))
        } else {
            Message::Finished(Box::new(outcome))
        };
        if !(self.receive)(message) {
            self.shared.cancel();
        }
        if !running.rest.left().is_empty() {
            self.shared
                .queue()
                .tasks
                .push_front(Task::Run(running.rest));
        }
        self.spawn();
    }
}

pub(super) fn rest(time: Duration) {
    std::thread::sleep(time);
}

fn too_long(limit: Duration) -> String {
    format!(
        "the test took longer than {} s (--timeout).",
        limit.as_secs_f64()
    )
}

pub(super) const CRASHED: &str =
    "internal error in Swanilda, please report it: the simulator has crashed.";
