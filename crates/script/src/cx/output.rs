//! Printed and logged output, and its capture by tests. Output changes nothing a script can read back, so `&Cx` suffices.

use std::rc::Rc;

use super::Cx;
use crate::coverage::LineCounts;
use crate::test_bench::TestBench;

impl Cx<'_> {
    /// A line of a script's `print`.
    pub fn print(&self, line: &[u8]) {
        let origin = || self.script().log_name(&self.sim.scene.borrow());
        self.sim
            .log
            .print(line, self.sim.clock.time(), self.script().id, origin);
    }

    /// Remembers a path that leads to no object, for the hint beside the error.
    pub fn note_missing_path(&self, path: &str) {
        self.sim.log.note_missing_path(path);
    }

    /// Remembers the name of a scene or model of which there is no file, for the hint beside the error.
    pub fn note_missing_file(&self, name: &str) {
        self.sim.log.note_missing_file(name);
    }

    /// Number of uncaught script errors.
    pub fn errors(&self) -> u64 {
        self.sim.log.errors()
    }

    /// What the simulator has open that is no memory, by names for users.
    pub fn open_resources(&self) -> Vec<String> {
        self.sim.open_resources()
    }

    /// What `work` computes, in the memory of the program. All that it did is undone: see [`Sim::undone`](crate::Sim::undone).
    pub fn undone<T: Clone>(&self, work: impl FnOnce() -> T) -> heap::Outer<T> {
        let sim = &self.sim;
        heap::Outer::new(sim.undone(|| sim.copied_out(|_| work())))
    }

    /// The same again and again, as long as `goes_on` says of the result; the last one.
    pub fn undone_while<T: Clone>(
        &self,
        mut work: impl FnMut() -> T,
        goes_on: impl FnMut(&T) -> bool,
    ) -> heap::Outer<T> {
        let sim = &self.sim;
        let work = || sim.copied_out(|_| work());
        heap::Outer::new(sim.undone_while(work, goes_on))
    }

    /// The connection to the test runner, if this is a test.
    pub fn test_bench(&self) -> Option<&Rc<TestBench>> {
        self.sim.test_bench.get()
    }

    /// The counts of the lines of all scripts since the last call.
    pub fn take_line_counts(&self) -> LineCounts {
        self.sim.take_line_counts()
    }

    /// Adds lines that another simulator has counted.
    pub fn add_line_counts(&mut self, counts: LineCounts) {
        self.sim.line_counts.borrow_mut().merge(counts);
    }
}
