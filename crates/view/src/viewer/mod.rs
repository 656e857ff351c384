//! The simulation's side of the viewer: between iterations it answers requests, and shows what changed.

mod capture;
mod frames;

use std::io;
use std::net::{SocketAddr, TcpListener};
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::busy::BusySign;
use crate::debugging::Debugging;
use crate::edit::{Editor, Pulls};
use crate::images::Images;
use crate::mirror::Demanded;
use crate::observe::{Observation, ObservedWindows, Observer, Source, WindowObserver};
use crate::perform::{perform, rows};
use crate::question::ask;
use crate::recording::Recording;
use crate::request::Action;
use crate::server::{Asked, RecordedSite, Shared, ViewSite};
use ::io::SiteServer;
use serde_json::Value;
use simulator::Simulator;

use script::log::RecentLine;
use script::{SimulationState, wall_clock};

/// Time between two observations: 60 a second.
const FRAME: Duration = Duration::from_micros(16_600);
/// The same for images, at most 10 a second.
const IMAGE: Duration = Duration::from_millis(100);
/// The same for values of properties, at most 5 a second.
const VALUES: Duration = Duration::from_millis(200);

pub use capture::CaptureViewer;

/// What a request of a page is called in a capture.
const REQUEST: &str = "a request of a page";

/// What pages asked for in a captured run, without pages.
#[derive(Default)]
pub struct ReplayedRequests(Editor);

impl ReplayedRequests {
    /// Performs what they asked for at this place of the run.
    pub fn perform(&mut self, sim: &mut Simulator) {
        let tape = sim.tape().clone();
        while tape.next_is(REQUEST) {
            let Ok(action) = tape.input(REQUEST, || Action::Pause) else {
                return;
            };
            // Only pages look at the answer.
            let _ = perform(sim, &action, &mut Vec::new(), &mut self.0);
        }
    }
}

/// Shows a simulator to pages. They are told of the end when this is dropped.
pub struct Viewer {
    observer: Observer,
    shared: Arc<Shared>,
    server: SiteServer,
    token: String,
    is_read_only: bool,
    /// The simulation waits for a page to let it go on.
    is_held: bool,
    /// Lines of the log that are not shown yet.
    lines: Vec<RecentLine>,
    windows: WindowObserver,
    frame: Timer,
    images: Timer,
    values: Timer,
    samples: Timer,
    images_shown: Images,
    sampled: Sampled,
    editor: Editor,
    pulls: Pulls,
    debugging: Option<Debugging>,
}

/// Of what numbers for pages were read last.
#[derive(Default)]
struct Sampled {
    moment: Option<(u64, u64)>,
    asked: Asked,
    /// Pages do not have them yet.
    is_new: bool,
}

/// Says when something is due again.
#[derive(Default)]
struct Timer(Option<Instant>);

impl Timer {
    fn is_due(&mut self, now: Instant, pause: Duration) -> bool {
        let due = self.0.is_none_or(|last| now.duration_since(last) >= pause);
        if due {
            self.0 = Some(now);
        }
        due
    }
}

impl Viewer {
    /// Serves pages that connect to `listener`. With `is_read_only` they cannot change anything.
    ///
    /// # Errors
    /// When the server cannot start.
    pub fn start(sim: &Simulator, listener: TcpListener, is_read_only: bool) -> io::Result<Self> {
        let viewer = Self::open(listener, is_read_only)?;
        viewer.attach(sim);
        Ok(viewer)
    }

    /// The same for pages that debug: they belong to the session of the simulator.
    ///
    /// # Errors
    /// When the server cannot start.
    pub fn start_with(
        sim: &Simulator,
        listener: TcpListener,
        debugging: &Debugging,
    ) -> io::Result<Self> {
        let is_read_only = debugging.is_read_only();
        let mut viewer = Self::serve(listener, Arc::clone(&debugging.shared), is_read_only)?;
        viewer.debugging = Some(debugging.clone());
        viewer.attach(sim);
        Ok(viewer)
    }

    /// The same for a simulator that is not attached yet.
    pub(crate) fn open(listener: TcpListener, is_read_only: bool) -> io::Result<Self> {
        Self::serve(listener, Arc::new(Shared::new(is_read_only)), is_read_only)
    }

    fn serve(listener: TcpListener, shared: Arc<Shared>, is_read_only: bool) -> io::Result<Self> {
        let token = ViewSite::new_token()?;
        let site = ViewSite::new(Arc::clone(&shared), token.clone());
        let server = SiteServer::start(listener, |_| site)?;
        shared.wake_by(server.waker());
        Ok(Self {
            observer: Observer::default(),
            shared,
            server,
            token,
            is_read_only,
            is_held: false,
            lines: Vec::new(),
            windows: WindowObserver::default(),
            frame: Timer::default(),
            images: Timer::default(),
            values: Timer::default(),
            samples: Timer::default(),
            images_shown: Images::default(),
            sampled: Sampled::default(),
            editor: Editor::default(),
            pulls: Pulls::default(),
            debugging: None,
        })
    }

