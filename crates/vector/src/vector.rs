//! All worlds of an environment.

use std::sync::Arc;

use crate::arrays::{Array, Arrays, Item};
use crate::declaration::Declaration;
use crate::interruption::{StopSign, WantsEnd, gather};
use crate::recordings::Recording;
use crate::worker::{Command, Failure, Worker};
use crate::world::Layout;

/// Many worlds that step together.
pub struct Vector {
    workers: Vec<Worker>,
    arrays: Arc<Arrays>,
    layout: Layout,
    count: usize,
    stop: StopSign,
    wants_end: WantsEnd,
}

impl Vector {
    /// `count` worlds on `threads` threads; their first episodes begin with [`begin`](Self::begin). `wants_end` is asked now and whenever
    /// something takes long.
    ///
    /// # Errors
    /// When there are none, or one cannot be made.
    pub fn new(
        declaration: Declaration,
        count: usize,
        threads: usize,
        mut wants_end: WantsEnd,
    ) -> Result<Self, Failure> {
        let fault = |reason: String| Failure { world: 0, reason };
        if count == 0 {
            return Err(fault("there are no worlds.".into()));
        }
        let stop = StopSign::default();
        let workers = start(&Arc::new(declaration), count, threads, &stop);
        let workers = workers.map_err(|error| fault(format!("there is no thread: {error}")))?;
        let layouts = gather(&workers, &stop, &mut wants_end, Worker::layout);
        let layouts: Result<Vec<Layout>, Failure> = layouts.into_iter().collect();
        let layout = layouts?.swap_remove(0);
        Ok(Self {
            workers,
            arrays: Arc::new(arrays(&layout, count)),
            layout,
            count,
            stop,
            wants_end,
        })
    }

    /// How many worlds there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// How many threads there are.
    pub fn threads(&self) -> usize {
        self.workers.len()
    }

    /// How wide the rows of the arrays are.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// What worlds read and write.
    pub fn arrays(&self) -> &Arc<Arrays> {
        &self.arrays
    }

    /// Begins an episode in these worlds. All that is random in it, and in those to come, follows from the seed, where there is one.
    pub fn begin(&mut self, worlds: &[(usize, Option<u32>)]) -> Vec<Failure> {
        let worlds: Arc<[_]> = worlds.into();
        self.run(|arrays| Command::Begin(arrays, Arc::clone(&worlds)))
    }

    /// Steps all worlds with the actions in the arrays; those in `resets` begin an episode instead. Worlds that have failed wait until
    /// then.
    ///
    /// # Errors
    /// The world and the place of an action that is no finite number: then nothing has happened.
    pub fn step(&mut self) -> Result<Vec<Failure>, (usize, usize)> {
        for world in 0..self.count {
            if self.arrays.resets.get(world) != 0 {
                continue;
            }
            let mut actions = self.arrays.actions.row(world).iter().map(f64::get);
            if let Some(place) = actions.position(|action| !action.is_finite()) {
                return Err((world, place));
            }
        }
        Ok(self.run(Command::Step))
    }

    /// Draws the pictures of the camera at that place in all worlds.
    pub fn draw(&mut self, camera: usize) -> Vec<Failure> {
        self.run(|arrays| Command::Draw(arrays, camera))
    }

    /// Records the next episodes of worlds, each in a file, which is complete after [`finish_recordings`](Self::finish_recordings), when
    /// another episode has begun, and when the worlds are dropped. The failures are of files that cannot be written; such an episode is not
    /// recorded.
    pub fn record(&mut self, recordings: &[Recording]) -> Vec<Failure> {
        let recordings: Arc<[_]> = recordings.into();
        self.run(|_| Command::Record(Arc::clone(&recordings)))
    }

    /// Completes the recordings of these worlds' present episodes; the failures are of files that could not be written.
    pub fn finish_recordings(&mut self, worlds: &[usize]) -> Vec<Failure> {
        let worlds: Arc<[_]> = worlds.into();
        self.run(|_| Command::FinishRecordings(Arc::clone(&worlds)))
    }

    fn run(&mut self, command: impl Fn(Arc<Arrays>) -> Command) -> Vec<Failure> {
        for worker in &self.workers {
            worker.send(command(Arc::clone(&self.arrays)));
        }
        let done = gather(&self.workers, &self.stop, &mut self.wants_end, Worker::wait);
        done.into_iter().flatten().collect()
    }
}

/// Starts the threads; each has as many worlds as the others, or one more.
fn start(
    declaration: &Arc<Declaration>,
    count: usize,
    threads: usize,
    stop: &StopSign,
) -> std::io::Result<Vec<Worker>> {
    let threads = threads.clamp(1, count);
    let bound = |thread: usize| thread * count / threads;
    let start = |thread: usize| {
        let worlds = bound(thread)..bound(thread + 1);
        Worker::start(Arc::clone(declaration), worlds, stop.clone())
    };
    (0..threads).map(start).collect()
}

fn arrays(layout: &Layout, count: usize) -> Arrays {
    let side = scene::numbers::place;
    let image = |[width, height]: &[u32; 2]| Array::new(count, 3 * side(*width) * side(*height), 0);
    Arrays {
        actions: Array::new(count, layout.actions, 0.0),
        observations: Array::new(count, layout.observations.iter().sum(), 0.0),
        infos: Array::new(count, layout.infos.iter().sum(), 0.0),
        rewards: Array::new(count, 1, 0.0),
        terminated: Array::new(count, 1, 0),
        truncated: Array::new(count, 1, 0),
        resets: Array::new(count, 1, 0),
        failed: Array::new(count, 1, 0),
        images: layout.images.iter().map(image).collect(),
    }
}
