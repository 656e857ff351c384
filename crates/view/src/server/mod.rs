//! The server of the viewer: what its threads and the simulation's thread share, addresses, and one visitor for each page.

mod assets;
mod python_check;
mod recorded;
mod reference;
mod site;
mod visitor;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use serde_json::{Value, json};

use super::mirror::Mirror;
use super::request::Action;
use super::sample::{Followed, Samples};
pub use assets::page_file;
use io::SiteWaker;
use python_check::PythonCheck;
pub(crate) use recorded::RecordedSite;
pub(crate) use site::ViewSite;

/// Requests that wait for the simulation; more are refused.
const MAX_REQUESTS: usize = 1000;

/// Number of a page, as long as it is connected.
pub(crate) type PageId = u64;

/// What pages and simulation share. Locks are held for moments only.
#[derive(Default)]
pub(crate) struct Shared {
    mirror: Mutex<Mirror>,
    demand: Mutex<Demand>,
    samples: Mutex<Samples>,
    requests: Mutex<VecDeque<Pending>>,
    arrived: Condvar,
    is_read_only: bool,
    /// Whether pages debug scripts.
    has_debugger: AtomicBool,
    /// What is shown is a capture.
    is_capture: AtomicBool,
    /// How many dialogs were shown.
    questions: AtomicU64,
    /// A dialog waits for its answer.
    asks: AtomicBool,
    /// A page has asked for a stop that is not carried out yet.
    stop_requested: AtomicBool,
    busy: Mutex<Busy>,
    /// What checks texts in Python.
    python: PythonCheck,
    /// Pages are told of what is new by it.
    waker: OnceLock<SiteWaker>,
    /// Why the simulator ends, once it does.
    end: Mutex<Option<String>>,
}

/// What pages want to see beyond what all see.
#[derive(Default)]
pub(crate) struct Demand {
    pages: BTreeMap<PageId, PageDemand>,
    opened: PageId,
    /// What any page follows.
    asked: Asked,
}

/// The numbers that pages have asked for.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Asked {
    /// How often they have.
    times: u64,
    /// All that they follow, sorted; nothing if there is nothing.
    pub items: Option<Arc<[Followed]>>,
}

#[derive(Debug, Clone, Default)]
pub(crate) struct PageDemand {
    pub sensors: BTreeSet<i64>,
    pub inspected: Option<i64>,
    pub contacts: bool,
    pub followed: Vec<Followed>,
}

impl Demand {
    fn gather_followed(&mut self) {
        let all: BTreeSet<&Followed> = self
            .pages
            .values()
            .flat_map(|page| &page.followed)
            .collect();
        self.asked.items = (!all.is_empty()).then(|| all.into_iter().cloned().collect());
    }
}

/// What the simulation's thread is busy with; numbered, so that pages are told once.
#[derive(Default)]
struct Busy {
    sentence: Option<String>,
    changes: u64,
}

/// A request on its way to the simulation.
pub(crate) struct Pending {
    pub id: Value,
    pub action: Action,
    /// The number of the page, if it has said who it is.
    pub author: Option<u64>,
    pub replies: Arc<Mutex<VecDeque<String>>>,
}

impl Pending {
    /// Answers; the page gets it when it is woken.
    pub(crate) fn answer(&self, result: Result<Value, String>) {
        lock(&self.replies).push_back(reply(&self.id, result));
    }
}

/// The reply to a request.
fn reply(id: &Value, result: Result<Value, String>) -> String {
    match result {
        Ok(result) => json!({ "type": "reply", "id": id, "result": result }),
        Err(error) => json!({ "type": "reply", "id": id, "error": error }),
    }
    .to_string()
}