    /// Pages answer the dialogs of the simulator and get its lines from now on.
    pub(crate) fn attach(&self, sim: &Simulator) {
        sim.keep_recent_lines();
        let (asks, waker) = (Arc::clone(&self.shared), self.server.waker());
        sim.set_person(Rc::new(move |question, is_ending| {
            ask(&asks, &waker, question, is_ending)
        }));
    }

    /// The simulation stands still until a page lets it go on.
    pub(crate) fn hold(&mut self) {
        self.is_held = true;
    }

    /// Whether it stands still that way: there are no iterations meanwhile.
    pub fn is_held(&self) -> bool {
        self.is_held
    }

    /// Where the page is.
    pub fn url(&self) -> String {
        url(self.server.address(), &self.token)
    }

    /// For a thread that watches the simulation's.
    pub fn busy_sign(&self) -> BusySign {
        BusySign {
            shared: Arc::clone(&self.shared),
            waker: self.server.waker(),
        }
    }

    /// Answers requests, waiting up to `timeout` for the first, and shows what changed if it is time for that.
    pub fn attend(&mut self, sim: &mut Simulator, timeout: Duration) {
        self.shared.attend();
        for pull in self.pulls.due(sim.steps()) {
            // A page that has to know asks itself.
            let _ = self.perform(sim, &pull);
        }
        let mut timeout = timeout;
        let mut answered = false;
        while let Some(pending) = self.shared.next_request(timeout) {
            timeout = Duration::ZERO;
            answered = true;
            self.editor.set_author(pending.author);
            let result = self.perform(sim, &pending.action);
            self.is_held &= result.is_err() || !lets_go_on(&pending.action);
            pending.answer(result);
            // Code may run for a long time: its effects are shown before the next request.
            if matches!(pending.action, Action::Run(_)) {
                break;
            }
        }
        self.sample(sim);
        if self.frame.is_due(wall_clock::now(), FRAME) || answered {
            self.show(sim);
        }
        if answered {
            self.server.waker().wake();
        }
    }

    /// Reads the numbers that pages follow, once for each step, and at once when they are others.
    pub(crate) fn sample(&mut self, sim: &Simulator) {
        let asked = self.shared.asked();
        let moment = Some((sim.steps(), sim.time().to_bits()));
        let is_followed = asked.items.is_some();
        if self.sampled.asked == asked && (!is_followed || self.sampled.moment == moment) {
            return self.sample_again(sim);
        }
        match &asked.items {
            Some(items) => self.shared.samples().take(sim, items),
            None => self.shared.samples().forget(),
        }
        self.sampled = Sampled {
            moment,
            asked,
            is_new: is_followed,
        };
    }

    /// The same now and then while there are no steps.
    fn sample_again(&mut self, sim: &Simulator) {
        if self.sampled.asked.items.is_some() && self.samples.is_due(wall_clock::now(), VALUES) {
            self.sampled.is_new |= self.shared.samples().take_again(sim);
        }
    }

    fn perform(&mut self, sim: &mut Simulator, action: &Action) -> Result<Value, String> {
        if let Some(answer) = self.pulls.repeated(action, sim.steps()) {
            return Ok(answer);
        }
        if self.editor.takes_snapshot(sim, action) {
            self.let_go(sim);
        }
        sim.tape().add(REQUEST, action);
        let answer = perform(sim, action, &mut self.lines, &mut self.editor);
        self.pulls.note(action, sim.steps(), &answer);
        self.look_again(action, answer.is_err());
        self.note_python(sim, action);
        answer
    }

    /// Whoever changes a text has read it before: from then on it can be checked.
    fn note_python(&self, sim: &Simulator, action: &Action) {
        if let Action::Script(handle) = action {
            let command = sim.python_command(*handle).ok().flatten();
            self.shared.check_python_with(command);
        }
    }

    /// Breakpoints lie in the memory of scripts, which an undo has brought back, and what has failed.
    fn look_again(&self, action: &Action, has_failed: bool) {
        let is_back = matches!(action, Action::Undo { .. } | Action::Redo { .. });
        if let Some(debugging) = &self.debugging
            && (is_back || (has_failed && action.is_edit()))
        {
            debugging.set_again();
        }
    }

    /// Keeps nothing that lies in the memory of the simulator, which may be taken back.
    fn let_go(&mut self, sim: &Simulator) {
        self.lines.extend(sim.take_recent_lines());
        self.observer.let_go(&sim.scene());
        self.windows = WindowObserver::default();
    }

