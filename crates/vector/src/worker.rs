//! A thread with its worlds.

use std::ops::Range;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, OnceLock};
use std::thread::JoinHandle;
use std::time::Duration;

use io::signals::InterruptibleThread;
use script::interrupt_running_code;
use simulator::Simulator;

use crate::arrays::Arrays;
use crate::declaration::Declaration;
use crate::interruption::StopSign;
use crate::recordings::Recording;
use crate::world::{Layout, World};

/// A world that could not go on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// Its number.
    pub world: usize,
    /// Why: an error of a script, with its line, or what could not be read or written.
    pub reason: String,
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "world {}: {}", self.world, self.reason)
    }
}

impl std::error::Error for Failure {}

/// What a thread is to do.
pub(crate) enum Command {
    /// Step all worlds; those in `resets` begin an episode instead, and those that have failed wait.
    Step(Arc<Arrays>),
    /// Begin an episode in these worlds, from a seed where there is one.
    Begin(Arc<Arrays>, Arc<[(usize, Option<u32>)]>),
    /// Draw the pictures of the camera at that place.
    Draw(Arc<Arrays>, usize),
    /// Record the next episodes of worlds.
    Record(Arc<[Recording]>),
    /// Complete the recordings of these worlds' present episodes.
    FinishRecordings(Arc<[usize]>),
}

/// What a thread has done: the worlds that failed meanwhile.
type Done = Vec<Failure>;

/// The thread.
pub(crate) struct Worker {
    /// None when it is to end.
    commands: Option<Sender<Command>>,
    done: Receiver<Done>,
    made: Receiver<Result<Layout, Failure>>,
    thread: Option<JoinHandle<()>>,
    /// How signals reach the thread, which lives as long as this.
    scripts: Arc<OnceLock<InterruptibleThread>>,
    first: usize,
}

impl Worker {
    /// Begins to make the worlds with these numbers.
    pub(crate) fn start(
        declaration: Arc<Declaration>,
        worlds: Range<usize>,
        stop: StopSign,
    ) -> std::io::Result<Self> {
        let (commands, received) = channel();
        let (says_done, done) = channel();
        let (says_made, made) = channel();
        let first = worlds.start;
        let scripts = Arc::<OnceLock<_>>::default();
        let of_this_thread = Arc::clone(&scripts);
        let run = move || {
            of_this_thread.get_or_init(|| InterruptibleThread::current(interrupt_running_code));
            let made = make(&declaration, worlds, &stop);
            let layout = made.as_ref().map(|worlds| worlds[0].1.layout());
            let _ = says_made.send(layout.map_err(Clone::clone));
            let Ok(mut worlds) = made else { return };
            for command in received {
                let done = perform(&mut worlds, &command);
                if says_done.send(done).is_err() {
                    return;
                }
            }
        };
        let thread = std::thread::Builder::new()
            .name(format!("worlds from {first}"))
            .stack_size(Simulator::STACK_SIZE)
            .spawn(run)?;
        Ok(Self {
            commands: Some(commands),
            done,
            made,
            thread: Some(thread),
            scripts,
            first,
        })
    }

    /// The layout of its worlds; None where they are not there in time.
    pub(crate) fn layout(&self, limit: Duration) -> Option<Result<Layout, Failure>> {
        match self.made.recv_timeout(limit) {
            Ok(made) => Some(made),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => Some(Err(self.has_ended())),
        }
    }

    /// Says what is to be done; [`wait`](Self::wait) follows.
    pub(crate) fn send(&self, command: Command) {
        if let Some(commands) = &self.commands {
            // A thread that has ended says so where its answer is awaited.
            let _ = commands.send(command);
        }
    }

    /// What it has done; None where it is not ready in time.
    pub(crate) fn wait(&self, limit: Duration) -> Option<Vec<Failure>> {
        match self.done.recv_timeout(limit) {
            Ok(done) => Some(done),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => Some(vec![self.has_ended()]),
        }
    }

    /// Ends the script that runs, if one does, with an error.
    pub(crate) fn interrupt_script(&self) {
        if let Some(scripts) = self.scripts.get() {
            scripts.wake();
        }
    }

    fn has_ended(&self) -> Failure {
        Failure {
            world: self.first,
            reason: "its thread has ended: this is a fault of Swanilda.".into(),
        }
    }
}

impl Drop for Worker {
    /// Worlds end with their thread.
    fn drop(&mut self) {
        self.commands = None;
        if let Some(thread) = self.thread.take() {
            // It has ended, in whatever way.
            let _ = thread.join();
        }
    }
}

fn make(
    declaration: &Arc<Declaration>,
    numbers: Range<usize>,
    stop: &StopSign,
) -> Result<Vec<(usize, World)>, Failure> {
    let make = |world| {
        let number = u32::try_from(world).unwrap_or_default();
        let made = World::new(declaration, number, stop).map(|made| (world, made));
        made.map_err(|reason| Failure { world, reason })
    };
    numbers.map(make).collect()
}

fn perform(worlds: &mut [(usize, World)], command: &Command) -> Done {
    let mut failures = Vec::new();
    match command {
        Command::Step(arrays) => {
            for (number, world) in worlds {
                if arrays.resets.get(*number) != 0 {
                    note(&mut failures, arrays, *number, world.begin(*number, arrays));
                } else if arrays.failed.get(*number) == 0 {
                    note(&mut failures, arrays, *number, world.step(*number, arrays));
                }
            }
        }
        Command::Draw(arrays, camera) => {
            for (number, world) in worlds {
                let drawn = world.draw(*number, *camera, arrays);
                failures.extend(failure(*number, drawn));
            }
        }
        Command::Begin(arrays, which) => {
            for (number, seed) in which.iter() {
                let Some(world) = own(worlds, *number) else {
                    continue;
                };
                if let Some(seed) = seed {
                    world.set_seed(*seed);
                }
                note(&mut failures, arrays, *number, world.begin(*number, arrays));
            }
        }
        Command::Record(recordings) => {
            for recording in recordings.iter() {
                let recorded = own(worlds, recording.world).map(|world| world.record(recording));
                failures.extend(recorded.and_then(|recorded| failure(recording.world, recorded)));
            }
        }
        Command::FinishRecordings(which) => {
            for number in which.iter() {
                let finished = own(worlds, *number).map(World::finish_recording);
                failures.extend(finished.and_then(|finished| failure(*number, finished)));
            }
        }
    }
    failures
}

/// The world with that number, if it is one of this thread.
fn own(worlds: &mut [(usize, World)], number: usize) -> Option<&mut World> {
    let first = worlds.first()?.0;
    let (_, world) = worlds.get_mut(number.checked_sub(first)?)?;
    Some(world)
}

/// Notes how the step of a world or the beginning of its episode has ended.
fn note(failures: &mut Done, arrays: &Arrays, world: usize, result: Result<(), String>) {
    arrays.failed.set(world, result.is_err().into());
    failures.extend(failure(world, result));
}

fn failure(world: usize, result: Result<(), String>) -> Option<Failure> {
    result.err().map(|reason| Failure { world, reason })
}