/// Data behind these locks are whole at any time, also after a panic of somebody who held one.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Shared {
    pub(crate) fn new(is_read_only: bool) -> Self {
        Self {
            is_read_only,
            ..Self::default()
        }
    }

    pub(crate) fn mirror(&self) -> MutexGuard<'_, Mirror> {
        lock(&self.mirror)
    }

    /// Says whether what is shown is a capture.
    pub(crate) fn set_capture(&self, is_capture: bool) {
        self.is_capture.store(is_capture, Ordering::Relaxed);
    }

    /// Whether pages may ask for it. All may go to another moment of a capture.
    fn permits(&self, action: &Action) -> bool {
        let is_free = self.is_capture.load(Ordering::Relaxed) && action.moves_in_time();
        !self.is_read_only || is_free || !action.changes_something()
    }

    /// Whether any page is connected.
    pub(crate) fn has_pages(&self) -> bool {
        !lock(&self.demand).pages.is_empty()
    }

    /// The number of the next dialog, from 1.
    pub(crate) fn number_question(&self) -> u64 {
        self.questions.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Whether any page is connected that may answer.
    pub(crate) fn has_persons(&self) -> bool {
        !self.is_read_only && self.has_pages()
    }

    /// What all pages together want.
    pub(crate) fn demand(&self) -> (PageDemand, BTreeSet<i64>) {
        let demand = lock(&self.demand);
        let mut all = PageDemand::default();
        let mut inspected = BTreeSet::new();
        for page in demand.pages.values() {
            all.sensors.extend(&page.sensors);
            all.contacts |= page.contacts;
            inspected.extend(page.inspected);
        }
        (all, inspected)
    }

    /// The numbers that pages follow.
    pub(crate) fn asked(&self) -> Asked {
        lock(&self.demand).asked.clone()
    }

    pub(crate) fn samples(&self) -> MutexGuard<'_, Samples> {
        lock(&self.samples)
    }

    /// The next request, but for those of the debugger, who takes them himself; waits for one up to a time limit.
    pub(crate) fn next_request(&self, timeout: Duration) -> Option<Pending> {
        self.next_of(timeout, |action| !matches!(action, Action::Debug(_)))
    }

    /// The next request that is `wanted`; waits for one up to a time limit, and no longer than until any arrives.
    pub(crate) fn next_of(
        &self,
        timeout: Duration,
        wanted: impl Fn(&Action) -> bool,
    ) -> Option<Pending> {
        let mut requests = lock(&self.requests);
        let place = |requests: &VecDeque<Pending>| {
            let mut actions = requests.iter().map(|pending| &pending.action);
            actions.position(&wanted)
        };
        if place(&requests).is_none() && !timeout.is_zero() {
            let waited = self.arrived.wait_timeout(requests, timeout);
            requests = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        place(&requests).and_then(|place| requests.remove(place))
    }

    /// Waits until a request arrives, up to a time limit.
    pub(crate) fn wait_for_request(&self, timeout: Duration) {
        drop(self.arrived.wait_timeout(lock(&self.requests), timeout));
    }

    /// Whether requests to the debugger wait for code that runs.
    pub(crate) fn has_debug_requests(&self) -> bool {
        let requests = lock(&self.requests);
        let mut actions = requests.iter().map(|pending| &pending.action);
        actions.any(|action| matches!(action, Action::Debug(_)))
    }

    /// Pages debug scripts from now on.
    pub(crate) fn allow_debugging(&self) {
        self.has_debugger.store(true, Ordering::Relaxed);
    }

    pub(crate) fn has_debugger(&self) -> bool {
        self.has_debugger.load(Ordering::Relaxed)
    }

    /// Texts in Python are checked by this program with these arguments. Who may only read starts none.
    pub(crate) fn check_python_with(&self, command: Option<Vec<String>>) {
        self.python.set(command.filter(|_| !self.is_read_only));
    }

    /// Pages are told by it of what is new.
    pub(crate) fn wake_by(&self, waker: SiteWaker) {
        // There is one server.
        let _ = self.waker.set(waker);
    }

    pub(crate) fn wake(&self) {
        if let Some(waker) = self.waker.get() {
            waker.wake();
        }
    }

    /// A request waits for the simulation; false when there is no room.
    pub(crate) fn submit(&self, pending: Pending) -> bool {
        let mut requests = lock(&self.requests);
        let has_room = requests.len() < MAX_REQUESTS;
        if has_room {
            if matches!(pending.action, Action::Stop) {
                self.stop_requested.store(true, Ordering::Relaxed);
            }
            requests.push_back(pending);
            self.arrived.notify_one();
        }
        has_room
    }

    /// The simulation's thread attends to requests again.
    pub(crate) fn attend(&self) {
        self.stop_requested.store(false, Ordering::Relaxed);
    }

    pub(crate) fn stop_is_requested(&self) -> bool {
        self.stop_requested.load(Ordering::Relaxed)
    }

    pub(crate) fn set_asking(&self, asks: bool) {
        self.asks.store(asks, Ordering::Relaxed);
    }

    pub(crate) fn is_asking(&self) -> bool {
        self.asks.load(Ordering::Relaxed)
    }

    /// Sets what the simulation's thread is busy with; false when that is not new.
    pub(crate) fn set_busy(&self, sentence: Option<String>) -> bool {
        let mut busy = lock(&self.busy);
        let is_new = busy.sentence != sentence;
        if is_new {
            busy.sentence = sentence;
            busy.changes += 1;
        }
        is_new
    }

    /// What the thread is busy with, with the number of the change, if that is another than `seen`.
    fn busy_since(&self, seen: u64) -> Option<(u64, Option<String>)> {
        let busy = lock(&self.busy);
        (busy.changes != seen).then(|| (busy.changes, busy.sentence.clone()))
    }

    /// The simulator ends: pages are told why.
    pub(crate) fn end(&self, reason: &str) {
        lock(&self.end).get_or_insert_with(|| reason.to_owned());
    }

    fn end_reason(&self) -> Option<String> {
        lock(&self.end).clone()
    }

    fn add_page(&self) -> PageId {
        let mut demand = lock(&self.demand);
        demand.opened += 1;
        let page = demand.opened;
        demand.pages.insert(page, PageDemand::default());
        page
    }

    fn change_demand(&self, page: PageId, change: impl FnOnce(&mut PageDemand)) {
        let mut demand = lock(&self.demand);
        if let Some(wanted) = demand.pages.get_mut(&page) {
            change(wanted);
            demand.gather_followed();
        }
    }

    /// A page follows these numbers from now on. It gets them once in any case, also where they were followed before and do not change.
    fn follow(&self, page: PageId, followed: Vec<Followed>) {
        lock(&self.demand).asked.times += 1;
        self.change_demand(page, |demand| demand.followed = followed);
    }

    fn remove_page(&self, page: PageId) {
        let mut demand = lock(&self.demand);
        demand.pages.remove(&page);
        demand.gather_followed();
    }
}
