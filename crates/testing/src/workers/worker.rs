//! A thread that does tasks with a simulator at a time.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;
use std::time::Instant;

use super::super::batch;
use super::super::case::{Outcome, Status, TestCase};
use super::super::isolated;
use super::super::plan::{Collection, Job};
use super::super::property::Property;
use super::super::session::Session;
use super::{CRASHED, Message, Running, Shared, Task, WorkerEvent};
use simulator::Tape;

/// A thread with a simulator at a time.
pub(super) struct Worker {
    pub(super) id: usize,
    pub(super) shared: Arc<Shared>,
    pub(super) sender: Sender<(usize, WorkerEvent)>,
}

impl Worker {
    /// Does tasks as long as there are any.
    pub(super) fn work(self) {
        while let Some(task) = self.shared.next_task(self.id) {
            match task {
                Task::Collect(file) => self.collect(&file),
                Task::Run(job) => match self.shared.config.isolate {
                    Some(command) => self.run_isolated(job, command),
                    None => self.run(job),
                },
                Task::Simulate(job) => self.simulate(&job),
            }
        }
        self.send(WorkerEvent::Gone);
    }

    /// Without a receiver the run is over, and so is this thread's work.
    fn send(&self, event: WorkerEvent) {
        let _ = self.sender.send((self.id, event));
    }

    /// The rest of a job is left to other workers, or dropped.
    fn is_to_end(&self) -> bool {
        self.shared.cancelled.load(Ordering::Relaxed)
            || self.shared.queue().abandoned.contains(&self.id)
    }

    fn begin(&self, test: &Arc<TestCase>, rest: Job, stop: &Arc<AtomicBool>) {
        let (test, stop) = (Arc::clone(test), Arc::clone(stop));
        let now = Instant::now();
        self.send(WorkerEvent::Started(Running {
            test,
            rest,
            stop,
            started: now,
            case_started: now,
        }));
    }

    fn collect(&self, file: &Path) {
        let test = Arc::new(TestCase::of_file(file));
        let stop = Arc::new(AtomicBool::new(false));
        self.begin(&test, Job::none(), &stop);
        let config = &self.shared.config;
        let collect =
            || Session::new(config, file, config.seed, stop, &Tape::default()).collect(file);
        let collection = catch_unwind(AssertUnwindSafe(collect))
            .unwrap_or_else(|_| Collection::broken(Outcome::new(test, Status::Error, CRASHED)));
        self.send(WorkerEvent::Ready(Message::Collected(Box::new(collection))));
    }

    /// Runs tests in one simulator; those after one that had to be stopped get another.
    fn run(&self, mut job: Job) {
        while let Some(first) = job.left().first().cloned()
            && !self.is_to_end()
        {
            let stop = Arc::new(AtomicBool::new(false));
            self.begin(&first, job.rest(), &stop);
            let left = catch_unwind(AssertUnwindSafe(|| {
                self.run_until_stopped(job.clone(), &stop)
            }));
            job = left.unwrap_or_else(|_| {
                self.finished(Outcome::new(first, Status::Error, CRASHED));
                job.rest()
            });
        }
    }

    /// Each test in a process of its own.
    fn run_isolated(&self, mut job: Job, command: fn(&TestCase) -> Command) {
        while let Some(test) = job.left().first().cloned()
            && !self.is_to_end()
        {
            let stop = Arc::new(AtomicBool::new(false));
            job = job.rest();
            self.begin(&test, job.clone(), &stop);
            self.finished(isolated::run(command(&test), &test, &stop));
        }
    }

    fn run_property(&self, test: &Arc<TestCase>, job: &Job, stop: &Arc<AtomicBool>) -> Outcome {
        let property = Property {
            config: &self.shared.config,
            test,
            compiled: job.compiled.clone(),
            stop,
        };
        let (id, sender) = (self.id, self.sender.clone());
        // Without a receiver the run is over.
        let on_case = move || drop(sender.send((id, WorkerEvent::NextCase)));
        property.run(on_case, &mut |found| {
            let message = Message::Progress(Arc::clone(test), Box::new(found.clone()));
            self.send(WorkerEvent::Ready(message));
        })
    }

    /// Returns the job with the tests that are left.
    fn run_until_stopped(&self, mut job: Job, stop: &Arc<AtomicBool>) -> Job {
        let Some(first) = job.left().first().cloned() else {
            return job;
        };
        if first.property.is_some() {
            self.finished(self.run_property(&first, &job, stop));
            return job.rest();
        }
        let session = Session::of_tests(&self.shared.config, job.left(), None, Arc::clone(stop));
        let mut session = match session {
            Ok(session) => session,
            Err(outcome) => {
                self.finished(*outcome);
                return job.rest();
            }
        };
        let only = (job.left().len() == 1).then_some(first.index);
        let compiled = job.compiled.clone().filter(|_| session.takes_compiled());
        let loaded = session.load(&first.file, compiled, only);
        while let Some(test) = job.left().first().cloned()
            && !stop.load(Ordering::Relaxed)
            && !self.is_to_end()
        {
            job = job.rest();
            self.begin(&test, job.clone(), stop);
            let mut outcome = match &loaded {
                Err(broken) => Outcome {
                    test,
                    ..Outcome::clone(broken)
                },
                Ok(()) => session.run(&test),
            };
            let is_last = job.left().is_empty();
            if is_last {
                session.finish(&mut outcome);
            }
            session.take_line_counts(&mut outcome);
            session.note_capture(&mut outcome);
            if is_last || stop.load(Ordering::Relaxed) {
                // A hang or crash while the simulator is closed counts as a failure of the test.
                drop(session);
                self.finished(outcome);
                return job;
            }
            self.finished(outcome);
        }
        job
    }

    fn simulate(&self, job: &batch::Job) {
        let stop = Arc::new(AtomicBool::new(false));
        self.begin(&job.case, Job::none(), &stop);
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            batch::simulate(&self.shared.config, job, &stop)
        }));
        self.finished(
            outcome.unwrap_or_else(|_| Outcome::new(Arc::clone(&job.case), Status::Error, CRASHED)),
        );
    }

    fn finished(&self, outcome: Outcome) {
        self.send(WorkerEvent::Ready(Message::Finished(Box::new(outcome))));
    }
}