    /// Shows what changed since the last time; nothing while there are no pages.
    fn show(&mut self, sim: &Simulator) {
        self.lines.extend(sim.take_recent_lines());
        let surplus = self.lines.len().saturating_sub(crate::mirror::LOG_LINES);
        self.lines.drain(..surplus);
        if !self.shared.has_pages() {
            self.observer.pause();
            return;
        }
        let lines = std::mem::take(&mut self.lines);
        let seen = {
            let scene = sim.scene();
            let mut source = Source {
                is_read_only: self.is_read_only,
                edits: self.editor.describe(sim),
                has_debugger: self.shared.has_debugger(),
                ..Source::of(sim, &scene)
            };
            if self.is_held && source.now.state != SimulationState::Stopped {
                source.now.state = SimulationState::Paused;
            }
            self.observer.observe(&source, &lines)
        };
        let windows = self.windows.observe(sim);
        let found = self.find_demanded(sim);
        self.publish(seen, windows, found);
    }

    /// Pages get what was found.
    fn publish(&mut self, seen: Observation, windows: Option<ObservedWindows>, found: Demanded) {
        if let Some(debugging) = self.debugging.as_ref().filter(|_| seen.is_another_scene) {
            debugging.forget();
        }
        let changed = {
            let mut mirror = self.shared.mirror();
            let mut changed = mirror.apply(seen);
            changed |= windows.is_some_and(|windows| mirror.apply_windows(windows));
            mirror.apply_demanded(found) || changed
        };
        if std::mem::take(&mut self.sampled.is_new) || changed {
            self.server.waker().wake();
        }
    }

    /// What some pages ask for.
    fn find_demanded(&mut self, sim: &Simulator) -> Demanded {
        let (demand, inspected) = self.shared.demand();
        let now = wall_clock::now();
        let mut found = Demanded::default();
        if !demand.sensors.is_empty() && self.images.is_due(now, IMAGE) {
            self.images_shown.keep(&demand.sensors);
            let scene = sim.scene();
            let mut new_image = |sensor: i64| {
                Some((
                    sensor,
                    self.images_shown.new_image(&scene, sensor, sim.time())?,
                ))
            };
            found.images = demand
                .sensors
                .iter()
                .filter_map(|sensor| new_image(*sensor))
                .collect();
        }
        if demand.contacts {
            found.contacts = Some(contacts(sim));
        }
        if self.values.is_due(now, VALUES) {
            self.shared
                .mirror()
                .forget_unwanted(&inspected, &demand.sensors);
            found.rows = inspected
                .iter()
                .filter_map(|handle| Some((*handle, values(sim, *handle)?)))
                .collect();
        }
        found
    }
}

/// Whether the simulation goes on after such a request.
fn lets_go_on(action: &Action) -> bool {
    matches!(action, Action::Play | Action::Stop | Action::Step(_))
}

impl Drop for Viewer {
    fn drop(&mut self) {
        self.shared.end("The simulator has ended.");
        self.server.waker().wake();
    }
}

/// The contacts of the last sub-step as a message.
fn contacts(sim: &Simulator) -> Vec<u8> {
    let contacts = sim.last_contacts();
    let mut message = vec![3, 0, 0, 0];
    message.extend_from_slice(&(contacts.len() as u32).to_le_bytes());
    message.extend_from_slice(&sim.time().to_le_bytes());
    for contact in &contacts {
        for shape in contact.shapes {
            message.extend_from_slice(&(shape.raw() as i32).to_le_bytes());
        }
        for number in contact
            .point
            .iter()
            .chain(&contact.normal)
            .chain(&contact.force)
        {
            message.extend_from_slice(&(*number as f32).to_le_bytes());
        }
    }
    message
}

/// Names and rows of the properties of an object that is inspected; None when it is gone.
fn values(sim: &Simulator, handle: i64) -> Option<Vec<(String, String)>> {
    let rows = rows(sim, handle).ok()?;
    Some(
        rows.into_iter()
            .map(|(name, row)| (name, row.to_string()))
            .collect(),
    )
}

/// Shows a recording to pages, as long as this is there.
pub struct RecordedViewer {
    server: SiteServer,
    token: String,
}

impl RecordedViewer {
    /// Serves pages that connect to `listener`.
    ///
    /// # Errors
    /// When the server cannot start.
    pub fn start<R: io::Read + io::Seek + Send + Sync + 'static>(
        recording: Recording<R>,
        listener: TcpListener,
    ) -> io::Result<Self> {
        let token = ViewSite::new_token()?;
        let site = RecordedSite::new(recording, token.clone());
        Ok(Self {
            server: SiteServer::start(listener, |_| site)?,
            token,
        })
    }

    /// Where the page is.
    pub fn url(&self) -> String {
        url(self.server.address(), &self.token)
    }
}

/// The address of a page, one that a browser can connect to also where the server listens at all of the machine's.
fn url(mut address: SocketAddr, token: &str) -> String {
    if address.ip().is_unspecified() {
        address.set_ip(if address.is_ipv4() {
            [127, 0, 0, 1].into()
        } else {
            [0, 0, 0, 0, 0, 0, 0, 1].into()
        });
    }
    format!("http://{address}/{token}/")
}
