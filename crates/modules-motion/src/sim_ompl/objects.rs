//! The state spaces and tasks of one script, by the handles it has of them.
//!
//! A handle is a text, `<hexadecimal number>:OMPL.<kind>`. The number holds that of the script, so that nobody takes the object of another script for his own.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use kinematics::Random;

use super::spaces::StateSpace;
use super::tasks::Task;
use super::{ApiError, Cx, Result, refused};

const TASK: &str = "OMPL.Task";
const SPACE: &str = "OMPL.StateSpace";
/// Handles of one script.
const NUMBERS_PER_SCRIPT: u64 = 1 << 32;

/// They end with the script.
#[derive(Default)]
pub(super) struct Objects {
    pub spaces: RefCell<BTreeMap<u64, StateSpace>>,
    pub tasks: RefCell<BTreeMap<u64, Rc<RefCell<Task>>>>,
    last: Cell<u64>,
}

/// How many generators of random numbers were made.
#[derive(Default)]
struct Generators(Cell<u64>);

pub(super) fn objects(cx: &Cx) -> Rc<Objects> {
    cx.script_state()
}

/// The task of a handle.
///
/// # Errors
/// When there is none.
pub(super) fn task(cx: &Cx, handle: &str) -> Result<Rc<RefCell<Task>>> {
    let number = number(handle, TASK)?;
    objects(cx)
        .tasks
        .borrow()
        .get(&number)
        .cloned()
        .ok_or_else(invalid)
}

pub(super) fn invalid() -> ApiError {
    refused("invalid object handle")
}

fn number(handle: &str, kind: &str) -> Result<u64> {
    let (digits, named) = handle.split_once(':').ok_or_else(invalid)?;
    u64::from_str_radix(digits, 16)
        .ok()
        .filter(|_| named == kind)
        .ok_or_else(invalid)
}

/// # Errors
/// When it is no handle of a task.
pub(super) fn task_number(handle: &str) -> Result<u64> {
    number(handle, TASK)
}

/// # Errors
/// When it is no handle of a state space.
pub(super) fn space_number(handle: &str) -> Result<u64> {
    number(handle, SPACE)
}

impl Objects {
    pub(super) fn add_space(&self, cx: &Cx, space: StateSpace) -> String {
        let number = self.next(cx);
        self.spaces.borrow_mut().insert(number, space);
        format!("{number:x}:{SPACE}")
    }

    pub(super) fn add_task(&self, cx: &Cx, task: Task) -> String {
        let number = self.next(cx);
        self.tasks
            .borrow_mut()
            .insert(number, Rc::new(RefCell::new(task)));
        format!("{number:x}:{TASK}")
    }

    fn next(&self, cx: &Cx) -> u64 {
        self.last.set(self.last.get() + 1);
        cx.script().id.unsigned_abs() * NUMBERS_PER_SCRIPT + self.last.get()
    }

    /// State spaces by their numbers.
    ///
    /// # Errors
    /// When one of them is gone.
    pub(super) fn spaces(&self, numbers: &[u64]) -> Result<Vec<StateSpace>> {
        let spaces = self.spaces.borrow();
        numbers
            .iter()
            .map(|number| spaces.get(number).cloned().ok_or_else(invalid))
            .collect()
    }
}

/// A generator of random numbers: each has a sequence of its own, which the simulator's seed decides.
pub(super) fn new_generator(cx: &Cx) -> Random {
    let made = cx.module_state::<Generators>();
    made.0.set(made.0.get() + 1);
    Random::new((u64::from(cx.options().seed) << 32) | (made.0.get() & 0xffff_ffff))
}
